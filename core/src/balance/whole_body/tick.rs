//! One tick.

use super::contact::{Asked, Contact, Place};
use super::measured::{checked, first3, posture, screws};
use super::program::WholeBodyProgram;
use super::reduced::Reduced;
use super::report::WholeBodyReport;
use super::robot::{MOST_LEG_JOINTS, WholeBody};
use super::{WholeBodyCommand, WholeBodyMemory, WholeBodySettings, WholeBodyState};
use crate::Real;
use crate::balance::{ContactFoot, ContactProgram, Fault, Input, Reference, desired_acceleration};
use crate::dynamics::{
    BodyKinematics, forward_kinematics_in, joint_poses, legged_inverse_dynamics, mass_matrix,
};
use crate::model::Tree;
use crate::qp::{Settings, solve};
use crate::spatial::{Twist, Wrench};
use nalgebra::Vector3;

/// All constants of one controller.
#[derive(Clone, Copy, Debug)]
pub struct WholeBodyController<
    'a,
    T,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
> {
    /// Bodies and joints.
    pub tree: &'a Tree<T, N, NQ, NV>,
    /// Its legs, found in the same tree.
    pub robot: &'a WholeBody<T, FEET, NV>,
    /// Gains, postures, limits.
    pub settings: &'a WholeBodySettings<T, NV>,
}

/// From a measured state to the torques of all joints; `contacts` says which feet touch the ground (all,
/// where nobody knows). A foot that does not carries nothing, and its leg tracks its posture.
///
/// # Errors
/// A [`Fault`]: an input that is not finite, a quaternion that is none, numbers so large that they
/// overflow, or a robot that cannot be held ([`Fault::NotHeld`]). A limit that binds and a leg in a
/// singular posture are no faults: [`WholeBodyCommand::limits`] has them.
///
/// # Cost
/// Kinematics, inverse dynamics and mass matrix of the tree, about 2000 multiplications a foot, and at
/// most `settings.limits.work` on limits. No allocation, no panic.
#[inline]
pub fn whole_body_tick<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    state: &WholeBodyState<T, NQ, NV>,
    reference: &Reference<T>,
    contacts: &[bool; FEET],
    memory: &mut WholeBodyMemory<T>,
) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
    tick_under(controller, state, reference, (contacts, None), memory)
}

/// The same for a robot on whose central body a known wrench acts from outside, about its centre of mass in
/// world axes (N, N·m); `None` where nobody knows of one.
///
/// # Errors
/// As of [`whole_body_tick`]; [`Fault::Overflow`] for a wrench that is not finite.
#[inline]
pub fn whole_body_tick_under<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    state: &WholeBodyState<T, NQ, NV>,
    reference: &Reference<T>,
    (contacts, external): (&[bool; FEET], Option<Wrench<T>>),
    memory: &mut WholeBodyMemory<T>,
) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
    tick_under(controller, state, reference, (contacts, external), memory)
}

/// Of either, in one piece: without a wrench nothing of it runs.
#[inline(always)]
fn tick_under<T: Real, const N: usize, const NQ: usize, const NV: usize, const FEET: usize>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    state: &WholeBodyState<T, NQ, NV>,
    reference: &Reference<T>,
    (contacts, external): (&[bool; FEET], Option<Wrench<T>>),
    memory: &mut WholeBodyMemory<T>,
) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
    let WholeBodyController { tree, robot, settings } = controller;
    let central = checked(tree, state, reference)?;
    let position = first3(&state.positions);
    let desired = desired_acceleration(&settings.gains, &central, position, reference)?;

    // The posture's accelerations, and what they make of the feet. The world's origin is frame 1's.
    let mut positions = state.positions;
    positions.iter_mut().take(3).for_each(|x| *x = T::zero());
    let poses = joint_poses(tree, &positions).map_err(|_| Fault::NotUnit(Input::Orientation))?;
    let mut accelerations = posture(robot, settings, state);
    let mut kinematics = [BodyKinematics::still(); N];
    forward_kinematics_in(tree, &poses, &state.velocities, &accelerations, &mut kinematics);
    let screws = screws(tree, robot, &kinematics, &central.rotation);
    let mut pressing = [None; FEET];
    for ((place, leg), touches) in pressing.iter_mut().zip(&robot.legs).zip(contacts) {
        let Some(leg) = leg.as_ref().filter(|_| *touches) else { continue };
        let body = kinematics.get(leg.foot.body).ok_or(Fault::NotHeld)?;
        let of_leg = leg.joints.map(|joint| screws.get(joint).copied().unwrap_or(Twist::zero()));
        let from = Place { central: &central.rotation, body, screws: of_leg };
        // Made where it stays: each copy would cost as much as a joint.
        let (contact, _) = place.insert((Contact::empty(), leg));
        let asked = Asked::Rest(settings.rest_rate);
        contact.set(leg, &from, &asked, settings.damping).ok_or(Fault::Overflow)?;
        for (joint, more) in contact.joints.iter().zip(contact.correction()).take(contact.count) {
            if let Some(to) = accelerations.get_mut(*joint) {
                *to += more;
            }
        }
    }
    let legs = pressing.each_ref().map(|foot| foot.as_ref().map(|(contact, _)| *contact));
    let mut bias = legged_inverse_dynamics(tree, &poses, &state.velocities, &accelerations);
    if let Some(external) = external {
        // Of the ground's wrenches this much is made already.
        let (force, torque) =
            (central.rotation.tr_mul(&external.force), central.rotation.tr_mul(&external.torque));
        for (bias, w) in bias.iter_mut().zip((Wrench { force, torque }).to_array()) {
            *bias -= w;
        }
    }
    let masses = mass_matrix(tree, &poses);
    if !bias.iter().chain(masses.as_flattened()).all(|x| x.is_finite()) {
        return Err(Fault::Overflow);
    }
    let reduced = Reduced::new(robot, &legs, &masses, bias, screws).ok_or(Fault::NotHeld)?;

    let desired_wrench = reduced.wrench(desired.x);
    let mut command = WholeBodyCommand {
        torques: [T::zero(); NV],
        foot_wrenches: [Wrench::zero(); FEET],
        desired_wrench,
        accelerations,
        position_error: desired.position_error,
        orientation_error: desired.orientation_error,
        limits: WholeBodyReport::free(),
    };
    let mut positions = [Vector3::zeros(); FEET];
    let mut feet = [None; FEET];
    for ((foot, place), position) in feet.iter_mut().zip(&pressing).zip(&mut positions) {
        if let Some((contact, leg)) = place {
            *position = contact.position;
            *foot = Some(ContactFoot {
                rotation: contact.rotation,
                position: contact.position,
                joints: [],
                carried: Wrench::zero(),
                limits: &leg.foot.limits,
            });
        }
    }
    let (on_base, x) = if feet.iter().any(Option::is_some) {
        // The split of what is left when each foot carries its own leg.
        let carried = carried(&reduced, &legs, desired.x);
        let rest = carried
            .iter()
            .zip(&positions)
            .fold(desired_wrench, |rest, (w, p)| rest - w.shifted(*p));
        let weights = &settings.weights;
        let shared = ContactProgram::new(&feet, weights, &central.rotation, rest);
        let shared = shared.ok_or(Fault::Overflow)?;
        let mut wrenches = carried;
        for (w, more) in wrenches.iter_mut().zip(shared.least_norm()) {
            *w += more;
        }
        let contacts = shared.around(wrenches);
        let program = WholeBodyProgram {
            contacts,
            positions: &positions,
            reduced: &reduced,
            robot,
            torques: &settings.torques,
        };
        within(&program, &settings.limits, memory, &mut command)?;
        let on_base = program.on_base(&command.foot_wrenches);
        (on_base, program.acceleration(&on_base))
    } else {
        *memory = WholeBodyMemory::new();
        ([Wrench::zero(); FEET], reduced.acceleration(Wrench::zero()))
    };
    command.limits.given_up = on_base.iter().fold(desired_wrench, |rest, w| rest - *w);
    let of_base = x.to_array();
    for (to, x) in command.accelerations.iter_mut().zip(of_base) {
        *to = x;
    }
    for (number, contact) in legs.iter().enumerate() {
        let Some(contact) = contact else { continue };
        let mut moved = contact.correction();
        for ((moved, row), joint) in moved.iter_mut().zip(contact.per_base).zip(contact.joints) {
            let more = x.power(row);
            *moved += more;
            if let Some(to) = command.accelerations.get_mut(joint).filter(|_| more != T::zero()) {
                *to += more;
            }
        }
        if contact.damping > T::zero()
            && let Some(place) = command.limits.singular.get_mut(number)
        {
            *place = Some(contact.given_up(x, &moved));
        }
    }
    let motors = command.torques.iter_mut().zip(&robot.joints).zip(&settings.torques);
    for (velocity, ((torque, joint), limit)) in motors.enumerate() {
        if joint.is_some() {
            let asked = reduced.torque(velocity, x, &on_base);
            if !asked.is_finite() {
                return Err(Fault::Overflow);
            }
            *torque = asked.max(-*limit).min(*limit);
        }
    }
    Ok(command)
}

/// The wrenches within limits, and what is reported of them.
#[inline(never)]
fn within<T: Real, const FEET: usize, const NV: usize>(
    program: &WholeBodyProgram<'_, T, FEET, NV>,
    settings: &Settings<T>,
    memory: &mut WholeBodyMemory<T>,
    command: &mut WholeBodyCommand<T, FEET, NV>,
) -> Result<(), Fault> {
    let active = &mut memory.active;
    let solution = solve(program, active, settings).map_err(|_| Fault::Overflow)?;
    command.foot_wrenches = solution.x;
    let worst = program.worst(&solution.x, active);
    // It has no rows of ranges.
    command.limits.fill(&solution, active, worst, |_, _| 0);
    Ok(())
}

/// What the ground gives each foot so that its leg carries itself at the acceleration `x`.
#[inline(always)]
fn carried<T: Real, const FEET: usize, const NV: usize>(
    reduced: &Reduced<T, NV>,
    contacts: &[Option<Contact<T>>; FEET],
    x: Twist<T>,
) -> [Wrench<T>; FEET] {
    let nothing = [Wrench::zero(); FEET];
    contacts.each_ref().map(|contact| {
        let Some(contact) = contact else { return Wrench::zero() };
        let mut torques = [T::zero(); MOST_LEG_JOINTS];
        for (torque, joint) in torques.iter_mut().zip(contact.joints).take(contact.count) {
            *torque = reduced.torque(joint, x, &nothing);
        }
        contact.holding(&torques)
    })
}
