//! The control loop's maps: delay against rate, gains against friction.

use super::axis::Axis;
use super::column::{Foretold, Map, Stack};
use super::edge::edge;
use super::ground::should_stand;
use super::landing::should_land;
use super::outcome::{Failure, Outcome};
use crate::stability::TreeProblemError;
use crate::stability::loop_limits::{Criterion, Footing, Loop, Manner, Quantity, Trial};
use surefoot_sim::scene::{Scene, load};

/// Control rates, Hz.
const RATES: [f64; 2] = [15.0, 1000.0];
/// Delays, s.
const DELAYS: [f64; 2] = [0.0, 0.057];
/// Coefficients of friction.
const FRICTIONS: [f64; 2] = [0.01, 1.0];
/// Scales of the gains.
const GAINS: [f64; 2] = [0.25, 16.0];

/// The maps of this module.
///
/// # Errors
/// Never for the scenes as shipped.
pub fn loop_maps(cells: usize) -> Result<Vec<Map>, TreeProblemError> {
    let first = load("experiment-1")?;
    let second = load("experiment-2")?;
    Ok(vec![
        delay_and_rate(
            "delay-rate-experiment-1",
            "Experiment 1: delay and control rate",
            &first,
            cells,
        ),
        gains_and_friction(
            "gain-friction-experiment-1",
            "Experiment 1: gains and friction",
            &first,
            cells,
        ),
        gains_and_friction(
            "gain-friction-experiment-2",
            "Experiment 2, struck by a block: gains and friction",
            &second,
            cells,
        ),
    ])
}

/// How `works_if` is said, and what the forecast is.
const NOTE: &str = "A cell works if the robot stands within 10 mm and 1° of its set point for the last 0.5 s of \
                    4 s. Foretold from a run with feet that are held, which must settle, and ask of the ground \
                    what soles and friction can give; and from the first 0.4 s on the floor, which must end \
                    on flat soles.";

/// A scene with one more quantity changed, in steps of which a control period has a whole number.
fn trial(scene: &Scene, quantity: Quantity) -> Option<Trial<'_>> {
    let criterion = Criterion::default();
    let footing = *Footing::of(scene).first()?;
    Some(Trial { scene, quantity, footing, control: Loop::Bare, criterion })
}

/// Where on an axis of a quantity a scene's edge should be.
fn foretold(scene: &Scene, quantity: Quantity, axis: &Axis) -> Foretold {
    let Some(trial) = trial(scene, quantity) else { return Foretold::Unlimited };
    let at = |value| trial.scene_at(value, scene.integrator.step_s);
    edge(axis, |value| should_stand(&at(value), &trial.criterion), |value| should_land(&at(value)))
}

/// What becomes of a scene with one more quantity changed.
fn outcome(scene: &Scene, quantity: Quantity, value: f64) -> Outcome {
    let Some(trial) = trial(scene, quantity) else { return Outcome::Works };
    match trial.attempt(value, scene.integrator.step_s) {
        Ok(manner) => manner.into(),
        // A value that the scene's check refuses, like a delay beyond what motors can have.
        Err(_) => Outcome::Fails(Failure::Loop(Manner::NotReachable)),
    }
}

fn delay_and_rate(name: &'static str, title: &str, scene: &Scene, cells: usize) -> Map {
    let scene = scene.clone();
    let y = Axis::plain("delay", "ms", DELAYS).shown(1e3).cells(cells);
    Map {
        name,
        title: title.to_owned(),
        note: NOTE,
        x: Axis::logarithmic("control rate", "Hz", RATES).cells(cells),
        y,
        stack: Box::new(move |rate_hz| {
            let mut scene = scene.clone();
            Quantity::ControlRate.set(&mut scene, rate_hz);
            Stack {
                foretold: foretold(&scene, Quantity::Delay, &y),
                attempt: Box::new(move |delay| outcome(&scene, Quantity::Delay, delay)),
            }
        }),
    }
}

fn gains_and_friction(name: &'static str, title: &str, scene: &Scene, cells: usize) -> Map {
    let scene = scene.clone();
    let y = Axis::logarithmic("scale of the gains", "×", GAINS).cells(cells);
    Map {
        name,
        title: title.to_owned(),
        note: NOTE,
        x: Axis::logarithmic("friction", "", FRICTIONS).cells(cells),
        y,
        stack: Box::new(move |friction| {
            let mut scene = scene.clone();
            Quantity::Friction.set(&mut scene, friction);
            Stack {
                foretold: foretold(&scene, Quantity::GainScale, &y),
                attempt: Box::new(move |scale| outcome(&scene, Quantity::GainScale, scale)),
            }
        }),
    }
}
