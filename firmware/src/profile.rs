//! What each stage of a tick costs, one after the other, for one measurement.

use crate::board::Counter;
use crate::control::reference;
use crate::robot::{self, JOINTS, ROBOT, ROWS};
use crate::six_jointed::{configure, controller};
use core::hint::black_box;
use surefoot::balance::{
    Controller, Fault, Reference, RobotState, WorkspaceForm, big_base, central_body,
    desired_acceleration, fixed_foot_wrench, joint_torques, leg_kinematics, tick,
    wrench_distribution,
};
use surefoot_link::{FromTarget, Sensors, SetPoint, Settings, Stages};

/// The tick's constants, kept a second time for idle.
pub struct Profile {
    controller: Controller<'static, f32, ROWS>,
    reference: Reference<f32>,
}

impl Profile {
    /// With the tick's constants after a reset.
    pub fn new() -> Self {
        Self { controller: controller(), reference: robot::reference() }
    }

    /// As the tick is configured.
    pub fn configure(&mut self, settings: &Settings<JOINTS>) {
        configure(&mut self.controller, settings);
    }

    /// As the tick is.
    pub fn set_point(&mut self, pose: &SetPoint) {
        self.reference = reference(pose);
    }

    /// Costs of all stages; zero from the stage on that finds the measurement faulty.
    #[inline(never)]
    pub fn stages(&self, counter: Counter, sensors: &Sensors<JOINTS>) -> FromTarget<JOINTS> {
        let (state, mut stages) = (sensors.state(), Stages::default());
        // A fault is an answer too, and ends the list.
        let _ = each(self, counter, black_box(&state), &mut stages);
        let begin = counter.now();
        let _ = black_box(tick(&self.controller, black_box(&state), &self.reference));
        stages.tick = counter.since(begin);
        FromTarget::Stages(stages)
    }
}

fn each(
    profile: &Profile,
    counter: Counter,
    state: &RobotState<f32, ROWS>,
    stages: &mut Stages,
) -> Result<(), Fault> {
    let Profile { controller, reference } = profile;
    let mut begin = counter.now();
    let mut stage = |cost: &mut u32| {
        *cost = counter.since(begin);
        begin = counter.now();
    };
    let central = black_box(central_body(&ROBOT, state))?;
    stage(&mut stages.central_body);
    let legs = black_box(leg_kinematics(&ROBOT, &central, state));
    stage(&mut stages.leg_kinematics);
    let desired =
        black_box(desired_acceleration(&controller.gains, &central, state.position, reference))?;
    stage(&mut stages.desired_acceleration);
    let wrench = black_box(match controller.form {
        WorkspaceForm::FixedFoot => {
            fixed_foot_wrench(&ROBOT, &central, &legs, controller.singularity, desired.x)
        }
        WorkspaceForm::BigBase { factor } => {
            big_base(&ROBOT, &central, &legs, factor).map(|dynamics| dynamics.wrench(desired.x))
        }
    })?;
    stage(&mut stages.workspace_dynamics);
    let feet = black_box(wrench_distribution(wrench, &legs)).ok_or(Fault::Overflow)?;
    stage(&mut stages.wrench_distribution);
    for (leg, foot) in legs.iter().zip(feet.in_central_axes) {
        black_box(joint_torques(leg, foot));
    }
    stage(&mut stages.joint_torques);
    Ok(())
}
