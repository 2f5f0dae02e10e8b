//! One tick of the balance controller: measured state in, joint torques or a typed fault out.

use super::leg_kinematics::walk_legs;
use super::robot::LEG;
use super::workspace_dynamics::fixed_foot_wrench_of_legs;
use super::{
    CentralBody, Controller, DesiredAcceleration, Fault, FootWrenches, Input, LegJacobian,
    LegKinematics, Reference, RobotState, WorkspaceForm, big_base, central_body,
    desired_acceleration, fixed_foot_wrenches, joint_torques, leg_kinematics, wrench_distribution,
};
use crate::Real;
use crate::spatial::{Quaternion, Twist, Wrench};
use nalgebra::Vector3;

/// What a tick asks of the robot, and why.
#[derive(Clone, Copy, Debug)]
pub struct Command<T, const LEGS: usize> {
    /// Torques by leg, hip to foot, N·m. All finite.
    pub joint_torques: [[T; LEG]; LEGS],
    /// `F_1^{bd}`: wrench asked of the legs on the central body, in its frame.
    pub desired_wrench: Wrench<T>,
    /// Wrenches of the ground on the feet that would make it, in the feet's body frames.
    pub foot_wrenches: [Wrench<T>; LEGS],
    /// `p − p_d`, world frame, m.
    pub position_error: Vector3<T>,
    /// `q_e`, world frame, scalar part not negative.
    pub orientation_error: Quaternion<T>,
}

/// Algorithms 4.1 to 4.6.
///
/// # Errors
/// A [`Fault`] with its reason. Then there are no torques: what the motors do is for the supervisor
/// to say.
///
/// # Cost
/// No allocation, no panic, no loop but over legs and joints; the same work for every state that is
/// not faulty. Foot limits add the ground's wrenches and their check to it; without them nothing of
/// that runs.
///
/// ```
/// use surefoot::balance::{Controller, LeggedRobot, Reference, RobotState, tick};
/// use surefoot::model::robots::biped;
/// use surefoot::spatial::{Quaternion, Twist};
/// use nalgebra::Vector3;
///
/// static ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
/// let controller = Controller::new(&ROBOT);
/// let leg = [0.0, 40.0, 0.0, -77.46, 0.0, 37.46].map(f64::to_radians);
/// let state = RobotState {
///     position: Vector3::new(0.0, 0.0, 1.035),
///     orientation: Quaternion::identity(),
///     velocity: Twist::zero(),
///     joint_angles: [leg; 2],
///     joint_rates: [[0.0; 6]; 2],
/// };
/// let reference = Reference::at_rest(state.position, state.orientation);
/// let command = tick(&controller, &state, &reference)?;
/// // At rest at the set point, the legs carry the robot less its feet.
/// let carried = (biped::TREE.mass() - 2.0 * 1.455) * 9.81;
/// assert!((command.desired_wrench.force.z / carried - 1.0).abs() < 0.2);
/// # Ok::<(), surefoot::balance::Fault>(())
/// ```
#[inline]
pub fn tick<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    state: &RobotState<T, LEGS>,
    reference: &Reference<T>,
) -> Result<Command<T, LEGS>, Fault> {
    check_finite(state, reference)?;
    let robot = controller.robot;
    let is_plain = matches!(controller.form, WorkspaceForm::FixedFoot)
        && controller.foot_limits.is_none()
        && !robot.has_reversed
        && !robot.has_rotors;
    if !is_plain {
        return tick_in_full(controller, state, reference);
    }
    let central = central_body(robot, state)?;
    let desired = desired_acceleration(&controller.gains, &central, state.position, reference)?;
    let mut legs = [LegKinematics::empty(); LEGS];
    walk_legs::<T, LEGS, false>(robot, &central, state, &mut legs);
    let desired_wrench = fixed_foot_wrench_of_legs::<T, LEGS, false>(
        robot,
        &central,
        &legs,
        controller.singularity,
        desired.x,
        |_, _| {},
    )?;
    let feet = wrench_distribution(desired_wrench, &legs).ok_or(Fault::Overflow)?;
    command(&legs, desired_wrench, &feet, &desired)
}

/// The same with the big base, foot limits, reversed joints or rotors. A function apart, so that a tick
/// without them costs a test more and nothing else: what a branch reads cannot stay in registers
/// before it.
#[inline(never)]
fn tick_in_full<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    state: &RobotState<T, LEGS>,
    reference: &Reference<T>,
) -> Result<Command<T, LEGS>, Fault> {
    let robot = controller.robot;
    let central = central_body(robot, state)?;
    let desired = desired_acceleration(&controller.gains, &central, state.position, reference)?;
    let legs = leg_kinematics(robot, &central, state);
    let x = desired.x;
    let held = || fixed_foot_wrenches(robot, &central, &legs, controller.singularity, x);
    let (desired_wrench, held) = match (controller.form, &controller.foot_limits) {
        (WorkspaceForm::BigBase { factor }, None) => {
            (big_base_wrench(controller, &central, &legs, factor, x)?, None)
        }
        (WorkspaceForm::BigBase { factor }, Some(limits)) => {
            (big_base_wrench(controller, &central, &legs, factor, x)?, Some((limits, held()?)))
        }
        (WorkspaceForm::FixedFoot, limits) => {
            let held = held()?;
            (held.on_central_body, limits.as_ref().map(|limits| (limits, held)))
        }
    };
    let feet = wrench_distribution(desired_wrench, &legs).ok_or(Fault::Overflow)?;
    let command = command(&legs, desired_wrench, &feet, &desired)?;
    if let Some((limits, held)) = held {
        limits.check(robot, &legs, &feet, &held)?;
    }
    Ok(command)
}

/// `F_1 = P_1 X + z_1` (4.3) with the big base.
#[inline]
pub(super) fn big_base_wrench<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    central: &CentralBody<T>,
    legs: &[LegKinematics<T>; LEGS],
    factor: T,
    x: Twist<T>,
) -> Result<Wrench<T>, Fault> {
    let robot = controller.robot;
    // The big base has an inertia even for a straight knee, but no torque that makes it move.
    for (leg, (kinematics, reach)) in legs.iter().zip(&robot.reach).enumerate() {
        LegJacobian::new(kinematics, *reach, controller.singularity)
            .ok_or(Fault::SingularLeg { leg })?;
    }
    Ok(big_base(robot, central, legs, factor)?.wrench(x))
}

/// Alg. 4.6 for all legs.
#[inline(always)]
fn command<T: Real, const LEGS: usize>(
    legs: &[LegKinematics<T>; LEGS],
    desired_wrench: Wrench<T>,
    feet: &FootWrenches<T, LEGS>,
    desired: &DesiredAcceleration<T>,
) -> Result<Command<T, LEGS>, Fault> {
    let mut torques = [[T::zero(); LEG]; LEGS];
    for ((torques, kinematics), foot) in torques.iter_mut().zip(legs).zip(&feet.in_central_axes) {
        *torques = joint_torques(kinematics, *foot);
        if !torques.iter().all(|x| x.is_finite()) {
            return Err(Fault::Overflow);
        }
    }
    Ok(Command {
        joint_torques: torques,
        desired_wrench,
        foot_wrenches: feet.in_foot_frames,
        position_error: desired.position_error,
        orientation_error: desired.orientation_error,
    })
}

#[inline(always)]
pub(super) fn check_finite<T: Real, const LEGS: usize>(
    state: &RobotState<T, LEGS>,
    reference: &Reference<T>,
) -> Result<(), Fault> {
    let finite = |v: &Vector3<T>| v.x.is_finite() && v.y.is_finite() && v.z.is_finite();
    let finite_quaternion = |q: &Quaternion<T>| q.s.is_finite() && finite(&q.v);
    let check = |good: bool, input| if good { Ok(()) } else { Err(Fault::NotFinite(input)) };
    check(finite(&state.position), Input::Position)?;
    check(finite_quaternion(&state.orientation), Input::Orientation)?;
    check(state.velocity.is_finite(), Input::Velocity)?;
    for (leg, (angles, rates)) in state.joint_angles.iter().zip(&state.joint_rates).enumerate() {
        check(angles.iter().all(|x| x.is_finite()), Input::JointAngles(leg))?;
        check(rates.iter().all(|x| x.is_finite()), Input::JointRates(leg))?;
    }
    check_reference(reference)
}

/// The reference's part of it.
#[inline(always)]
pub(super) fn check_reference<T: Real>(reference: &Reference<T>) -> Result<(), Fault> {
    let finite = |v: &Vector3<T>| v.x.is_finite() && v.y.is_finite() && v.z.is_finite();
    let q = &reference.orientation;
    let good = finite(&reference.position)
        && finite(&reference.velocity)
        && finite(&reference.acceleration)
        && (q.s.is_finite() && finite(&q.v))
        && finite(&reference.angular_velocity)
        && finite(&reference.angular_acceleration);
    if good { Ok(()) } else { Err(Fault::NotFinite(Input::Reference)) }
}
