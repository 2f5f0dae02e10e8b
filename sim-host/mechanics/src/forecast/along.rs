//! Forecasts for methods on mechanisms: a probe made of a method's own steps.

use super::course::Course;
use super::local::{
    Change, Forecast, Probe, has_modified_energy, oscillation_limit, steps_and_share,
};
use super::verdict::{Bounds, FailureKind};
use crate::integrators::{Method, Motion, StartError};
use crate::{Lagrangian, jacobian};

/// Share of the largest kinetic energy by which energy may be off.
const ENERGY_BAND: f64 = 0.1;
/// Constraints' bound, relative to squares of coordinates.
const CONSTRAINT: f64 = 0.01;
/// Steps in question, s.
pub const RANGE_S: [f64; 2] = [0.005, 1.5];

/// What a run on a course must keep.
pub fn bounds<S, const N: usize, const C: usize>(
    system: &S,
    course: &Course<N>,
    (x, v): (&[f64; N], &[f64; N]),
    duration_s: f64,
) -> Bounds
where
    S: Lagrangian<N, C>,
{
    let extent = x.iter().fold(1.0_f64, |m, x| m.max(x * x));
    Bounds {
        duration_s,
        energy: system.energy(x, v),
        energy_band: ENERGY_BAND * course.kinetic_j,
        dissipates: false,
        constraint: CONSTRAINT * extent,
    }
}

/// Whether a method imposes constraints' accelerations alone.
fn drifts(method: Method) -> bool {
    matches!(method, Method::SemiImplicitEuler | Method::RungeKutta4)
}

/// The longest step that a method should bear along a course; `None` where it is not made for the system.
/// `start` begins a motion with a step, from a configuration and a velocity.
///
/// # Cost
/// Some 100 000 steps.
pub fn foretell<S, const N: usize, const C: usize>(
    system: &S,
    course: &Course<N>,
    method: Method,
    start: impl Fn(f64, [f64; N], [f64; N]) -> Result<Motion<N>, StartError>,
) -> Option<Forecast>
where
    S: Lagrangian<N, C>,
{
    // The adaptive method bears any step: it makes its own.
    if method == Method::DormandPrince8 {
        return Some(Forecast::default());
    }
    let (x, v) = course.states.first()?;
    if let Err(error) = start(RANGE_S[0], *x, *v)
        && !matches!(error, StartError::FirstStep(_))
    {
        return None;
    }
    let step = |state: usize, steps: usize, h: f64| -> Result<Change, FailureKind> {
        let (x, v) = course.states[state];
        let mut motion = match start(h, x, v) {
            Ok(motion) => motion,
            Err(StartError::FirstStep(error)) => return Err(error.into()),
            Err(_) => return Err(FailureKind::NotFinite),
        };
        let energy_before = system.energy(&x, &v);
        let (mut energy, mut largest_energy) = (0.0, 0.0_f64);
        for _ in 0..steps {
            motion.step()?;
            energy = system.energy(motion.configuration(), &motion.velocity()?) - energy_before;
            if !(energy.abs() <= largest_energy.abs()) {
                largest_energy = energy;
            }
        }
        let (to, velocity) = (motion.configuration(), motion.velocity()?);
        let (constraints, rows) = jacobian(to, |q| system.constraints(q));
        let rate = |row: &[f64; N]| row.iter().zip(&velocity).map(|(g, v)| g * v).sum();
        Ok(Change {
            energy,
            largest_energy,
            constraints: constraints.to_vec(),
            rates: if drifts(method) { rows.iter().map(rate).collect() } else { Vec::new() },
        })
    };
    let (most_steps, share) = steps_and_share(method, C > 0);
    let probe = Probe {
        states: course.states.len(),
        spacing_s: course.spacing_s,
        most_steps,
        share,
        step: &step,
        has_modified_energy: has_modified_energy(method, C > 0),
        unstable_s: oscillation_limit(method) / course.oscillation,
        range_s: RANGE_S,
    };
    let duration_s = course.spacing_s * course.states.len() as f64;
    Some(probe.forecast(&bounds(system, course, (x, v), duration_s)))
}
