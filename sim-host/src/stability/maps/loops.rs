//! The control loop's maps: delay against rate, gains against friction.

use super::axis::Axis;
use super::column::{Foretold, Map, Stack};
use super::outcome::{Failure, Outcome};
use super::prediction::{Axes, settles};
use crate::scene::{Feet, Scene, load};
use crate::stability::TreeProblemError;
use crate::stability::loop_limits::{Criterion, Footing, Manner, Quantity, Trial, play};

/// Control rates, Hz.
const RATES: [f64; 2] = [15.0, 1000.0];
/// Delays, s.
const DELAYS: [f64; 2] = [0.0, 0.057];
/// Coefficients of friction.
const FRICTIONS: [f64; 2] = [0.02, 1.0];
/// Scales of the gains.
const GAINS: [f64; 2] = [0.25, 1000.0];
/// Bisections of a forecast: to a thousandth of its range.
const BISECTIONS: usize = 12;

/// The maps of this module.
///
/// # Errors
/// Never for the scenes as shipped.
pub fn loop_maps(cells: usize) -> Result<Vec<Map>, TreeProblemError> {
    let first = load("experiment-1")?;
    let second = load("experiment-2")?;
    Ok(vec![
        delay_and_rate("delay-rate-experiment-1", "Experiment 1: delay and control rate", &first, cells),
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

/// What becomes of a scene with one more quantity changed.
fn outcome(scene: &Scene, quantity: Quantity, value: f64) -> Outcome {
    let [footing, ..] = Footing::of(scene) else { return Outcome::Works };
    let criterion = Criterion::default();
    let trial = Trial { scene, quantity, footing: *footing, criterion };
    match trial.attempt(value, scene.integrator.step_s) {
        Ok(manner) => manner.into(),
        // A value that the scene's check refuses, like a delay beyond what motors can have.
        Err(_) => Outcome::Fails(Failure::Loop(Manner::NotReachable)),
    }
}

/// The last value between two that works, if any does.
fn edge(axis: &Axis, works: impl Fn(f64) -> bool) -> Foretold {
    let (mut low, mut high) = (axis.from, axis.to);
    if !works(low) {
        return Foretold::NothingWorks;
    }
    if works(high) {
        return Foretold::Unlimited;
    }
    for _ in 0..BISECTIONS {
        let middle = axis.between(low, high);
        *(if works(middle) { &mut low } else { &mut high }) = middle;
    }
    Foretold::At(low)
}

fn delay_and_rate(name: &'static str, title: &str, scene: &Scene, cells: usize) -> Map {
    let scene = scene.clone();
    let y = Axis::plain("delay", "ms", DELAYS).shown(1e3).cells(cells);
    Map {
        name,
        title: title.to_owned(),
        note: "A cell works if the robot stands within 10 mm and 1° of its set point for the last 0.5 s of 4 s. \
               Foretold for six double integrators under the sampled, delayed law, on ground that holds.",
        x: Axis::logarithmic("control rate", "Hz", RATES).cells(cells),
        y,
        stack: Box::new(move |rate_hz| {
            let mut scene = scene.clone();
            Quantity::ControlRate.set(&mut scene, rate_hz);
            let (axes, criterion) = (Axes::of(&scene), Criterion::default());
            Stack {
                foretold: edge(&y, |delay| settles(&axes, 1.0 / rate_hz, delay, &criterion)),
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
        note: "A cell works if the robot stands within 10 mm and 1° of its set point for the last 0.5 s of 4 s. \
               Foretold from the same run with feet that cannot slip: while what it asks of the floor's \
               friction is there, and the sampled loop settles.",
        x: Axis::logarithmic("friction", "", FRICTIONS).cells(cells),
        y,
        stack: Box::new(move |friction| {
            let mut scene = scene.clone();
            Quantity::Friction.set(&mut scene, friction);
            let criterion = Criterion::default();
            let (axes, period_s) = (Axes::of(&scene), 1.0 / scene.controller.rate_hz);
            let foretold = edge(&y, |scale| {
                let delay_s = scene.acting.delay_s;
                settles(&axes.scaled(scale), period_s, delay_s, &criterion)
                    && friction_asked(&scene, scale) <= friction
            });
            Stack {
                foretold,
                attempt: Box::new(move |scale| outcome(&scene, Quantity::GainScale, scale)),
            }
        }),
    }
}

/// The coefficient of friction that a loop asks for in the mean over both feet: at the worst moment, over the
/// whole run, with feet on ground of endless friction. Infinite where even that run fails.
fn friction_asked(scene: &Scene, scale: f64) -> f64 {
    /// More than any run asks for.
    const ENDLESS: f64 = 1e3;
    let mut scene = scene.clone();
    Quantity::GainScale.set(&mut scene, scale);
    if let Feet::Floor { floor, .. } = &mut scene.feet {
        (floor.static_friction, floor.dynamic_friction) = (ENDLESS, ENDLESS);
    }
    let (run, _) = play(&scene);
    if run.failure.is_some() {
        return f64::INFINITY;
    }
    let asked = run.samples.iter().filter_map(|sample| {
        let corners = sample.corner_forces?;
        let mut sum = [0.0; 3];
        for force in corners.as_flattened() {
            (0..3).for_each(|axis| sum[axis] += force[axis]);
        }
        // Feet that hardly press need no friction: they carry nothing.
        (sum[2] > 0.0).then(|| sum[0].hypot(sum[1]) / sum[2])
    });
    asked.fold(0.0, f64::max)
}
