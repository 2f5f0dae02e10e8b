//! How all charts look.

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

impl ChartError {
    pub(super) fn new(path: &Path, error: &dyn std::error::Error) -> Self {
        Self { path: path.display().to_string(), reason: error.to_string() }
    }
}

pub(super) type Painted = Result<(), Box<dyn std::error::Error>>;

/// Okabe and Ito's colours, which people with any common colour vision can tell apart, darkest
/// first; curves beyond six repeat them dashed.
pub(super) const COLORS: [RGBColor; 6] = [
    RGBColor(0, 0, 0),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
];

pub(super) const WIDTH: u32 = 900;
pub(super) const PANEL_HEIGHT: u32 = 300;
pub(super) const LEGEND_WIDTH: u32 = 170;
pub(super) const TITLE_HEIGHT: u32 = 40;

/// Legend beside the axes, where it hides nothing: names, and whether each is a ring.
pub(super) fn names<'a>(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    names: impl Iterator<Item = (&'a str, bool)>,
) -> Painted {
    for (i, (name, ring)) in names.enumerate() {
        let y = 40 + 19 * i as i32;
        let style = COLORS[i % COLORS.len()].stroke_width(3);
        if ring {
            let style = COLORS[i % COLORS.len()].stroke_width(2);
            area.draw(&Circle::new((17, y), 7, style))?;
        } else if i < COLORS.len() {
            area.draw(&PathElement::new(vec![(4, y), (30, y)], style))?;
        } else {
            area.draw(&PathElement::new(vec![(4, y), (13, y)], style))?;
            area.draw(&PathElement::new(vec![(20, y), (29, y)], style))?;
        }
        area.draw(&Text::new(name, (38, y - 7), ("sans-serif", 14)))?;
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
