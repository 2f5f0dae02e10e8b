//! When errors have gone for good.

use super::Sample;

/// Last times at which errors exceed what a run is asked for, s; `None` where they never do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    /// Position error above 1 mm.
    pub position_s: Option<f64>,
    /// Orientation error above 0.1°.
    pub orientation_s: Option<f64>,
}

impl Settling {
    /// Position error that is asked for, m.
    pub const DISTANCE: f64 = 1e-3;
    /// Orientation error that is asked for, degrees.
    pub const ANGLE_DEG: f64 = 0.1;

    /// Of a run's samples.
    pub fn of(samples: &[Sample]) -> Self {
        let last = |exceeds: fn(&Sample) -> bool| {
            samples.iter().rev().find(|sample| exceeds(sample)).map(|sample| sample.time_s)
        };
        Self {
            position_s: last(|sample| !(sample.error_distance() <= Self::DISTANCE)),
            orientation_s: last(|sample| !(sample.error_angle().to_degrees() <= Self::ANGLE_DEG)),
        }
    }
}
