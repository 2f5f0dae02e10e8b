//! Joint coordinates and their rates, from the bodies' states: what every engine tells, whatever its own coordinates.
//!
//! # Notation
//! `q_o, q_i` orientations of the outboard and inboard body, `h` the joint's home, `a` its axis in the outboard body
//! ```text
//! revolute:  exp(θ a/2) = h̄ ⋆ q̄_i ⋆ q_o
//! universal: exp(α u/2) ⋆ exp(β w/2) = q̄_i ⋆ q_o ⋆ h̄,   u = a_i, w = R(h) a_o, both in the inboard body
//! ```

use nalgebra::Vector3;
use std::f64::consts::TAU;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{BodyState, Joint, JointConstraint};

/// A body at an instant: world axes.
#[derive(Clone, Copy)]
pub(super) struct BodyMotion {
    pub center: Vector3<f64>,
    pub orientation: Quaternion<f64>,
    pub velocity: Vector3<f64>,
    pub omega: Vector3<f64>,
}

impl BodyMotion {
    /// The world, as a joint's inboard body.
    pub const WORLD: Self = Self {
        center: Vector3::new(0.0, 0.0, 0.0),
        orientation: Quaternion { s: 1.0, v: Vector3::new(0.0, 0.0, 0.0) },
        velocity: Vector3::new(0.0, 0.0, 0.0),
        omega: Vector3::new(0.0, 0.0, 0.0),
    };

    /// From a state and its rate: `ω = 2 q̇ ⋆ q̄`.
    pub fn of(x: &BodyState, v: &BodyState) -> Self {
        let orientation = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let rate = Quaternion::from_array([v[3], v[4], v[5], v[6]]);
        Self {
            center: Vector3::new(x[0], x[1], x[2]),
            orientation,
            velocity: Vector3::new(v[0], v[1], v[2]),
            omega: rate.product(orientation.conjugate()).v * 2.0,
        }
    }

    /// Angular velocity in the body's axes, rad/s.
    pub fn omega_in_body(&self) -> Vector3<f64> {
        self.orientation.conjugate().rotate(self.omega)
    }

    fn point(&self, at: &[f64; 3]) -> (Vector3<f64>, Vector3<f64>) {
        let arm = self.orientation.rotate((*at).into());
        (self.center + arm, self.velocity + self.omega.cross(&arm))
    }
}

/// Where a joint is, and how it moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointMotion {
    /// Angles (rad) of a revolute or universal joint, the displacement (m) of a prismatic one, or the unit quaternion,
    /// scalar first, of a spherical one: outboard body against its home, inboard axes.
    pub positions: Vec<f64>,
    /// rad/s or m/s; of a spherical joint the angular velocity against the inboard body, in that one's axes.
    pub rates: Vec<f64>,
}

/// Of a joint between two bodies. Angles lie within half a turn.
pub(super) fn joint_motion(joint: &Joint, on: &BodyMotion, body: &BodyMotion) -> JointMotion {
    let home = Quaternion::from_array(joint.home);
    let back = on.orientation.conjugate();
    let relative = back.product(body.orientation);
    let omega = back.rotate(body.omega - on.omega);
    let (positions, rates) = match joint.constraint {
        JointConstraint::Floating | JointConstraint::Fixed => (Vec::new(), Vec::new()),
        JointConstraint::Revolute { axis } => {
            let a = Vector3::from(axis);
            let turn = home.conjugate().product(relative);
            let in_body = body.orientation.conjugate().rotate(body.omega - on.omega);
            (vec![within_half(2.0 * turn.v.dot(&a).atan2(turn.s))], vec![in_body.dot(&a)])
        }
        JointConstraint::Prismatic { axis } => {
            let along = on.orientation.rotate(axis.into());
            let ((p, v), (p_i, v_i)) = (body.point(&joint.outboard), on.point(&joint.inboard));
            // The axis turns with the inboard body, and what lies along it has no part in that.
            (vec![along.dot(&(p - p_i))], vec![along.dot(&(v - v_i))])
        }
        JointConstraint::Universal { inboard_axis, outboard_axis } => {
            let (u, w) = (Vector3::from(inboard_axis), home.rotate(outboard_axis.into()));
            let turn = relative.product(home.conjugate());
            let (moved, seen) = (turn.rotate(w), turn.conjugate().rotate(u));
            let first = u.cross(&w).dot(&moved).atan2(w.dot(&moved));
            let second = -w.cross(&u).dot(&seen).atan2(u.dot(&seen));
            (vec![first, second], vec![omega.dot(&u), omega.dot(&moved)])
        }
        JointConstraint::Spherical => {
            let turn = relative.product(home.conjugate());
            (turn.to_array().to_vec(), omega.as_slice().to_vec())
        }
    };
    JointMotion { positions, rates }
}

/// An angle within half a turn.
fn within_half(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Adds whole turns to an angle, so that it goes on from an earlier one, with the rates of both.
pub(super) fn carried_on(angle: f64, (before, rate_before): (f64, f64), rate: f64, dt: f64) -> f64 {
    let expected = before + 0.5 * dt * (rate_before + rate);
    let turns = ((expected - angle) / TAU).round();
    if turns.is_finite() { angle + TAU * turns } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(orientation: Quaternion<f64>, omega: Vector3<f64>) -> BodyMotion {
        BodyMotion { orientation, omega, ..BodyMotion::WORLD }
    }

    /// A universal joint is put together from its angles and rates, which come back; so does a revolute one's.
    #[test]
    fn angles_and_rates_come_back() {
        let (u, w) = (Vector3::x(), Vector3::y());
        let home = Quaternion::from_axis_angle(Vector3::new(0.6, 0.0, 0.8), 0.7);
        let on = at(Quaternion::from_axis_angle(Vector3::z(), 0.4), Vector3::new(0.3, -0.2, 0.5));
        for (alpha, beta) in [(0.5, -0.8), (-2.8, 1.2), (1.0, 3.0)] {
            let (alpha_rate, beta_rate) = (1.5, -2.5);
            let turn =
                Quaternion::from_axis_angle(u, alpha).product(Quaternion::from_axis_angle(w, beta));
            let orientation = on.orientation.product(turn.product(home));
            let second = Quaternion::from_axis_angle(u, alpha).rotate(w);
            let relative = u * alpha_rate + second * beta_rate;
            let body = at(orientation, on.omega + on.orientation.rotate(relative));
            let outboard_axis = home.conjugate().rotate(w).into();
            let joint = Joint {
                outboard: [0.0; 3],
                inboard: [0.0; 3],
                home: home.to_array(),
                constraint: JointConstraint::Universal { inboard_axis: u.into(), outboard_axis },
            };
            let found = joint_motion(&joint, &on, &body);
            let expected = [alpha, beta, alpha_rate, beta_rate];
            for (ours, expected) in found.positions.iter().chain(&found.rates).zip(expected) {
                assert!((ours - expected).abs() < 1e-14, "{found:?} against {expected}");
            }
            // About its second axis alone it is a revolute one.
            let orientation =
                on.orientation.product(home.product(Quaternion::from_axis_angle(w, beta)));
            let spin = on.omega + orientation.rotate(w) * beta_rate;
            let joint = Joint { constraint: JointConstraint::Revolute { axis: w.into() }, ..joint };
            let found = joint_motion(&joint, &on, &at(orientation, spin));
            assert!((found.positions[0] - beta).abs() < 1e-14, "{found:?}");
            assert!((found.rates[0] - beta_rate).abs() < 1e-14, "{found:?}");
        }
    }

    #[test]
    fn turns_are_counted_on() {
        let rate = 7.0;
        let (mut angle, mut last) = (0.0, 0.0);
        for k in 1..=1000 {
            let true_angle = 0.01 * rate * f64::from(k);
            last = carried_on(within_half(true_angle), (angle, rate), rate, 0.01);
            angle = last;
        }
        assert!((last - 70.0).abs() < 1e-12, "{last}");
    }
}
