//! Curves over time: panels below each other on one time axis.

use super::style::{
    COLORS, ChartError, LEGEND_WIDTH, PANEL_HEIGHT, Painted, TITLE_HEIGHT, WIDTH, at, drawn, font,
    label, names, points, range,
};
use plotters::coord::Shift;
use plotters::prelude::*;
use serde::Serialize;

/// A named curve.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Values, one a time.
    pub values: Vec<f64>,
}

/// One set of axes.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What is shown.
    pub title: String,
    /// Quantity and unit.
    pub axis: String,
    /// Curves.
    pub series: Vec<Series>,
}

/// A moment that is marked by a vertical line, and listed beside the first panel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// s
    pub time_s: f64,
    /// What happened, in a few letters.
    pub label: String,
}

/// Curves over time with their marks.
#[derive(Clone, Debug)]
pub struct TimeSeries<'a> {
    /// Above all panels.
    pub title: String,
    /// Times of all values, s.
    pub times: &'a [f64],
    /// Axes, from top to bottom.
    pub panels: Vec<Panel>,
    /// Moments.
    pub marks: &'a [Mark],
}

/// Marks that the legend has room for.
const LISTED_MARKS: usize = 8;

/// Columns of a panel in which a curve has at most its lowest and its highest value drawn.
const COLUMNS: usize = 700;

impl TimeSeries<'_> {
    /// Draws all panels with a common time axis as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if they cannot be drawn.
    pub fn svg(&self) -> Result<String, ChartError> {
        let height = TITLE_HEIGHT + PANEL_HEIGHT * self.panels.len() as u32;
        drawn(&self.title, (WIDTH, height), |root| self.paint(root))
    }

    fn paint(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let area = root.margin(at(8), 0, 0, 0).titled(&self.title, font(20))?;
        let areas = area.split_evenly((self.panels.len(), 1));
        for (i, (panel, area)) in self.panels.iter().zip(areas).enumerate() {
            let (plot, legend) = area.split_horizontally(points(WIDTH - LEGEND_WIDTH));
            self.axes(&plot, panel)?;
            names(&legend, panel.series.iter().map(|series| (series.name.as_str(), false)))?;
            if i == 0 {
                self.list_marks(&legend, panel.series.len() as i32)?;
            }
        }
        Ok(())
    }

    fn axes(&self, area: &DrawingArea<SVGBackend<'_>, Shift>, panel: &Panel) -> Painted {
        let end = self.times.last().copied().unwrap_or(1.0).max(1e-9);
        let (low, high) = range(panel.series.iter().flat_map(|series| &series.values).copied());
        let mut chart = ChartBuilder::on(area)
            .caption(&panel.title, font(16))
            .margin_left(at(10))
            .margin_right(at(12))
            .margin_top(at(6))
            .margin_bottom(at(6))
            .x_label_area_size(at(38))
            .y_label_area_size(at(74))
            .build_cartesian_2d(0.0..end, low..high)?;
        chart
            .configure_mesh()
            .x_desc("time (s)")
            .y_desc(&panel.axis)
            .x_labels(8)
            .y_labels(6)
            .y_label_formatter(&|y| label(*y, high - low))
            .label_style(font(13))
            .axis_desc_style(font(14))
            .set_all_tick_mark_size(at(5))
            .max_light_lines(0)
            .bold_line_style(RGBColor(220, 220, 220).stroke_width(points(1)))
            .axis_style(BLACK.stroke_width(points(1)))
            .draw()?;
        for mark in self.marks {
            // Whole: each dash would be an element of its own, and there are thousands.
            let line = vec![(mark.time_s, low), (mark.time_s, high)];
            let style = RGBColor(160, 160, 160).stroke_width(points(1));
            chart.draw_series([PathElement::new(line, style)])?;
        }
        for (i, series) in panel.series.iter().enumerate() {
            let curve = thinned(self.times, &series.values);
            let style = COLORS[i % COLORS.len()].stroke_width(points(2));
            if i < COLORS.len() {
                chart.draw_series(LineSeries::new(curve, style))?;
            } else {
                chart.draw_series(DashedLineSeries::new(curve, points(7), points(4), style))?;
            }
        }
        Ok(())
    }

    /// The marks' times and labels below so many names.
    fn list_marks(&self, area: &DrawingArea<SVGBackend<'_>, Shift>, below: i32) -> Painted {
        let top = 40 + 19 * below + 8;
        let grey = TextStyle::from(font(12)).color(&RGBColor(90, 90, 90));
        let mut lines: Vec<String> = self
            .marks
            .iter()
            .take(LISTED_MARKS)
            .map(|mark| format!("| {:.3} s {}", mark.time_s, mark.label))
            .collect();
        if self.marks.len() > LISTED_MARKS {
            lines.push(format!("and {} more", self.marks.len() - LISTED_MARKS));
        }
        for (i, line) in lines.into_iter().enumerate() {
            area.draw(&Text::new(line, (at(4), at(top + 16 * i as i32 - 6)), grey.clone()))?;
        }
        Ok(())
    }
}

/// A curve with no more points than can be seen: of each column the lowest and the highest value, in
/// their order.
fn thinned(times: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let all: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).collect();
    if all.len() <= 2 * COLUMNS {
        return all;
    }
    let mut kept = Vec::with_capacity(2 * COLUMNS + 2);
    for column in all.chunks(all.len().div_ceil(COLUMNS)) {
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let (low, high) = (column.iter().min_by(by_value), column.iter().max_by(by_value));
        let mut pair: Vec<(f64, f64)> = low.into_iter().chain(high).copied().collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        pair.dedup();
        kept.extend(pair);
    }
    // The end is the end, whatever its column's extremes are.
    kept.extend(all.last().filter(|last| kept.last() != Some(last)));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinned_curves_keep_extremes_and_ends() {
        let times: Vec<f64> = (0..100_000).map(|k| f64::from(k) * 1e-3).collect();
        let mut values: Vec<f64> = times.iter().map(|t| t.sin()).collect();
        values[54_321] = 7.0;
        values[65_432] = -7.0;
        let kept = thinned(&times, &values);
        assert!(kept.len() <= 2 * COLUMNS + 1);
        assert!(kept.contains(&(times[54_321], 7.0)) && kept.contains(&(times[65_432], -7.0)));
        assert_eq!(kept.last(), Some(&(times[99_999], values[99_999])));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(thinned(&times[..9], &values[..9]).len(), 9);
    }
}
