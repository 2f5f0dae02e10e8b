//! Workspace dynamics with the feet held exactly.
//!
//! # Idea
//! With the foot at rest, six joints leave the leg no freedom of its own: an acceleration `X` of the
//! central body determines the joints', `J θ̈ = −(what the foot would do)`, and Newton and Euler give
//! the links' forces. With no torque in the joints, the ground holds the rest. That is one 6 × 6
//! factorisation and two solves per leg; no inertia matrix is formed.
//!
//! # Notation
//! Frame 1; `o` the last joint, `q_k, e_k, ω_k` joints, axes, angular velocities.
//! - `α_k, a_k` angular acceleration of link k, acceleration of `q_k` less gravity
//! - `t_k = e_k · n_k + I_k θ̈_k`, with `n_k` the moment about `q_k` of the inertial forces of links k
//!   to 5, and `I_k` the joint's rotor inertia
//! - `w` wrench at `o` with `Jᵀ w = t`; `F_k` inertial wrenches
//!
//! ```text
//! α_k = α_{k−1} + e_k θ̈_k + ω_{k−1} × e_k θ̇_k,   a_k = a_{k−1} + K_{k−1}(q_k − q_{k−1})      (1)
//! foot at rest: α_6 = 0 and a_6 = ω_6 × v_6 − g                                            (2)
//! F_1 = M_1 X + b_1 + Σ_legs (Σ_k F_k − w)                                                  (3)
//! ```
//! (2) says that the component derivative of the foot's twist is zero, which is what the big base of
//! Alg. 4.3 tends to. (3) equals `P_1 X + z_1` with `P_1 = M_1 + Σ J⁻ᵀ M_l J⁻¹`; [`fixed_foot_dynamics`]
//! forms that matrix for those who want to see it.

use super::WorkspaceDynamics;
use super::inertial::{inertial_wrench, relative_acceleration};
use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{CentralBody, Fault, LegJacobian, LegKinematics, LeggedRobot};
use crate::model::Node;
use crate::spatial::{ArticulatedInertia, RigidInertia, Rotation, SymmetricMatrix3, Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// The wrench `P_1 X + z_1` on the central body that gives it the acceleration `x` while the feet
/// stand still and the joints are free. `singularity` is the least pivot of a leg's dimensionless
/// Jacobian that is accepted.
///
/// # Errors
/// [`Fault::SingularLeg`].
///
/// # Cost
/// O(1) per leg: about 700 multiplications, 18 divisions.
#[inline(always)]
pub fn fixed_foot_wrench<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    singularity: T,
    x: Twist<T>,
) -> Result<Wrench<T>, Fault> {
    fixed_foot_wrench_of_legs::<T, LEGS, true>(robot, central, legs, singularity, x, |_, _| {})
}

/// The same, which calls `held` with the number of each leg and its `w`: the wrench at the last joint,
/// frame 1's axes, by which the ground holds the leg while its joints are free. Without `ROTORS` for
/// robots that have none.
#[inline(always)]
pub(in crate::balance) fn fixed_foot_wrench_of_legs<
    T: Real,
    const LEGS: usize,
    const ROTORS: bool,
>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    singularity: T,
    x: Twist<T>,
    mut held: impl FnMut(usize, Wrench<T>),
) -> Result<Wrench<T>, Fault> {
    let v = central.velocity;
    // Acceleration of the centre of mass less gravity, from the component derivative.
    let a = x.linear + v.angular.cross(&v.linear) - central.gravity;
    let mut wrench = inertial_wrench(&robot.central, &Matrix3::identity(), v.angular, x.angular, a);
    for (number, ((links, leg), reach)) in robot.legs.iter().zip(legs).zip(&robot.reach).enumerate()
    {
        let jacobian =
            LegJacobian::new(leg, *reach, singularity).ok_or(Fault::SingularLeg { leg: number })?;
        let inertial =
            leg_wrench::<T, ROTORS>(links, leg, &jacobian, central, (x.angular, a), None);
        wrench += inertial.links - inertial.ground.shifted(leg.origins[LEG - 1]);
        held(number, inertial.ground);
    }
    Ok(wrench)
}

/// One leg's part of (3).
pub(in crate::balance) struct LegWrench<T> {
    /// `Σ F_k`, at the centre of mass of the central body.
    pub links: Wrench<T>,
    /// `w`, at the last joint.
    pub ground: Wrench<T>,
}

/// That part, for the angular acceleration `alpha_1` of the central body and the acceleration `a_1` of
/// its centre of mass less gravity. A foot that creeps goes on as it does; with a rate ρ (1/s) it comes
/// to rest, `α_6 = −ρ ω_6`, `a_6 = ω_6 × v_6 − g − ρ v_6` in place of (2).
#[inline(always)]
pub(in crate::balance) fn leg_wrench<T: Real, const ROTORS: bool>(
    links: &[Node<T>; LEG],
    leg: &LegKinematics<T>,
    jacobian: &LegJacobian<T>,
    central: &CentralBody<T>,
    (alpha_1, a_1): (Vector3<T>, Vector3<T>),
    rest_rate: Option<T>,
) -> LegWrench<T> {
    let zero = Vector3::zeros();
    // What the foot would do with θ̈ = 0, and by (2) should do.
    let (alpha, a) = accelerate(leg, central, alpha_1, a_1, &[T::zero(); LEG], |_, _, _| {});
    let at_rest = leg.angular_velocities[LEG - 1].cross(&leg.last_velocity) - central.gravity;
    let mut missing = Twist { linear: at_rest - a, angular: -alpha };
    if let Some(rate) = rest_rate {
        missing.linear -= leg.last_velocity * rate;
        missing.angular -= leg.angular_velocities[LEG - 1] * rate;
    }
    let theta_ddot = jacobian.solve(missing);

    let mut forces = [Wrench { force: zero, torque: zero }; LEG];
    accelerate(leg, central, alpha_1, a_1, &theta_ddot, |k, alpha, a| {
        // The foot stands still and asks for nothing.
        if k < LEG - 1 {
            forces[k] =
                inertial_wrench(&links[k], &leg.rotations[k], leg.angular_velocities[k], alpha, a);
        }
    });

    // Moments inboard, about each joint in turn; then about frame 1's origin.
    let mut t = [T::zero(); LEG];
    let mut sum = Wrench { force: zero, torque: zero };
    let mut at = leg.origins[LEG - 1];
    for k in (0..LEG - 1).rev() {
        sum = sum.shifted(at - leg.origins[k]) + forces[k];
        at = leg.origins[k];
        t[k] = leg.axes[k].dot(&sum.torque);
    }
    if ROTORS {
        for ((t, node), theta_ddot) in t.iter_mut().zip(links).zip(theta_ddot) {
            *t += node.rotor_inertia * theta_ddot;
        }
    }
    LegWrench { links: sum.shifted(at), ground: jacobian.solve_transposed(&t) }
}

/// (1) along a leg: calls `link` with the number, angular acceleration and joint's acceleration of
/// each link, and returns those of the foot.
#[inline(always)]
pub(super) fn accelerate<T: Real>(
    leg: &LegKinematics<T>,
    central: &CentralBody<T>,
    alpha_1: Vector3<T>,
    a_1: Vector3<T>,
    theta_ddot: &[T; LEG],
    mut link: impl FnMut(usize, Vector3<T>, Vector3<T>),
) -> (Vector3<T>, Vector3<T>) {
    let (mut alpha, mut a) = (alpha_1, a_1);
    let mut omega = central.velocity.angular;
    let mut at = Vector3::zeros();
    for k in 0..LEG {
        let arm = leg.origins[k] - at;
        // Joints in one point, as in a hip or an ankle, share their acceleration.
        if arm != Vector3::zeros() {
            a += relative_acceleration(omega, alpha, arm);
            at = leg.origins[k];
        }
        let e = leg.axes[k];
        alpha += e * theta_ddot[k] + omega.cross(&e) * leg.rates[k];
        omega = leg.angular_velocities[k];
        link(k, alpha, a);
    }
    (alpha, a)
}

/// `P_1` and `z_1` themselves: `P_1 = M_1 + Σ J⁻ᵀ M_l J⁻¹`, with `M_l` the leg's mass matrix seen
/// from its foot.
///
/// Link j moves with the joints outboard of it, `V_j = −Σ_{k>j} S_k θ̇_k`, so that joints k ≤ m share
/// the links inboard of k: `M_l[k, m] = S_kᵀ (Σ_{j<k} I_j) S_m` (4). A rotor adds its inertia on the
/// diagonal.
///
/// # Errors
/// [`Fault::SingularLeg`].
///
/// # Cost
/// About 2000 multiplications per leg. The tick does not need it.
#[inline]
pub fn fixed_foot_dynamics<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    singularity: T,
) -> Result<WorkspaceDynamics<T>, Fault> {
    let bias = fixed_foot_wrench(robot, central, legs, singularity, Twist::zero())?;
    let mut inertia = ArticulatedInertia::from(robot.central.inertia);
    for (number, ((links, leg), reach)) in robot.legs.iter().zip(legs).zip(&robot.reach).enumerate()
    {
        let jacobian =
            LegJacobian::new(leg, *reach, singularity).ok_or(Fault::SingularLeg { leg: number })?;
        inertia = inertia + leg_inertia(links, leg, &jacobian).shifted(leg.origins[LEG - 1]);
    }
    Ok(WorkspaceDynamics { inertia, bias })
}

/// `J⁻ᵀ M_l J⁻¹` at the last joint.
#[inline]
fn leg_inertia<T: Real>(
    links: &[Node<T>; LEG],
    leg: &LegKinematics<T>,
    jacobian: &LegJacobian<T>,
) -> ArticulatedInertia<T> {
    let zero = T::zero();
    let o = leg.origins[LEG - 1];
    let mut s = [Twist::zero(); LEG];
    for k in 0..LEG {
        s[k] = Twist { linear: leg.axes[k].cross(&(o - leg.origins[k])), angular: leg.axes[k] };
    }
    let mut composite = RigidInertia {
        mass: zero,
        first_moment: Vector3::zeros(),
        rotational: SymmetricMatrix3::zero(),
    };
    // (4); joint 1 has no link inboard of it within the leg.
    let mut m = [[zero; LEG]; LEG];
    for k in 1..LEG {
        let body = &links[k - 1].inertia;
        let rotation = Rotation::General(leg.rotations[k - 1]);
        let turned = RigidInertia {
            mass: body.mass,
            first_moment: rotation.inboard(body.first_moment),
            rotational: rotation.inboard_symmetric(&body.rotational),
        };
        composite = composite + turned.shifted(leg.origins[k - 1] - o);
        let momentum = composite.product(s[k]);
        for j in k..LEG {
            let entry = s[j].power(momentum);
            m[k][j] = entry;
            m[j][k] = entry;
        }
    }
    for k in 0..LEG {
        m[k][k] += links[k].rotor_inertia;
    }
    // Rows of J⁻ᵀ M (M is symmetric), then columns.
    let rows = m.map(|row| jacobian.solve_transposed(&row).to_array());
    let mut full = [[zero; 6]; 6];
    for i in 0..6 {
        let mut column = [zero; LEG];
        for k in 0..LEG {
            column[k] = rows[k][i];
        }
        full[i] = jacobian.solve_transposed(&column).to_array();
    }
    symmetric_from_rows(&full)
}

/// The symmetric part of a 6 × 6 array.
#[inline]
fn symmetric_from_rows<T: Real>(full: &[[T; 6]; 6]) -> ArticulatedInertia<T> {
    let half = T::of(0.5);
    let block = |r: usize, c: usize| {
        Matrix3::from_fn(|i, j| (full[r + i][c + j] + full[c + j][r + i]) * half)
    };
    ArticulatedInertia {
        linear: SymmetricMatrix3::from_matrix(&block(0, 0)),
        coupling: block(0, 3),
        angular: SymmetricMatrix3::from_matrix(&block(3, 3)),
    }
}
