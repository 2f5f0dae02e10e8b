//! One tick of the filter.

use super::covariance::{FOOT_ORIENTATION, FOOT_POSITION, PerError};
use super::health::health;
use super::measurement::{Update, logarithm};
use super::predict::{near_unit, predict};
use super::touch_down::touch_down;
use super::{
    Estimate, EstimateFault, EstimateReport, Estimator, EstimatorState, Floor, FootKind,
    Innovation, Readings, Turn,
};
use crate::Real;
use crate::spatial::{Quaternion, Twist};
use nalgebra::{Matrix3, Vector3};

/// Variances of a foot that has not settled are so many times as large.
const SETTLING: f64 = 100.0;
/// The floor is not believed to be level under a foot before it has settled for so long, s.
const LEVEL_AFTER: f64 = 0.04;
/// Share of a new sample in the specific force of (9): 25 rad/s at 500 Hz.
const SMOOTHING_RATE: f64 = 25.0;

/// A foot that is measured in this tick.
#[derive(Clone, Copy)]
struct Measured<T> {
    kind: FootKind,
    age: u16,
    innovation: Innovation<T>,
    /// `m_i`
    arm: Vector3<T>,
}

impl<T: Real, const FEET: usize> Estimator<T, FEET> {
    /// One tick: prediction by the inertial samples, then what the standing feet say of it.
    ///
    /// Bounded: the same loops at every tick, no search. See [`super`] for equations and cost.
    ///
    /// # Errors
    /// An input that is not usable; the state is then as it was. [`EstimateFault::Diverged`] where it is not finite
    /// any more.
    pub fn step(
        &self,
        state: &mut EstimatorState<T, FEET>,
        readings: &Readings<T, FEET>,
    ) -> Result<EstimateReport<T, FEET>, EstimateFault> {
        readings.check(&self.feet)?;
        state.tick = state.tick.wrapping_add(1);
        let force = self.imu.rotation * readings.imu.accelerometer;
        let rate = self.imu.rotation * readings.imu.gyroscope;
        let present = state.present(self);
        predict(self, state, &present, (force, rate));
        let rotation = state.orientation.to_matrix();
        let measured = self.feet_of(state, readings, &rotation);
        let is_indefinite = self.update(state, readings, &measured, (force, &rotation));
        if !state.is_finite() {
            return Err(EstimateFault::Diverged);
        }
        let innovations = measured.map(|foot| foot.map(|foot| foot.innovation));
        Ok(EstimateReport {
            estimate: self.estimate(state, rate),
            health: health(self, state, &innovations, is_indefinite),
            innovations,
        })
    }

    /// Which feet stand, whose turn it is, and touch-downs.
    #[inline(always)]
    fn feet_of(
        &self,
        state: &mut EstimatorState<T, FEET>,
        readings: &Readings<T, FEET>,
        rotation: &Matrix3<T>,
    ) -> [Option<Measured<T>>; FEET] {
        let mut standing = 0_u32;
        for ((foot, reading), kind) in state.feet.iter_mut().zip(&readings.feet).zip(&self.feet) {
            if kind.is_none() {
                continue;
            }
            let disagrees = reading.is_pressed != reading.is_planned;
            foot.disagreement = if disagrees { foot.disagreement.saturating_add(1) } else { 0 };
            if reading.is_pressed && reading.is_planned {
                foot.age = foot.age.saturating_add(1);
                standing += 1;
            } else {
                foot.age = 0;
                foot.is_known = false;
            }
        }
        state.airborne = if standing == 0 { state.airborne.saturating_add(1) } else { 0 };
        let turn = match self.turn {
            Turn::One => state.tick.checked_rem(standing),
            Turn::All => None,
        };
        let mut measured = [None; FEET];
        let mut count = 0;
        for number in 0..FEET {
            let (Some(foot), Some(reading), Some(Some(kind))) =
                (state.feet.get(number), readings.feet.get(number), self.feet.get(number))
            else {
                continue;
            };
            if foot.age == 0 {
                continue;
            }
            let is_its_turn = turn.is_none_or(|turn| turn == count);
            count += 1;
            if !is_its_turn {
                continue;
            }
            let s = reading.position - self.imu.position;
            let arm = rotation.tr_mul(&(foot.position - state.position));
            let mut found = Measured {
                kind: *kind,
                age: foot.age,
                innovation: Innovation {
                    position: s - arm,
                    orientation: Vector3::zeros(),
                    is_reset: false,
                },
                arm,
            };
            let is_off = foot.is_known && found.innovation.position.amax() > self.gate;
            if is_off || !foot.is_known {
                found.innovation.is_reset = is_off;
                touch_down(self, state, number, (*kind, reading, s), rotation);
                if !is_off {
                    found.innovation.position = Vector3::zeros();
                    found.arm = s;
                }
            } else if *kind == FootKind::Sole {
                // (5)
                let seen = reading.orientation.product(foot.orientation.conjugate());
                found.innovation.orientation = logarithm(seen.product(state.orientation));
            }
            if let Some(to) = measured.get_mut(number) {
                *to = Some(found);
            }
        }
        measured
    }

    /// (4), (5), (7) to (9), and what they find into the state; whether the covariance was not positive.
    #[inline(always)]
    fn update(
        &self,
        state: &mut EstimatorState<T, FEET>,
        readings: &Readings<T, FEET>,
        measured: &[Option<Measured<T>>; FEET],
        (force, rotation): (Vector3<T>, &Matrix3<T>),
    ) -> bool {
        let noise = &self.noise;
        let present = state.present(self);
        let mut update = Update {
            covariance: &mut state.covariance,
            errors: PerError::zero(),
            present,
            is_indefinite: false,
        };
        let [settled, level_from] = [self.settling_s, T::of(LEVEL_AFTER)].map(|s| self.ticks(s));
        let per_second = |deviation: T| deviation * deviation / self.period_s;
        for (number, (foot, known)) in measured.iter().zip(&state.feet).enumerate() {
            let Some(foot) = foot.filter(|foot| !foot.innovation.is_reset) else { continue };
            let factor = if foot.age >= settled { T::one() } else { T::of(SETTLING) };
            let variance = |deviation: T| deviation * deviation * factor;
            let Innovation { position, orientation, .. } = foot.innovation;
            let of_position = variance(noise.leg_position);
            update.position(number, (position, foot.arm), rotation, of_position);
            if foot.kind == FootKind::Sole {
                let of_orientation = variance(noise.leg_orientation);
                update.orientation(number, orientation, rotation, of_orientation);
                if self.floor != Floor::Unknown && foot.age >= level_from {
                    update.level(number, known.orientation, per_second(noise.level));
                }
            }
            if let Floor::LevelAt(height) = self.floor {
                let y = height - known.position.z;
                let of_height = noise.height * noise.height;
                update.foot_row((number, FOOT_POSITION, 2), y, of_height);
            }
        }
        match readings.feet_force {
            Some(feet) if feet.norm() > T::zero() => {
                let share = T::of(SMOOTHING_RATE) * self.period_s;
                state.smooth_force += (force - state.smooth_force) * share;
                let f = state.smooth_force;
                let bias = f - feet * (f.norm() / feet.norm());
                let variance = per_second(noise.force_direction);
                update.force_direction(bias, state.accelerometer_bias, variance);
            }
            _ => state.smooth_force = force,
        }
        let (errors, is_indefinite) = (update.errors, update.is_indefinite);
        inject(state, &errors);
        is_indefinite
    }

    /// From the sensor's point to the central body's centre of mass.
    #[inline(always)]
    fn estimate(&self, state: &EstimatorState<T, FEET>, rate: Vector3<T>) -> Estimate<T> {
        let orientation = state.orientation;
        let angular = rate - state.gyroscope_bias;
        let arm = self.imu.position;
        let linear = orientation.conjugate().rotate(state.velocity) - angular.cross(&arm);
        Estimate {
            position: state.position - orientation.rotate(arm),
            orientation,
            velocity: Twist { linear, angular },
        }
    }
}

/// `x ← x + δ`, of feet that are known.
#[inline(always)]
fn inject<T: Real, const FEET: usize>(
    state: &mut EstimatorState<T, FEET>,
    errors: &PerError<Vector3<T>, FEET>,
) {
    let [position, velocity, tilt, accelerometer, gyroscope] = errors.body;
    state.position += position;
    state.velocity += velocity;
    let turn = Quaternion::from_rotation_vector(tilt);
    state.orientation = near_unit(state.orientation.product(turn));
    state.accelerometer_bias += accelerometer;
    state.gyroscope_bias += gyroscope;
    for (foot, errors) in state.feet.iter_mut().zip(&errors.feet) {
        if foot.is_known {
            foot.position += errors[FOOT_POSITION];
            let turn = Quaternion::from_rotation_vector(errors[FOOT_ORIENTATION]);
            foot.orientation = near_unit(turn.product(foot.orientation));
        }
    }
}
