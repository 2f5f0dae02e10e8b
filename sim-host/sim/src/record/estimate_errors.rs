//! How far an estimate is from the truth that the simulator knows.

use super::Sample;
use nalgebra::Vector3;
use serde::Serialize;
use surefoot::spatial::Quaternion;

/// Sizes of an estimate's errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct EstimateErrors {
    /// m
    pub position_error_m: f64,
    /// Of the velocity in the world, m/s.
    pub velocity_error_m_s: f64,
    /// Between the two verticals, rad.
    pub tilt_error_rad: f64,
    /// Of the rotation about the vertical, rad.
    pub heading_error_rad: f64,
}

/// The same over a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WorstErrors {
    /// At the last sample.
    #[serde(rename = "final")]
    pub last: EstimateErrors,
    /// The largest of each over all samples.
    pub worst: EstimateErrors,
}

impl EstimateErrors {
    /// Of a sample; `None` where nothing was estimated.
    pub fn of(sample: &Sample) -> Option<Self> {
        let [x, y, z, s, i, j, k, u, v, w, ..] = sample.estimate?;
        let unit = |q: [f64; 4]| {
            let q = Quaternion::from_array(q);
            q.normalized().unwrap_or(q)
        };
        let estimated = unit([s, i, j, k]);
        let truth = unit(std::array::from_fn(|i| sample.positions[3 + i]));
        let velocity = truth.rotate(Vector3::from_row_slice(&sample.velocities[..3]));
        let position = Vector3::from_row_slice(&sample.positions[..3]);
        let error = estimated.product(truth.conjugate());
        let up = error.rotate(Vector3::z());
        Some(Self {
            position_error_m: (Vector3::new(x, y, z) - position).norm(),
            velocity_error_m_s: (estimated.rotate(Vector3::new(u, v, w)) - velocity).norm(),
            tilt_error_rad: libm::atan2(up.xy().norm(), up.z),
            heading_error_rad: 2.0 * libm::atan2(error.v.z.abs(), error.s.abs()),
        })
    }

    fn larger(self, other: Self) -> Self {
        Self {
            position_error_m: self.position_error_m.max(other.position_error_m),
            velocity_error_m_s: self.velocity_error_m_s.max(other.velocity_error_m_s),
            tilt_error_rad: self.tilt_error_rad.max(other.tilt_error_rad),
            heading_error_rad: self.heading_error_rad.max(other.heading_error_rad),
        }
    }
}

impl WorstErrors {
    /// Of all samples; `None` where nothing was estimated.
    pub fn of(samples: &[Sample]) -> Option<Self> {
        let errors = samples.iter().filter_map(EstimateErrors::of);
        errors.fold(None, |all: Option<Self>, last| {
            let worst = all.map_or(last, |all| all.worst.larger(last));
            Some(Self { last, worst })
        })
    }
}
