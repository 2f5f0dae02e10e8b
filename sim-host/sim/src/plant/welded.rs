//! The biped with its feet welded to the floor: 18 degrees of freedom and 12 constraints, solved
//! densely. No contact code runs.
//!
//! # Notation
//! - `𝕄 β̇ + ℂ = τ + Jᵀ λ`, with `J` (12 × 18) from `β` to the feet's body twists
//! - step: `β⁺ = β + h β̇`, with `J β⁺ = 0` (1): the feet stand still at the end of the step
//!
//! (1) makes `J β̇ = −J β / h`; so `(J 𝕄⁻¹ Jᵀ) λ = −J β/h − J 𝕄⁻¹ (τ − ℂ)` (2). Both matrices are
//! positive definite and are factored by Cholesky.

use super::energies::energies;
use super::explicit_state::{ExplicitState, generalized};
use super::joint_stops::{motors_and_stops, stop_energy};
use super::{
    Observation, PerPoint, Plant, PlantState, StepFailure, check_velocities, in_body, retract,
};
use nalgebra::{Cholesky, SMatrix, SVector};
use surefoot::dynamics::{
    DynamicsFault, bias_forces, body_poses, body_velocities, joint_poses, mass_matrix,
};
use surefoot::model::robots::biped::{FEET, TREE};
use surefoot::spatial::{Pose, Wrench};
use surefoot_multibody::Stops;
use surefoot_multibody::contact::ContactState;

/// Coordinates and velocities of the robot.
const NQ: usize = 19;
const NV: usize = 18;
/// Constraints of two welded feet.
const WELDS: usize = 12;

/// The biped with welded feet.
#[derive(Clone, Debug)]
pub struct Welded {
    state: ExplicitState<NQ, NV>,
    stops: Option<Vec<Stops>>,
    /// Where the feet were welded, world from body.
    welds: [Pose<f64>; 2],
    /// Vertical forces on the feet in the last step, N.
    vertical: [f64; 2],
}

impl Welded {
    /// Welds the feet where they are at `state`.
    ///
    /// # Errors
    /// If that is no configuration.
    pub fn new(state: &PlantState) -> Result<Self, DynamicsFault> {
        let state = ExplicitState::of(state);
        let poses = body_poses(&TREE, &joint_poses(&TREE, &state.positions)?);
        Ok(Self { state, stops: None, welds: FEET.map(|foot| poses[foot]), vertical: [0.0; 2] })
    }

    /// With stops in the joints, left leg then right, hip to foot.
    pub fn with_stops(self, stops: Option<Vec<Stops>>) -> Self {
        Self { stops, ..self }
    }
}

impl Plant for Welded {
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        self.state.read(state);
        Ok(())
    }

    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        let ExplicitState { positions, velocities } = self.state;
        let relative = joint_poses(&TREE, &positions)?;
        let mut jacobian = SMatrix::<f64, WELDS, NV>::zeros();
        for column in 0..NV {
            let mut unit = [0.0; NV];
            unit[column] = 1.0;
            let twists = body_velocities(&TREE, &relative, &unit);
            for (foot, body) in FEET.into_iter().enumerate() {
                for (row, entry) in twists[body].to_array().into_iter().enumerate() {
                    jacobian[(6 * foot + row, column)] = entry;
                }
            }
        }
        let mass = SMatrix::from(mass_matrix(&TREE, &relative));
        let mass = Cholesky::new(mass)
            .ok_or(StepFailure::Dynamics(DynamicsFault::SingularInertia { joint: 0 }))?;
        let beta = SVector::from(velocities);
        let poses = body_poses(&TREE, &relative);
        let mut force = SVector::from(generalized(&motors_and_stops(
            torques,
            self.stops.as_deref(),
            &positions,
        ))) - SVector::from(bias_forces(&TREE, &relative, &velocities, None));
        if let Some(load) = load {
            let mut on_body = force.fixed_rows_mut::<6>(0);
            on_body += SVector::from(in_body(&load, &poses[0]).to_array());
        }

        // (2)
        let response = mass.solve(&jacobian.transpose());
        let compliance =
            Cholesky::new(jacobian * response).ok_or(StepFailure::SingularConstraints)?;
        let free = mass.solve(&force);
        let lambda = compliance.solve(&(-(jacobian * (beta / step_s + free))));
        let next: [f64; NV] = (beta + (free + response * lambda) * step_s).into();
        check_velocities(&next)?;

        for (foot, body) in FEET.into_iter().enumerate() {
            let on_foot = lambda.fixed_rows::<3>(6 * foot);
            self.vertical[foot] = (poses[body].rotation * on_foot).z;
        }
        self.state =
            ExplicitState { positions: retract(&positions, &next, step_s), velocities: next };
        Ok(())
    }

    fn read_contacts(&self, _: &mut PerPoint<ContactState>) -> bool {
        false
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let ExplicitState { positions, velocities } = &self.state;
        let relative = joint_poses(&TREE, positions)?;
        let poses = body_poses(&TREE, &relative);
        let (kinetic_energy, potential) = energies(&TREE, &poses, &relative, velocities);
        let apart = FEET.into_iter().zip(&self.welds).map(|(foot, weld)| {
            let drift = weld.inverse().compose(&poses[foot]);
            let turned = (drift.rotation - nalgebra::Matrix3::identity()).norm();
            // |R − 1| = 2√2 sin(θ/2) in the Frobenius norm.
            drift.position.norm().max(turned / std::f64::consts::SQRT_2)
        });
        Ok(Observation {
            kinetic_energy,
            potential_energy: potential + stop_energy(self.stops.as_deref(), positions),
            foot_forces: self.vertical.to_vec(),
            contacts: None,
            corner_forces: None,
            block: None,
            constraint: apart.fold(0.0, f64::max),
        })
    }

    fn step_limit(&self) -> Option<f64> {
        None
    }

    fn unknowns(&self) -> usize {
        NV + WELDS
    }
}
