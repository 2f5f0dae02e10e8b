//! The state estimator in the precision of the controller that sees its estimate, or on that controller's target.

use super::controller::Scalar;
use super::whole_body_settings::FEET;
use crate::robot::{Contacts, SharedRobot, with_tree};
use nalgebra::Vector3;
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;
use surefoot::Real;
use surefoot::balance::WholeBodyFoot;
use surefoot::estimate::{
    EstimateFault, Estimator, EstimatorState, FootKind, FootPose, FootReading, ImuReading,
    OutOfBounds, Readings, SensorNoise, StartPose, foot_poses,
};
use surefoot::model::Tree;

/// Of the direction in which the feet's forces are found, m/s²/√Hz: a tenth in variance of core's starting value, with
/// which a sensor that is askew by 1.5° takes twice as long to be righted.
const FORCE_DIRECTION: f64 = 0.03;

/// Where a scene's state is estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilterPlace {
    /// Here, in this precision.
    Host(Scalar),
    /// On the controller's target, from readings.
    Target,
}

/// What sensors read at a tick.
#[derive(Clone, Copy, Debug)]
pub struct SensorReadings {
    /// Of the inertial sensor.
    pub imu: ImuReading<f64>,
    /// Which feet press on their switches.
    pub pressed: [bool; FEET],
    /// Which of them a planner has stand.
    pub planned: [bool; FEET],
    /// Of the ground on all feet, central body's axes, N, where that is known.
    pub feet_force: Option<Vector3<f64>>,
}

/// What is made of them.
#[derive(Clone, Copy, Debug)]
pub struct Filtered {
    /// Position (m), quaternion and body twist (m/s, rad/s) of the central body.
    pub central: [f64; 13],
    /// Feet that were made anew.
    pub made_anew: u64,
    /// What is farthest out of bounds.
    pub worst: Option<OutOfBounds<f64>>,
}

/// What sensors and ground are taken to be: floors of scenes yield.
pub(super) fn noise<T: Real>(walks: bool) -> SensorNoise<T> {
    let noise = if walks { SensorNoise::walking() } else { SensorNoise::yielding_ground() };
    SensorNoise { force_direction: T::of(FORCE_DIRECTION), ..noise }
}

/// The filter in either precision.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "a run has one")]
pub(super) enum Filter {
    F32(FilterIn<f32>),
    F64(FilterIn<f64>),
}

/// The filter in precision `T`.
#[derive(Clone, Debug)]
pub(super) struct FilterIn<T> {
    settings: Estimator<T, FEET>,
    kinematics: Kinematics<T>,
    state: Option<EstimatorState<T, FEET>>,
}

impl Filter {
    /// For ticks `period_s` apart.
    ///
    /// # Panics
    /// For a robot without feet on legs, which the scene's check refuses.
    pub fn new(robot: &SharedRobot, period_s: f64, scalar: Scalar, walks: bool) -> Self {
        let feet = Contacts::of(robot).expect("a robot with feet on legs").feet;
        let gravity = robot.tree.gravity().norm();
        match scalar {
            Scalar::F32 => {
                let kinematics =
                    with_tree!(&robot.tree, tree => Kinematics::of(tree.to_f32(), feet));
                Self::F32(FilterIn::new(kinematics, feet, (period_s, gravity), noise(walks)))
            }
            Scalar::F64 => {
                let kinematics = with_tree!(&robot.tree, tree => Kinematics::of(*tree, feet));
                Self::F64(FilterIn::new(kinematics, feet, (period_s, gravity), noise(walks)))
            }
        }
    }

    /// One tick with these readings and joint angles; `start` says where a robot is that begins.
    ///
    /// # Errors
    /// The estimator's fault.
    pub fn step(
        &mut self,
        readings: &SensorReadings,
        angles: &[f64],
        start: impl FnOnce() -> StartPose<f64>,
    ) -> Result<Filtered, EstimateFault> {
        match self {
            Self::F32(filter) => filter.step(readings, angles, start),
            Self::F64(filter) => filter.step(readings, angles, start),
        }
    }
}

impl<T: Real> FilterIn<T> {
    fn new(
        kinematics: Kinematics<T>,
        feet: [Option<WholeBodyFoot<f64>>; FEET],
        (period_s, gravity): (f64, f64),
        noise: SensorNoise<T>,
    ) -> Self {
        let kinds = feet.map(|foot| foot.as_ref().map(FootKind::of));
        let settings = Estimator::new(T::of(period_s), T::of(gravity), kinds);
        Self { settings: Estimator { noise, ..settings }, kinematics, state: None }
    }

    fn step(
        &mut self,
        readings: &SensorReadings,
        angles: &[f64],
        start: impl FnOnce() -> StartPose<f64>,
    ) -> Result<Filtered, EstimateFault> {
        let poses = (self.kinematics.0)(angles);
        let round = |v: Vector3<f64>| v.map(T::of);
        let readings = Readings {
            imu: ImuReading {
                accelerometer: round(readings.imu.accelerometer),
                gyroscope: round(readings.imu.gyroscope),
            },
            feet: std::array::from_fn(|foot| FootReading {
                position: poses[foot].position,
                orientation: poses[foot].orientation,
                is_pressed: readings.pressed[foot],
                is_planned: readings.planned[foot],
            }),
            feet_force: readings.feet_force.map(round),
        };
        let mut state = match self.state {
            Some(state) => state,
            None => {
                let StartPose { feet, heading } = start();
                let start = StartPose { feet: round(feet), heading: T::of(heading) };
                EstimatorState::start(&self.settings, &readings, &start)?
            }
        };
        let report = self.settings.step(&mut state, &readings)?;
        self.state = Some(state);
        let estimate = report.estimate;
        let pose = estimate.position.iter().copied().chain(estimate.orientation.to_array());
        let mut central = [0.0; 13];
        let numbers = pose.chain(estimate.velocity.to_array());
        central.iter_mut().zip(numbers).for_each(|(to, x)| *to = x.to_f64());
        let anew = report.innovations.iter().flatten().filter(|found| found.is_reset).count();
        let worst = report.health.worst.map(|worst| OutOfBounds {
            concern: worst.concern,
            size: worst.size.to_f64(),
            limit: worst.limit.to_f64(),
        });
        Ok(Filtered { central, made_anew: anew as u64, worst })
    }
}

/// Where the feet are in the central body's frame, by the joints' angles.
#[derive(Clone)]
struct Kinematics<T>(Arc<FeetAtAngles<T>>);

/// Poses of the feet in the central body's frame, of the joints' angles.
type FeetAtAngles<T> = dyn Fn(&[f64]) -> [FootPose<T>; FEET] + Send + Sync;

impl<T: Real> Kinematics<T> {
    fn of<const N: usize, const NQ: usize, const NV: usize>(
        tree: Tree<T, N, NQ, NV>,
        feet: [Option<WholeBodyFoot<f64>>; FEET],
    ) -> Self {
        let feet = feet.map(|foot| foot.map(|foot| foot.rounded()));
        Self(Arc::new(move |angles| {
            let mut positions = [T::zero(); NQ];
            positions.iter_mut().skip(7).zip(angles).for_each(|(to, x)| *to = T::of(*x));
            foot_poses(&tree, &feet, &positions)
        }))
    }
}

impl<T> Debug for Kinematics<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("Kinematics")
    }
}
