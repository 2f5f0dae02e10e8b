//! Readings to a target that estimates the state itself, and what it makes of them.

use super::{LinkError, Target};
use crate::closed_loop::disturbance::Observed;
use crate::closed_loop::filter::{Filtered, SensorReadings, noise};
use crate::scene::Scene;
use surefoot::estimate::{OutOfBounds, StartPose};
use surefoot_link::{
    Estimated, FilterSettings, ObserverSettings, Readings, Sensors, ToTarget, Torques,
};

/// What is between a scene's sensors and a target.
pub(super) struct Sensing {
    period: f32,
    gravity: f32,
    walks: bool,
    /// At the next tick, and where the robot was at the first.
    readings: Option<(SensorReadings, StartPose<f64>)>,
    /// Whether the target has its filter.
    is_told: bool,
    /// Whether it has been armed.
    pub is_armed: bool,
    estimated: Option<Estimated>,
}

impl Sensing {
    /// Of a scene whose state is estimated.
    pub fn of(scene: &Scene) -> Self {
        let step = scene.integrator.step_s;
        let period = (1.0 / (scene.controller.rate_hz * step)).round() * step;
        Self {
            period: period as f32,
            gravity: scene.robot().tree.gravity().norm() as f32,
            walks: !scene.walk.is_empty(),
            readings: None,
            is_told: false,
            is_armed: false,
            estimated: None,
        }
    }

    /// What sensors read at the next tick.
    pub fn read(&mut self, readings: &SensorReadings, start: &StartPose<f64>) {
        self.readings = Some((*readings, *start));
    }

    /// Tells the target where the robot is, before the first readings.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn begin<const JOINTS: usize>(
        &mut self,
        target: &mut Target<JOINTS>,
    ) -> Result<(), LinkError> {
        let Some((_, start)) = self.readings.filter(|_| !self.is_told) else { return Ok(()) };
        self.is_told = true;
        let settings = FilterSettings {
            period: self.period,
            gravity: self.gravity,
            noise: noise(self.walks),
            imu_position: [0.0; 3],
            imu_orientation: [1.0, 0.0, 0.0, 0.0],
            feet: start.feet.map(|x| x as f32).into(),
            heading: start.heading as f32,
        };
        target.order("filter", &ToTarget::Filter(settings))
    }

    /// One tick: of a measurement the joints, contacts and forces, and for the central body what sensors read.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn tick<const JOINTS: usize>(
        &mut self,
        target: &mut Target<JOINTS>,
        measured: &Sensors<JOINTS>,
    ) -> Result<Torques<JOINTS>, LinkError> {
        // They are read before every tick.
        let Some((read, _)) = &self.readings else { return target.tick(measured) };
        let torques = target.tick_by_readings(&Readings {
            accelerometer: read.imu.accelerometer.map(|x| x as f32).into(),
            gyroscope: read.imu.gyroscope.map(|x| x as f32).into(),
            joint_angles: measured.joint_angles,
            joint_rates: measured.joint_rates,
            switches: Sensors::<JOINTS>::contact_bits(&read.pressed),
            contacts: measured.contacts,
            forces: measured.forces,
        })?;
        self.estimated = torques.estimated;
        Ok(torques)
    }

    /// What the target has made of the last.
    pub fn filtered(&self) -> Option<Filtered> {
        let Estimated { central, made_anew, worst } = self.estimated?;
        let worst = worst.map(|worst| OutOfBounds {
            concern: worst.concern,
            size: f64::from(worst.size),
            limit: f64::from(worst.limit),
        });
        Some(Filtered { central: central.map(f64::from), made_anew: made_anew.into(), worst })
    }
}

/// The observer of a scene.
pub(super) fn observer(scene: &Scene) -> ObserverSettings {
    let Observed { mass, gravity, height, nominal } = Observed::of(scene);
    ObserverSettings {
        mass: mass as f32,
        gravity: gravity as f32,
        height: height as f32,
        nominal: nominal.map(|x| x as f32),
    }
}
