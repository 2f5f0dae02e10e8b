//! The controller of robots whose legs have not six joints each, or that move other limbs too.

use crate::board::Counter;
use crate::robot::{
    COORDINATES, FEET, GAINS, JOINTS, LIMITS, NODES, ON_FEET, ROW, ROWS, TREE, VELOCITIES, gains,
};
use surefoot::balance::{
    Command, ContactLimits, Fault, LimitError, LimitFault, LimitField, Reference, RobotState,
    WholeBody, WholeBodyController, WholeBodyFoot, WholeBodyMemory, WholeBodySettings,
    WholeBodyState, whole_body_tick,
};
use surefoot::model::Tree;
use surefoot::spatial::Wrench;
use surefoot_link::{
    Acknowledged, FromTarget, Sensors, SetPoint, Settings, StanceSettings, TickLimits,
    WrenchSettings,
};

/// In flash.
static MODEL: Tree<f32, NODES, COORDINATES, VELOCITIES> = TREE;

/// How the robot stands: what a message says of it, ready for ticks.
pub struct Stance {
    robot: WholeBody<f32, FEET, VELOCITIES>,
    settings: WholeBodySettings<f32, VELOCITIES>,
}

/// The controller, what a tick leaves for the next, and what the last one met.
pub struct Balance {
    stance: Option<Stance>,
    /// Diagonals.
    gains: [[f32; 3]; 4],
    memory: WholeBodyMemory<f32>,
    /// Of the last tick.
    met: Option<TickLimits<f32>>,
}

impl Balance {
    /// With the gains of the robot's file; it does not know yet how the robot stands.
    pub fn new() -> Self {
        Self { stance: None, gains: GAINS, memory: WholeBodyMemory::new(), met: None }
    }

    /// New gains; how it stands must be said again.
    pub fn configure(&mut self, settings: &Settings<JOINTS>) {
        *self = Self { gains: settings.gains, ..Self::new() };
    }

    /// How it stands.
    pub fn limit(&mut self, mut stance: Stance) {
        stance.settings.gains = gains(self.gains);
        self.stance = Some(stance);
        self.memory = WholeBodyMemory::new();
    }

    /// What limits made of the last tick.
    pub fn take_limits(&mut self) -> Option<TickLimits<f32>> {
        self.met.take()
    }

    /// One tick.
    #[inline(never)]
    pub fn tick(
        &mut self,
        state: &RobotState<f32, ROWS>,
        reference: &Reference<f32>,
        contacts: Option<&[bool; FEET]>,
    ) -> Result<Command<f32, ROWS>, Fault> {
        let Self { stance, memory, met, .. } = self;
        // None is armed without one.
        let Stance { robot, settings } = stance.as_ref().ok_or(Fault::NotHeld)?;
        let controller = WholeBodyController { tree: &MODEL, robot, settings };
        let contacts = contacts.unwrap_or(&[true; FEET]);
        let state = WholeBodyState::of_rows(state);
        let answer = whole_body_tick(&controller, &state, reference, contacts, memory)?;
        *met = Some(TickLimits::from(&answer.limits));
        let mut joint_torques = [[0.0; ROW]; ROWS];
        let torques = answer.torques.iter().skip(6);
        joint_torques.as_flattened_mut().iter_mut().zip(torques).for_each(|(to, t)| *to = *t);
        Ok(Command {
            joint_torques,
            desired_wrench: answer.desired_wrench,
            foot_wrenches: [Wrench::zero(); ROWS],
            position_error: answer.position_error,
            orientation_error: answer.orientation_error,
        })
    }
}

/// These limits are of legs of six joints.
pub fn limits(_: &WrenchSettings<JOINTS>) -> Result<Stance, Acknowledged> {
    Err(Acknowledged::Unsupported)
}

/// What a message says, with no more torque than the robot's own.
#[inline(never)]
pub fn stance(message: &StanceSettings<JOINTS>) -> Result<Stance, Acknowledged> {
    let StanceSettings { ground, height, gravity, torques, posture } = message;
    let is_positive = |x: f32| x.is_finite() && x > 0.0;
    if !(is_positive(*height) && is_positive(*gravity)) {
        return Err(Acknowledged::Invalid);
    }
    let mut settings = WholeBodySettings::scaled(*height, *gravity, FEET);
    let own = LIMITS.joints.as_flattened();
    let wanted = torques.iter().zip(posture.iter()).zip(own).enumerate();
    let places = settings.torques.iter_mut().zip(&mut settings.posture).skip(6);
    for ((joint, ((torque, angle), own)), (to, posture)) in wanted.zip(places) {
        if *torque > own.torque {
            let joint = Some((joint / ROW, joint % ROW));
            let (field, fault) = (LimitField::Torque, LimitFault::Widens);
            return Err(Acknowledged::Limit(LimitError { joint, field, fault }));
        }
        (*to, *posture) = (*torque, *angle);
    }
    let feet = ON_FEET.map(|foot| {
        foot.map(|foot| WholeBodyFoot {
            limits: ContactLimits {
                least_force: ground.least_force,
                greatest_force: ground.greatest_force,
                friction: ground.friction,
                ..foot.limits
            },
            ..foot
        })
    });
    let refused = |fault: surefoot::balance::WholeBodyRobotFault| {
        defmt::warn!("how it stands is refused: {}", defmt::Display2Format(&fault));
        Acknowledged::Invalid
    };
    settings.check().map_err(refused)?;
    let robot = WholeBody::new(&MODEL, &feet).map_err(refused)?;
    Ok(Stance { robot, settings })
}

/// Costs of stages are told of the controller for legs of six joints.
pub struct Profile;

impl Profile {
    /// Nothing.
    pub fn new() -> Self {
        Self
    }

    /// Nothing changes.
    pub fn configure(&mut self, _: &Settings<JOINTS>) {}

    /// Nothing changes.
    pub fn set_point(&mut self, _: &SetPoint) {}

    /// It has none.
    pub fn stages(&self, _: Counter, _: &Sensors<JOINTS>) -> FromTarget<JOINTS> {
        FromTarget::Acknowledged(Acknowledged::Unsupported)
    }
}
