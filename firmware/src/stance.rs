//! Robots of the whole-body controller: those whose legs have not six joints each, or that move other limbs too, and
//! all that walk.

use crate::board::Counter;
pub use crate::robot::MODEL;
use crate::robot::{FEET, JOINTS, LIMITS, ON_FEET, ROW, VELOCITIES};
use surefoot::balance::{
    ContactLimits, LimitError, LimitFault, LimitField, WHOLE_BODY_FEET, WholeBody, WholeBodyFoot,
    WholeBodyRobotFault, WholeBodySettings,
};
use surefoot_link::{
    Acknowledged, FromTarget, Sensors, SetPoint, Settings, StanceSettings, WrenchSettings,
};

/// How the robot stands: what a message says of it, ready for ticks.
pub struct Stance {
    pub robot: WholeBody<f32, FEET, VELOCITIES>,
    pub settings: WholeBodySettings<f32, VELOCITIES>,
}

/// These limits are of legs of six joints.
pub fn limits<L>(_: &WrenchSettings<JOINTS>) -> Result<L, Acknowledged> {
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
    // A budget with room for the most feet that there are: the host's.
    let mut settings = WholeBodySettings::scaled(*height, *gravity, WHOLE_BODY_FEET);
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
    let refused = |fault: WholeBodyRobotFault| {
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
