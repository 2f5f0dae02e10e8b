//! Algorithm 4.3: workspace dynamics with very heavy feet, as printed.
//!
//! # Notation
//! Alg. 3.3's recursion (see `dynamics/forward_dynamics.rs`) with `τ = 0`, along each leg from a foot
//! with `P_foot = factor · M_1`, `z_foot = 0`, to the central body. Body bias `b = ΩMV − F^e`, with
//! gravity as an external force as printed: as an acceleration it would be multiplied by the big
//! base, and lost to round-off.
//!
//! The recursion runs in classical accelerations `a = v̇ + ω × v`; the printed `z_foot = 0` is for
//! the component derivative `v̇` at the foot's centre of mass, hence `z_foot = −P_foot (ω × v, 0)`.

use super::WorkspaceDynamics;
use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{CentralBody, Fault, LegKinematics, LeggedRobot};
use crate::dynamics::project_turn;
use crate::model::{JointKind, Node};
use crate::spatial::{ArticulatedInertia, Rotation, SymmetricMatrix3, Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// Alg. 4.3 with feet `factor` times as heavy as the central body (printed: 10⁶).
///
/// # Errors
/// [`Fault::IndefiniteInertia`] where round-off has made an articulated inertia indefinite.
///
/// # Accuracy
/// The model's own error is of the order of 1/factor; round-off grows as factor · ε. In f64 the
/// printed factor leaves 10⁻⁷, in f32 8 %.
#[inline]
pub fn big_base<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    factor: T,
) -> Result<WorkspaceDynamics<T>, Fault> {
    let body = &robot.central.inertia;
    let v = central.velocity;
    let mut inertia = ArticulatedInertia::from(*body);
    // In component derivatives, as V̇_1 is: b = (ω × m v, ω × Iω) − gravity.
    let mut bias = Wrench {
        force: (v.angular.cross(&v.linear) - central.gravity) * body.mass,
        torque: v.angular.cross(&body.rotational.product(v.angular)),
    };
    for (number, (links, leg)) in robot.legs.iter().zip(legs).enumerate() {
        let (p, z) = leg_recursion(robot, links, leg, central, factor)
            .ok_or(Fault::IndefiniteInertia { leg: number })?;
        // The leg's z is for the classical acceleration of the central body's origin.
        let shift = Twist { linear: v.angular.cross(&v.linear), angular: Vector3::zeros() };
        inertia = inertia + p;
        bias += z + p.product(shift);
    }
    Ok(WorkspaceDynamics { inertia, bias })
}

/// What one leg adds to the central body.
#[inline]
fn leg_recursion<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    links: &[Node<T>; LEG],
    leg: &LegKinematics<T>,
    central: &CentralBody<T>,
    factor: T,
) -> Option<(ArticulatedInertia<T>, Wrench<T>)> {
    let (mut p, mut z) = heavy_foot(robot, &links[LEG - 1], leg, factor);
    for k in (0..LEG).rev() {
        let node = &links[k];
        if k < LEG - 1 {
            p = p + ArticulatedInertia::from(node.inertia);
            z += body_bias(node, &leg.rotations[k], leg.angular_velocities[k], central.gravity);
        }
        let (inboard_rotation, inboard_omega, inboard_origin) = if k == 0 {
            (Matrix3::identity(), central.velocity.angular, Vector3::zeros())
        } else {
            (leg.rotations[k - 1], leg.angular_velocities[k - 1], leg.origins[k - 1])
        };
        let r = &leg.rotations[k];
        // c = (Rᵀ ω × (ω × r), ω × e θ̇), in the joint frame.
        let arm = leg.origins[k] - inboard_origin;
        let product = Twist {
            linear: r.tr_mul(&inboard_omega.cross(&inboard_omega.cross(&arm))),
            angular: r.tr_mul(&inboard_omega.cross(&leg.axes[k])) * leg.rates[k],
        };
        let JointKind::Revolute(axis) = &node.kind else { return None };
        let (projected, projected_bias, _) =
            project_turn(*axis, &p, &z, product, T::zero(), Some(node.rotor_inertia))?;
        let relative = Rotation::General(inboard_rotation.tr_mul(r));
        p = projected.rotated_inboard(&relative).shifted(node.offset);
        z = Wrench {
            force: relative.inboard(projected_bias.force),
            torque: relative.inboard(projected_bias.torque),
        }
        .shifted(node.offset);
    }
    Some((p, z))
}

/// `P_foot` and `z_foot` in the last joint's frame.
#[inline]
fn heavy_foot<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    foot: &Node<T>,
    leg: &LegKinematics<T>,
    factor: T,
) -> (ArticulatedInertia<T>, Wrench<T>) {
    let body = &robot.central.inertia;
    let at_center = ArticulatedInertia {
        linear: SymmetricMatrix3::scalar(body.mass * factor),
        coupling: Matrix3::zeros(),
        angular: body.rotational.scaled(factor),
    };
    let turn = foot.body_rotation.map_or(Rotation::Identity, Rotation::General);
    let p = at_center.rotated_inboard(&turn).shifted(foot.center);
    let r = &leg.rotations[LEG - 1];
    let omega = r.tr_mul(&leg.angular_velocities[LEG - 1]);
    let v = r.tr_mul(&leg.last_velocity) + omega.cross(&foot.center);
    // −P (ω × v, 0) at the centre of mass, then taken at the joint.
    let z = Wrench { force: omega.cross(&v) * (-body.mass * factor), torque: Vector3::zeros() }
        .shifted(foot.center);
    // The classical acceleration of the joint's point differs from the centre's by ω × (ω × c).
    let centripetal =
        Twist { linear: omega.cross(&omega.cross(&foot.center)), angular: Vector3::zeros() };
    (p, z + p.product(centripetal))
}

/// `b` of a link in its joint frame: gyroscopic terms less gravity.
#[inline]
fn body_bias<T: Real>(
    node: &Node<T>,
    rotation: &Matrix3<T>,
    omega: Vector3<T>,
    gravity: Vector3<T>,
) -> Wrench<T> {
    let inertia = &node.inertia;
    let (w, g) = (rotation.tr_mul(&omega), rotation.tr_mul(&gravity));
    let h = inertia.first_moment;
    Wrench {
        force: w.cross(&w.cross(&h)) - g * inertia.mass,
        torque: w.cross(&inertia.rotational.product(w)) - h.cross(&g),
    }
}
