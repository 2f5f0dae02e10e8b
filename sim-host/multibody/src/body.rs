//! One rigid body: its frame at the centre of mass, along the principal axes.

use surefoot_mechanics::systems::FreeRigidBody;
use surefoot_mechanics::{DiscreteLagrangian, Momenta};

/// A body's inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// kg
    pub mass: f64,
    /// Principal inertias, kg·m².
    pub inertia: [f64; 3],
}

/// Position of the centre of mass and unit quaternion (world from body, scalar first), or their rates:
/// `X` of §5.4.1.
pub type BodyState = [f64; 7];

impl Body {
    /// Momenta of a step of the body alone under gravity: (5.5) by the midpoint rule for the position,
    /// and (2.51) for the quaternion.
    pub(super) fn momenta(&self, x: &BodyState, d: &BodyState, h: f64, gravity: f64) -> Momenta<7> {
        let (_, q) = split(x);
        let (v, q_dot) = split(d);
        let turning = FreeRigidBody { inertia: self.inertia }.derivatives(&q, &q_dot, h);
        let mut all = Momenta { begin: [0.0; 7], end: [0.0; 7], stiffness: [[0.0; 7]; 7] };
        for i in 0..3 {
            let weight = if i == 2 { 0.5 * h * self.mass * gravity } else { 0.0 };
            all.begin[i] = self.mass * v[i] + weight;
            all.end[i] = self.mass * v[i] - weight;
            all.stiffness[i][i] = self.mass;
        }
        for i in 0..4 {
            all.begin[3 + i] = turning.begin[i];
            all.end[3 + i] = turning.end[i];
            all.stiffness[3 + i][3..].copy_from_slice(&turning.stiffness[i]);
        }
        all
    }

    /// Kinetic and potential energy, J.
    pub(super) fn energy(&self, x: &BodyState, v: &BodyState, gravity: f64) -> f64 {
        let ((position, q), (velocity, q_dot)) = (split(x), split(v));
        let omega = FreeRigidBody::angular_velocity(&q, &q_dot);
        let speed_squared: f64 = velocity.iter().map(|v| v * v).sum();
        0.5 * self.mass * speed_squared
            + FreeRigidBody { inertia: self.inertia }.kinetic_energy(&omega)
            + self.mass * gravity * position[2]
    }

    /// Linear and angular momentum about the world's origin: N·s, N·m·s.
    pub fn momentum(&self, x: &BodyState, v: &BodyState) -> ([f64; 3], [f64; 3]) {
        let ((position, q), (velocity, q_dot)) = (split(x), split(v));
        let linear = velocity.map(|v| self.mass * v);
        let spin = FreeRigidBody { inertia: self.inertia }.discrete_momentum(&q, &q_dot, 0.0);
        let orbit = cross(&position, &linear);
        (linear, std::array::from_fn(|i| spin[i] + orbit[i]))
    }
}

/// Position and quaternion.
pub(super) fn split(x: &BodyState) -> ([f64; 3], [f64; 4]) {
    let [a, b, c, s, i, j, k] = *x;
    ([a, b, c], [s, i, j, k])
}

pub(super) fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
