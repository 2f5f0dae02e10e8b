//! Errors of a central body's pose and twist as a robot estimates them: gyroscope and accelerometer are
//! integrated, and drawn back with a time constant to what the legs' kinematics and gravity tell (a
//! complementary filter), which is taken to be exact. What a tilt does to the direction in which gravity
//! is subtracted is left out: it is part of what gravity corrects.
//!
//! # Notation
//! - `n`: density of white noise `ξ`, such that `∫ ξ dt` over `t` has the standard deviation `n √t` (a
//!   spectral density `n²` at positive and negative frequencies)
//! - `Δ`: seconds between ticks; `T`: time constant; `a = e^(−Δ/T)`
//! - `θ, v, p`: errors of orientation (rotation vector), velocity and position, world axes
//!
//! A sensor tells its mean over a tick, so that its noise is constant there, with standard deviation
//! `n/√Δ` (1), and the filter obeys
//!
//! ```text
//! θ' = ξ_g − θ/T      v' = ξ_a − v/T      p' = v − p/T                        (2)
//! ```
//!
//! which (3), with `c = T (1 − a)`, solves exactly from tick to tick:
//!
//! ```text
//! θ⁺ = a θ + c ξ_g    v⁺ = a v + c ξ_a    p⁺ = a (p + Δ v) + T (c − a Δ) ξ_a   (3)
//! ```
//!
//! Had the noise been white within ticks as well, (2) would have the stationary standard deviations
//! `σ_θ = n_g √(T/2)`, `σ_v = n_a √(T/2)`, `σ_p = n_a √(T³)/2`, and `⟨v p⟩ = n_a² T²/4` (4). The first two
//! variances of (3) are (4) times `2T/Δ tanh(Δ/2T) = 1 − Δ²/12T² + …`.
//!
//! White noise has no direction, so that the bodies' axes, in which sensors measure, and the world's make
//! no difference to (2).

use crate::plant::PlantState;
use crate::scene::Sensing;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::spatial::Quaternion;

/// The errors, from tick to tick.
#[derive(Clone, Debug)]
pub(super) struct Estimate {
    random: Pcg64Mcg,
    /// (1), rad/s and m/s².
    deviations: [f64; 2],
    /// `Δ, a, c, T (c − a Δ)` of (3).
    period_s: f64,
    decay: f64,
    into_rate: f64,
    into_position: f64,
    /// The gyroscope's noise over the last tick, world axes, rad/s.
    angular_velocity: Vector3<f64>,
    orientation: Vector3<f64>,
    velocity: Vector3<f64>,
    position: Vector3<f64>,
}

impl Estimate {
    /// A filter that has run long before the first tick: its errors are drawn from (4).
    pub(super) fn new(sensing: &Sensing, period_s: f64) -> Self {
        let &Sensing { gyroscope_noise, accelerometer_noise, correction_s: t, seed, .. } = sensing;
        let decay = (-period_s / t).exp();
        let into_rate = -t * (-period_s / t).exp_m1();
        let mut estimate = Self {
            random: Pcg64Mcg::seed_from_u64(seed),
            deviations: [gyroscope_noise, accelerometer_noise].map(|n| n / period_s.sqrt()),
            period_s,
            decay,
            into_rate,
            into_position: t * (into_rate - decay * period_s),
            angular_velocity: Vector3::zeros(),
            orientation: Vector3::zeros(),
            velocity: Vector3::zeros(),
            position: Vector3::zeros(),
        };
        let stationary = (0.5 * t).sqrt();
        for axis in 0..3 {
            let [turn, speed] = normal_pair(&mut estimate.random);
            let [way, _] = normal_pair(&mut estimate.random);
            estimate.orientation[axis] = gyroscope_noise * stationary * turn;
            estimate.velocity[axis] = accelerometer_noise * stationary * speed;
            // Given v, (4) has p at T/2 v with variance n² T³/8.
            estimate.position[axis] =
                0.5 * t * (estimate.velocity[axis] + accelerometer_noise * stationary * way);
        }
        estimate
    }

    /// (3): one tick on. Each axis draws one pair of numbers, whatever the densities.
    pub(super) fn advance(&mut self) {
        for axis in 0..3 {
            let [turning, pushing] = normal_pair(&mut self.random);
            let [gyroscope, accelerometer] =
                [self.deviations[0] * turning, self.deviations[1] * pushing];
            self.angular_velocity[axis] = gyroscope;
            self.orientation[axis] =
                self.decay * self.orientation[axis] + self.into_rate * gyroscope;
            self.position[axis] = self.decay
                * (self.position[axis] + self.period_s * self.velocity[axis])
                + self.into_position * accelerometer;
            self.velocity[axis] = self.decay * self.velocity[axis] + self.into_rate * accelerometer;
        }
    }

    /// Puts the central body of `truth` with these errors into `seen`.
    pub(super) fn apply(&self, truth: &PlantState, seen: &mut PlantState) {
        let [px, py, pz, s, x, y, z] = std::array::from_fn(|i| truth.positions[i]);
        let [vx, vy, vz, wx, wy, wz] = std::array::from_fn(|i| truth.velocities[i]);
        let q = Quaternion::from_array([s, x, y, z]);
        let turned = Quaternion::from_rotation_vector(self.orientation).product(q);
        let turned = turned.normalized().unwrap_or(turned);
        // The estimate of a velocity in the world is told in axes that are estimated too.
        let velocity = q.rotate(Vector3::new(vx, vy, vz)) + self.velocity;
        let noise = q.conjugate().rotate(self.angular_velocity);
        let position = Vector3::new(px, py, pz) + self.position;
        seen.positions[..3].copy_from_slice(position.as_slice());
        seen.positions[3..7].copy_from_slice(&turned.to_array());
        seen.velocities[..3].copy_from_slice(turned.conjugate().rotate(velocity).as_slice());
        seen.velocities[3..6].copy_from_slice((Vector3::new(wx, wy, wz) + noise).as_slice());
    }
}

/// Two independent standard normal numbers, by Marsaglia's polar method: its one transcendental function is
/// libm's, so that a seed gives the same noise on every machine.
pub(super) fn normal_pair(random: &mut Pcg64Mcg) -> [f64; 2] {
    loop {
        let [x, y]: [f64; 2] = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        let square = x * x + y * y;
        // A disk's point is outside with probability 0.21, and at the centre hardly ever.
        if square > 0.0 && square < 1.0 {
            let size = (-2.0 * libm::log(square) / square).sqrt();
            return [x * size, y * size];
        }
    }
}
