//! A start from rest.

use super::covariance::Covariance;
use super::readings::within;
use super::{
    EstimateFault, EstimateInput, Estimator, EstimatorState, FootReading, FootState, Readings,
};
use crate::Real;
use crate::spatial::Quaternion;
use nalgebra::Vector3;

/// What the filter cannot know: where the world's origin is and which way the robot faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartPose<T> {
    /// The middle of the reference points of all feet that stand, or of all feet if none does, m.
    pub feet: Vector3<T>,
    /// Rotation about the vertical after the tilt that needs the least rotation, rad.
    pub heading: T,
}

impl<T: Real> StartPose<T> {
    /// At the origin, straight ahead.
    pub fn origin() -> Self {
        Self { feet: Vector3::zeros(), heading: T::zero() }
    }
}

/// Position and heading at the start are what they are said to be, m and rad.
const START_POSITION: f64 = 1e-4;
const START_HEADING: f64 = 1e-4;
/// A robot at rest moves no faster, m/s.
const START_VELOCITY: f64 = 0.02;

/// World from body by the accelerometer: the least rotation that makes it point up, then the heading.
#[inline(always)]
pub(super) fn orientation<T: Real>(force: Vector3<T>, heading: T) -> Quaternion<T> {
    let norm = force.norm();
    let up = force / norm;
    // Half way between up and e₃: (1 + z, up × e₃), of norm √(2 (1 + z)).
    let half = Quaternion { s: T::one() + up.z, v: up.cross(&Vector3::z()) };
    // Upside down any horizontal axis does.
    let upside_down = Quaternion { s: T::zero(), v: Vector3::x() };
    let tilt =
        if half.s > T::of(1e-6) { half.normalized().unwrap_or(upside_down) } else { upside_down };
    Quaternion::from_axis_angle(Vector3::z(), heading).product(tilt)
}

/// # Errors
/// See [`EstimatorState::start`].
pub(super) fn start<T: Real, const FEET: usize>(
    settings: &Estimator<T, FEET>,
    readings: &Readings<T, FEET>,
    pose: &StartPose<T>,
) -> Result<EstimatorState<T, FEET>, EstimateFault> {
    settings.check()?;
    readings.check(&settings.feet)?;
    // Far away f32 has no millimetres.
    within(&pose.feet, 1e4, EstimateInput::StartPose)?;
    within(&Vector3::new(pose.heading, T::zero(), T::zero()), 1e2, EstimateInput::StartPose)?;
    let force = settings.imu.rotation * readings.imu.accelerometer;
    let share = force.norm() / settings.gravity;
    if !(share > T::of(0.5) && share < T::of(2.0)) {
        return Err(EstimateFault::NotAtRest);
    }
    let orientation = orientation(force, pose.heading);
    let stands = |foot: &FootReading<T>| foot.is_pressed && foot.is_planned;
    let of_robot = || readings.feet.iter().zip(&settings.feet).filter(|(_, kind)| kind.is_some());
    let is_standing = of_robot().any(|(foot, _)| stands(foot));
    let (mut sum, mut count) = (Vector3::zeros(), T::zero());
    for (foot, _) in of_robot().filter(|(foot, _)| !is_standing || stands(foot)) {
        sum += foot.position;
        count += T::one();
    }
    let middle = sum / count - settings.imu.position;
    let position = pose.feet - orientation.rotate(middle);
    let feet = readings.feet.map(|foot| FootState {
        position: position + orientation.rotate(foot.position - settings.imu.position),
        orientation: orientation.product(foot.orientation),
        age: 0,
        is_known: false,
        disagreement: 0,
    });
    let [tilt, accelerometer, gyroscope] = settings.noise.start.map(|d| d * d);
    let all = |deviation: f64| Vector3::from_element(T::of(deviation * deviation));
    let heading = T::of(START_HEADING * START_HEADING);
    Ok(EstimatorState {
        position,
        velocity: Vector3::zeros(),
        orientation,
        accelerometer_bias: Vector3::zeros(),
        gyroscope_bias: Vector3::zeros(),
        feet,
        smooth_force: force,
        tick: 0,
        airborne: 0,
        covariance: Covariance::diagonal([
            all(START_POSITION),
            all(START_VELOCITY),
            Vector3::new(tilt, tilt, heading),
            Vector3::from_element(accelerometer),
            Vector3::from_element(gyroscope),
        ]),
    })
}
