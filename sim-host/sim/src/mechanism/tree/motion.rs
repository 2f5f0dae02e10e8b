//! Methods on the differential equations of a tree, in joint coordinates: what most simulators do.

use super::super::moving::{Moving, dissipates_nothing, kinetic};
use super::description::tree_model;
use super::equations::{Rates, TreeModel};
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use std::cell::Cell;
use surefoot::dynamics::DynamicsFault;
use surefoot_mechanics::integrators::{Method, Progress, StartError, StepError, StepFailure};
use surefoot_mechanics::newton::NewtonFailure;
use surefoot_multibody::{BodyState, Simulation, System};

/// Coordinates and velocities stay below this, or have run away.
const LARGEST: f64 = 1e100;
/// Adaptive steps within a step at most.
const MOST_ADAPTIVE_STEPS: usize = 100_000;

/// A method on differential equations.
#[derive(Clone, Copy, Debug, PartialEq)]
enum TreeMethod {
    /// Velocities, then positions along the new ones.
    SemiImplicitEuler,
    RungeKutta4,
    /// Within a tolerance.
    DormandPrince8(f64),
}

/// A tree on its way.
pub(crate) struct OnTree {
    model: Box<dyn TreeModel>,
    system: System,
    /// Whether angular momentum is conserved.
    is_free: bool,
    /// Whether a motor does work.
    is_driven: bool,
    method: TreeMethod,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    progress: Progress,
}

impl OnTree {
    /// From a motion that has not begun, with torques held in its joints by link.
    ///
    /// # Errors
    /// [`StartError::NotFor`] where the method is not one on differential equations, or does not take the bodies.
    pub fn new(
        method: Method,
        tolerance: f64,
        mut simulation: Simulation,
        torques: &[f64],
    ) -> Result<Self, StartError> {
        let not_for = |takes| StartError::NotFor { method, takes };
        let on_tree = match method {
            Method::SemiImplicitEuler => TreeMethod::SemiImplicitEuler,
            Method::RungeKutta4 => TreeMethod::RungeKutta4,
            Method::DormandPrince8 => TreeMethod::DormandPrince8(tolerance),
            _ => return Err(not_for("the mechanisms of chapter 2")),
        };
        let model = tree_model(&mut simulation, torques).map_err(not_for)?;
        let is_free = !simulation.conserved()?.1.is_empty();
        let (positions, velocities) = model.start();
        let progress = Progress::new(simulation.progress().h);
        let system = simulation.system().clone();
        let is_driven = torques.iter().any(|torque| *torque != 0.0);
        let method = on_tree;
        Ok(Self { model, system, is_free, is_driven, method, positions, velocities, progress })
    }

    fn fault(&self, fault: DynamicsFault) -> StepError {
        self.progress.error(fault)
    }

    fn rates(&self, x: &[f64], v: &[f64]) -> Result<[Vec<f64>; 2], StepError> {
        let (mut positions, mut velocities) = (vec![0.0; x.len()], vec![0.0; v.len()]);
        let into = Rates { positions: &mut positions, velocities: &mut velocities };
        self.model.rates(x, v, into).map_err(|fault| self.fault(fault))?;
        Ok([positions, velocities])
    }

    fn euler(&mut self) -> Result<(), StepError> {
        let h = self.progress.h;
        let [_, a] = self.rates(&self.positions, &self.velocities)?;
        let v = moved(&self.velocities, &a, h);
        let x_dot = self.model.position_rates(&self.positions, &v);
        self.positions = moved(&self.positions, &x_dot, h);
        self.velocities = v;
        self.progress.evaluated(1);
        Ok(())
    }

    fn runge_kutta(&mut self) -> Result<(), StepError> {
        let h = self.progress.h;
        let (x, v) = (&self.positions, &self.velocities);
        let k1 = self.rates(x, v)?;
        let k2 = self.rates(&moved(x, &k1[0], 0.5 * h), &moved(v, &k1[1], 0.5 * h))?;
        let k3 = self.rates(&moved(x, &k2[0], 0.5 * h), &moved(v, &k2[1], 0.5 * h))?;
        let k4 = self.rates(&moved(x, &k3[0], h), &moved(v, &k3[1], h))?;
        let mean = |part: usize| -> Vec<f64> {
            let all = k1[part].iter().zip(&k2[part]).zip(&k3[part]).zip(&k4[part]);
            all.map(|(((a, b), c), d)| (a + 2.0 * (b + c) + d) / 6.0).collect()
        };
        let (x, v) = (moved(x, &mean(0), h), moved(v, &mean(1), h));
        (self.positions, self.velocities) = (x, v);
        self.progress.evaluated(4);
        Ok(())
    }

    fn dormand_prince(&mut self, tolerance: f64) -> Result<(), StepError> {
        let split = self.positions.len();
        let failed: Cell<Option<DynamicsFault>> = Cell::new(None);
        let model = &self.model;
        let rates = |_: f64, y: &Vec<f64>, rates: &mut Vec<f64>| {
            let (positions, velocities) = rates.split_at_mut(split);
            let into = Rates { positions, velocities };
            if let Err(fault) = model.rates(&y[..split], &y[split..], into) {
                failed.set(Some(fault));
                rates.fill(f64::NAN);
            }
        };
        let start = [&self.positions[..], &self.velocities[..]].concat();
        let method = ExplicitRungeKutta::dop853()
            .rtol(tolerance)
            .atol(tolerance)
            .max_steps(MOST_ADAPTIVE_STEPS);
        let solution = IVP::ode_from_fn(rates, 0.0, self.progress.h, start).method(method).solve();
        let progress = &self.progress;
        let lost = || progress.error(failed.get().map_or(StepFailure::Adaptive, Into::into));
        let solution = solution.map_err(|_| lost())?;
        let Some((_, end)) = solution.last().ok().filter(|(_, y)| y.iter().all(|y| y.is_finite()))
        else {
            return Err(lost());
        };
        self.progress.evaluated(solution.evals.function as u64);
        self.positions.copy_from_slice(&end[..split]);
        self.velocities.copy_from_slice(&end[split..]);
        Ok(())
    }

    fn bodies(&self) -> Result<(Vec<BodyState>, Vec<BodyState>), StepError> {
        self.model.bodies(&self.positions, &self.velocities).map_err(|fault| self.fault(fault))
    }
}

fn moved(from: &[f64], along: &[f64], by: f64) -> Vec<f64> {
    from.iter().zip(along).map(|(x, d)| x + by * d).collect()
}

impl Moving for OnTree {
    fn step(&mut self) -> Result<(), StepError> {
        let before = (self.positions.clone(), self.velocities.clone());
        match self.method {
            TreeMethod::SemiImplicitEuler => self.euler()?,
            TreeMethod::RungeKutta4 => self.runge_kutta()?,
            TreeMethod::DormandPrince8(tolerance) => self.dormand_prince(tolerance)?,
        }
        // Energies are squares of these.
        let bears = |x: &f64| x.abs() < LARGEST;
        if !self.positions.iter().chain(&self.velocities).all(bears) {
            (self.positions, self.velocities) = before;
            return Err(self.progress.error(NewtonFailure::NotFinite));
        }
        if let Some(first) = self.model.quaternion() {
            let q = &mut self.positions[first..first + 4];
            let norm = q.iter().map(|q| q * q).sum::<f64>().sqrt();
            q.iter_mut().for_each(|q| *q /= norm);
        }
        self.progress.advance();
        Ok(())
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        let (states, rates) = self.bodies()?;
        Ok((states.concat(), rates.concat()))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        let (states, rates) = self.bodies()?;
        let system = &self.system;
        let momentum =
            if self.is_free { system.momentum(&states, &rates).1.to_vec() } else { Vec::new() };
        let energy = system.energy(&states, &rates, |link| self.model.angle(link, &self.positions));
        Ok((energy, momentum, system.largest_constraint(&states)))
    }

    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        kinetic(&self.system, configuration, velocity)
    }

    fn keeps_energy(&self) -> bool {
        dissipates_nothing(&self.system) && !self.is_driven
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Nothing is foretold of these methods on trees.
    fn forecast_s(&mut self) -> Option<f64> {
        None
    }

    fn unknowns(&self) -> usize {
        self.velocities.len()
    }
}
