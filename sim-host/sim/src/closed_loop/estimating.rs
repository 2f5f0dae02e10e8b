//! The state estimator in the loop: what it is fed, and what it makes of the state that controllers see.

use super::filter::{Filter, FilterPlace, Filtered, SensorReadings};
use super::inertial::{InertialSensor, logarithm};
use super::whole_body_settings::FEET;
use crate::plant::PlantState;
use crate::robot::{Contacts, SharedRobot};
use crate::scene::Sensing;
use nalgebra::Vector3;
use serde::Serialize;
use surefoot::balance::WholeBodyFoot;
use surefoot::estimate::{Concern, EstimateFault, EstimateWatch, Health, StartPose};
use surefoot::spatial::{Pose, Quaternion};

/// A foot's switch closes at this share of the robot's weight: 20 N of a person's.
const SWITCH_SHARE: f64 = 0.03;

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
    /// None where it runs on a target.
    filter: Option<Filter>,
    sensor: InertialSensor,
    pressed: [bool; FEET],
    planned: [bool; FEET],
    /// For the next tick alone.
    feet_force: Option<Vector3<f64>>,
    /// Of the last tick, for a target, and where the robot was at the first.
    readings: Option<(SensorReadings, StartPose<f64>)>,
    period_s: f64,
    ticks: u64,
    tally: EstimateTally,
    watch: EstimateWatch<f64>,
    walks: bool,
    /// What it is not believed any more for.
    distrusted: Option<Concern>,
}

impl Estimating {
    /// As a scene has it, for ticks `period_s` apart.
    ///
    /// # Panics
    /// For a robot without feet on legs, which the scene's check refuses.
    pub fn new(
        sensing: &Sensing,
        period_s: f64,
        robot: &SharedRobot,
        (place, walks): (FilterPlace, bool),
    ) -> Self {
        let feet = Contacts::of(robot).expect("a robot with feet on legs").feet;
        let filter = match place {
            FilterPlace::Host(scalar) => Some(Filter::new(robot, period_s, scalar, walks)),
            FilterPlace::Target => None,
        };
        Self {
            filter,
            feet,
            sensor: InertialSensor::new(sensing, period_s, robot.tree.gravity()),
            pressed: [false; FEET],
            planned: [true; FEET],
            feet_force: None,
            readings: None,
            period_s,
            ticks: 0,
            tally: EstimateTally::default(),
            watch: EstimateWatch::new(),
            walks,
            distrusted: None,
            robot: robot.clone(),
        }
    }

    /// The ground's vertical forces on the feet (N), and which of them a planner has stand; both before a tick.
    ///
    /// # Returns
    /// What the switches say, as forces: the robot's weight of a foot that presses.
    pub fn see_feet(
        &mut self,
        forces: impl Iterator<Item = f64>,
        planned: Option<[bool; FEET]>,
    ) -> Vec<f64> {
        let weight = self.robot.tree.mass() * self.robot.tree.gravity().norm();
        let own = self.pressed.iter_mut().zip(forces);
        let switched = own.map(|(to, force)| {
            *to = force > SWITCH_SHARE * weight;
            if *to { weight } else { 0.0 }
        });
        let switched = switched.collect();
        self.planned = planned.unwrap_or([true; FEET]);
        switched
    }

    /// The force of the ground on all feet, central body's axes, N, for the next tick.
    pub fn see_feet_force(&mut self, force: Vector3<f64>) {
        self.feet_force = Some(force);
    }

    /// So far.
    pub fn tally(&self) -> &EstimateTally {
        &self.tally
    }

    /// What it is not to be believed any more for.
    pub fn distrusted(&self) -> Option<Concern> {
        self.distrusted
    }

    /// What sensors have read at the last tick, and where the robot was at the first, for a filter on a target.
    pub fn readings(&self) -> Option<&(SensorReadings, StartPose<f64>)> {
        self.readings.as_ref()
    }

    /// Puts the estimate in the place of the central body's pose and twist in `seen`, whose angles and rates are the
    /// encoders'; of a filter on a target, what is not known.
    ///
    /// # Errors
    /// The estimator's fault.
    pub fn read(&mut self, truth: &PlantState, seen: &mut PlantState) -> Result<(), EstimateFault> {
        let readings = SensorReadings {
            imu: self.sensor.read(truth),
            pressed: self.pressed,
            planned: self.planned,
            feet_force: self.feet_force.take(),
        };
        let Some(mut filter) = self.filter.take() else {
            let start = self.readings.map_or_else(|| self.start_pose(truth), |(_, start)| start);
            self.readings = Some((readings, start));
            let nowhere = PlantState::home(seen.joints());
            seen.positions[..7].copy_from_slice(&nowhere.positions[..7]);
            seen.velocities[..6].copy_from_slice(&nowhere.velocities[..6]);
            return Ok(());
        };
        let filtered = filter.step(&readings, &seen.positions[7..], || self.start_pose(truth));
        self.filter = Some(filter);
        self.note(&filtered?, seen);
        Ok(())
    }

    /// What a filter has made of a tick's readings.
    pub fn note(&mut self, filtered: &Filtered, seen: &mut PlantState) {
        let time_s = self.ticks as f64 * self.period_s;
        self.ticks += 1;
        self.tally.feet_made_anew += filtered.made_anew;
        let health = Health { worst: filtered.worst, count: u8::from(filtered.worst.is_some()) };
        // Of a robot that stands doubts are counted alone: a strike, and a push that lifts a foot, raise some too.
        let distrusted = if self.walks { self.watch.after(&health, self.period_s) } else { None };
        self.distrusted = self.distrusted.or(distrusted);
        if let Some(worst) = filtered.worst {
            self.tally.doubtful_ticks += 1;
            let what = || EstimateDoubt { time_s, what: worst.to_string() };
            self.tally.first.get_or_insert_with(what);
        }
        seen.positions[..7].copy_from_slice(&filtered.central[..7]);
        seen.velocities[..6].copy_from_slice(&filtered.central[7..]);
    }

    /// Reference points and axes of the feet in the world, of a robot at `positions`.
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
