//! The swinging foot.
//!
//! Its reference starts where the foot lifts and is planned anew at each tick, from its own position `x`,
//! velocity `v` and acceleration `a`, so that a target that moves is followed without a jump:
//!
//! ```text
//! a' = (60 (x_T − x)/T − 36 v)/T² − 9 a/T     horizontally: the quintic of least jerk to rest at x_T   (1)
//! a  = 6 (x_T − x)/T² − (4 v + 2 v_T)/T        vertically: a cubic to the apex, then one to the ground  (2)
//! ```
//! (1) is the start of Flash and Hogan's quintic (their appendix) with `v_T = a_T = 0`. From there a foot goes on
//! down at the landing speed until it feels the ground.

use super::Gait;
use super::bounded::bounded;
use super::heading::{wrapped, yaw};
use super::orientation::level;
use super::step::FOOT_LAG;
use crate::Real;
use crate::balance::{FootTask, ObservedFoot};
use nalgebra::{Vector2, Vector3};

/// Share of a swing at which the foot is highest.
const APEX_AT: f64 = 0.45;
/// In the last of a swing (1/ω) nothing is planned anew.
const LAST: f64 = 0.1;
/// Least time in which a foot turns, 1/ω.
const LEAST_TURN: f64 = 0.173;
/// Most acceleration of a reference, in the plane and vertically, in units of gravity.
const MOST_ACCELERATION: [f64; 2] = [8.0, 12.0];
/// How far below the ground a foot is looked for, in units of `z`.
const DEEPEST: f64 = 0.073;

/// Reference of a swinging foot; world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingFoot<T> {
    /// m
    pub position: Vector3<T>,
    /// m/s
    pub velocity: Vector3<T>,
    /// In the plane, m/s².
    pub acceleration: Vector2<T>,
    /// Yaw of the sole at lift-off, rad.
    pub yaw: T,
}

/// Where a foot is going.
#[derive(Clone, Copy)]
pub(super) struct Landing<T> {
    /// World, m.
    pub point: Vector2<T>,
    /// Height of the ground, m.
    pub ground: T,
    /// Yaw of the sole, rad.
    pub yaw: T,
    /// Since lift-off and until touch-down, s.
    pub elapsed: T,
    pub left: T,
}

impl<T: Real> SwingFoot<T> {
    /// At rest where the foot is.
    pub(super) fn lifted(foot: &ObservedFoot<T>) -> Self {
        Self {
            position: foot.position,
            velocity: Vector3::zeros(),
            acceleration: Vector2::zeros(),
            yaw: yaw(&foot.rotation),
        }
    }

    /// The reference `dt` seconds on, (1) and (2), and the acceleration that brings the foot to it.
    pub(super) fn advance(
        &mut self,
        gait: &Gait<T>,
        gravity: T,
        foot: &ObservedFoot<T>,
        to: &Landing<T>,
        dt: T,
    ) -> FootTask<T> {
        let time = |x: f64| T::of(x) / gait.omega;
        let last = time(LAST);
        let duration = to.elapsed + to.left;
        let [most_level, most] = MOST_ACCELERATION.map(|x| gravity * T::of(x));

        if to.left > last {
            let left = to.left;
            let way = to.point - self.position.xy();
            let (v, a) = (self.velocity.xy(), self.acceleration);
            let jerk = (way * (T::of(60.0) / left) - v * T::of(36.0)) / (left * left)
                - a * (T::of(9.0) / left);
            self.acceleration += jerk * dt;
        } else {
            self.acceleration = -self.velocity.xy() / last;
        }
        self.acceleration = self.acceleration.map(|a| bounded(a, -most_level, most_level));

        let (height, speed) = (self.position.z, self.velocity.z);
        let to_apex = duration * T::of(APEX_AT) - to.elapsed;
        let vertical = if to_apex > last {
            cubic(height, speed, to.ground + gait.apex, T::zero(), to_apex)
        } else if to.left > last {
            cubic(height, speed, to.ground, gait.landing_speed, to.left)
        } else {
            (gait.landing_speed - speed) / time(FOOT_LAG)
        };
        let acceleration =
            Vector3::new(self.acceleration.x, self.acceleration.y, bounded(vertical, -most, most));
        self.position += self.velocity * dt + acceleration * (dt * dt * T::of(0.5));
        self.velocity += acceleration * dt;
        let deepest = to.ground - gait.height * T::of(DEEPEST);
        if self.position.z < deepest {
            self.position.z = deepest;
            self.velocity.z = T::zero();
        }

        let [stiffness, damping] = gait.foot_gains;
        let turning = (duration - last).max(time(LEAST_TURN));
        let share = (to.elapsed / turning).min(T::one());
        let sole = self.yaw + wrapped(to.yaw - self.yaw) * share;
        FootTask::Swing {
            linear: acceleration
                + (self.position - foot.position) * stiffness
                + (self.velocity - foot.velocity) * damping,
            angular: level(
                &foot.rotation,
                &foot.angular_velocity,
                (sole, T::zero()),
                gait.foot_gains,
            ),
        }
    }
}

/// (2)
pub(super) fn cubic<T: Real>(x: T, v: T, to: T, speed: T, time: T) -> T {
    (to - x) * T::of(6.0) / (time * time) - (v * T::of(4.0) + speed * T::of(2.0)) / time
}
