//! One quantity against another, on plain or logarithmic axes.

use super::axes::{Axis, Plane, axes, power, powers};
use super::style::{
    COLORS, ChartError, LEGEND_WIDTH, PANEL_HEIGHT, Painted, TITLE_HEIGHT, WIDTH, drawn, font,
    label, names, points, range, write,
};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A named curve.
#[derive(Clone, Debug)]
pub struct XySeries {
    /// Name in the legend.
    pub name: String,
    /// Points, in order.
    pub points: Vec<(f64, f64)>,
    /// Rings at the points instead of a curve through them, as for data of others.
    pub rings: bool,
}

impl XySeries {
    /// A curve.
    pub fn curve(name: impl Into<String>, points: impl Iterator<Item = (f64, f64)>) -> Self {
        Self { name: name.into(), points: points.collect(), rings: false }
    }

    /// `y` against `x`.
    pub fn against(name: impl Into<String>, x: &[f64], y: &[f64]) -> Self {
        Self::curve(name, x.iter().copied().zip(y.iter().copied()))
    }

    /// The same as rings.
    pub fn rings(self) -> Self {
        Self { rings: true, ..self }
    }
}

/// A chart, and perhaps others below it.
#[derive(Clone, Debug)]
pub struct XyChart {
    title: String,
    x_axis: String,
    y_axis: String,
    logarithmic: bool,
    series: Vec<XySeries>,
    below: Vec<XyChart>,
}

impl XyChart {
    /// Empty, on plain axes.
    pub fn new(title: impl Into<String>, x_axis: &str, y_axis: &str) -> Self {
        Self {
            title: title.into(),
            x_axis: x_axis.to_owned(),
            y_axis: y_axis.to_owned(),
            logarithmic: false,
            series: Vec::new(),
            below: Vec::new(),
        }
    }

    /// On logarithmic axes, with a mark at every point. Points that are not positive have no place
    /// there and are left out.
    pub fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    /// With these curves.
    pub fn with(self, series: Vec<XySeries>) -> Self {
        Self { series, ..self }
    }

    /// With another chart below.
    pub fn below(mut self, chart: Self) -> Self {
        self.below.push(chart);
        self
    }

    /// Draws it as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(&self) -> Result<String, ChartError> {
        let panels = 1 + self.below.len() as u32;
        let height = TITLE_HEIGHT + (PANEL_HEIGHT + 80) * panels;
        drawn(&self.title, (WIDTH, height), |root| self.paint(root))
    }

    /// Draws it to an SVG file.
    ///
    /// # Errors
    /// [`ChartError`] if the file cannot be written.
    pub fn draw(&self, path: &Path) -> Result<(), ChartError> {
        write(path, &self.svg()?)
    }

    fn paint(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let areas = root.split_evenly((1 + self.below.len(), 1));
        for (chart, area) in std::iter::once(self).chain(&self.below).zip(areas) {
            let area = area.titled(&chart.title, font(20))?;
            let (plot, legend) = area.split_horizontally(points(WIDTH - LEGEND_WIDTH));
            let (x, y) = (chart.range(|(x, _)| x), chart.range(|(_, y)| y));
            let (x_axis, y_axis) = (chart.x_axis.as_str(), chart.y_axis.as_str());
            if chart.logarithmic {
                let axis = |description, (from, to): (f64, f64)| Axis {
                    range: (from..to).log_scale(),
                    description,
                    label: &power,
                };
                chart.curves(axes(&plot, axis(x_axis, x), axis(y_axis, y))?)?;
            } else {
                let x_label = |v: &f64| label(*v, x.1 - x.0);
                let y_label = |v: &f64| label(*v, y.1 - y.0);
                let across = Axis { range: x.0..x.1, description: x_axis, label: &x_label };
                let up = Axis { range: y.0..y.1, description: y_axis, label: &y_label };
                chart.curves(axes(&plot, across, up)?)?;
            }
            names(&legend, chart.series.iter().map(|series| (series.name.as_str(), series.rings)))?;
        }
        Ok(())
    }

    fn curves<X, Y>(&self, mut chart: Plane<'_, '_, X, Y>) -> Painted
    where
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        for (i, series) in self.series.iter().enumerate() {
            let color = COLORS[i % COLORS.len()];
            let shown = self.shown(series);
            if series.rings {
                let style = color.stroke_width(points(2));
                chart.draw_series(shown.map(|point| Circle::new(point, points(7), style)))?;
                continue;
            }
            if i < COLORS.len() {
                chart.draw_series(LineSeries::new(shown.clone(), color.stroke_width(points(2))))?;
            } else {
                let style = color.stroke_width(points(2));
                chart.draw_series(DashedLineSeries::new(shown.clone(), 7, 4, style))?;
            }
            if self.logarithmic {
                chart.draw_series(
                    shown.map(|point| Circle::new(point, points(3), color.filled())),
                )?;
            }
        }
        Ok(())
    }

    fn shown<'a>(&self, series: &'a XySeries) -> impl Iterator<Item = (f64, f64)> + Clone + 'a {
        let logarithmic = self.logarithmic;
        series.points.iter().copied().filter(move |(x, y)| {
            x.is_finite() && y.is_finite() && !(logarithmic && (*x <= 0.0 || *y <= 0.0))
        })
    }

    /// Range of one coordinate; whole powers of ten on logarithmic axes.
    fn range(&self, of: impl Fn((f64, f64)) -> f64 + Clone) -> (f64, f64) {
        let values = self.series.iter().flat_map(|series| self.shown(series)).map(of);
        if self.logarithmic { powers(values) } else { range(values) }
    }
}
