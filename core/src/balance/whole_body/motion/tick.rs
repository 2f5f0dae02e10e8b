//! One tick.

use super::super::contact::{Asked, Contact, Place};
use super::super::measured::first3;
use super::super::observed::ObservedBody;
use super::super::report::WholeBodyReport;
use super::super::robot::Leg;
use super::super::{
    AngularTask, FootTask, LinearTask, MotionTask, WholeBodyCommand, WholeBodyController,
    WholeBodyMemory,
};
use super::dynamics::{MotionDynamics, MotionFoot, Unknowns};
use super::objective::{Objective, Surroundings};
use super::program::MotionProgram;
use super::range::ranges;
use crate::Real;
use crate::balance::{ContactLimits, Fault, Input};
use crate::dynamics::legged_inverse_dynamics;
use crate::qp::{Settings, solve};
use crate::spatial::{Quaternion, Twist, Wrench};
use nalgebra::Vector3;

/// From an observed state to the torques of all joints, for a planner's task. A foot that swings carries
/// nothing, whatever it touches; in flight no foot presses. `memory` may be of a tick in which other feet
/// pressed: rows of a foot that swings now are left out.
///
/// Of the command, `desired_wrench` is the sum of the feet's wrenches that the task asks for within no
/// limits, and `limits.given_up` what limits took from it; position and orientation errors are zero, as
/// they are the planner's.
///
/// # Errors
/// A [`Fault`]: a task that is not finite, numbers so large that they overflow, or a robot of which no
/// acceleration of the central body follows ([`Fault::NotHeld`]).
///
/// # Cost
/// Inverse dynamics of the tree, about 2000 multiplications a foot, and at most `settings.limits.work` on
/// limits. No allocation, no panic.
pub fn whole_body_motion_tick<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    observed: &ObservedBody<T, N, NQ, NV>,
    task: &MotionTask<T, FEET>,
    memory: &mut WholeBodyMemory<T>,
) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
    motion_tick_under(controller, observed, task, None, memory)
}

/// The same for a robot on whose central body a known wrench acts from outside, about its centre of mass in
/// world axes (N, N·m); `None` where nobody knows of one. A centre of pressure is that of the ground's forces, which
/// carry the wrench too.
///
/// # Errors
/// As of [`whole_body_motion_tick`]; [`Fault::Overflow`] for a wrench that is not finite.
pub fn whole_body_motion_tick_under<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    observed: &ObservedBody<T, N, NQ, NV>,
    task: &MotionTask<T, FEET>,
    external: Option<Wrench<T>>,
    memory: &mut WholeBodyMemory<T>,
) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
    motion_tick_under(controller, observed, task, external, memory)
}

/// Of either, in one piece: without a wrench nothing of it runs.
#[inline(always)]
fn motion_tick_under<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    observed: &ObservedBody<T, N, NQ, NV>,
    task: &MotionTask<T, FEET>,
    external: Option<Wrench<T>>,
    memory: &mut WholeBodyMemory<T>,
) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
    let WholeBodyController { tree, robot, settings } = controller;
    if !is_finite(task) {
        return Err(Fault::NotFinite(Input::Reference));
    }
    let ObservedBody { state, central, poses, screws, masses, .. } = observed;
    let mut accelerations = observed.accelerations;
    let mut feet = [None; FEET];
    set_feet(controller, observed, task, &mut accelerations, &mut feet)?;
    let ranges = ranges(robot, settings, state, &accelerations);
    let mut bias = legged_inverse_dynamics(tree, poses, &state.velocities, &accelerations);
    let mut gravity = tree.gravity;
    if let Some(external) = external {
        // Of the ground's wrenches this much is made already; the whole falls as if gravity were so much more.
        let (force, torque) =
            (central.rotation.tr_mul(&external.force), central.rotation.tr_mul(&external.torque));
        for (bias, w) in bias.iter_mut().zip((Wrench { force, torque }).to_array()) {
            *bias -= w;
        }
        gravity += external.force / robot.mass;
    }
    if !bias.iter().all(|x| x.is_finite()) {
        return Err(Fault::Overflow);
    }
    let dynamics = MotionDynamics::new(robot, &feet, masses, screws, bias).ok_or(Fault::NotHeld)?;
    let around = Surroundings {
        central: &central.rotation,
        position: first3(&state.positions),
        gravity,
        mass: robot.mass,
    };
    let free = dynamics.free();
    let objective = Objective::new(&dynamics, &settings.motion, &around, task, free);
    let objective = objective.ok_or(Fault::Overflow)?;
    let program = MotionProgram {
        dynamics: &dynamics,
        objective: &objective,
        torques: &settings.torques,
        free,
        ranges: ranges.as_ref(),
    };
    let mut limits = WholeBodyReport::free();
    let x = &within(&program, &settings.limits, memory, &mut limits)?;
    let moved = dynamics.moved(x);
    let sum = |all: &[Unknowns<T>; FEET]| {
        let feet = feet.iter().zip(all);
        feet.fold(Wrench::zero(), |sum, (foot, x)| match foot {
            Some(foot) if foot.limits.is_some() => sum + foot.contact.on_base(x),
            _ => sum,
        })
    };
    let desired_wrench = sum(&objective.minimum);
    limits.given_up = desired_wrench - sum(x);
    let mut command = WholeBodyCommand {
        torques: [T::zero(); NV],
        foot_wrenches: [Wrench::zero(); FEET],
        desired_wrench,
        accelerations,
        position_error: Vector3::zeros(),
        orientation_error: Quaternion::identity(),
        limits,
    };
    for (to, x) in command.accelerations.iter_mut().zip(moved.base.to_array()) {
        *to = x;
    }
    let legs = dynamics.legs(&moved);
    for (number, ((foot, leg), x)) in feet.iter().zip(&legs).zip(x).enumerate() {
        let Some(MotionFoot { contact, limits }) = foot else { continue };
        for (joint, more) in contact.joints.iter().zip(leg).take(contact.count) {
            if let Some(to) = command.accelerations.get_mut(*joint) {
                *to += *more;
            }
        }
        let presses = limits.is_some();
        if let Some(to) = command.foot_wrenches.get_mut(number).filter(|_| presses) {
            *to = contact.in_frame(x);
        }
        if contact.damping > T::zero()
            && let Some(place) = command.limits.singular.get_mut(number)
        {
            let mut joints = contact.correction();
            for (joint, more) in joints.iter_mut().zip(leg) {
                *joint += *more;
            }
            let mut left = contact.given_up(moved.base, &joints);
            if !presses {
                left = left - Twist::from_array(*x);
            }
            *place = Some(left);
        }
    }
    let asked = dynamics.torques(&moved);
    let motors = command.torques.iter_mut().zip(&robot.joints).zip(&settings.torques);
    for (((torque, joint), limit), asked) in motors.zip(asked) {
        if joint.is_some() {
            if !asked.is_finite() {
                return Err(Fault::Overflow);
            }
            *torque = asked.max(-*limit).min(*limit);
        }
    }
    Ok(command)
}

/// The feet's contacts, and on the posture's accelerations what makes their feet accelerate as wanted. A
/// function of its own, like [`within`], so that its numbers leave the stack.
#[inline(never)]
fn set_feet<T: Real, const N: usize, const NQ: usize, const NV: usize, const FEET: usize>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    observed: &ObservedBody<T, N, NQ, NV>,
    task: &MotionTask<T, FEET>,
    accelerations: &mut [T; NV],
    feet: &mut [Option<MotionFoot<T>>; FEET],
) -> Result<(), Fault> {
    let WholeBodyController { robot, settings, .. } = controller;
    let ObservedBody { central, kinematics, screws, .. } = observed;
    for ((place, leg), task) in feet.iter_mut().zip(&robot.legs).zip(&task.feet) {
        let Some(leg) = leg else { continue };
        let body = kinematics.get(leg.foot.body).ok_or(Fault::NotHeld)?;
        let of_leg = leg.joints.map(|joint| screws.get(joint).copied().unwrap_or(Twist::zero()));
        let from = Place { central: &central.rotation, body, screws: of_leg };
        let asked = match task {
            FootTask::Press { .. } => Asked::Rest(settings.rest_rate),
            FootTask::Swing { linear, angular } => {
                Asked::Move { linear: *linear, angular: *angular }
            }
        };
        // Made where it stays: each copy would cost as much as a joint.
        let foot =
            place.insert(MotionFoot { contact: Contact::empty(), limits: limits(leg, task) });
        let contact = &mut foot.contact;
        contact.set(leg, &from, &asked, settings.damping).ok_or(Fault::Overflow)?;
        for (joint, more) in contact.joints.iter().zip(contact.correction()).take(contact.count) {
            if let Some(to) = accelerations.get_mut(*joint) {
                *to += more;
            }
        }
    }
    Ok(())
}

/// The unknowns within limits, and what is reported of them.
#[inline(never)]
fn within<T: Real, const FEET: usize, const NV: usize>(
    program: &MotionProgram<'_, T, FEET, NV>,
    settings: &Settings<T>,
    memory: &mut WholeBodyMemory<T>,
    report: &mut WholeBodyReport<T, FEET>,
) -> Result<[Unknowns<T>; FEET], Fault> {
    let active = &mut memory.active;
    let solution = solve(program, active, settings).map_err(|_| Fault::Overflow)?;
    let worst = program.worst(&solution.x, active);
    report.fill(&solution, active, worst, |foot, joint| program.joint(foot, joint));
    Ok(solution.x)
}

/// What the ground can give a foot with this task; `None` where it swings. A cap leaves room above the
/// least force, or the two would contradict each other.
#[inline(always)]
fn limits<T: Real>(leg: &Leg<T>, task: &FootTask<T>) -> Option<ContactLimits<T, 0>> {
    let FootTask::Press { most_force } = task else { return None };
    let own = leg.foot.limits;
    let most = most_force.max(own.least_force * T::of(2.0)).min(own.greatest_force);
    Some(ContactLimits { greatest_force: most, ..own })
}

/// Whether every number can be; only a cap may be infinite.
#[inline(always)]
fn is_finite<T: Real, const FEET: usize>(task: &MotionTask<T, FEET>) -> bool {
    let finite = |v: &Vector3<T>| v.x.is_finite() && v.y.is_finite() && v.z.is_finite();
    let linear = match &task.linear {
        LinearTask::CenterOfMass(a) => finite(a),
        LinearTask::CenterOfPressure { point: [x, y], vertical, per_length } => {
            [x, y, vertical, per_length].iter().all(|x| x.is_finite())
        }
        LinearTask::Free => true,
    };
    let feet = task.feet.iter().all(|foot| match foot {
        // NaN compares as false.
        FootTask::Press { most_force } => *most_force >= T::zero(),
        FootTask::Swing { linear, angular } => finite(linear) && finite(angular),
    });
    let angular = match &task.angular {
        AngularTask::CentralBody(acceleration) => finite(acceleration),
        AngularTask::Momentum { rate, inertia } => {
            finite(rate) && *inertia > T::zero() && inertia.is_finite()
        }
    };
    linear && feet && angular
}
