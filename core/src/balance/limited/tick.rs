//! One tick within limits.

use super::loads::{Loads, loads, loads_at_rest};
use super::{BrokenLimit, LimitMemory, LimitReport, LimitedCommand, WrenchLimits};
use crate::Real;
use crate::balance::ground_wrench::in_axes;
use crate::balance::leg_kinematics::walk_legs;
use crate::balance::robot::LEG;
use crate::balance::tick::check_finite;
use crate::balance::wrench_distribution::{in_foot_frames, split};
use crate::balance::{
    CentralBody, Command, ContactFoot, ContactProgram, Controller, Fault, LegKinematics, Reference,
    RobotState, central_body, desired_acceleration, joint_torques,
};
use crate::qp::{ActiveRows, RowSet, Search, Settings, solve};
use crate::spatial::{Twist, Wrench};

/// [`tick`](crate::balance::tick) within limits; `contacts` says which feet touch the ground (all, where
/// nobody knows). Foot limits of the controller are not looked at: nothing beyond limits is asked for.
///
/// # Errors
/// A [`Fault`] as of [`tick`](crate::balance::tick). Limits that bind are none.
///
/// # Cost
/// Where nothing binds, a tenth more than [`tick`](crate::balance::tick); else, at most
/// [`WrenchLimits::MOST_WORK`] multiplications more. No allocation, no panic.
///
/// ```
/// use surefoot::balance::{
///     Controller, Ground, LeggedRobot, LimitMemory, Reference, RobotState, Sole, WrenchLimits,
///     limited_tick,
/// };
/// use surefoot::model::robots::biped;
/// use surefoot::spatial::{Quaternion, Twist};
/// use nalgebra::Vector3;
///
/// static ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
/// let controller = Controller::new(&ROBOT);
/// let sole = Sole { x: [-0.2015, 0.0503], y: [-0.05, 0.05], z: -0.06 };
/// let ground = Ground { least_force: 5.0, greatest_force: 2000.0, friction: 0.24 };
/// let torques = biped::LIMITS.joints.map(|leg| leg.map(|joint| joint.torque));
/// let limits = WrenchLimits::new(&ROBOT, &[sole; 2], ground, &torques)?;
/// let leg = [0.0, 40.0, 0.0, -77.46, 0.0, 37.46].map(f64::to_radians);
/// let mut state = RobotState {
///     position: Vector3::new(0.0, 0.0, 1.035),
///     orientation: Quaternion::identity(),
///     velocity: Twist::zero(),
///     joint_angles: [leg; 2],
///     joint_rates: [[0.0; 6]; 2],
/// };
/// let reference = Reference::at_rest(state.position, state.orientation);
/// let mut memory = LimitMemory::new();
/// let calm = limited_tick(&controller, &limits, &state, &reference, &[true; 2], &mut memory)?;
/// assert!(!calm.limits.is_limited());
/// // Pushed to the side: more than the soles can take.
/// state.velocity.linear.y = 0.6;
/// let pushed = limited_tick(&controller, &limits, &state, &reference, &[true; 2], &mut memory)?;
/// assert!(pushed.limits.worst.is_some() && pushed.limits.given_up.torque.x.abs() > 1.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[inline]
pub fn limited_tick<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    limits: &WrenchLimits<T, LEGS>,
    state: &RobotState<T, LEGS>,
    reference: &Reference<T>,
    contacts: &[bool; LEGS],
    memory: &mut LimitMemory<T>,
) -> Result<LimitedCommand<T, LEGS>, Fault> {
    check_finite(state, reference)?;
    let robot = controller.robot;
    let central = central_body(robot, state)?;
    let desired = desired_acceleration(&controller.gains, &central, state.position, reference)?;
    let mut legs = [LegKinematics::empty(); LEGS];
    walk_legs::<T, LEGS, true>(robot, &central, state, &mut legs);
    let mut loads = loads(controller, limits, &central, &legs, contacts, desired.x)?;
    let mut positions = [None; LEGS];
    for ((position, leg), stands) in positions.iter_mut().zip(&legs).zip(contacts) {
        *position = stands.then_some(leg.foot.position);
    }
    let mut wrenches = [Wrench::zero(); LEGS];
    if contacts.iter().any(|stands| *stands) {
        wrenches = split(loads.desired, positions).ok_or(Fault::Overflow)?;
    }
    let mut torques = torques(&legs, contacts, &wrenches, &loads)?;
    let mut report = LimitReport::free();
    let is_broken = breaks(limits, contacts, &wrenches, &torques, &loads);
    if is_broken && contacts.iter().all(|stands| *stands) {
        loads = loads_at_rest(controller, limits, &central, &legs, contacts, desired.x)?;
        wrenches = split(loads.desired, positions).ok_or(Fault::Overflow)?;
    }
    if is_broken {
        let world = (&central, &legs, contacts, &loads);
        report = within(limits, world, &mut wrenches, &mut memory.active)?;
        torques = self::torques(&legs, contacts, &wrenches, &loads)?;
    } else {
        memory.active = ActiveRows::new();
    }
    if report.is_limited() || !contacts.iter().all(|stands| *stands) {
        for (torques, limits) in torques.iter_mut().zip(&limits.legs) {
            for (torque, limit) in torques.iter_mut().zip(&limits.torques) {
                *torque = torque.max(-*limit).min(*limit);
            }
        }
        let feet = wrenches.iter().zip(positions);
        let made = feet.fold(Wrench::zero(), |sum, (w, position)| match position {
            Some(position) => sum + w.shifted(position),
            None => sum,
        });
        report.given_up = loads.desired - made;
    }
    let command = Command {
        joint_torques: torques,
        desired_wrench: loads.desired,
        foot_wrenches: in_foot_frames(wrenches, &legs).in_foot_frames,
        position_error: desired.position_error,
        orientation_error: desired.orientation_error,
    };
    Ok(LimitedCommand { command, limits: report })
}

/// Alg. 4.6 for the legs that stand; the others hold themselves.
#[inline(always)]
fn torques<T: Real, const LEGS: usize>(
    legs: &[LegKinematics<T>; LEGS],
    contacts: &[bool; LEGS],
    wrenches: &[Wrench<T>; LEGS],
    loads: &Loads<T, LEGS>,
) -> Result<[[T; LEG]; LEGS], Fault> {
    let mut torques = loads.hanging;
    for (((torques, leg), stands), w) in torques.iter_mut().zip(legs).zip(contacts).zip(wrenches) {
        if *stands {
            *torques = joint_torques(leg, *w);
        }
        if !torques.iter().all(|x| x.is_finite()) {
            return Err(Fault::Overflow);
        }
    }
    Ok(torques)
}

/// Whether wrenches break a limit of a foot that stands.
#[inline(always)]
fn breaks<T: Real, const LEGS: usize>(
    limits: &WrenchLimits<T, LEGS>,
    contacts: &[bool; LEGS],
    wrenches: &[Wrench<T>; LEGS],
    torques: &[[T; LEG]; LEGS],
    loads: &Loads<T, LEGS>,
) -> bool {
    let held = RowSet::default();
    let mut search = Search::new(&held, limits.settings.tolerance);
    let feet = limits.legs.iter().zip(contacts).zip(wrenches).zip(torques);
    for ((((limits, stands), w), torques), (axes, carried)) in
        feet.zip(loads.axes.iter().zip(&loads.carried))
    {
        if *stands {
            limits.scan_contact(&(in_axes(axes, w) + *carried), 0, &mut search);
            limits.scan_torques(|k| torques[k], 0, &mut search);
        }
    }
    search.worst().is_some()
}

/// What the program around a split needs to know of the robot.
type World<'a, T, const LEGS: usize> =
    (&'a CentralBody<T>, &'a [LegKinematics<T>; LEGS], &'a [bool; LEGS], &'a Loads<T, LEGS>);

/// Brings wrenches that make the desired one within limits, as near to it as can be.
#[inline(never)]
fn within<T: Real, const LEGS: usize, const K: usize>(
    limits: &WrenchLimits<T, LEGS>,
    (central, legs, contacts, loads): World<'_, T, LEGS>,
    wrenches: &mut [Wrench<T>; LEGS],
    active: &mut ActiveRows<T, K>,
) -> Result<LimitReport<T, LEGS>, Fault> {
    let mut feet = [None; LEGS];
    let given = legs.iter().zip(contacts).zip(&limits.legs);
    for ((foot, ((leg, stands), limits)), (axes, carried)) in
        feet.iter_mut().zip(given).zip(loads.axes.iter().zip(&loads.carried))
    {
        if *stands {
            let position = leg.foot.position;
            let mut joints = [Twist::zero(); LEG];
            for ((twist, e), q) in joints.iter_mut().zip(&leg.axes).zip(&leg.origins) {
                *twist = Twist { linear: e.cross(&(position - q)), angular: *e };
            }
            let (rotation, carried) = (*axes, *carried);
            *foot = Some(ContactFoot { rotation, position, joints, carried, limits });
        }
    }
    let program = ContactProgram::new(&feet, &limits.weights, &central.rotation, loads.desired);
    let program = program.ok_or(Fault::Overflow)?.around(*wrenches);
    let work = limits.settings.work.min(WrenchLimits::<T, LEGS>::MOST_WORK);
    let settings = Settings { work, ..limits.settings };
    let solution = solve(&program, active, &settings).map_err(|_| Fault::Overflow)?;
    *wrenches = solution.x;
    let mut report = LimitReport {
        status: solution.status,
        worst: program.reason(&solution.x, active),
        changes: solution.changes,
        work: solution.work,
        ..LimitReport::free()
    };
    for (row, _) in active.iter() {
        let (leg, limit) = program.limit_of(row);
        if let Some(set) = report.binding.get_mut(leg) {
            set.insert(limit);
        }
    }
    report.broken = solution.violation.map(|violation| {
        let (leg, limit) = program.limit_of(violation.row);
        BrokenLimit { leg, limit, amount: violation.amount }
    });
    Ok(report)
}
