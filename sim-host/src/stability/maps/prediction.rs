//! What the loop would do on rigid ground that always holds: the forecast of the loop's maps.
//!
//! # Notation
//! With feet that stay, the controller's torques make the central body follow, axis by axis, the double
//! integrator `ẍ = u`. `u = −Kp x(t_k) − Kv ẋ(t_k)` holds from `t_k + τ` to `t_{k+1} + τ`, with `t_k = k T`.
//! Between switches the motion is a parabola, so that the loop can be followed exactly.

use crate::scene::Scene;
use crate::stability::loop_limits::Criterion;
use nalgebra::Vector3;
use surefoot::spatial::{Quaternion, orientation_error};

/// Gains and first errors of the six axes: position, then orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// `Kp`, 1/s².
    pub position_gain: [f64; 6],
    /// `Kv`, 1/s.
    pub velocity_gain: [f64; 6],
    /// m and rad.
    pub error: [f64; 6],
}

impl Axes {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        let settings = &scene.controller;
        let both = |a: [f64; 3], b: [f64; 3]| [a[0], a[1], a[2], b[0], b[1], b[2]];
        let start = scene.initial.state();
        let [x, y, z, q @ ..] = *start.positions.first_chunk::<7>().unwrap_or(&[0.0; 7]);
        let at = Vector3::from(scene.set_point.position_m);
        let apart = Vector3::new(x, y, z) - at;
        let desired = Quaternion::from_array(scene.set_point.orientation);
        let turn = orientation_error(Quaternion::from_array(q), desired);
        Self {
            position_gain: both(settings.position_gain, settings.orientation_gain),
            velocity_gain: both(settings.velocity_gain, settings.angular_velocity_gain),
            // The controller's orientation error is twice the quaternion's vector part.
            error: both(apart.into(), (turn.v * 2.0).into()),
        }
    }

    /// Times a scale, damping ratios kept.
    #[must_use]
    pub fn scaled(mut self, scale: f64) -> Self {
        self.position_gain.iter_mut().for_each(|k| *k *= scale);
        self.velocity_gain.iter_mut().for_each(|k| *k *= scale.sqrt());
        self
    }
}

/// Whether all axes meet a criterion with a control period and a delay, s.
pub fn settles(axes: &Axes, period_s: f64, delay_s: f64, criterion: &Criterion) -> bool {
    (0..6).all(|axis| {
        let near = if axis < 3 { criterion.distance_m } else { criterion.angle_deg.to_radians() };
        let gains = [axes.position_gain[axis], axes.velocity_gain[axis]];
        axis_settles(gains, axes.error[axis], near, [period_s, delay_s], criterion)
    })
}

fn axis_settles(
    [kp, kv]: [f64; 2],
    error: f64,
    near: f64,
    [period_s, delay_s]: [f64; 2],
    criterion: &Criterion,
) -> bool {
    let ticks = (criterion.least_duration_s / period_s).ceil() as usize;
    // A command comes into force so many whole periods after its tick, and a rest.
    let whole = (delay_s / period_s + 1e-9).floor();
    let rest_s = (delay_s - whole * period_s).max(0.0);
    let mut commands = vec![0.0; whole as usize + 2];
    let oldest = commands.len() - 1;
    let (mut x, mut v) = (error, 0.0);
    let settled_from = criterion.least_duration_s - criterion.settled_for_s;
    for tick in 0..=ticks {
        if !(f64::abs(x) < 1e6) || (tick as f64 * period_s >= settled_from && f64::abs(x) > near) {
            return false;
        }
        commands.rotate_right(1);
        commands[0] = -kp * x - kv * v;
        for (command, time_s) in [(oldest, rest_s), (oldest - 1, period_s - rest_s)] {
            let u: f64 = commands[command];
            x += v * time_s + 0.5 * u * time_s * time_s;
            v += u * time_s;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXIS: Axes =
        Axes { position_gain: [200.0; 6], velocity_gain: [14.142; 6], error: [0.065; 6] };

    /// The continuous loop's delay margin: `ω_c² = Kv²/2 + √(Kv⁴/4 + Kp²)`, phase `atan(Kv ω_c/Kp)`; a
    /// sampled loop has half a period less.
    #[test]
    fn the_delay_margin_is_that_of_the_loop() {
        let (kp, kv) = (200.0_f64, 14.142_f64);
        let crossing = (0.5 * kv * kv + (0.25 * kv.powi(4) + kp * kp).sqrt()).sqrt();
        let margin = (kv * crossing / kp).atan() / crossing;
        // A criterion that is met by whatever decays.
        let criterion =
            Criterion { least_duration_s: 60.0, distance_m: 0.065, ..Criterion::default() };
        let criterion = Criterion { angle_deg: 0.065_f64.to_degrees(), ..criterion };
        let period_s = 2e-3;
        let works = |delay_s: f64| settles(&AXIS, period_s, delay_s, &criterion);
        let expected = margin - 0.5 * period_s;
        assert!(works(0.98 * expected) && !works(1.02 * expected), "{expected}");
    }

    /// Without a delay or a period to speak of the loop settles, and with negative gains it does not.
    #[test]
    fn fast_loops_settle() {
        let criterion = Criterion::default();
        assert!(settles(&AXIS, 1e-3, 0.0, &criterion));
        let wrong = Axes { position_gain: [-200.0; 6], ..AXIS };
        assert!(!settles(&wrong, 1e-3, 0.0, &criterion));
    }
}
