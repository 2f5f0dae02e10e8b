//! What a robot that walks makes of the wrench that its observer reads.
//!
//! # Notation
//! World axes, about the central body's centre of mass `r`. `W, M` force and moment from outside; `m g` the model's
//! weight, `c` its centre of mass.
//! ```text
//! d = ((M_y + W_z o_x), (−M_x + W_z o_y))/(m g − W_z),   o = c − r                                 (1)
//! ```
//! (1) is how far the centre of mass of robot and load together is from the model's, as in core's balance point. Swings
//! and landings read as 20 to 35 N of push, which is none: while it walks a robot goes on with the moment that it read
//! standing, turned with it, and follows the vertical force alone.

use nalgebra::{Vector2, Vector3};
use surefoot::Real;
use surefoot::spatial::Wrench;

/// `|d|` is at most this share of the height.
const FARTHEST: f64 = 0.08;

/// What is carried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carrying<T> {
    /// The model's weight, N, and how high its centre of mass is, m.
    weight: T,
    height: T,
    /// About the vertical axis of the robot's heading when it was read: M_x, M_y.
    moment: Vector2<T>,
    /// `W_z`, N.
    vertical: T,
}

impl<T: Real> Carrying<T> {
    /// Nothing yet.
    pub fn new(weight: T, height: T) -> Self {
        Self { weight, height, moment: Vector2::zeros(), vertical: T::zero() }
    }

    /// What the observer reads at a tick of a robot with this heading (rad) that stands, or walks.
    pub fn read(&mut self, wrench: &Wrench<T>, heading: T, stands: bool) {
        self.vertical = wrench.force.z;
        if stands {
            self.moment = turned(wrench.torque.xy(), -heading);
        }
    }

    /// The wrench that the feet are to carry.
    pub fn wrench(&self, heading: T) -> Wrench<T> {
        let [x, y] = turned(self.moment, heading).into();
        Wrench {
            force: Vector3::new(T::zero(), T::zero(), self.vertical),
            torque: Vector3::new(x, y, T::zero()),
        }
    }

    /// (1), within its bound, for `o` (m).
    pub fn offset(&self, o: Vector2<T>, heading: T) -> Vector2<T> {
        let m = turned(self.moment, heading);
        // Nothing stands that is lifted by more than nine tenths of its weight.
        let carried = (self.weight - self.vertical).max(self.weight * T::of(0.1));
        let d = (Vector2::new(m.y, -m.x) + o * self.vertical) / carried;
        let most = self.height * T::of(FARTHEST);
        d.map(|x| x.max(-most).min(most))
    }
}

/// `v` turned by an angle, rad.
fn turned<T: Real>(v: Vector2<T>, angle: T) -> Vector2<T> {
    let (sine, cosine) = (angle.sin(), angle.cos());
    Vector2::new(v.x * cosine - v.y * sine, v.x * sine + v.y * cosine)
}
