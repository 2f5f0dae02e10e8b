//! An inertial sensor that is turned in the body against where it is taken to be, and whose gyroscope is biased.
//!
//! # Notation
//! - `q`: world from body; `r`: body from sensor, which the controller takes for the identity
//! - `b`: the gyroscope's bias, sensor's axes; `T`: time constant of the complementary filter of
//!   [`super::estimate`], whose errors obey `θ' = b − θ/T` and rest at `b T`
//!
//! `q_seen = q ⋆ r ⋆ exp(b T)`, `ω_seen = r̄ ω + b`; the body's velocity in the world is taken for right.

use crate::plant::PlantState;
use crate::scene::Sensing;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// The sensor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Askew {
    /// `r`
    turn: Quaternion<f64>,
    /// `exp(b T)`
    drifted: Quaternion<f64>,
    bias: Vector3<f64>,
}

impl Askew {
    /// `None` where it is as it is taken to be.
    pub fn new(sensing: &Sensing) -> Option<Self> {
        let bias = Vector3::from(sensing.gyroscope_bias);
        let tilt = Vector3::from(sensing.imu_tilt_deg.map(f64::to_radians));
        sensing.is_askew().then(|| Self {
            turn: Quaternion::from_rotation_vector(tilt),
            drifted: Quaternion::from_rotation_vector(bias * sensing.correction_s),
            bias,
        })
    }

    /// Makes the central body's pose and twist those that the sensor reports.
    pub fn apply(&self, seen: &mut PlantState) {
        let [s, x, y, z] = std::array::from_fn(|i| seen.positions[3 + i]);
        let q = Quaternion::from_array([s, x, y, z]);
        let seen_q = q.product(self.turn).product(self.drifted);
        let seen_q = seen_q.normalized().unwrap_or(seen_q);
        let velocity = q.rotate(Vector3::from_row_slice(&seen.velocities[..3]));
        let omega = Vector3::from_row_slice(&seen.velocities[3..6]);
        seen.positions[3..7].copy_from_slice(&seen_q.to_array());
        seen.velocities[..3].copy_from_slice(seen_q.conjugate().rotate(velocity).as_slice());
        let omega = self.turn.conjugate().rotate(omega) + self.bias;
        seen.velocities[3..6].copy_from_slice(omega.as_slice());
    }
}
