//! What goes into a step.

use super::{EstimateFault, EstimateInput};
use crate::Real;
use crate::spatial::Quaternion;
use nalgebra::Vector3;

/// Means over the tick that ends now, sensor's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuReading<T> {
    /// Specific force (gravity up at rest), m/s².
    pub accelerometer: Vector3<T>,
    /// rad/s
    pub gyroscope: Vector3<T>,
}

/// A foot, now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootReading<T> {
    /// Its reference point in the central body's frame, from that body's centre of mass, by the encoders, m.
    pub position: Vector3<T>,
    /// Central body from sole, unit quaternion. Not read of a point.
    pub orientation: Quaternion<T>,
    /// Its switch says that it presses on the ground.
    pub is_pressed: bool,
    /// The planner does not swing it. It stands where both say so.
    pub is_planned: bool,
}

/// All that is read in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Readings<T, const FEET: usize> {
    /// Inertial sensor.
    pub imu: ImuReading<T>,
    /// Those of absent feet are not read.
    pub feet: [FootReading<T>; FEET],
    /// Force of the ground on all feet together, central body's axes, N, for (9): only while the robot rests on
    /// its feet and on nothing else. `None` where it is not known.
    pub feet_force: Option<Vector3<T>>,
}

/// Largest readings: a hundred times gravity, sixteen turns a second, a leg of 100 m, a mountain's weight.
const MOST_ACCELERATION: f64 = 1e3;
const MOST_RATE: f64 = 1e2;
const MOST_LENGTH: f64 = 1e2;
const MOST_FORCE: f64 = 1e7;

impl<T: Real, const FEET: usize> Readings<T, FEET> {
    /// # Errors
    /// The first input that is not usable.
    #[inline(always)]
    pub(super) fn check(
        &self,
        kinds: &[Option<super::FootKind>; FEET],
    ) -> Result<(), EstimateFault> {
        use EstimateInput::{Accelerometer, FeetForce, FootOrientation, FootPosition, Gyroscope};
        within(&self.imu.accelerometer, MOST_ACCELERATION, Accelerometer)?;
        within(&self.imu.gyroscope, MOST_RATE, Gyroscope)?;
        for (number, (foot, kind)) in self.feet.iter().zip(kinds).enumerate() {
            let Some(kind) = kind else { continue };
            within(&foot.position, MOST_LENGTH, FootPosition(number))?;
            let off = (foot.orientation.norm_squared() - T::one()).abs();
            // NaN compares as false.
            if *kind == super::FootKind::Sole && !(off < T::of(2e-3)) {
                return Err(EstimateFault::NotUnit(FootOrientation(number)));
            }
        }
        self.feet_force.map_or(Ok(()), |force| within(&force, MOST_FORCE, FeetForce))
    }
}

/// # Errors
/// For a component beyond `most`, or NaN.
#[inline(always)]
pub(super) fn within<T: Real>(
    v: &Vector3<T>,
    most: f64,
    input: EstimateInput,
) -> Result<(), EstimateFault> {
    let is_good = v.iter().all(|x| x.abs() <= T::of(most));
    if is_good { Ok(()) } else { Err(EstimateFault::NotUsable(input)) }
}
