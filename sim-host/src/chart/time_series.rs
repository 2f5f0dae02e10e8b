//! Curves over time: panels below each other on one time axis.

use super::style::{
    COLORS, ChartError, LEGEND_WIDTH, PANEL_HEIGHT, Painted, TITLE_HEIGHT, WIDTH, label, names,
    range,
};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

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

/// Draws panels with a common time axis (s) to an SVG file.
///
/// # Errors
/// [`ChartError`] if the file cannot be written.
pub fn draw(path: &Path, title: &str, times: &[f64], panels: &[Panel]) -> Result<(), ChartError> {
    let height = TITLE_HEIGHT + PANEL_HEIGHT * panels.len() as u32;
    let root = SVGBackend::new(path, (WIDTH, height)).into_drawing_area();
    paint(&root, title, times, panels).map_err(|error| ChartError::new(path, error.as_ref()))
}

fn paint(
    root: &DrawingArea<SVGBackend<'_>, Shift>,
    title: &str,
    times: &[f64],
    panels: &[Panel],
) -> Painted {
    root.fill(&WHITE)?;
    let area = root.titled(title, ("sans-serif", 20))?;
    for (panel, area) in panels.iter().zip(area.split_evenly((panels.len(), 1))) {
        let (plot, legend) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
        axes(&plot, times, panel)?;
        names(&legend, panel.series.iter().map(|series| (series.name.as_str(), false)))?;
    }
    root.present()?;
    Ok(())
}

fn axes(area: &DrawingArea<SVGBackend<'_>, Shift>, times: &[f64], panel: &Panel) -> Painted {
    let end = times.last().copied().unwrap_or(1.0).max(1e-9);
    let (low, high) = range(panel.series.iter().flat_map(|series| &series.values).copied());
    let mut chart = ChartBuilder::on(area)
        .caption(&panel.title, ("sans-serif", 16))
        .margin_left(10)
        .margin_right(12)
        .margin_bottom(6)
        .x_label_area_size(38)
        .y_label_area_size(74)
        .build_cartesian_2d(0.0..end, low..high)?;
    chart
        .configure_mesh()
        .x_desc("time (s)")
        .y_desc(&panel.axis)
        .x_labels(8)
        .y_labels(6)
        .y_label_formatter(&|y| label(*y, high - low))
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(220, 220, 220))
        .draw()?;
    for (i, series) in panel.series.iter().enumerate() {
        let points = times.iter().copied().zip(series.values.iter().copied());
        let style = COLORS[i % COLORS.len()].stroke_width(2);
        if i < COLORS.len() {
            chart.draw_series(LineSeries::new(points, style))?;
        } else {
            chart.draw_series(DashedLineSeries::new(points, 7, 4, style))?;
        }
    }
    Ok(())
}
