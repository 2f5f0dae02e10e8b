//! Algorithms 4.1 and 4.2: where the legs are and how fast, all in the frame of the central body.
//!
//! # Notation
//! In frame 1, for joint k of a leg:
//! - `R_k` frame 1 from joint frame, `q_k` joint, `e_k` axis
//! - `ω_k` angular velocity of link k, `v_k` velocity of the point `q_k`
//!
//! ```text
//! R_k = R_{k−1} R(θ_k),   q_k = q_{k−1} + R_{k−1} r_k,   e_k = R_k e
//! ω_k = ω_{k−1} + e_k θ̇_k,   v_k = v_{k−1} + ω_{k−1} × (q_k − q_{k−1})
//! ```

use super::robot::LEG;
use super::{Fault, Input, LeggedRobot, RobotState};
use crate::Real;
use crate::model::{Axis, JointKind, Node};
use crate::spatial::{AxisTurn, Pose, Quaternion, Rotation, Twist};
use nalgebra::{Matrix3, Vector3};

/// The central body's orientation, velocity and gravity (Alg. 4.1).
#[derive(Clone, Copy, Debug)]
pub struct CentralBody<T> {
    /// World from frame 1.
    pub rotation: Matrix3<T>,
    /// The same, as a unit quaternion.
    pub orientation: Quaternion<T>,
    /// Body twist `V_1`.
    pub velocity: Twist<T>,
    /// Gravity in frame 1, m/s².
    pub gravity: Vector3<T>,
}

/// One leg in frame 1 (Alg. 4.2).
#[derive(Clone, Copy, Debug)]
pub struct LegKinematics<T> {
    /// Frame 1 from each joint frame.
    pub rotations: [Matrix3<T>; LEG],
    /// Joints.
    pub origins: [Vector3<T>; LEG],
    /// Joint axes, unit vectors.
    pub axes: [Vector3<T>; LEG],
    /// Angular velocities of the links.
    pub angular_velocities: [Vector3<T>; LEG],
    /// Joint rates, as measured.
    pub rates: [T; LEG],
    /// Velocity of the last joint's point.
    pub last_velocity: Vector3<T>,
    /// Frame 1 from the foot's body frame.
    pub foot: Pose<T>,
}

/// Alg. 4.1. A quaternion within 1 in 1000 of unit norm is scaled to it.
///
/// # Errors
/// [`Fault::NotUnit`].
#[inline(always)]
pub fn central_body<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    state: &RobotState<T, LEGS>,
) -> Result<CentralBody<T>, Fault> {
    let orientation = unit(state.orientation).ok_or(Fault::NotUnit(Input::Orientation))?;
    let rotation = orientation.to_matrix();
    Ok(CentralBody {
        rotation,
        orientation,
        velocity: state.velocity,
        gravity: rotation.tr_mul(&robot.gravity),
    })
}

/// The unit quaternion next to one that is off by at most 1 in 1000.
#[inline(always)]
pub(super) fn unit<T: Real>(q: Quaternion<T>) -> Option<Quaternion<T>> {
    let error = q.norm_squared() - T::one();
    if error.abs() < T::of(2e-3) { q.normalized() } else { None }
}

/// Alg. 4.2 for all legs.
#[inline(always)]
pub fn leg_kinematics<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    state: &RobotState<T, LEGS>,
) -> [LegKinematics<T>; LEGS] {
    let mut legs = [LegKinematics::empty(); LEGS];
    walk_legs::<T, LEGS, true>(robot, central, state, &mut legs);
    legs
}

/// The same into a place that is there already: a copy costs a tenth of a tick. Without `REVERSED` for
/// robots that have no reversed joint.
#[inline(always)]
pub(super) fn walk_legs<T: Real, const LEGS: usize, const REVERSED: bool>(
    robot: &LeggedRobot<T, LEGS>,
    central: &CentralBody<T>,
    state: &RobotState<T, LEGS>,
    legs: &mut [LegKinematics<T>; LEGS],
) {
    let joints = state.joint_angles.iter().zip(&state.joint_rates);
    for ((leg, links), (angles, rates)) in legs.iter_mut().zip(&robot.legs).zip(joints) {
        if !REVERSED {
            walk(leg, links, central, angles, rates);
            continue;
        }
        // A joint whose axis points against its frame's is one along that axis whose angle counts
        // backwards.
        let sense = |k: usize| if links[k].is_reversed { -T::one() } else { T::one() };
        let along = |all: &[T; LEG]| core::array::from_fn(|k| all[k] * sense(k));
        walk(leg, links, central, &along(angles), &along(rates));
        leg.axes = core::array::from_fn(|k| leg.axes[k] * sense(k));
        leg.rates = *rates;
    }
}

impl<T: Real> LegKinematics<T> {
    /// To be filled.
    #[inline(always)]
    pub(super) fn empty() -> Self {
        let zero = Vector3::zeros();
        Self {
            rotations: [Matrix3::zeros(); LEG],
            origins: [zero; LEG],
            axes: [zero; LEG],
            angular_velocities: [zero; LEG],
            rates: [T::zero(); LEG],
            last_velocity: zero,
            foot: Pose { rotation: Matrix3::zeros(), position: zero },
        }
    }
}

/// One leg, from hip to foot.
#[inline(always)]
fn walk<T: Real>(
    leg: &mut LegKinematics<T>,
    links: &[Node<T>; LEG],
    central: &CentralBody<T>,
    angles: &[T; LEG],
    rates: &[T; LEG],
) {
    let mut r = Matrix3::identity();
    let mut q = Vector3::zeros();
    let mut v = central.velocity.linear;
    let mut omega = central.velocity.angular;
    for k in 0..LEG {
        let node = &links[k];
        if node.is_offset {
            let arm = r * node.offset;
            q += arm;
            v += omega.cross(&arm);
        }
        if let Some(home) = &node.home_rotation {
            r *= home;
        }
        let turn = AxisTurn::new(angles[k]);
        let (turned, e): (_, Vector3<T>) = match &node.kind {
            JointKind::Revolute(Axis::X) => (Rotation::X(turn).compose(&r), r.column(0).into()),
            JointKind::Revolute(Axis::Y) => (Rotation::Y(turn).compose(&r), r.column(1).into()),
            _ => (Rotation::Z(turn).compose(&r), r.column(2).into()),
        };
        r = turned;
        omega += e * rates[k];
        leg.rotations[k] = r;
        leg.origins[k] = q;
        leg.axes[k] = e;
        leg.angular_velocities[k] = omega;
    }
    let foot = &links[LEG - 1];
    leg.rates = *rates;
    leg.last_velocity = v;
    leg.foot = Pose {
        rotation: match &foot.body_rotation {
            None => r,
            Some(body) => r * body,
        },
        position: q + r * foot.center,
    };
}
