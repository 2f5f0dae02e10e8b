//! The discrete equations of motion (5.11) and their solution.
//!
//! # Notation
//! As in [`surefoot_mechanics::integrators::Variational`]: `d` is a step's mean velocity, `p` the momentum at its
//! beginning; per body
//!
//! ```text
//! p⁻(X, d) − p − Bᵀ γ − G_oᵀ λ − Σ G_{j,i}ᵀ λ_j = 0                       (1) = (5.11)
//! b(X + h d)/h = 0,   g(X_o + h d_o, X_i + h d_i)/h = 0
//! ```
//! `γ, λ` are impulses, and constraints are divided by the step: with that the Jacobian's blocks are
//! `[M −Gᵀ; G 0]` with no power of h, where the raw one's condition grows as h⁻².

use super::super::body::BodyState;
use super::super::scale::Scale;
use super::super::system::{System, WORLD};
use super::super::system_error::SystemError;
use super::scales::{extent, inertia};
use super::tree_solver::{Correction, Equations, TreeEquations};
use super::trial::Trial;
use surefoot_mechanics::integrators::{Progress, StepError, StepFailure};
use surefoot_mechanics::newton::NewtonFailure;

/// A motion of a system.
#[derive(Clone, Debug)]
pub struct ConstrainedSimulation {
    pub(super) system: System,
    states: Vec<BodyState>,
    /// Mean velocities of the last step.
    pub(super) d: Vec<BodyState>,
    /// `p⁺` of the last step.
    pub(super) momenta: Vec<BodyState>,
    pub(super) multipliers: Vec<Correction>,
    pub(super) equations: TreeEquations,
    /// Iterates, corrections, and momenta at the end of the step tried.
    trial: Trial,
    /// Of the step that is being made.
    scale: Scale,
    pub(super) progress: Progress,
}

/// Newton steps at most.
const MOST_ITERATIONS: u32 = 30;
/// Halvings of a step at most.
const MOST_HALVINGS: u32 = 10;
/// Residuals, relative to their terms, that count as a root once they fall no further.
const TOLERANCE: f64 = 1e-10;
/// Residuals that count as a root at once.
const ROUND_OFF: f64 = 1e-14;

impl ConstrainedSimulation {
    /// From states and rates on the manifold, without spoiling the order.
    ///
    /// # Errors
    /// A [`SystemError`].
    pub fn new(
        system: System,
        h: f64,
        states: Vec<BodyState>,
        rates: Vec<BodyState>,
    ) -> Result<Self, SystemError> {
        if !(h > 0.0 && h.is_finite()) {
            return Err(SystemError::Step { h });
        }
        system.check_start(&states, &rates)?;
        let nodes = system
            .links()
            .iter()
            .map(|link| Equations::new(link.inboard, link.joint.constraints()))
            .collect();
        let gravity = system.gravity();
        let each = || system.links().iter().zip(&states).zip(&rates);
        let momenta: Vec<BodyState> =
            each().map(|((link, x), v)| link.body.momenta(x, v, 0.0, gravity).begin).collect();
        let trial = Trial::new(&rates, &momenta);
        Ok(Self {
            system,
            states,
            d: rates,
            momenta,
            multipliers: trial.multipliers.clone(),
            equations: TreeEquations::new(nodes),
            trial,
            scale: Scale::default(),
            progress: Progress::new(h),
        })
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// All bodies' states.
    pub fn states(&self) -> &[BodyState] {
        &self.states
    }

    /// Time and statistics.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Coordinates and constraints.
    pub fn unknowns(&self) -> usize {
        self.equations.nodes.iter().map(|node| 8 + node.constraints).sum()
    }

    /// Velocities along the manifold that have this momentum, up to what constraints may add.
    ///
    /// # Errors
    /// A [`StepError`] where constraints are dependent.
    pub fn rates(&self) -> Result<Vec<BodyState>, StepError> {
        let mut equations = self.equations.clone();
        for (k, link) in self.system.links().iter().enumerate() {
            let x = &self.states[k];
            let inboard = link.inboard.map_or(&WORLD, |inboard| &self.states[inboard]);
            let rows = link.joint.rows(x, inboard);
            let node = &mut equations.nodes[k];
            // For a step of no length the momentum is linear in the velocity.
            node.stiffness = link.body.momenta(x, &self.d[k], 0.0, 0.0).stiffness;
            node.force = self.momenta[k].map(|p| -p);
            node.norm = [norm_row(x); 2];
            node.norm_error = 0.0;
            node.outboard_rows = [rows.outboard; 2];
            node.inboard_rows = [rows.inboard; 2];
            node.error = Default::default();
        }
        let mut all = self.multipliers.clone();
        equations.solve(&mut all).map_err(|error| self.singular(error.joint))?;
        Ok(all.iter().map(|correction| correction.coordinates).collect())
    }

    /// One step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    ///
    /// # Cost
    /// Linear in the number of links for each Newton iteration; no allocation.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.trial.begin(&self.d, &self.multipliers);
        self.begin();
        let mut error = self.evaluate();
        let mut iterations = 0;
        'newton: loop {
            if !error.is_finite() {
                return Err(self.progress.error(NewtonFailure::NotFinite));
            }
            if error <= ROUND_OFF {
                break;
            }
            if iterations == MOST_ITERATIONS {
                let failure = NewtonFailure::TooManyIterations { iterations, residual: error };
                return Err(self.progress.error(failure));
            }
            if let Err(singular) = self.equations.solve(&mut self.trial.corrections) {
                return Err(self.singular(singular.joint));
            }
            self.trial.keep();
            let mut share = 1.0;
            for halvings in 0..=MOST_HALVINGS {
                self.trial.take(share);
                let tried = self.evaluate();
                if tried <= (1.0 - 1e-4 * share) * error {
                    error = tried;
                    iterations += 1;
                    continue 'newton;
                }
                if error <= TOLERANCE {
                    // Round-off has the last word: back to the best iterate.
                    self.trial.take(0.0);
                    self.evaluate();
                    break 'newton;
                }
                if halvings == MOST_HALVINGS {
                    let failure = NewtonFailure::NoRootNearby { residual: error };
                    return Err(self.progress.error(failure));
                }
                share *= 0.5;
            }
        }
        let h = self.progress.h;
        for k in 0..self.states.len() {
            for i in 0..7 {
                self.states[k][i] += h * self.trial.d[k][i];
            }
        }
        self.d.copy_from_slice(&self.trial.d);
        self.momenta.copy_from_slice(&self.trial.ends);
        self.multipliers.copy_from_slice(&self.trial.multipliers);
        self.progress.iterated(iterations, error);
        self.progress.advance();
        Ok(())
    }

    fn singular(&self, joint: usize) -> StepError {
        self.progress.error(StepFailure::Newton(NewtonFailure::SingularJacobian { pivot: joint }))
    }

    /// Rows at the step's beginning, into `equations`.
    fn begin(&mut self) {
        for (k, link) in self.system.links().iter().enumerate() {
            let x = &self.states[k];
            let inboard = link.inboard.map_or(&WORLD, |inboard| &self.states[inboard]);
            let rows = link.joint.rows(x, inboard);
            let node = &mut self.equations.nodes[k];
            node.norm[0] = norm_row(x);
            node.outboard_rows[0] = rows.outboard;
            node.inboard_rows[0] = rows.inboard;
        }
        self.scale = self.measured();
    }

    /// Residual (5.11) and Jacobian (5.13) at the trial, into `equations`; largest residual relative to
    /// its terms.
    fn evaluate(&mut self) -> f64 {
        self.progress.evaluated(1);
        let h = self.progress.h;
        let gravity = self.system.gravity();
        let mut largest = 0.0_f64;
        let mut note = |residual: f64, size: f64| {
            let relative = (residual / size).abs();
            if relative > largest || relative.is_nan() {
                largest = relative;
            }
        };
        let end_of = |x: &BodyState, d: &BodyState| -> BodyState {
            std::array::from_fn(|i| x[i] + h * d[i])
        };
        for (k, link) in self.system.links().iter().enumerate() {
            let (x, d) = (&self.states[k], &self.trial.d[k]);
            let y = end_of(x, d);
            let y_i = match link.inboard {
                None => WORLD,
                Some(i) => end_of(&self.states[i], &self.trial.d[i]),
            };
            let step = link.body.momenta(x, d, h, gravity);
            self.trial.ends[k] = step.end;
            let end = link.joint.rows(&y, &y_i);
            let node = &mut self.equations.nodes[k];
            let tried = &self.trial.multipliers[k];
            node.stiffness = step.stiffness;
            node.norm[1] = norm_row(&y);
            node.outboard_rows[1] = end.outboard;
            node.inboard_rows[1] = end.inboard;
            for i in 0..7 {
                let held: f64 = (0..node.constraints)
                    .map(|c| node.outboard_rows[0][c][i] * tried.multipliers[c])
                    .sum();
                let norm = node.norm[0][i] * tried.norm_multiplier;
                node.force[i] = step.begin[i] - self.momenta[k][i] - held - norm;
            }
            let norm = y[3..].iter().map(|q| q * q).sum::<f64>() - 1.0;
            node.norm_error = norm / h;
            note(norm, 1.0);
            // A length is off against the joint's arms, and where it is; an angle against one.
            let away = y[..3].iter().fold(extent(link), |m, x| m.max(x.abs()));
            for c in 0..node.constraints {
                node.error[c] = end.error[c] / h;
                let is_length = end.outboard[c][..3].iter().any(|g| *g != 0.0);
                note(end.error[c], if is_length { away } else { 1.0 });
            }
        }
        // Outboard joints pull on their inboard bodies.
        for k in (0..self.equations.nodes.len()).rev() {
            let node = &self.equations.nodes[k];
            let Some(inboard) = node.inboard else { continue };
            let (rows, constraints) = (node.inboard_rows[0], node.constraints);
            let tried = self.trial.multipliers[k].multipliers;
            let force = &mut self.equations.nodes[inboard].force;
            for c in 0..constraints {
                for (f, g) in force.iter_mut().zip(&rows[c]) {
                    *f -= g * tried[c];
                }
            }
        }
        let mut sum = 0.0;
        for (node, link) in self.equations.nodes.iter().zip(self.system.links()) {
            for (f, inertia) in node.force.iter().zip(inertia(&link.body)) {
                sum += f * f / inertia;
            }
        }
        note(self.scale.relative(sum), 1.0);
        largest
    }
}

/// `B`: derivative of `|q|² − 1`.
fn norm_row(x: &BodyState) -> BodyState {
    [0.0, 0.0, 0.0, 2.0 * x[3], 2.0 * x[4], 2.0 * x[5], 2.0 * x[6]]
}
