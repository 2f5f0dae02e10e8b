//! The controller of a robot that walks: planner and whole-body controller.

use crate::control::Measurement;
use crate::robot::{COORDINATES, FEET, JOINTS, NODES, ROWS, VELOCITIES};
use crate::stance::{self, MODEL, Stance};
use surefoot::balance::{
    Command, Fault, ObservedBody, Reference, RobotState, WholeBodyController, WholeBodyMemory,
    WholeBodyState, whole_body_motion_tick,
};
use surefoot::spatial::Quaternion;
use surefoot::walk::{Planner, RANGE_MARGIN, WalkCommand, WalkMemory};
use surefoot_link::{
    Acknowledged, Settings, StanceSettings, TickLimits, WalkOrder, WalkerSettings,
};

/// It must know how the robot stands and walks.
pub const NEEDED: [bool; 2] = [true, true];

/// What is told before the robot is armed.
#[expect(clippy::large_enum_variant, reason = "there is no heap for the larger one")]
pub enum Limits {
    /// How it stands.
    Stance(Stance),
    /// How it walks.
    Walker(Walker),
}

/// A planner of the robot, and where it begins.
pub struct Walker {
    planner: Planner<f32, FEET>,
    heading: f32,
}

/// Planner and controller, and what a tick leaves for the next.
pub struct Balance {
    stance: Option<Stance>,
    walker: Option<Walker>,
    plan: WalkMemory<f32, FEET>,
    command: WalkCommand<f32>,
    period: f32,
    memory: WholeBodyMemory<f32>,
    /// The state, its kinematics and masses: here, and on no stack.
    observed: ObservedBody<f32, NODES, COORDINATES, VELOCITIES>,
    /// Of the last tick.
    met: Option<TickLimits<f32>>,
}

impl Balance {
    /// It does not know yet how the robot stands and walks.
    pub fn new() -> Self {
        Self {
            stance: None,
            walker: None,
            plan: WalkMemory::standing(0.0),
            command: WalkCommand::stand(),
            period: crate::control::PERIOD,
            memory: WholeBodyMemory::new(),
            observed: ObservedBody::new(),
            met: None,
        }
    }

    /// Another period; how it stands and walks must be said again.
    pub fn configure(&mut self, settings: &Settings<JOINTS>) {
        *self = Self { period: settings.period, ..Self::new() };
    }

    /// How it stands or walks. Apart, so that no tick has its stack.
    #[cold]
    #[inline(never)]
    pub fn limit(&mut self, limits: Limits) {
        match limits {
            Limits::Stance(stance) => self.stance = Some(stance),
            Limits::Walker(walker) => {
                self.plan = WalkMemory::standing(walker.heading);
                self.walker = Some(walker);
            }
        }
        if let (Some(stance), Some(walker)) = (&mut self.stance, &self.walker) {
            // Starting values belong to the height of the centre of mass here.
            let stature = &walker.planner.stature;
            let (height, gravity) = (stature.height, stature.robot.gravity);
            let feet = stature.feet.iter().flatten().count();
            let settings = stance.settings.for_walks(height, gravity, feet);
            stance.settings = settings.within(&crate::robot::LIMITS, RANGE_MARGIN);
        }
        self.command = WalkCommand::stand();
        self.memory = WholeBodyMemory::new();
    }

    /// What it is to do from now on.
    pub fn walk(&mut self, order: &WalkOrder) {
        self.command = WalkCommand::from(order);
    }

    /// What acts from outside is not taken into a walk.
    #[cfg(estimates)]
    pub fn under(&mut self, _: Option<surefoot::spatial::Wrench<f32>>) {}

    /// Steps so far.
    pub fn steps(&self) -> u32 {
        self.plan.steps
    }

    /// What limits made of the last tick.
    pub fn take_limits(&mut self) -> Option<TickLimits<f32>> {
        self.met.take()
    }

    /// Whether the robot leaps now, as it is to.
    pub fn leaps(&self) -> bool {
        self.walker.as_ref().is_some_and(|walker| walker.planner.leeway(&self.plan).leaps)
    }

    /// Where the supervisor is to expect the robot: where it is, at its height, or as far below as what is planned takes
    /// it.
    pub fn reference(
        &self,
        own: &Reference<f32>,
        state: Option<&RobotState<f32, ROWS>>,
    ) -> Reference<f32> {
        let mut position = own.position;
        if let Some(state) = state {
            (position.x, position.y) = (state.position.x, state.position.y);
        }
        if let Some(walker) = &self.walker {
            position.z -= walker.planner.leeway(&self.plan).sinks;
        }
        Reference::at_rest(position, Quaternion::identity())
    }

    /// One tick.
    #[inline(never)]
    pub fn tick(
        &mut self,
        state: &RobotState<f32, ROWS>,
        _: &Reference<f32>,
        measured: Option<&Measurement>,
    ) -> Result<Command<f32, ROWS>, Fault> {
        let Self { stance, walker, plan, memory, observed, met, .. } = self;
        // None is armed without both, and no tick goes on without a measurement.
        let (Some(Stance { robot, settings }), Some(walker)) = (stance, walker) else {
            return Err(Fault::NotHeld);
        };
        let forces = measured.map_or(&[0.0; FEET], |measured| &measured.forces);
        let controller = WholeBodyController { tree: &MODEL, robot, settings };
        observed.observe(&controller, &WholeBodyState::of_rows(state))?;
        let motion = observed.motion(&controller)?;
        let task = walker.planner.plan(plan, &motion, forces, &self.command, self.period)?;
        let answer = whole_body_motion_tick(&controller, observed, &task.motion, memory)?;
        *met = Some(TickLimits::from(&answer.limits));
        Ok(answer.in_rows())
    }
}

/// How it stands, as a message says it.
pub fn standing(message: &StanceSettings<JOINTS>) -> Result<Limits, Acknowledged> {
    stance::stance(message).map(Limits::Stance)
}

/// How it walks, as a message says it.
#[inline(never)]
pub fn walker(message: &WalkerSettings) -> Result<Limits, Acknowledged> {
    let stature = message.stature();
    if !(stature.check().is_ok() && message.heading.is_finite()) {
        return Err(Acknowledged::Invalid);
    }
    Ok(Limits::Walker(Walker { planner: Planner::new(stature), heading: message.heading }))
}
