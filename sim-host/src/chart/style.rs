//! How all charts look.

use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;
use surefoot_sim::picture::OKABE_ITO;
use surefoot_sim::written::write_text;

/// A chart could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[error("chart {chart}: {reason}")]
pub struct ChartError {
    chart: String,
    reason: String,
}

impl ChartError {
    pub(super) fn new(chart: impl std::fmt::Display, error: &dyn std::error::Error) -> Self {
        Self { chart: chart.to_string(), reason: error.to_string() }
    }
}

/// Writes a drawing to a file.
pub(super) fn write(path: &Path, svg: &str) -> Result<(), ChartError> {
    write_text(path, svg).map_err(|reason| ChartError { chart: path.display().to_string(), reason })
}

pub(super) type Painted = Result<(), Box<dyn std::error::Error>>;

/// The palette of all pictures, for the backend.
pub(super) const COLORS: [RGBColor; 6] = {
    let mut colors = [RGBColor(0, 0, 0); 6];
    let mut i = 0;
    while i < colors.len() {
        let (red, green, blue) = OKABE_ITO[i];
        colors[i] = RGBColor(red, green, blue);
        i += 1;
    }
    colors
};

pub(super) const WIDTH: u32 = 900;
pub(super) const PANEL_HEIGHT: u32 = 300;
pub(super) const LEGEND_WIDTH: u32 = 170;
pub(super) const TITLE_HEIGHT: u32 = 40;

/// Points of a drawing to a pixel. The backend rounds to whole points, and curves in whole pixels have
/// steps.
const FINENESS: u32 = 4;

/// Pixels as points of the drawing.
pub(super) const fn points(pixels: u32) -> u32 {
    FINENESS * pixels
}

/// The same, signed: for coordinates.
pub(super) const fn at(pixels: i32) -> i32 {
    FINENESS as i32 * pixels
}

/// A font whose size is given in pixels.
pub(super) fn font(pixels: u32) -> (&'static str, i32) {
    ("sans-serif", points(pixels) as i32)
}

/// A drawing of so many pixels, as SVG text.
pub(super) fn drawn(
    title: &str,
    (width, height): (u32, u32),
    paint: impl FnOnce(&DrawingArea<SVGBackend<'_>, Shift>) -> Painted,
) -> Result<String, ChartError> {
    let mut svg = String::new();
    let size = (points(width), points(height));
    {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        let painted = root.fill(&WHITE).map_err(Into::into).and_then(|()| paint(&root));
        painted
            .and_then(|()| root.present().map_err(Into::into))
            .map_err(|error| ChartError::new(title, error.as_ref()))?;
    }
    let fine = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    Ok(svg.replacen(&fine, &format!("width=\"{width}\" height=\"{height}\""), 1))
}

/// Legend beside the axes, where it hides nothing: names, and whether each is a ring.
pub(super) fn names<'a>(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    names: impl Iterator<Item = (&'a str, bool)>,
) -> Painted {
    for (i, (name, ring)) in names.enumerate() {
        let y = at(40 + 19 * i as i32);
        let color = COLORS[i % COLORS.len()];
        let line = |from: i32, to: i32| {
            let ends = vec![(at(from), y), (at(to), y)];
            PathElement::new(ends, color.stroke_width(points(3)))
        };
        if ring {
            area.draw(&Circle::new((at(17), y), points(7), color.stroke_width(points(2))))?;
        } else if i < COLORS.len() {
            area.draw(&line(4, 30))?;
        } else {
            area.draw(&line(4, 13))?;
            area.draw(&line(20, 29))?;
        }
        area.draw(&Text::new(name, (at(38), y - at(7)), font(14)))?;
    }
    Ok(())
}

/// From the least to the greatest finite value, with a margin; never empty.
pub(super) fn range(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let finite = values.filter(|y| y.is_finite());
    let low = finite.clone().fold(f64::INFINITY, f64::min);
    let high = finite.fold(f64::NEG_INFINITY, f64::max);
    if low > high {
        return (-1.0, 1.0);
    }
    let margin = (0.06 * (high - low)).max(1e-9 * high.abs().max(low.abs())).max(1e-12);
    (low - margin, high + margin)
}

/// As many digits as the range needs.
pub(super) fn label(y: f64, span: f64) -> String {
    let digits = (1.5 - span.log10()).ceil().clamp(0.0, 9.0) as usize;
    let text = format!("{y:.digits$}");
    // No "-0" or "-0.00".
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') {
        text.trim_start_matches('-').to_owned()
    } else {
        text
    }
}
