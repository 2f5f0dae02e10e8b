//! The charts of a survey.

use super::measure::Measurement;
use super::peers::MUJOCO_INTEGRATORS;
use super::sentences;
use super::survey::Survey;
use super::tree_contenders::{AT_MIDPOINTS, WITH_CONSTRAINTS};
use crate::chart::{ChartError, LogLogChart, MarkedCurve};
use surefoot_mechanics::integrators::Method;

/// A chart with what it shows.
#[derive(Clone, Debug)]
pub struct PrecisionFigure {
    /// Part of its file's name.
    pub name: &'static str,
    /// The drawing.
    pub svg: String,
    /// What it shows, in a sentence.
    pub says: String,
    /// All of it in numbers.
    pub note: String,
}

type Quantity = fn(&Measurement) -> Option<f64>;

struct Axes {
    name: &'static str,
    title: &'static str,
    x: (&'static str, Quantity),
    y: (&'static str, Quantity),
}

const STEP: (&str, Quantity) = ("step (s)", |m| Some(m.step_s));
const ERROR: (&str, Quantity) = ("error of the trajectory, relative", |m| m.error);

const AXES: [Axes; 8] = [
    Axes {
        name: "time",
        title: "error against computing time",
        x: ("computing time a simulated second (s)", |m| m.time.map(|time| time.median)),
        y: ERROR,
    },
    Axes { name: "step", title: "error against step", x: STEP, y: ERROR },
    Axes {
        name: "evaluations",
        title: "error against evaluations",
        x: ("evaluations a simulated second", |m| Some(m.evaluations)),
        y: ERROR,
    },
    Axes {
        name: "newton",
        title: "Newton iterations",
        x: STEP,
        y: ("iterations a step, mean", |m| m.newton_mean),
    },
    Axes {
        name: "energy-band",
        title: "energy: largest less least",
        x: STEP,
        y: ("band (J)", |m| m.energy_band_j),
    },
    Axes {
        name: "energy-slope",
        title: "energy: slope of its straight line",
        x: STEP,
        y: ("slope, absolute (J/s)", |m| m.energy_slope_j_s.map(f64::abs)),
    },
    Axes {
        name: "momentum",
        title: "momentum: largest change",
        x: STEP,
        y: ("change, relative", |m| m.momentum_drift),
    },
    Axes { name: "constraint", title: "constraints", x: STEP, y: ("largest", |m| m.constraint) },
];

/// All charts of a survey that have something to show.
///
/// # Errors
/// [`ChartError`] if one cannot be drawn.
pub fn figures(survey: &Survey) -> Result<Vec<PrecisionFigure>, ChartError> {
    let mut all = Vec::new();
    let stand_out = sentences::stand_out(survey);
    for axes in &AXES {
        let curve = |curve: &super::Curve| MarkedCurve {
            name: curve.method.clone(),
            style: style(&curve.method),
            // Peers are shown only where they were asked for.
            stands_out: stand_out.contains(&curve.method)
                || survey.peers.iter().any(|peer| peer.method == curve.method),
            points: curve
                .measurements
                .iter()
                .filter(|m| m.failure.is_none())
                .filter_map(|m| Some(((axes.x.1)(m)?, (axes.y.1)(m)?)))
                .filter(|(x, y)| *x > 0.0 && *y > 0.0)
                .collect(),
        };
        let measured = survey.curves.iter().chain(&survey.peers);
        let curves: Vec<_> = measured.map(curve).filter(|curve| !curve.points.is_empty()).collect();
        if curves.is_empty() {
            continue;
        }
        let chart = LogLogChart {
            title: format!("{}: {}", survey.problem, axes.title),
            x_axis: axes.x.0.to_owned(),
            y_axis: axes.y.0.to_owned(),
            curves,
        };
        let (says, note) = words(survey, axes);
        all.push(PrecisionFigure { name: axes.name, svg: chart.svg()?, says, note });
    }
    Ok(all)
}

/// What a chart shows in a sentence, and in numbers.
fn words(survey: &Survey, axes: &Axes) -> (String, String) {
    match axes.name {
        "time" => (sentences::frontier(survey), sentences::quickest(survey)),
        "step" => (sentences::orders(survey), sentences::slopes(survey)),
        "evaluations" => (
            "The same without the machine.".to_owned(),
            "Residuals of implicit methods, differential equations of others; an evaluation's cost differs from \
             method to method."
                .to_owned(),
        ),
        _ => (
            sentences::extremes(survey, axes.y.1),
            sentences::ranges(survey, "Over all steps that work", axes.y.1),
        ),
    }
}

/// The same colour and mark for a method in all charts.
fn style(method: &str) -> usize {
    let all = Method::all();
    let known = all.iter().position(|known| known.name() == method);
    let mut others = [WITH_CONSTRAINTS, AT_MIDPOINTS]
        .into_iter()
        .chain(MUJOCO_INTEGRATORS.iter().map(|(name, ..)| *name));
    // Peers' names begin with their versions.
    let other = others.position(|name| method.ends_with(name));
    known.unwrap_or_else(|| all.len() + other.unwrap_or(all.len()))
}
