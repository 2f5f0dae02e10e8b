//! The charts of the controller's precision.

use super::controller::{ControllerPrecision, FASTEST_HZ, TorqueError};
use super::figures::PrecisionFigure;
use crate::chart::{ChartError, LogLogChart, MarkedCurve};
use crate::closed_loop::Scalar;

const SCALARS: [(Scalar, &str); 2] = [(Scalar::F64, "f64"), (Scalar::F32, "f32")];

/// All charts.
///
/// # Errors
/// [`ChartError`] if one cannot be drawn.
pub fn controller_figures(
    precision: &ControllerPrecision,
) -> Result<Vec<PrecisionFigure>, ChartError> {
    let of = |scalar: Scalar, is_exact: bool| {
        precision
            .torques
            .iter()
            .filter(move |row| row.scalar == scalar && row.factor.is_none() == is_exact)
    };
    let mut by_factor = Vec::new();
    let mut by_time = Vec::new();
    for (k, (scalar, name)) in SCALARS.into_iter().enumerate() {
        // The exact foot is a level, as it has no factor.
        let exact = of(scalar, true).find_map(|row| row.largest).unwrap_or(f64::NAN);
        let factor = |row: &TorqueError| Some((row.factor?, row.largest?));
        let level = of(scalar, false).filter_map(|row| Some((row.factor?, exact)));
        let time = |row: &TorqueError| Some((row.tick?.median, row.largest?));
        by_factor.push(curve(format!("big base, {name}"), k, of(scalar, false).filter_map(factor)));
        by_factor.push(curve(format!("exact foot, {name}"), k + 2, level));
        by_time.push(curve(format!("big base, {name}"), k, of(scalar, false).filter_map(time)));
        by_time.push(curve(
            format!("exact foot, {name}"),
            k + 2,
            of(scalar, true).filter_map(time),
        ));
    }
    let tracking = |name: &str, k: usize, of: fn(&super::TrackingError) -> Option<f64>| {
        let points = precision.tracking.iter().filter_map(|row| Some((row.rate_hz, of(row)?)));
        curve(name.to_owned(), k, points)
    };
    let figure = |name, title: &str, x: &str, y: &str, curves, sentence| {
        let chart = LogLogChart {
            title: format!("controller: {title}"),
            x_axis: x.to_owned(),
            y_axis: y.to_owned(),
            curves,
        };
        Ok(PrecisionFigure { name, svg: chart.svg()?, says: sentence, note: String::new() })
    };
    let error = "largest error of a torque, relative";
    Ok(vec![
        figure(
            "factor",
            "torque error against the feet's mass",
            "mass of a foot over the central body's",
            error,
            by_factor,
            factor_sentence(precision),
        )?,
        figure(
            "tick",
            "torque error against a tick's time",
            "computing time of a tick (s)",
            error,
            by_time,
            "Of the exact foot in f64 nothing is shown, as it is what the others are compared with. \
             Instructions of a tick, which repeat exactly: `cargo xtask instructions biped`."
                .to_owned(),
        )?,
        figure(
            "rate",
            "motion against control rate",
            "rate (Hz)",
            "root mean square distance (m, rad)",
            vec![
                tracking("position (m)", 0, |row| row.position_m),
                tracking("orientation (rad)", 1, |row| row.orientation_rad),
            ],
            rate_sentence(precision),
        )?,
    ])
}

fn curve(name: String, style: usize, points: impl Iterator<Item = (f64, f64)>) -> MarkedCurve {
    MarkedCurve { name, style, stands_out: true, points: points.collect() }
}

fn factor_sentence(precision: &ControllerPrecision) -> String {
    let each = SCALARS.map(|(scalar, name)| {
        let rows = || precision.torques.iter().filter(move |row| row.scalar == scalar);
        let best = rows()
            .filter_map(|row| Some((row.largest?, row.factor?)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let exact = rows().find(|row| row.factor.is_none()).and_then(|row| row.largest);
        let faults: usize = rows().map(|row| row.faults).sum();
        let best = best.map_or("fails".to_owned(), |(error, factor)| {
            format!("is best at a factor of {factor:.0e}, {error:.1e} off")
        });
        let exact = exact.map_or("fails".to_owned(), |error| format!("is {error:.1e} off"));
        format!("In {name} the big base {best}; the exact foot {exact}; {faults} ticks without torques. ")
    });
    each.concat()
}

fn rate_sentence(precision: &ControllerPrecision) -> String {
    let fallen: Vec<String> = precision
        .tracking
        .iter()
        .filter(|row| row.position_m.is_none())
        .map(|row| format!("{:.0} Hz", row.rate_hz))
        .collect();
    let falls = if fallen.is_empty() {
        "The robot stands at all rates.".to_owned()
    } else {
        format!("The robot does not stand to the end at {}.", fallen.join(", "))
    };
    format!(
        "Experiment 1, distance from the motion under the same controller at {FASTEST_HZ} Hz, in steps of \
         {:.3} ms. {falls}",
        1e3 / FASTEST_HZ
    )
}
