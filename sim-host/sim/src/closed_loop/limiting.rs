//! What a scene's floor and motors can give, as its controller knows it.

use crate::record::{NotedLimit, TickNote};
use crate::robot::{LEG, Robot, SharedRobot, by_leg};
use crate::scene::{Distribution, Feet, Scene};
use serde::Serialize;
use surefoot::Real;
use surefoot::balance::{
    self, Command, ContactLimit, Fault, Ground, LeggedRobot, LimitMemory, Reference, RobotState,
    Sole, WrenchLimits, limited_tick_under,
};
use surefoot::spatial::Wrench;
use surefoot_link::TickLimits;
use surefoot_multibody::contact::Floor;

/// Shares of friction and of the soles' lengths that the controller counts on.
pub(super) const FRICTION_SHARE: f64 = 0.8;
pub(super) const SOLE_SHARE: f64 = 0.92;
/// A foot that stands is pressed on with so much, N.
const LEAST_FORCE: f64 = 5.0;
/// Greatest force on a foot in weights of the robot.
pub(super) const MOST_WEIGHTS: f64 = 4.0;

/// Limits of a scene, what the last tick leaves for the next, and what became of the ticks so far.
pub(super) struct Limiting<T, const LEGS: usize> {
    robot: SharedRobot,
    limits: WrenchLimits<T, LEGS>,
    memory: LimitMemory<T>,
    contacts: [bool; LEGS],
    time_s: f64,
    tally: LimitTally,
}

/// How often limits bound, and which did most.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LimitTally {
    /// Ticks.
    pub ticks: u64,
    /// Share of them in which some limit bound.
    pub active_share: f64,
    /// Ticks whose work was spent before the answer was reached.
    pub unfinished: u64,
    /// The limit that cost most at any tick.
    pub worst: Option<WorstLimit>,
    /// Of the last tick.
    #[serde(skip)]
    pub last: TickNote,
    #[serde(skip)]
    active: u64,
}

/// A limit that bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WorstLimit {
    /// `lift`, `press`, `slip`, `tip`, `twist` or `torque`.
    pub limit: &'static str,
    /// Name of the leg.
    pub leg: String,
    /// Number of the joint, hip to foot from 0, of a torque.
    pub joint: Option<u8>,
    /// When, s.
    pub time_s: f64,
    /// By how much the objective would fall per 100 % of a wider limit.
    pub relief: f64,
}

impl LimitTally {
    /// The same without what is known of the last tick alone, which a target does not tell whole.
    pub fn over_all(mut self) -> Self {
        self.last = TickNote::default();
        self
    }

    /// Another tick.
    pub(super) fn count(&mut self, is_limited: bool, is_unfinished: bool) {
        self.ticks += 1;
        self.active += u64::from(is_limited);
        self.active_share = self.active as f64 / self.ticks as f64;
        self.unfinished += u64::from(is_unfinished);
    }

    /// Another tick of a robot on legs of six joints.
    pub(super) fn count_tick<T: Real>(&mut self, robot: &Robot, time_s: f64, tick: &TickLimits<T>) {
        self.count(tick.is_active, tick.is_unfinished);
        self.last = TickNote::default();
        let Some(reason) = tick.worst else { return };
        let (limit, mut joint) = named(reason.limit);
        let of_leg = robot.legs.get(reason.foot);
        let of = match joint {
            // Its name says more than its number.
            Some(k) if !robot.tree.is_six_jointed() => {
                joint = None;
                robot.joints.get(LEG * reason.foot + usize::from(k))
            }
            _ => of_leg,
        };
        let leg = of.cloned().unwrap_or_default();
        self.bound(WorstLimit { limit, leg, joint, time_s, relief: reason.relief.to_f64() });
    }

    /// The limit that cost most at a tick.
    pub(super) fn bound(&mut self, limit: WorstLimit) {
        let of = limit
            .joint
            .map_or_else(|| limit.leg.clone(), |joint| format!("{} joint {joint}", limit.leg));
        self.last.limit = Some(NotedLimit { limit: limit.limit, of, relief: limit.relief });
        if self.worst.as_ref().is_none_or(|worst| worst.relief < limit.relief) {
            self.worst = Some(limit);
        }
    }
}

/// A limit's word, and the joint that it is of.
pub(super) fn named(limit: ContactLimit) -> (&'static str, Option<u8>) {
    match limit {
        ContactLimit::Lift => ("lift", None),
        ContactLimit::Press => ("press", None),
        ContactLimit::Slip => ("slip", None),
        ContactLimit::Tip => ("tip", None),
        ContactLimit::Twist => ("twist", None),
        ContactLimit::Torque(joint) => ("torque", Some(joint)),
        ContactLimit::Range(joint) => ("range", Some(joint)),
    }
}

/// What a scene's floor and motors give.
pub(super) struct Given {
    pub ground: Ground<f64>,
    /// Of each leg, so much of it as is counted on.
    pub soles: Vec<Sole<f64>>,
    /// Greatest torques, joint by joint, N·m.
    pub torques: Vec<f64>,
}

impl Given {
    /// To a controller whose distribution is limited.
    pub fn by(scene: &Scene) -> Option<Self> {
        let Feet::Floor { floor, .. } = &scene.feet else { return None };
        if scene.controller.distribution != Distribution::Limited {
            return None;
        }
        let robot = scene.robot();
        let weight = robot.tree.mass() * robot.tree.gravity().norm();
        let ground = Ground {
            least_force: LEAST_FORCE,
            greatest_force: MOST_WEIGHTS * weight,
            friction: FRICTION_SHARE * friction(floor),
        };
        let mut torques: Vec<f64> = robot.limits.joints.iter().map(|joint| joint.torque).collect();
        if let Some(motors) = scene.acting.torque_limits_nm {
            for (torque, motor) in torques.iter_mut().zip(motors.into_iter().cycle()) {
                *torque = torque.min(motor);
            }
        }
        let soles = robot.soles().expect("the scene's check requires soles");
        Some(Self { ground, soles: soles.iter().map(counted_on).collect(), torques })
    }
}

impl<T: Real, const LEGS: usize> Limiting<T, LEGS> {
    /// Of a scene whose controller's distribution is limited.
    pub fn of(scene: &Scene, model: &LeggedRobot<T, LEGS>) -> Option<Self> {
        let Given { ground, soles, torques } = Given::by(scene)?;
        let ground = Ground {
            least_force: T::of(ground.least_force),
            greatest_force: T::of(ground.greatest_force),
            friction: T::of(ground.friction),
        };
        let torques: [[f64; LEG]; LEGS] = by_leg(&torques);
        let soles: [Sole<T>; LEGS] = std::array::from_fn(|leg| {
            let Sole { x, y, z } = soles[leg];
            Sole { x: x.map(T::of), y: y.map(T::of), z: T::of(z) }
        });
        let limits = WrenchLimits::new(model, &soles, ground, &torques.map(|leg| leg.map(T::of)))
            .expect("a checked floor, and a robot with limits");
        let (memory, tally) = (LimitMemory::new(), LimitTally::default());
        let robot = scene.robot();
        Some(Self { robot, limits, memory, contacts: [true; LEGS], time_s: 0.0, tally })
    }

    /// Which feet touch the ground at the next tick, and when that is.
    pub fn touch(&mut self, time_s: f64, feet: &[bool]) {
        self.time_s = time_s;
        for (to, touches) in self.contacts.iter_mut().zip(feet) {
            *to = *touches;
        }
    }

    /// One tick, under a wrench from outside if one is known.
    pub fn tick(
        &mut self,
        controller: &balance::Controller<'_, T, LEGS>,
        state: &RobotState<T, LEGS>,
        reference: &Reference<T>,
        external: Option<Wrench<T>>,
    ) -> Result<Command<T, LEGS>, Fault> {
        let Self { limits, memory, contacts, .. } = self;
        let around = (&*contacts, external);
        let answer = limited_tick_under(controller, limits, state, reference, around, memory)?;
        self.tally.count_tick(&self.robot, self.time_s, &TickLimits::from(&answer.limits));
        self.tally.last.work = Some(answer.limits.work);
        Ok(answer.command)
    }

    /// What became of the ticks so far.
    pub fn tally(&self) -> LimitTally {
        self.tally.clone()
    }

    /// Limits that bound at the last tick.
    pub fn rows(&self) -> Vec<(u8, f64)> {
        self.memory.rows().map(|(row, multiplier)| (row, multiplier.to_f64())).collect()
    }

    /// Goes on with them.
    pub fn resume(&mut self, rows: &[(u8, f64)]) {
        self.memory =
            LimitMemory::of(rows.iter().map(|(row, multiplier)| (*row, T::of(*multiplier))));
    }
}

/// What a floor can be counted on to hold.
pub(super) fn friction(floor: &Floor) -> f64 {
    floor.static_friction.min(floor.dynamic_friction)
}

/// The share of a sole that is counted on.
fn counted_on(sole: &Sole<f64>) -> Sole<f64> {
    let range = |[least, greatest]: [f64; 2]| {
        let (middle, half) = (0.5 * (least + greatest), 0.5 * SOLE_SHARE * (greatest - least));
        [middle - half, middle + half]
    };
    Sole { x: range(sole.x), y: range(sole.y), z: sole.z }
}
