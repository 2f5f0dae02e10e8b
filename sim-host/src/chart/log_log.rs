//! Curves on logarithmic axes, each with a colour and a mark of its own.

use super::axes::{Axis, axes, power, powers};
use super::style::{
    COLORS, ChartError, LEGEND_WIDTH, Painted, TITLE_HEIGHT, WIDTH, at, drawn, font, points,
};
use plotters::coord::Shift;
use plotters::prelude::*;

/// A curve with marks at its points.
#[derive(Clone, Debug)]
pub struct MarkedCurve {
    /// Name in the legend.
    pub name: String,
    /// Number of its colour and mark: the same for the same thing in all charts. Thirty differ.
    pub style: usize,
    /// Whether it stands out: the others are paler, thinner, and behind.
    pub stands_out: bool,
    /// Points, in order. Those that are not positive have no place on logarithmic axes and are left out.
    pub points: Vec<(f64, f64)>,
}

/// A chart on logarithmic axes.
#[derive(Clone, Debug)]
pub struct LogLogChart {
    /// Above it.
    pub title: String,
    /// Quantity and unit.
    pub x_axis: String,
    /// Quantity and unit.
    pub y_axis: String,
    /// Curves.
    pub curves: Vec<MarkedCurve>,
}

const HEIGHT: u32 = 420;
/// Half the size of marks, in pixels.
const MARK: i32 = 4;
/// Names of methods are longer than those of joints.
const NAMES_WIDTH: u32 = LEGEND_WIDTH + 60;

/// Nearer to white, and still told from the others.
fn pale(RGBColor(red, green, blue): RGBColor) -> RGBColor {
    let mixed = |part: u8| 255 - (255 - part) / 5 * 2;
    RGBColor(mixed(red), mixed(green), mixed(blue))
}

impl LogLogChart {
    /// Draws it as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(&self) -> Result<String, ChartError> {
        drawn(&self.title, (WIDTH, HEIGHT + TITLE_HEIGHT), |root| self.paint(root))
    }

    fn paint(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let area = root.titled(&self.title, font(18))?;
        let (plot, legend) = area.split_horizontally(points(WIDTH - NAMES_WIDTH));
        let (x, y) = (self.range(|point| point.0), self.range(|point| point.1));
        let axis = |description, (from, to): (f64, f64)| Axis {
            range: (from..to).log_scale(),
            description,
            label: &power,
        };
        let mut chart = axes(&plot, axis(&self.x_axis, x), axis(&self.y_axis, y))?;
        // In the legend those that stand out come first; on the plot they are drawn last.
        let mut ordered: Vec<&MarkedCurve> = self.curves.iter().collect();
        ordered.sort_by_key(|curve| !curve.stands_out);
        for (place, curve) in ordered.into_iter().enumerate().rev() {
            let own = COLORS[curve.style % COLORS.len()];
            let (color, width, size) =
                if curve.stands_out { (own, 3, MARK + 1) } else { (pale(own), 1, MARK - 1) };
            let style = color.stroke_width(points(width));
            chart.draw_series(LineSeries::new(curve.shown(), style))?;
            let y = 30 + 20 * place as i32;
            let line = vec![(at(2), at(y)), (at(32), at(y))];
            legend.draw(&PathElement::new(line, style))?;
            let ink = if curve.stands_out { BLACK } else { RGBColor(90, 90, 90) };
            let text = font(13).into_text_style(root).color(&ink);
            legend.draw(&Text::new(curve.name.as_str(), (at(38), at(y - 7)), text))?;
            let ends = [(at(17), at(y))];
            // A macro, as each mark is a type of its own.
            macro_rules! mark {
                ($shape:expr) => {{
                    chart.draw_series(curve.shown().map(|p| EmptyElement::at(p) + $shape))?;
                    for end in ends {
                        legend.draw(&(EmptyElement::at(end) + $shape))?;
                    }
                }};
            }
            let (m, thick) = (at(size), color.stroke_width(points(2)));
            match curve.style % 5 {
                0 => mark!(Circle::new((0, 0), m, color.filled())),
                1 => mark!(Rectangle::new([(-m, -m), (m, m)], color.filled())),
                2 => mark!(Circle::new((0, 0), m + at(1), thick)),
                3 => mark!(Polygon::new(vec![(-m, m), (m, m), (0, -m)], color.filled())),
                _ => {
                    mark!(PathElement::new(vec![(0, -m), (m, 0), (0, m), (-m, 0), (0, -m)], thick))
                }
            }
        }
        Ok(())
    }

    fn range(&self, of: impl Fn((f64, f64)) -> f64 + Copy) -> (f64, f64) {
        powers(self.curves.iter().flat_map(MarkedCurve::shown).map(of))
    }
}

impl MarkedCurve {
    fn shown(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let fits = |x: f64| x.is_finite() && x > 0.0;
        self.points.iter().copied().filter(move |(x, y)| fits(*x) && fits(*y))
    }
}
