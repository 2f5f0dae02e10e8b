//! What the ground gives the feet: the wrenches that the joints make, and what the legs' links ask for.
//!
//! # Notation
//! - `w_i` wrench of Alg. 4.6 on foot i: the joint torques that make it are linear in it
//! - `c_i` what the leg's links and the foot add by their inertia and weight
//! - `t` joint moments of the inertial and weight forces of a leg's links (see `fixed_foot.rs`)
//! - sole axes: those in which the robot was described at home (z up there), fixed to the foot
//!
//! With the foot held, a leg obeys `M_l θ̈ + h_l = τ − J_lᵀ F_hip`. The wrench of the ground at its foot
//! is then
//! ```text
//! ground_i = w_i + c_i,    c_i = J⁻ᵀ t(X) − m_foot g                                       (1)
//! ```
//! at the acceleration `X` of the central body. Standing, `c_i` is the weight of a leg.

use super::robot::LEG;
use super::workspace_dynamics::fixed_foot_wrench_of_legs;
use super::{CentralBody, Fault, LegKinematics, LeggedRobot};
use crate::Real;
use crate::spatial::{Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// The wrench on the central body that an acceleration needs, and what the ground then gives the feet
/// beside the wrenches of the joints; from [`fixed_foot_wrenches`].
#[derive(Clone, Copy, Debug)]
pub struct FixedFootWrenches<T, const LEGS: usize> {
    /// `P_1 X + z_1`, on the central body, in its frame: what [`super::fixed_foot_wrench`] gives.
    pub on_central_body: Wrench<T>,
    /// `c_i` of (1), on each foot at its centre of mass, in sole axes.
    pub ground_bias: [Wrench<T>; LEGS],
}

/// [`super::fixed_foot_wrench`] with the ground's part, for the acceleration `x` of the central body.
///
/// # Errors
/// [`Fault::SingularLeg`].
///
/// # Cost
/// That of [`super::fixed_foot_wrench`] and about 60 multiplications a leg.
#[inline]
pub fn fixed_foot_wrenches<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    singularity: T,
    x: Twist<T>,
) -> Result<FixedFootWrenches<T, LEGS>, Fault> {
    let zero = Wrench { force: Vector3::zeros(), torque: Vector3::zeros() };
    let mut at_ankles = [zero; LEGS];
    let on_central_body = fixed_foot_wrench_of_legs::<T, LEGS, true>(
        robot,
        central,
        legs,
        singularity,
        x,
        |leg, w| {
            if let Some(entry) = at_ankles.get_mut(leg) {
                *entry = w;
            }
        },
    )?;
    let axes = sole_axes(robot, legs);
    let ground_bias = ground_biases(robot, central, legs, &axes, at_ankles);
    Ok(FixedFootWrenches { on_central_body, ground_bias })
}

/// `c_i` of (1) from the wrenches at the last joints by which the ground holds the legs.
#[inline(always)]
pub(super) fn ground_biases<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    axes: &[Matrix3<T>; LEGS],
    at_ankles: [Wrench<T>; LEGS],
) -> [Wrench<T>; LEGS] {
    let mut biases = at_ankles;
    for (((bias, leg), links), axes) in biases.iter_mut().zip(legs).zip(&robot.legs).zip(axes) {
        // From the last joint to the foot's centre of mass.
        let mut wrench = bias.shifted(leg.origins[LEG - 1] - leg.foot.position);
        wrench.force -= central.gravity * links[LEG - 1].inertia.mass;
        *bias = in_axes(axes, &wrench);
    }
    biases
}

/// Frame 1 from the sole axes of each foot.
#[inline]
pub fn sole_axes<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    legs: &[LegKinematics<T>; LEGS],
) -> [Matrix3<T>; LEGS] {
    let mut axes = [Matrix3::zeros(); LEGS];
    for ((axes, leg), links) in axes.iter_mut().zip(legs).zip(&robot.legs) {
        let last = &leg.rotations[LEG - 1];
        *axes = match &links[LEG - 1].home_axes {
            None => *last,
            Some(home) => last * home.transpose(),
        };
    }
    axes
}

/// A wrench in the axes that are the columns of a matrix.
#[inline]
pub(super) fn in_axes<T: Real>(axes: &Matrix3<T>, wrench: &Wrench<T>) -> Wrench<T> {
    Wrench { force: axes.tr_mul(&wrench.force), torque: axes.tr_mul(&wrench.torque) }
}
