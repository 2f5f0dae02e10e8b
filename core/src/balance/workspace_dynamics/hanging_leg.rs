//! A leg whose foot touches nothing.
//!
//! # Notation
//! As in `fixed_foot.rs`; `ρ` rate at which joints come to rest, 1/s.
//! ```text
//! θ̈_k = −ρ θ̇_k,    τ_k = e_k · n_k + I_k θ̈_k                                          (1)
//! ```
//! with `n_k` the moment about `q_k` of the inertial forces of links k to 6, the foot's among them: the
//! torques that make the joints come to rest where they are, whatever the central body does. It bears
//! the sum of these forces.

use super::fixed_foot::accelerate;
use super::inertial::inertial_wrench;
use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{CentralBody, LegKinematics};
use crate::model::Node;
use crate::spatial::Wrench;
use nalgebra::Vector3;

/// What a hanging leg asks for.
#[derive(Clone, Copy, Debug)]
pub(in crate::balance) struct HangingLeg<T> {
    /// Of the central body, at its centre of mass, frame 1's axes.
    pub on_central_body: Wrench<T>,
    /// Of its joints, N·m.
    pub torques: [T; LEG],
}

/// (1), for the angular acceleration `alpha_1` of the central body and the acceleration `a_1` of its
/// centre of mass less gravity, frame 1's axes.
#[inline]
pub(in crate::balance) fn hanging_leg<T: Real>(
    links: &[Node<T>; LEG],
    leg: &LegKinematics<T>,
    central: &CentralBody<T>,
    alpha_1: Vector3<T>,
    a_1: Vector3<T>,
    rest_rate: T,
) -> HangingLeg<T> {
    let theta_ddot = leg.rates.map(|rate| -rate * rest_rate);
    let mut forces = [Wrench::zero(); LEG];
    accelerate(leg, central, alpha_1, a_1, &theta_ddot, |k, alpha, a| {
        forces[k] =
            inertial_wrench(&links[k], &leg.rotations[k], leg.angular_velocities[k], alpha, a);
    });
    let mut torques = [T::zero(); LEG];
    let mut sum = Wrench::zero();
    let mut at = leg.origins[LEG - 1];
    for k in (0..LEG).rev() {
        sum = sum.shifted(at - leg.origins[k]) + forces[k];
        at = leg.origins[k];
        torques[k] = leg.axes[k].dot(&sum.torque) + links[k].rotor_inertia * theta_ddot[k];
    }
    HangingLeg { on_central_body: sum.shifted(at), torques }
}
