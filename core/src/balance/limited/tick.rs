//! One tick within limits.

use super::loads::{Loads, loads, loads_at_rest};
use super::outside::Outside;
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
/// nobody knows). Foot limits of the controller are not looked at: nothing beyond limits is required of a foot.
///
/// # Errors
/// A [`Fault`] as of [`tick`](crate::balance::tick). A limit that binds is not a fault.
///
/// # Cost
/// Where nothing binds, a sixth more than [`tick`](crate::balance::tick), and the stages before it once
/// more where limits cease to bind; else at most [`WrenchLimits::MOST_WORK`] multiplications more. No allocation, no panic.
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
/// assert!(pushed.limits.worst.is_some() && pushed.limits.given_up.force.y.abs() > 1.0);
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
    tick_under(controller, limits, state, reference, (contacts, ()), memory)
}

/// The same for a robot on whose central body a known wrench acts from outside, about its centre of mass in
/// world axes (N, N·m): the feet are asked for what is left. `None` where nobody knows of one.
///
/// # Errors
/// As of [`limited_tick`]; [`Fault::Overflow`] for a wrench that is not finite.
#[inline]
pub fn limited_tick_under<T: Real, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    limits: &WrenchLimits<T, LEGS>,
    state: &RobotState<T, LEGS>,
    reference: &Reference<T>,
    (contacts, external): (&[bool; LEGS], Option<Wrench<T>>),
    memory: &mut LimitMemory<T>,
) -> Result<LimitedCommand<T, LEGS>, Fault> {
    tick_under(controller, limits, state, reference, (contacts, external), memory)
}

/// Of either, in one piece: without a wrench nothing of it runs.
#[inline(always)]
fn tick_under<T: Real, E: Outside<T>, const LEGS: usize>(
    controller: &Controller<'_, T, LEGS>,
    limits: &WrenchLimits<T, LEGS>,
    state: &RobotState<T, LEGS>,
    reference: &Reference<T>,
    (contacts, external): (&[bool; LEGS], E),
    memory: &mut LimitMemory<T>,
) -> Result<LimitedCommand<T, LEGS>, Fault> {
    check_finite(state, reference)?;
    let central = central_body(controller.robot, state)?;
    let desired = desired_acceleration(&controller.gains, &central, state.position, reference)?;
    let mut legs = [LegKinematics::empty(); LEGS];
    walk_legs::<T, LEGS, true>(controller.robot, &central, state, &mut legs);
    let external = external.in_frame_1(&central.rotation);
    let robot = Standing { controller, limits, central: &central, legs: &legs, contacts, external };
    let is_standing = contacts.iter().all(|stands| *stands);
    let was_free = memory.active.is_empty();
    let mut asked =
        if is_standing && was_free { robot.plain(desired.x)? } else { robot.at_rest(desired.x)? };
    let mut is_free = !asked.is_broken;
    if is_standing && !was_free && is_free {
        // Limits that cease to bind, unless it is by what creeps coming to rest. Where they begin to,
        // what creeps has a tick's time.
        let plain = robot.plain(desired.x)?;
        is_free = !plain.is_broken;
        asked = if is_free { plain } else { asked };
    }
    let Asked { loads, mut wrenches, mut torques, is_broken } = asked;
    let mut report = LimitReport::free();
    if is_broken {
        report = within(&robot, &loads, &mut wrenches, &mut memory.active)?;
        torques = robot.torques(&loads, &wrenches)?;
    } else if is_free {
        memory.active = ActiveRows::new();
    }
    if report.is_limited() || !is_standing {
        for (torques, limits) in torques.iter_mut().zip(&limits.legs) {
            for (torque, limit) in torques.iter_mut().zip(&limits.torques) {
                *torque = torque.max(-*limit).min(*limit);
            }
        }
        let feet = wrenches.iter().zip(&legs);
        let made = feet.fold(Wrench::zero(), |sum, (w, leg)| sum + w.shifted(leg.foot.position));
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

/// The robot at a tick.
struct Standing<'a, T, E, const LEGS: usize> {
    controller: &'a Controller<'a, T, LEGS>,
    limits: &'a WrenchLimits<T, LEGS>,
    central: &'a CentralBody<T>,
    legs: &'a [LegKinematics<T>; LEGS],
    contacts: &'a [bool; LEGS],
    /// From outside, frame 1.
    external: E,
}

/// The printed split of the desired wrench, and whether it breaks a limit.
struct Asked<T, const LEGS: usize> {
    loads: Loads<T, LEGS>,
    /// On the feet, frame 1's axes.
    wrenches: [Wrench<T>; LEGS],
    torques: [[T; LEG]; LEGS],
    is_broken: bool,
}

impl<T: Real, E: Outside<T>, const LEGS: usize> Standing<'_, T, E, LEGS> {
    /// As the plain tick asks.
    #[inline(never)]
    fn plain(&self, x: Twist<T>) -> Result<Asked<T, LEGS>, Fault> {
        self.split(loads(self.controller, self.central, self.legs, x)?)
    }

    /// With what creeps coming to rest.
    #[inline(never)]
    fn at_rest(&self, x: Twist<T>) -> Result<Asked<T, LEGS>, Fault> {
        let Self { controller, limits, central, legs, contacts, .. } = self;
        self.split(loads_at_rest(controller, limits, central, legs, contacts, x)?)
    }

    #[inline(always)]
    fn split(&self, mut loads: Loads<T, LEGS>) -> Result<Asked<T, LEGS>, Fault> {
        loads.desired = self.external.less(loads.desired);
        let mut positions = [None; LEGS];
        for ((position, leg), stands) in positions.iter_mut().zip(self.legs).zip(self.contacts) {
            *position = stands.then_some(leg.foot.position);
        }
        let mut wrenches = [Wrench::zero(); LEGS];
        if self.contacts.iter().any(|stands| *stands) {
            wrenches = split(loads.desired, positions).ok_or(Fault::Overflow)?;
        }
        let torques = self.torques(&loads, &wrenches)?;
        let is_broken = self.breaks(&loads, &wrenches, &torques);
        Ok(Asked { loads, wrenches, torques, is_broken })
    }

    /// Alg. 4.6 for the legs that stand; the others hold themselves.
    #[inline(always)]
    fn torques(
        &self,
        loads: &Loads<T, LEGS>,
        wrenches: &[Wrench<T>; LEGS],
    ) -> Result<[[T; LEG]; LEGS], Fault> {
        let mut torques = loads.hanging;
        let given = self.legs.iter().zip(self.contacts).zip(wrenches);
        for (torques, ((leg, stands), w)) in torques.iter_mut().zip(given) {
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
    fn breaks(
        &self,
        loads: &Loads<T, LEGS>,
        wrenches: &[Wrench<T>; LEGS],
        torques: &[[T; LEG]; LEGS],
    ) -> bool {
        let held = RowSet::default();
        let mut search = Search::new(&held, self.limits.settings.tolerance);
        let feet = self.limits.legs.iter().zip(self.contacts).zip(wrenches).zip(torques);
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
}

/// Brings wrenches that make the desired one within limits, as near to it as can be.
#[inline(never)]
fn within<T: Real, E, const LEGS: usize, const K: usize>(
    robot: &Standing<'_, T, E, LEGS>,
    loads: &Loads<T, LEGS>,
    wrenches: &mut [Wrench<T>; LEGS],
    active: &mut ActiveRows<T, K>,
) -> Result<LimitReport<T, LEGS>, Fault> {
    let Standing { limits, central, legs, contacts, .. } = robot;
    let mut feet = [None; LEGS];
    let given = legs.iter().zip(*contacts).zip(&limits.legs);
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
