//! Trees of bodies under the multibody simulator: their limits, and what is foretold of them.
//!
//! The same three ways to fail as in [`super::forecast`], with the simulator's own steps as probes. Its
//! springs, dampers and floor are implicit and limit nothing but accuracy; weight enters a step like forces
//! do in Verlet's method, so that its fastest swing grows beyond `Ω h = 2`.

use super::problem::Problem;
use surefoot_mechanics::forecast::{Bounds, FailureKind, Verdict};
use surefoot_mechanics::forecast::{Change, FEW_STEPS, Forecast, Probe, SHARE, SHARE_OF_LOSSES};
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::contact::Floor;
use surefoot_multibody::{BodyState, Simulation, System, SystemError};

/// A motion of a tree: its system, its start, its time.
#[derive(Clone, Debug)]
pub struct TreeMotion {
    /// Bodies, joints, and what acts on them.
    pub system: System,
    /// All bodies' states.
    pub states: Vec<BodyState>,
    /// Their rates.
    pub rates: Vec<BodyState>,
    /// Time that it must last, s.
    pub duration_s: f64,
}

/// Steps in question, s.
const RANGE_S: [f64; 2] = [0.5e-3, 0.5];
/// The accurate motion's steps are this share of the time.
const STEPS: usize = 8000;
/// States of it that probes begin from.
const STATES: usize = 400;
/// Of these, those at which the fastest swing is asked for.
const SWINGS: usize = 20;
/// Share of the largest kinetic energy by which energy may be off.
const ENERGY_BAND: f64 = 0.1;
/// Largest error of a joint, m or rad.
const CONSTRAINT: f64 = 1e-6;

/// An accurate motion, watched.
struct Watched {
    states: Vec<(Vec<BodyState>, Vec<BodyState>)>,
    spacing_s: f64,
    unstable_s: f64,
    bounds: Bounds,
}

impl TreeMotion {
    /// As a problem of the catalogue. It has one method.
    pub fn problem(self, name: &'static str, description: &'static str) -> Problem {
        let watched = self.watched();
        let bounds = watched.bounds;
        let probed = self.clone();
        Problem {
            name,
            description,
            range_s: RANGE_S,
            period_s: None,
            attempt: Box::new(move |method, h| {
                (method == Method::Variational).then(|| self.attempt(h, &bounds))
            }),
            foretell: Box::new(move |method| {
                (method == Method::Variational).then(|| probed.forecast(&watched))
            }),
        }
    }

    /// The same with rates times a factor.
    #[must_use]
    pub fn faster(&self, by: f64) -> Self {
        let rates = self.rates.iter().map(|rate| rate.map(|x| x * by)).collect();
        Self { rates, ..self.clone() }
    }

    /// The same on another floor, if there is one.
    ///
    /// # Errors
    /// [`SystemError::Floor`].
    pub fn on_floor(mut self, floor: Floor) -> Result<Self, SystemError> {
        if let Some((_, switching)) = self.system.ground() {
            let (switching, sites) = (*switching, self.system.sites().to_vec());
            self.system = self.system.on_floor(floor, switching, sites)?;
        }
        Ok(self)
    }

    /// Whether the motion works in steps of `h`, none made in shorter ones.
    fn attempt(&self, h: f64, bounds: &Bounds) -> Verdict {
        let Self { system, states, rates, duration_s } = self;
        let fails = |kind, time_s| Verdict::Fails { kind, time_s };
        let Ok(simulation) = Simulation::new(system.clone(), h, states, rates) else {
            return fails(FailureKind::NotFinite, 0.0);
        };
        let mut simulation = simulation.without_splitting();
        for _ in 0..(duration_s / h).ceil() as u64 {
            let time_s = simulation.progress().time_s;
            if let Err(error) = simulation.step() {
                return fails(error.into(), error.time_s);
            }
            let energy = match simulation.energies() {
                Ok((kinetic, potential)) => kinetic + potential,
                Err(error) => return fails(error.into(), time_s),
            };
            if !energy.is_finite() {
                return fails(FailureKind::NotFinite, time_s);
            }
            if bounds.is_off(energy - bounds.energy) {
                return fails(FailureKind::Energy, time_s);
            }
        }
        if simulation.system().largest_constraint(&simulation.states()) <= bounds.constraint {
            Verdict::Works
        } else {
            fails(FailureKind::Constraint, simulation.progress().time_s)
        }
    }

    /// The motion in short steps, as far as it can be followed.
    fn watched(&self) -> Watched {
        let Self { system, states, rates, duration_s } = self;
        let dissipates =
            system.ground().is_some() || system.laws().iter().any(|(_, law)| law.dissipates());
        let mut watched = Watched {
            states: Vec::with_capacity(STATES),
            spacing_s: duration_s / STATES as f64,
            unstable_s: f64::INFINITY,
            bounds: Bounds {
                duration_s: *duration_s,
                energy: 0.0,
                energy_band: 0.0,
                dissipates,
                constraint: CONSTRAINT,
            },
        };
        let h = duration_s / STEPS as f64;
        let Ok(mut simulation) = Simulation::new(system.clone(), h, states, rates) else {
            return watched;
        };
        for step in 0..STEPS {
            if step % (STEPS / STATES) == 0 {
                let Ok((kinetic, potential)) = simulation.energies() else { break };
                let bounds = &mut watched.bounds;
                if step == 0 {
                    bounds.energy = kinetic + potential;
                }
                bounds.energy_band = bounds.energy_band.max(ENERGY_BAND * kinetic);
                let Ok(rates) = simulation.rates() else { break };
                watched.states.push((simulation.states(), rates));
            }
            if step % (STEPS / SWINGS) == 0
                && let Ok(swing) = simulation.fastest_swing()
            {
                watched.unstable_s = watched.unstable_s.min(2.0 / swing);
            }
            if simulation.step().is_err() {
                break;
            }
        }
        watched
    }

    fn forecast(&self, watched: &Watched) -> Forecast {
        let step = |state: usize, steps: usize, h: f64| -> Result<Change, FailureKind> {
            let (states, rates) = &watched.states[state];
            let simulation = Simulation::new(self.system.clone(), h, states, rates);
            let mut simulation =
                simulation.map_err(|_| FailureKind::NotFinite)?.without_splitting();
            let (kinetic, potential) = simulation.energies()?;
            let mut change = Change::default();
            for _ in 0..steps {
                simulation.step()?;
                let (kinetic_now, potential_now) = simulation.energies()?;
                change.energy = kinetic_now + potential_now - kinetic - potential;
                if !(change.energy.abs() <= change.largest_energy.abs()) {
                    change.largest_energy = change.energy;
                }
            }
            // What dissipates only loses energy: the floor and dampers are implicit.
            if watched.bounds.dissipates {
                change = Change::default();
            }
            Ok(change)
        };
        let probe = Probe {
            states: watched.states.len(),
            spacing_s: watched.spacing_s,
            step: &step,
            has_modified_energy: true,
            most_steps: FEW_STEPS,
            share: if watched.bounds.dissipates { SHARE_OF_LOSSES } else { SHARE },
            unstable_s: watched.unstable_s,
            range_s: RANGE_S,
        };
        probe.forecast(&watched.bounds)
    }
}
