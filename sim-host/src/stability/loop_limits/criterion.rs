//! What "works" means.

use serde::{Deserialize, Serialize};
use surefoot::spatial::{Quaternion, orientation_error};
use surefoot_sim::record::Sample;
use surefoot_sim::scene::SetPoint;

/// A run works if it ends upright, without a failure, and stays at the set point to its end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Criterion {
    /// Simulated time, unless the scene lasts longer, s.
    pub least_duration_s: f64,
    /// For how long before its end the run must be at the set point, s.
    pub settled_for_s: f64,
    /// How near the central body must be, m.
    pub distance_m: f64,
    /// How far it may be turned.
    pub angle_deg: f64,
}

impl Default for Criterion {
    fn default() -> Self {
        Self { least_duration_s: 4.0, settled_for_s: 0.5, distance_m: 0.01, angle_deg: 1.0 }
    }
}

impl Criterion {
    /// For people.
    pub fn words(&self) -> String {
        format!(
            "the run ends upright, without failure,\n\
             and stays within {:.0} mm and {}° of the set point for the last {} s of at least {} s",
            1e3 * self.distance_m,
            self.angle_deg,
            self.settled_for_s,
            self.least_duration_s,
        )
    }

    /// Whether a run's last samples are at the set point: as the body is, not as its sensors tell.
    pub fn is_settled(&self, samples: &[Sample], set_point: &SetPoint) -> bool {
        let last = last_seconds(samples, self.settled_for_s);
        !last.is_empty() && last.iter().all(|sample| self.is_at(sample, set_point))
    }

    fn is_at(&self, sample: &Sample, set_point: &SetPoint) -> bool {
        let [x, y, z, q @ ..] = *sample.positions.first_chunk::<7>().unwrap_or(&[f64::NAN; 7]);
        let at = set_point.position_m;
        let distance = (x - at[0]).hypot(y - at[1]).hypot(z - at[2]);
        let desired = Quaternion::from_array(set_point.orientation);
        let error = orientation_error(Quaternion::from_array(q), desired);
        let angle = 2.0 * error.v.norm().atan2(error.s);
        distance <= self.distance_m && angle <= self.angle_deg.to_radians()
    }
}

/// The samples of so many seconds before the last.
pub(super) fn last_seconds(samples: &[Sample], seconds: f64) -> &[Sample] {
    let Some(end) = samples.last().map(|sample| sample.time_s) else { return &[] };
    let from = samples.partition_point(|sample| sample.time_s < end - seconds - 1e-9);
    &samples[from..]
}
