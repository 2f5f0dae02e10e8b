//! An inertial sensor at the central body's centre of mass, that integrates over a tick.
//!
//! # Notation
//! - `q, v`: orientation and velocity (world) of the central body at a tick; `q₀, v₀`: at the one before
//! - `h`: seconds a tick; `g`: gravity; `r`: body from sensor
//! - `b`: biases, sensor's axes; `n ξ/√h`: noise of a sample, of density `n`
//!
//! ```text
//! gyro = r̄ log(q̄₀ ⋆ q)/h + b_w + noise      acc = r̄ q̄_½ ((v − v₀)/h − g) + b_f + noise
//! ```
//! with `q_½` half way between: a mean over the tick to second order in `h`. Readings end at what a sensor of ±16 g
//! and ±2000°/s can tell.

use super::estimate::normal_pair;
use crate::plant::PlantState;
use crate::scene::Sensing;
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use surefoot::estimate::ImuReading;
use surefoot::spatial::Quaternion;

/// Ranges: m/s², rad/s.
const MOST_ACCELERATION: f64 = 157.0;
const MOST_RATE: f64 = 34.9;

/// The sensor.
#[derive(Clone, Debug)]
pub(super) struct InertialSensor {
    random: Pcg64Mcg,
    /// `r`
    turn: Quaternion<f64>,
    /// `b_w, b_f`
    biases: [Vector3<f64>; 2],
    /// `n/√h` of gyroscope and accelerometer.
    deviations: [f64; 2],
    gravity: Vector3<f64>,
    period_s: f64,
    /// `q₀, v₀`; none before the first tick, up to which the robot is taken to have been at rest.
    before: Option<(Quaternion<f64>, Vector3<f64>)>,
}

impl InertialSensor {
    /// As a scene has it.
    pub fn new(sensing: &Sensing, period_s: f64, gravity: Vector3<f64>) -> Self {
        let tilt = Vector3::from(sensing.imu_tilt_deg.map(f64::to_radians));
        Self {
            random: Pcg64Mcg::seed_from_u64(sensing.seed),
            turn: Quaternion::from_rotation_vector(tilt),
            biases: [sensing.gyroscope_bias, sensing.accelerometer_bias].map(Vector3::from),
            deviations: [sensing.gyroscope_noise, sensing.accelerometer_noise]
                .map(|n| n / period_s.sqrt()),
            gravity,
            period_s,
            before: None,
        }
    }

    /// What it reads at the next tick.
    pub fn read(&mut self, truth: &PlantState) -> ImuReading<f64> {
        let (q, v) = pose_and_velocity(truth);
        let (q0, v0) = self.before.replace((q, v)).unwrap_or((q, v));
        let turned = q0.conjugate().product(q);
        let half = Quaternion { s: turned.s + 1.0, v: turned.v };
        let middle = q0.product(half.normalized().unwrap_or(Quaternion::identity()));
        let force = (v - v0) / self.period_s - self.gravity;
        let rate = logarithm(turned) / self.period_s;
        let back = self.turn.conjugate();
        let [b_w, b_f] = self.biases;
        let gyroscope = back.rotate(rate) + b_w;
        let accelerometer = back.rotate(middle.conjugate().rotate(force)) + b_f;
        let mut noise = [Vector3::zeros(); 2];
        for axis in 0..3 {
            let pair = normal_pair(&mut self.random);
            for (noise, (size, deviation)) in noise.iter_mut().zip(pair.iter().zip(self.deviations))
            {
                noise[axis] = size * deviation;
            }
        }
        let within = |v: Vector3<f64>, most: f64| v.map(|x| x.clamp(-most, most));
        ImuReading {
            accelerometer: within(accelerometer + noise[1], MOST_ACCELERATION),
            gyroscope: within(gyroscope + noise[0], MOST_RATE),
        }
    }
}

/// Of the central body: world from body, and its velocity in the world.
fn pose_and_velocity(state: &PlantState) -> (Quaternion<f64>, Vector3<f64>) {
    let q = Quaternion::from_array(std::array::from_fn(|i| state.positions[3 + i]));
    let q = q.normalized().unwrap_or(q);
    (q, q.rotate(Vector3::from_row_slice(&state.velocities[..3])))
}

/// The rotation vector of a unit quaternion.
pub(super) fn logarithm(q: Quaternion<f64>) -> Vector3<f64> {
    let sine = q.v.norm();
    let half = libm::atan2(sine, q.s.abs()).copysign(q.s);
    if sine < 1e-12 { q.v * 2.0 } else { q.v * (2.0 * half / sine) }
}
