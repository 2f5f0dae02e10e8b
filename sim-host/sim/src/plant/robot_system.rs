//! A legged robot as a system of the multibody simulator, and where its parts are in it.

use super::differences::Differences;
use super::robot_model::RobotModel;
use super::{PlantState, StepFailure};
use crate::robot::{Passive, Robot, Start};
use surefoot_multibody::{
    BodyState, Closing, Closure, Frame, Joint, Link, Reduced, Seat, System, SystemError, lumped,
    merged, rerooted,
};

/// Motors of one joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motors {
    pub seat: Seat,
    /// How many: one to three.
    pub count: usize,
}

/// The robot in a system, with what a plant adds to it, and how it starts.
#[derive(Clone, Debug)]
pub(super) struct RobotSystem {
    pub system: System,
    pub states: Vec<BodyState>,
    pub rates: Vec<BodyState>,
    /// Joints' motors in the order of torques.
    pub motors: Vec<Motors>,
    /// The foot of each leg.
    pub feet: Vec<Foot>,
    /// Link of the central body, and its frame in it.
    pub central: (usize, Frame),
    /// Potential energy of what is part of the world, J.
    pub still_energy: f64,
}

/// A foot in a system.
#[derive(Clone, Copy, Debug)]
pub(super) enum Foot {
    /// It moves: its link, and the foot's frame in it.
    Free(usize, Frame),
    /// It is part of the world, and this link, the shank's end, hangs from there; its weight, N.
    Still(usize, f64),
    /// It is welded to the world by the first of the closures.
    Welded,
}

impl RobotSystem {
    /// Afloat; what differs from the model is in the full one only.
    ///
    /// # Errors
    /// [`StepFailure::Dynamics`] for no configuration, [`StepFailure::System`] for what no body or joint can be.
    pub fn new(
        robot: &Robot,
        model: RobotModel,
        state: &PlantState,
        differences: &Differences,
    ) -> Result<Self, StepFailure> {
        let start = robot.tree.start(&state.positions, &state.velocities)?;
        if model == RobotModel::Full {
            let is_model = differences.is_none() && robot.passive.iter().all(Passive::is_none);
            let start = if is_model { start } else { differences.make(robot, start)? };
            return Ok(Self::of_start(robot, start));
        }
        let Start { system: full, states, rates, .. } = start;
        let tree = |link| Seat::Tree { link, is_reversed: false };
        let reduced = lumped(&full, robot.small_bodies)?;
        let free = |foot: &crate::robot::Foot| {
            carried(&reduced, foot.body).map(|(link, frame)| Foot::Free(link, frame))
        };
        let feet = robot.feet.iter().map(free).collect::<Result<Vec<_>, _>>()?;
        let central = carried(&reduced, 0);
        let system = reduced.system.clone();
        let count = |link: usize| 6 - system.links()[link].joint.constraints();
        let motors = (1..system.links().len())
            .map(|link| Motors { seat: tree(link), count: count(link) })
            .collect();
        let (states, rates) = reduced.start(&states, &rates);
        Ok(Self { motors, system, states, rates, feet, central: central?, still_energy: 0.0 })
    }

    /// With all bodies, as they start.
    fn of_start(robot: &Robot, Start { system, frames, states, rates }: Start) -> Self {
        let motor = |link| Motors { seat: Seat::Tree { link, is_reversed: false }, count: 1 };
        let foot = |foot: &crate::robot::Foot| Foot::Free(foot.body, frames[foot.body]);
        Self {
            motors: (1..robot.tree.bodies()).map(motor).collect(),
            feet: robot.feet.iter().map(foot).collect(),
            central: (0, frames[0]),
            still_energy: 0.0,
            system,
            states,
            rates,
        }
    }

    /// With a free body as the last link.
    ///
    /// # Errors
    /// A [`SystemError`].
    pub fn with_link(
        mut self,
        link: Link,
        (state, rate): (BodyState, BodyState),
    ) -> Result<Self, SystemError> {
        self.system = self.system.with_link(link)?;
        self.states.push(state);
        self.rates.push(rate);
        Ok(self)
    }

    /// With both feet held where they are. They are part of the world then, and both legs hang from it; the joint
    /// between central body and right leg closes the loop. Joints with laws cannot: then the tree hangs from the left
    /// foot only, and the right one is welded to the world.
    ///
    /// # Errors
    /// A [`SystemError`].
    pub fn on_still_feet(self) -> Result<Self, SystemError> {
        let [Foot::Free(left, _), Foot::Free(right, _)] = self.feet[..] else {
            let what = "two feet that are held, no more and no fewer,";
            return Err(SystemError::Unsupported { link: self.central.0, what });
        };
        let held = [left, right].map(|foot| (foot, self.states[foot]));
        // The first joint of the right leg.
        let Seat::Tree { link: hip, .. } = self.motors[self.motors.len() / 2].seat else {
            return Ok(self);
        };
        let is_free_of_laws = self.system.laws().is_empty();
        let turned = if is_free_of_laws {
            rerooted(&self.system, &held, &[hip])?
        } else {
            let joint = Joint::weld(&held[1].1);
            let weld = Closure { outboard: right, inboard: None, closing: Closing::Joint(joint) };
            rerooted(&self.system.clone().with_closure(weld)?, &held[..1], &[])?
        };
        let mut order = vec![0; turned.links.len()];
        for (old, new) in turned.links.iter().enumerate() {
            order[*new] = old;
        }
        let in_order =
            |all: &[BodyState]| -> Vec<BodyState> { order.iter().map(|old| all[*old]).collect() };
        let reduced = merged(&turned.system)?;
        let (states, rates) = reduced.start(&in_order(&self.states), &in_order(&self.rates));
        let link = |old: usize| carried(&reduced, old);
        let seat = |seat: Seat| -> Result<Seat, SystemError> {
            Ok(match seat {
                Seat::Tree { link: old, is_reversed } => {
                    Seat::Tree { link: link(old)?.0, is_reversed }
                }
                closure => closure,
            })
        };
        let seat_of = |motors: &Motors| -> Result<Motors, SystemError> {
            let Seat::Tree { link, .. } = motors.seat else { return Ok(*motors) };
            let what = "a joint that stays";
            let moved = turned.seats[link].ok_or(SystemError::Unsupported { link, what })?;
            Ok(Motors { seat: seat(moved)?, ..*motors })
        };
        let motors = self.motors.iter().map(seat_of).collect::<Result<Vec<_>, _>>()?;
        let foot = |old: usize, ankle: &Motors| match ankle.seat {
            Seat::Tree { link, is_reversed: true } => {
                let weight = self.system.links()[old].body.mass * self.system.gravity();
                Foot::Still(link, weight)
            }
            _ => Foot::Welded,
        };
        let half = motors.len() / 2;
        let feet = vec![foot(left, &motors[half - 1]), foot(right, &motors[motors.len() - 1])];
        let (central, frame) = link(turned.links[self.central.0])?;
        Ok(Self {
            states,
            rates,
            motors,
            feet,
            central: (central, frame.then(&self.central.1)),
            still_energy: reduced.still_energy(),
            system: reduced.system,
        })
    }
}

/// The moving link that carries a link, and where in it.
fn carried(reduced: &Reduced, link: usize) -> Result<(usize, Frame), SystemError> {
    let what = "a body that stays and moves";
    match reduced.carrier(link) {
        Some((Some(carrier), frame)) => Ok((carrier, frame)),
        _ => Err(SystemError::Unsupported { link, what }),
    }
}
