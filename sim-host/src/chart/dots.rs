//! Dots in a plane: what failed over what did not.

use super::axes::{Axis, axes};
use super::style::{
    COLORS, ChartError, LEGEND_WIDTH, PANEL_HEIGHT, Painted, TITLE_HEIGHT, WIDTH, at, drawn, font,
    label, points, range,
};
use plotters::coord::Shift;
use plotters::prelude::*;

/// A group of dots: its name in the legend, and where they are.
#[derive(Clone, Debug)]
pub struct DotGroup {
    /// Name.
    pub name: String,
    /// Places.
    pub places: Vec<(f64, f64)>,
}

/// A chart of dots.
#[derive(Clone, Debug)]
pub struct Dots {
    title: String,
    axes: [String; 2],
    groups: Vec<DotGroup>,
}

/// What did not fail.
const PALE: RGBColor = RGBColor(190, 196, 202);
/// Radii, pixels.
const SMALL: u32 = 2;
const LARGE: u32 = 4;

impl Dots {
    /// The first group is pale and small, those after it are drawn over it.
    pub fn new(title: impl Into<String>, axes: [String; 2], groups: Vec<DotGroup>) -> Self {
        Self { title: title.into(), axes, groups }
    }

    /// Draws it as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(&self) -> Result<String, ChartError> {
        let height = TITLE_HEIGHT + PANEL_HEIGHT + 160;
        drawn(&self.title, (WIDTH, height), |root| self.paint(root))
    }

    fn paint(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let area = root.titled(&self.title, font(20))?;
        let (plot, legend) = area.split_horizontally(points(WIDTH - LEGEND_WIDTH));
        let all = || self.groups.iter().flat_map(|group| group.places.iter().copied());
        let (x, y) = (range(all().map(|(x, _)| x)), range(all().map(|(_, y)| y)));
        let x_label = |v: &f64| label(*v, x.1 - x.0);
        let y_label = |v: &f64| label(*v, y.1 - y.0);
        let across = Axis { range: x.0..x.1, description: &self.axes[0], label: &x_label };
        let up = Axis { range: y.0..y.1, description: &self.axes[1], label: &y_label };
        let mut plane = axes(&plot, across, up)?;
        for (number, group) in self.groups.iter().enumerate() {
            let (color, radius) = look(number);
            let dots = group.places.iter();
            plane.draw_series(
                dots.map(|place| Circle::new(*place, points(radius), color.filled())),
            )?;
            let line = at(40 + 19 * number as i32);
            legend.draw(&Circle::new((at(17), line), points(radius), color.filled()))?;
            let name = group.name.as_str();
            legend.draw(&Text::new(name, (at(30), line - at(7)), font(14)))?;
        }
        Ok(())
    }
}

fn look(number: usize) -> (RGBColor, u32) {
    match number.checked_sub(1) {
        None => (PALE, SMALL),
        // Black would be the first of the colours.
        Some(k) => (COLORS[(k + 1) % COLORS.len()], LARGE),
    }
}
