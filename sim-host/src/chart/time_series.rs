//! Curves over time: panels below each other on one time axis.

use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

/// A chart could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[error("chart {path}: {reason}")]
pub struct ChartError {
    path: String,
    reason: String,
}

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

/// Okabe and Ito's colours, which people with any common colour vision can tell apart, darkest
/// first; curves beyond six repeat them dashed.
const COLORS: [RGBColor; 6] = [
    RGBColor(0, 0, 0),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
];

const WIDTH: u32 = 900;
const PANEL_HEIGHT: u32 = 300;
const LEGEND_WIDTH: u32 = 170;
const TITLE_HEIGHT: u32 = 40;

/// Draws panels with a common time axis (s) to an SVG file.
///
/// # Errors
/// [`ChartError`] if the file cannot be written.
pub fn draw(path: &Path, title: &str, times: &[f64], panels: &[Panel]) -> Result<(), ChartError> {
    let height = TITLE_HEIGHT + PANEL_HEIGHT * panels.len() as u32;
    let root = SVGBackend::new(path, (WIDTH, height)).into_drawing_area();
    paint(&root, title, times, panels)
        .map_err(|error| ChartError { path: path.display().to_string(), reason: error.to_string() })
}

type Painted = Result<(), Box<dyn std::error::Error>>;

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
        names(&legend, panel)?;
    }
    root.present()?;
    Ok(())
}

fn axes(area: &DrawingArea<SVGBackend<'_>, Shift>, times: &[f64], panel: &Panel) -> Painted {
    let end = times.last().copied().unwrap_or(1.0).max(1e-9);
    let (low, high) = range(panel);
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

/// Legend beside the axes, where it hides nothing.
fn names(area: &DrawingArea<SVGBackend<'_>, Shift>, panel: &Panel) -> Painted {
    for (i, series) in panel.series.iter().enumerate() {
        let y = 40 + 19 * i as i32;
        let style = COLORS[i % COLORS.len()].stroke_width(3);
        if i < COLORS.len() {
            area.draw(&PathElement::new(vec![(4, y), (30, y)], style))?;
        } else {
            area.draw(&PathElement::new(vec![(4, y), (13, y)], style))?;
            area.draw(&PathElement::new(vec![(20, y), (29, y)], style))?;
        }
        area.draw(&Text::new(series.name.as_str(), (38, y - 7), ("sans-serif", 14)))?;
    }
    Ok(())
}

/// From the least to the greatest finite value, with a margin; never empty.
fn range(panel: &Panel) -> (f64, f64) {
    let finite = || panel.series.iter().flat_map(|s| &s.values).copied().filter(|y| y.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    if low > high {
        return (-1.0, 1.0);
    }
    let margin = (0.06 * (high - low)).max(1e-9 * high.abs().max(low.abs())).max(1e-12);
    (low - margin, high + margin)
}

/// As many digits as the range needs.
fn label(y: f64, span: f64) -> String {
    let digits = (1.5 - span.log10()).ceil().clamp(0.0, 9.0) as usize;
    let text = format!("{y:.digits$}");
    // No "-0" or "-0.00".
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        text.trim_start_matches('-').to_owned()
    } else {
        text
    }
}
