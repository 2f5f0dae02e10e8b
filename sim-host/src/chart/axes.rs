//! Axes of charts of one quantity against another.

use super::style::{at, font, points};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

/// A plane to draw curves on.
pub(super) type Plane<'a, 'b, X, Y> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>;

/// An axis: its range, quantity and unit, and how its values are written.
pub(super) struct Axis<'a, R> {
    pub range: R,
    pub description: &'a str,
    pub label: &'a dyn Fn(&f64) -> String,
}

/// Draws axes with a grid.
pub(super) fn axes<'a, 'b, X, Y>(
    area: &'a DrawingArea<SVGBackend<'b>, Shift>,
    x: Axis<'_, X>,
    y: Axis<'_, Y>,
) -> Result<Plane<'a, 'b, X::CoordDescType, Y::CoordDescType>, Box<dyn std::error::Error>>
where
    X: AsRangedCoord<Value = f64>,
    Y: AsRangedCoord<Value = f64>,
    X::CoordDescType: ValueFormatter<f64>,
    Y::CoordDescType: ValueFormatter<f64>,
{
    let mut plane = ChartBuilder::on(area)
        .margin_left(at(10))
        .margin_right(at(12))
        .margin_bottom(at(6))
        .margin_top(at(12))
        .x_label_area_size(at(42))
        .y_label_area_size(at(78))
        .build_cartesian_2d(x.range, y.range)
        .map_err(|error| error.to_string())?;
    plane
        .configure_mesh()
        .x_desc(x.description)
        .y_desc(y.description)
        .x_labels(8)
        .y_labels(8)
        .x_label_formatter(&x.label)
        .y_label_formatter(&y.label)
        .label_style(font(13))
        .axis_desc_style(font(14))
        .set_all_tick_mark_size(at(5))
        .bold_line_style(RGBColor(220, 220, 220).stroke_width(points(1)))
        .axis_style(BLACK.stroke_width(points(1)))
        .max_light_lines(0)
        .draw()
        .map_err(|error| error.to_string())?;
    Ok(plane)
}

/// Whole powers of ten around positive values, a little wider.
pub(super) fn powers(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) =
        values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.1, 1.0);
    }
    (10_f64.powf(low.log10().floor() - 0.05), 10_f64.powf(high.log10().ceil() + 0.05))
}

/// A value as a power of ten.
pub(super) fn power(value: &f64) -> String {
    format!("{value:.0e}")
}
