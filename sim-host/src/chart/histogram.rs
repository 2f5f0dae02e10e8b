//! How values are distributed: panels of bars, those of failures on top of the others.

use super::axes::{Axis, axes};
use super::style::{
    COLORS, ChartError, LEGEND_WIDTH, Painted, TITLE_HEIGHT, WIDTH, at, drawn, font, label, points,
    range,
};
use plotters::coord::Shift;
use plotters::prelude::*;

/// A panel.
#[derive(Clone, Debug)]
pub struct Histogram {
    /// What the values are.
    pub axis: String,
    /// Of runs that did not fail.
    pub worked: Vec<f64>,
    /// Of runs that failed.
    pub failed: Vec<f64>,
}

/// Bars of a panel.
const BARS: usize = 40;
const HEIGHT: u32 = 190;
const PALE: RGBColor = RGBColor(150, 180, 205);

impl Histogram {
    /// Draws panels, one below the other, as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(title: &str, panels: &[Self]) -> Result<String, ChartError> {
        let height = TITLE_HEIGHT + HEIGHT * panels.len().max(1) as u32;
        drawn(title, (WIDTH, height), |root| {
            let area = root.titled(title, font(20))?;
            for (panel, area) in panels.iter().zip(area.split_evenly((panels.len().max(1), 1))) {
                panel.paint(&area)?;
            }
            Ok(())
        })
    }

    fn paint(&self, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let (plot, legend) = area.split_horizontally(points(WIDTH - LEGEND_WIDTH));
        let (from, to) = range(self.worked.iter().chain(&self.failed).copied());
        let width = (to - from) / BARS as f64;
        let counts = |values: &[f64]| {
            let mut counts = [0_u32; BARS];
            for value in values {
                counts[(((value - from) / width) as usize).min(BARS - 1)] += 1;
            }
            counts
        };
        let (worked, failed) = (counts(&self.worked), counts(&self.failed));
        let most = worked.iter().zip(&failed).map(|(a, b)| a + b).max().unwrap_or(0).max(1);
        let x_label = |v: &f64| label(*v, to - from);
        let y_label = |v: &f64| format!("{v:.0}");
        let across = Axis { range: from..to, description: &self.axis, label: &x_label };
        let up = Axis { range: 0.0..1.05 * f64::from(most), description: "runs", label: &y_label };
        let mut plane = axes(&plot, across, up)?;
        let bars = |low: [u32; BARS], high: [u32; BARS], color: RGBColor| {
            (0..BARS).filter(move |k| high[*k] > low[*k]).map(move |k| {
                let left = from + width * k as f64;
                let corners = [(left, f64::from(low[k])), (left + width, f64::from(high[k]))];
                Rectangle::new(corners, color.filled())
            })
        };
        let mut both = worked;
        both.iter_mut().zip(failed).for_each(|(both, failed)| *both += failed);
        plane.draw_series(bars([0; BARS], worked, PALE))?;
        plane.draw_series(bars(worked, both, COLORS[1]))?;
        for (line, (color, name)) in
            [(PALE, "no failure"), (COLORS[1], "failed")].into_iter().enumerate()
        {
            let y = at(30 + 19 * line as i32);
            legend
                .draw(&Rectangle::new([(at(8), y - at(6)), (at(22), y + at(6))], color.filled()))?;
            legend.draw(&Text::new(name, (at(30), y - at(7)), font(14)))?;
        }
        Ok(())
    }
}
