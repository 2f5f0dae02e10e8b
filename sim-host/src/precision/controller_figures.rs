//! The charts of the controller's precision.

use super::controller::{ControllerPrecision, FASTEST_HZ, TorqueError};
use super::controller_form::ControllerForm;
use super::figures::PrecisionFigure;
use crate::chart::{ChartError, LogLogChart, MarkedCurve};
use surefoot_sim::closed_loop::{Approximation, Scalar};

/// Torque errors that no one feels: a thousandth of the largest torque.
const GOOD: f64 = 1e-3;

const SCALARS: [(Scalar, &str); 2] = [(Scalar::F64, "f64"), (Scalar::F32, "f32")];

/// All charts.
///
/// # Errors
/// [`ChartError`] if one cannot be drawn.
pub fn controller_figures(
    precision: &ControllerPrecision,
) -> Result<Vec<PrecisionFigure>, ChartError> {
    let by_factor = by_factor(precision);
    let instructions = against(precision, |row| Some(row.instructions? as f64));
    let time = against(precision, |row| Some(row.tick?.median));
    let tracking = |name: &str, k: usize, of: fn(&super::TrackingError) -> Option<f64>| {
        let points = precision.tracking.iter().filter_map(|row| Some((row.rate_hz, of(row)?)));
        curve(name.to_owned(), k, points)
    };
    let figure = |name, title: &str, [x, y]: [&str; 2], curves, (says, note)| {
        let chart = LogLogChart {
            title: format!("controller: {title}"),
            x_axis: x.to_owned(),
            y_axis: y.to_owned(),
            curves,
        };
        Ok(PrecisionFigure { name, svg: chart.svg()?, says, note })
    };
    let error = "largest error of a torque, relative";
    let mut all = vec![
        figure(
            "factor",
            "torque error against the feet's mass",
            ["mass of a foot over the central body's", error],
            by_factor,
            (factor_glance(precision), factor_sentence(precision)),
        )?,
        figure(
            "tick-time",
            "torque error against a tick's time",
            ["computing time of a tick (s)", error],
            time,
            (
                "The same in time.".to_owned(),
                "This machine and its other users decide it.".to_owned(),
            ),
        )?,
        figure(
            "rate",
            "motion against control rate",
            ["rate (Hz)", "root mean square distance (m, rad)"],
            vec![
                tracking("position (m)", 0, |row| row.position_m),
                tracking("orientation (rad)", 1, |row| row.orientation_rad),
            ],
            (rate_glance(precision), rate_sentence(precision)),
        )?,
    ];
    if precision.uncounted.is_none() {
        let title = "torque error against a tick's instructions";
        let counted = figure(
            "tick",
            title,
            ["instructions of a tick", error],
            instructions,
            (tick_glance(precision), tick_sentence(precision)),
        )?;
        all.insert(1, counted);
    }
    Ok(all)
}

/// Big bases by their mass, and the level of the exact foot, which has none.
fn by_factor(precision: &ControllerPrecision) -> Vec<MarkedCurve> {
    let mut all = Vec::new();
    for (k, (scalar, name)) in SCALARS.into_iter().enumerate() {
        let rows = || precision.torques.iter().filter(move |row| row.form.scalar == scalar);
        let exact = rows().find(|row| is_plain(row)).and_then(|row| row.largest);
        let factors = rows().filter_map(|row| Some((row.form.factor?, row.largest?)));
        let level = rows().filter_map(|row| Some((row.form.factor?, exact?)));
        all.push(curve(format!("big base, {name}"), k, factors));
        all.push(curve(format!("exact foot, {name}"), k + 2, level));
    }
    all
}

/// Nothing left out, and feet held exactly.
fn is_plain(row: &TorqueError) -> bool {
    row.form.factor.is_none() && row.form.approximation.is_none()
}

/// All forms against what a tick costs.
fn against(
    precision: &ControllerPrecision,
    cost: impl Fn(&TorqueError) -> Option<f64>,
) -> Vec<MarkedCurve> {
    type IsIn = fn(&TorqueError) -> bool;
    let groups: [(&str, IsIn); 4] = [
        ("big base", |row| row.form.factor.is_some()),
        ("exact foot", is_plain),
        ("dynamics held", |row| {
            row.form.approximation.is_some_and(|left_out| left_out.held_for().is_some())
        }),
        ("no velocity products", |row| {
            row.form.approximation == Some(Approximation::NoVelocityProducts)
        }),
    ];
    let mut all = Vec::new();
    for (group, (title, is_in)) in groups.into_iter().enumerate() {
        for (k, (scalar, name)) in SCALARS.into_iter().enumerate() {
            let rows = precision.torques.iter();
            let rows = rows.filter(|row| row.form.scalar == scalar && is_in(row));
            // Nothing is off by nothing on a logarithmic axis.
            let points = rows.filter_map(|row| Some((cost(row)?, row.largest?)));
            let points = points.filter(|(_, error)| *error > 0.0);
            all.push(curve(format!("{title}, {name}"), 2 * group + k, points));
        }
    }
    all.retain(|curve| !curve.points.is_empty());
    all
}

/// What is saved by being less exact.
fn tick_sentence(precision: &ControllerPrecision) -> String {
    let exact = precision.torques.iter().find(|row| row.form == ControllerForm::EXACT);
    let Some(exact) = exact.and_then(|row| row.instructions) else { return String::new() };
    let f64s = precision.torques.iter().filter(|row| row.form.scalar == Scalar::F64);
    let less = f64s.filter(|row| row.form.approximation.is_some()).filter_map(|row| {
        let share = row.instructions? as f64 / exact as f64;
        Some(format!(
            "{} takes {share:.2} of that and is {:.1e} off at worst, {:.1e} at half of the ticks",
            row.form, row.largest?, row.median?
        ))
    });
    format!(
        "The exact foot in f64, which others are compared with, takes {exact} instructions (by callgrind, the mean \
         over Experiment 1). {}. The worst are at touch-down, where velocities jump.",
        less.collect::<Vec<_>>().join("; ")
    )
}

fn curve(name: String, style: usize, points: impl Iterator<Item = (f64, f64)>) -> MarkedCurve {
    MarkedCurve { name, style, stands_out: true, points: points.collect() }
}

/// How far feet that are held exactly are off, and the best big base.
fn factor_glance(precision: &ControllerPrecision) -> String {
    let single = || precision.torques.iter().filter(|row| row.form.scalar == Scalar::F32);
    let exact = single().find(|row| is_plain(row)).and_then(|row| row.largest);
    let bases = single().filter(|row| row.form.factor.is_some());
    let best = bases.filter_map(|row| row.largest).reduce(f64::min);
    match exact.zip(best) {
        Some((exact, best)) => {
            format!("In f32 the exact foot is {exact:.1e} off, the best big base {best:.1e}.")
        }
        None => "In f32 some form gives no torques.".to_owned(),
    }
}

/// The cheapest form that is good enough at every tick.
fn tick_glance(precision: &ControllerPrecision) -> String {
    let good = precision.torques.iter().filter(|row| row.largest.is_some_and(|off| off <= GOOD));
    let counted = good.filter_map(|row| Some((row.instructions?, row.form)));
    match counted.min_by_key(|(count, _)| *count) {
        Some((count, form)) => {
            let scalar = SCALARS.iter().find(|(scalar, _)| *scalar == form.scalar);
            let scalar = scalar.map_or("", |(_, name)| name);
            format!(
                "The cheapest form within {GOOD:.0e} at every tick: {form} in {scalar}, {count} instructions."
            )
        }
        None => format!("No form is within {GOOD:.0e} at every tick."),
    }
}

/// Over which rates the robot stands, and how far off it is at the highest.
fn rate_glance(precision: &ControllerPrecision) -> String {
    let standing =
        || precision.tracking.iter().filter_map(|row| Some((row.rate_hz, row.position_m?)));
    let lowest = standing().min_by(|a, b| a.0.total_cmp(&b.0));
    let highest = standing().max_by(|a, b| a.0.total_cmp(&b.0));
    match lowest.zip(highest) {
        Some((low, high)) => {
            format!("{:.1e} m off at {:.0} Hz, {:.1e} m at {:.0} Hz.", high.1, high.0, low.1, low.0)
        }
        None => "The robot stands at no rate.".to_owned(),
    }
}

fn factor_sentence(precision: &ControllerPrecision) -> String {
    let each = SCALARS.map(|(scalar, name)| {
        let all = precision.torques.iter().filter(|row| row.form.approximation.is_none());
        let rows = || all.clone().filter(move |row| row.form.scalar == scalar);
        let best = rows()
            .filter_map(|row| Some((row.largest?, row.form.factor?)))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let exact = rows().find(|row| is_plain(row)).and_then(|row| row.largest);
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
