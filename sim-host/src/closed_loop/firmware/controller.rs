//! The controller on a target, in place of the host's.

use super::{LinkError, Target};
use crate::closed_loop::{Commanded, ControlFailure, Controller, Costs, measured};
use crate::plant::PlantState;
use crate::scene::{Scene, Workspace};
use surefoot::balance::StopReason;
use surefoot::model::robots::biped;
use surefoot_link::{Counter, Pacing, Sensors, SetPoint, Settings, ToTarget, Torques};

/// A target that balances a scene's plant, in lock step with it.
pub struct FirmwareController {
    target: Target,
    /// What each tick has cost, in the target's unit.
    costs: Vec<u32>,
    stopped: Option<StopReason>,
}

impl FirmwareController {
    /// Configures a target for a scene, and arms it.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn new(mut target: Target, scene: &Scene) -> Result<Self, LinkError> {
        target.order("disarm", &ToTarget::Disarm)?;
        target.order("configure", &ToTarget::Configure(settings(scene)))?;
        target.order("set point", &ToTarget::SetPoint(set_point(scene)))?;
        target.order("arm", &ToTarget::Arm)?;
        Ok(Self { target, costs: Vec::new(), stopped: None })
    }

    /// What each tick has cost, in the target's unit.
    pub fn tick_costs(&self) -> &[u32] {
        &self.costs
    }

    /// The target.
    pub fn target(&mut self) -> &mut Target {
        &mut self.target
    }

    /// One tick.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn exchange(&mut self, state: &PlantState) -> Result<Torques, LinkError> {
        let torques = self.target.tick(&Sensors::from(&measured(state)))?;
        self.costs.push(torques.cost);
        Ok(torques)
    }
}

/// A scene's settings in single precision, with the biped's limits.
pub fn settings(scene: &Scene) -> Settings {
    let settings = &scene.controller;
    let single = |gain: [f64; 3]| gain.map(|x| x as f32);
    Settings {
        period: (1.0 / settings.rate_hz) as f32,
        pacing: Pacing::LockStep,
        gains: [
            single(settings.position_gain),
            single(settings.velocity_gain),
            single(settings.orientation_gain),
            single(settings.angular_velocity_gain),
        ],
        big_base: match settings.workspace {
            Workspace::FixedFoot => None,
            Workspace::BigBase(factor) => Some(factor as f32),
        },
        joint_limits: biped::LIMITS.to_f32().joints,
        thresholds: biped::LIMITS.to_f32().thresholds,
    }
}

/// A scene's set point in single precision.
pub fn set_point(scene: &Scene) -> SetPoint {
    SetPoint {
        position: scene.set_point.position_m.map(|x| x as f32),
        orientation: scene.set_point.orientation.map(|x| x as f32),
    }
}

impl Controller for FirmwareController {
    fn stopped(&self) -> Option<StopReason> {
        self.stopped
    }

    fn costs(&self) -> Option<Costs> {
        let identity = self.target.identity();
        let sum: f64 = self.costs.iter().map(|cost| f64::from(*cost)).sum();
        Some(Costs {
            unit: match identity.counter {
                Counter::Cycles => "cycles",
                Counter::Instructions => "instructions",
            },
            per_second: identity.per_second,
            min: *self.costs.iter().min()?,
            mean: sum / self.costs.len() as f64,
            max: *self.costs.iter().max()?,
        })
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let torques = self.exchange(state)?;
        self.stopped = torques.reason;
        let joints = torques.joint_torques.as_flattened();
        Ok(Commanded {
            torques: joints.iter().copied().map(f64::from).collect(),
            desired_wrench: torques.desired_wrench.map(f64::from),
        })
    }
}
