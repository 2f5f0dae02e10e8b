//! Controllers that compute less than they should: what a control engineer would try, and what it does.

use super::controller::{
    Commanded, ControlFailure, Controller, HostController, commanded, measured,
};
use crate::plant::PlantState;
use serde::Serialize;
use surefoot::Real;
use surefoot::balance::{
    CentralBody, Fault, RobotState, WorkspaceDynamics, central_body, desired_acceleration,
    fixed_foot_dynamics, fixed_foot_wrench, joint_torques, leg_kinematics, wrench_distribution,
};
use surefoot::spatial::{Twist, Wrench};

/// What is left out. Feet are held exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Approximation {
    /// `P_1` and `z_1` of (4.2) are computed at every second tick, and held at others
    #[value(name = "held-for-2")]
    #[serde(rename = "held-for-2")]
    HeldFor2,
    /// At every fourth
    #[value(name = "held-for-4")]
    #[serde(rename = "held-for-4")]
    HeldFor4,
    /// At every eighth
    #[value(name = "held-for-8")]
    #[serde(rename = "held-for-8")]
    HeldFor8,
    /// Products of velocities are left out of `z_1`: of bodies' motion only weight stays
    NoVelocityProducts,
}

impl Approximation {
    /// Ticks for which dynamics are held; none where they are not.
    pub fn held_for(self) -> Option<u32> {
        match self {
            Self::HeldFor2 => Some(2),
            Self::HeldFor4 => Some(4),
            Self::HeldFor8 => Some(8),
            Self::NoVelocityProducts => None,
        }
    }
}

/// The core's controller, stage by stage, with something left out.
pub struct ApproximateController<T, const LEGS: usize> {
    exact: HostController<T, LEGS>,
    approximation: Approximation,
    /// Since the last were computed, ticks.
    held: Option<(WorkspaceDynamics<T>, u32)>,
}

impl<T: Real, const LEGS: usize> ApproximateController<T, LEGS> {
    /// Of a controller, less an approximation.
    pub fn new(exact: HostController<T, LEGS>, approximation: Approximation) -> Self {
        Self { exact, approximation, held: None }
    }

    fn torques(&mut self, state: &PlantState) -> Result<([[T; 6]; LEGS], Wrench<T>), Fault> {
        let controller = self.exact.core();
        let (robot, singularity) = (controller.robot, controller.singularity);
        let state = measured(state);
        let central = central_body(robot, &state)?;
        let desired = desired_acceleration(
            &controller.gains,
            &central,
            state.position,
            &self.exact.reference,
        )?;
        let (wrench, legs) = match self.approximation.held_for() {
            Some(ticks) => {
                let legs = leg_kinematics(robot, &central, &state);
                let held = self.held.filter(|(_, age)| *age + 1 < ticks);
                let (dynamics, age) = match held {
                    Some((dynamics, age)) => (dynamics, age + 1),
                    None => (fixed_foot_dynamics(robot, &central, &legs, singularity)?, 0),
                };
                self.held = Some((dynamics, age));
                (dynamics.wrench(desired.x), legs)
            }
            None => {
                // The acceleration of the centre of mass is the controller's own, and stays: only what turning
                // and swinging bodies need besides is left out.
                let v = state.velocity;
                let x = Twist {
                    linear: desired.x.linear + v.angular.cross(&v.linear),
                    angular: desired.x.angular,
                };
                let central = CentralBody { velocity: Twist::zero(), ..central };
                let still = RobotState { joint_rates: [[T::zero(); 6]; LEGS], ..state };
                let legs = leg_kinematics(robot, &central, &still);
                (fixed_foot_wrench(robot, &central, &legs, singularity, x)?, legs)
            }
        };
        let feet = wrench_distribution(wrench, &legs).ok_or(Fault::Overflow)?.in_central_axes;
        let torques: [[T; 6]; LEGS] =
            std::array::from_fn(|leg| joint_torques(&legs[leg], feet[leg]));
        match torques.iter().flatten().all(|torque| torque.is_finite()) {
            true => Ok((torques, wrench)),
            false => Err(Fault::Overflow),
        }
    }
}

impl<T: Real, const LEGS: usize> Controller for ApproximateController<T, LEGS> {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let (torques, wrench) = self.torques(state).map_err(ControlFailure::Fault)?;
        Ok(commanded(torques, wrench))
    }
}
