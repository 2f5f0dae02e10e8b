//! The state estimator in the loop: what it is fed, and what it makes of the state that controllers see.

use super::inertial::{InertialSensor, logarithm};
use super::whole_body_settings::FEET;
use crate::plant::PlantState;
use crate::robot::{Contacts, SharedRobot};
use crate::scene::Sensing;
use nalgebra::Vector3;
use serde::Serialize;
use surefoot::balance::WholeBodyFoot;
use surefoot::estimate::{
    EstimateFault, Estimator, EstimatorState, FootKind, FootReading, Readings, SensorNoise,
    StartPose,
};
use surefoot::spatial::{Pose, Quaternion};

/// A foot's switch closes at this share of the robot's weight: 20 N of a person's.
const SWITCH_SHARE: f64 = 0.03;
/// Of the direction in which the feet's forces are found, m/s²/√Hz: a tenth in variance of core's starting value, with
/// which a sensor that is askew by 1.5° takes twice as long to be righted.
const FORCE_DIRECTION: f64 = 0.03;

/// What the estimator has said over a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct EstimateTally {
    /// Feet that were made anew because they were not where they had stood.
    pub feet_made_anew: u64,
    /// Ticks in which something was out of bounds.
    pub doubtful_ticks: u64,
    /// What was first.
    pub first: Option<EstimateDoubt>,
}

/// Something that was out of bounds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EstimateDoubt {
    /// When, s.
    pub time_s: f64,
    /// What, by how much, and its bound.
    pub what: String,
}

/// The estimator, its inertial sensor and switches. Encoders are read before it.
#[derive(Clone, Debug)]
pub(super) struct Estimating {
    robot: SharedRobot,
    feet: [Option<WholeBodyFoot<f64>>; FEET],
    settings: Estimator<f64, FEET>,
    state: Option<EstimatorState<f64, FEET>>,
    sensor: InertialSensor,
    pressed: [bool; FEET],
    planned: [bool; FEET],
    /// For the next tick alone.
    feet_force: Option<Vector3<f64>>,
    ticks: u64,
    tally: EstimateTally,
}

impl Estimating {
    /// As a scene has it, for ticks `period_s` apart.
    ///
    /// # Panics
    /// For a robot without feet on legs, which the scene's check refuses.
    pub fn new(sensing: &Sensing, period_s: f64, robot: &SharedRobot) -> Self {
        let feet = Contacts::of(robot).expect("a robot with feet on legs").feet;
        let kinds = feet.map(|foot| {
            foot.map(|foot| match foot.limits.patch.moments() {
                [true, true, true] => FootKind::Sole,
                _ => FootKind::Point,
            })
        });
        let gravity = robot.tree.gravity();
        // Floors of scenes yield.
        let noise =
            SensorNoise { force_direction: FORCE_DIRECTION, ..SensorNoise::yielding_ground() };
        let settings = Estimator { noise, ..Estimator::new(period_s, gravity.norm(), kinds) };
        Self {
            settings,
            feet,
            state: None,
            sensor: InertialSensor::new(sensing, period_s, gravity),
            pressed: [false; FEET],
            planned: [true; FEET],
            feet_force: None,
            ticks: 0,
            tally: EstimateTally::default(),
            robot: robot.clone(),
        }
    }

    /// The ground's vertical forces on the feet (N), and which of them a planner has stand; both before a tick.
    pub fn see_feet(&mut self, forces: impl Iterator<Item = f64>, planned: Option<&[bool]>) {
        let least = SWITCH_SHARE * self.robot.tree.mass() * self.settings.gravity;
        for (to, force) in self.pressed.iter_mut().zip(forces) {
            *to = force > least;
        }
        for (to, is_planned) in self.planned.iter_mut().zip(planned.into_iter().flatten()) {
            *to = *is_planned;
        }
    }

    /// The force of the ground on all feet, central body's axes, N, for the next tick.
    pub fn see_feet_force(&mut self, force: Vector3<f64>) {
        self.feet_force = Some(force);
    }

    /// So far.
    pub fn tally(&self) -> &EstimateTally {
        &self.tally
    }

    /// Puts the estimate in the place of the central body's pose and twist in `seen`, whose angles and rates are the
    /// encoders'.
    ///
    /// # Errors
    /// The estimator's fault.
    pub fn read(&mut self, truth: &PlantState, seen: &mut PlantState) -> Result<(), EstimateFault> {
        let imu = self.sensor.read(truth);
        let feet = self.foot_poses(&seen.positions[7..]);
        let feet = std::array::from_fn(|foot| FootReading {
            position: feet[foot].position,
            orientation: quaternion(&feet[foot]),
            is_pressed: self.pressed[foot],
            is_planned: self.planned[foot],
        });
        let readings = Readings { imu, feet, feet_force: self.feet_force.take() };
        let mut state = match self.state {
            Some(state) => state,
            None => EstimatorState::start(&self.settings, &readings, &self.start_pose(truth))?,
        };
        let report = self.settings.step(&mut state, &readings)?;
        self.state = Some(state);
        let time_s = self.ticks as f64 * self.settings.period_s;
        self.ticks += 1;
        let anew = report.innovations.iter().flatten().filter(|found| found.is_reset).count();
        self.tally.feet_made_anew += anew as u64;
        if let Some(worst) = report.health.worst {
            self.tally.doubtful_ticks += 1;
            let what = || EstimateDoubt { time_s, what: worst.to_string() };
            self.tally.first.get_or_insert_with(what);
        }
        let estimate = report.estimate;
        seen.positions[..3].copy_from_slice(estimate.position.as_slice());
        seen.positions[3..7].copy_from_slice(&estimate.orientation.to_array());
        seen.velocities[..6].copy_from_slice(&estimate.velocity.to_array());
        Ok(())
    }

    /// Reference points and axes of the feet in the central body's frame, by joint angles.
    fn foot_poses(&self, angles: &[f64]) -> [Pose<f64>; FEET] {
        let mut positions = PlantState::home(angles.len()).positions;
        positions[7..].copy_from_slice(angles);
        self.feet_at(&positions)
    }

    /// The same in the world, of a robot at `positions`.
    fn feet_at(&self, positions: &[f64]) -> [Pose<f64>; FEET] {
        // Angles of encoders are finite.
        let poses = self.robot.tree.body_poses(positions).unwrap_or_default();
        self.feet.map(|foot| {
            let of_foot = foot.and_then(|foot| {
                let pose = poses.get(foot.body)?;
                let position = pose.transform_point(foot.reference);
                Some(Pose { rotation: pose.rotation * foot.axes.to_matrix(), position })
            });
            of_foot.unwrap_or_else(Pose::identity)
        })
    }

    /// The world's origin and axes are the scene's: a robot cannot know them, and is told once.
    fn start_pose(&self, truth: &PlantState) -> StartPose<f64> {
        let all = self.feet_at(&truth.positions);
        let standing = self.pressed.iter().zip(&self.planned).map(|(a, b)| *a && *b);
        let standing: Vec<bool> = standing.collect();
        let own =
            || self.feet.iter().zip(&all).zip(&standing).filter(|((foot, _), _)| foot.is_some());
        let is_standing = own().any(|(_, stands)| *stands);
        let chosen = own().filter(|(_, stands)| !is_standing || **stands);
        let points: Vec<Vector3<f64>> = chosen.map(|((_, pose), _)| pose.position).collect();
        let q = Quaternion::from_array(std::array::from_fn(|i| truth.positions[3 + i]));
        // q = heading ⋆ tilt, of which the tilt is the least rotation that makes the body upright.
        let up = q.conjugate().rotate(Vector3::z());
        let tilt = Quaternion { s: 1.0 + up.z, v: up.cross(&Vector3::z()) };
        let tilt = tilt.normalized().unwrap_or(Quaternion::identity());
        StartPose {
            feet: points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64,
            heading: logarithm(q.product(tilt.conjugate())).z,
        }
    }
}

fn quaternion(pose: &Pose<f64>) -> Quaternion<f64> {
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(pose.rotation);
    let q = nalgebra::UnitQuaternion::from_rotation_matrix(&rotation);
    Quaternion::from_array([q.w, q.i, q.j, q.k])
}
