//! A foot with a contact's directions: where it is, and what its leg's joints do to hold or to move it.
//!
//! # Notation
//! Frame 1 (see the module above). `p` reference point, `R` frame 1 from sole axes, `s_k` the twist at
//! frame 1's origin per rate of joint k; `P` picks the directions that the contact has.
//! ```text
//! J_k = P Rᵀ (s_k seen from p),    J_b X = P Rᵀ (X seen from p)
//! J θ̈ + J_b X + b = a             ⇒    θ̈ = θ̈₀ + J⁺ (a − b) − J⁺ J_b X          (1)
//! ```
//! with `b` the point's acceleration for joints at their posture's accelerations `θ̈₀` and a central body
//! whose twist does not change; `a = −k v` of a pressing foot, from its velocity v.

use super::leg_inverse::{ByJoint, DIRECTIONS, leg_inverse};
use super::robot::{Leg, MOST_LEG_JOINTS};
use crate::Real;
use crate::dynamics::BodyKinematics;
use crate::spatial::{Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// A foot and its leg.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact<T> {
    /// `R`
    pub rotation: Matrix3<T>,
    /// `p`, m.
    pub position: Vector3<T>,
    /// Velocities of the leg's joints.
    pub joints: [usize; MOST_LEG_JOINTS],
    pub count: usize,
    /// `J⁺` by joint.
    inverse: ByJoint<T>,
    /// `−J⁺ J_b` of (1) by joint: what multiplies X.
    pub per_base: [Wrench<T>; MOST_LEG_JOINTS],
    /// `J` by joint.
    columns: ByJoint<T>,
    /// `a − b`
    asked: [T; DIRECTIONS],
    /// Those that the contact has.
    pub directions: [bool; DIRECTIONS],
    /// `ε²`; zero where the leg is not near a singular posture.
    pub damping: T,
}

/// `a` of (1).
#[derive(Clone, Copy, Debug)]
pub(super) enum Asked<T> {
    /// The foot comes to rest at this rate, 1/s.
    Rest(T),
    /// It moves: acceleration of its reference point (m/s²) and its angular one (rad/s²), world axes.
    Move {
        /// Of the point.
        linear: Vector3<T>,
        /// Of the foot.
        angular: Vector3<T>,
    },
}

/// What [`Contact::new`] reads.
pub(super) struct Place<'a, T> {
    /// World axes from frame 1; the world's origin is frame 1's.
    pub central: &'a Matrix3<T>,
    /// Of the foot's body.
    pub body: &'a BodyKinematics<T>,
    /// By the leg's joints, frame 1.
    pub screws: [Twist<T>; MOST_LEG_JOINTS],
}

impl<T: Real> Contact<T> {
    /// To be [set](Self::set).
    #[inline(always)]
    pub fn empty() -> Self {
        let nothing = [[T::zero(); DIRECTIONS]; MOST_LEG_JOINTS];
        Self {
            rotation: Matrix3::zeros(),
            position: Vector3::zeros(),
            joints: [0; MOST_LEG_JOINTS],
            count: 0,
            inverse: nothing,
            per_base: [Wrench::zero(); MOST_LEG_JOINTS],
            columns: nothing,
            asked: [T::zero(); DIRECTIONS],
            directions: [false; DIRECTIONS],
            damping: T::zero(),
        }
    }

    /// Of an empty one; `None` for numbers that are not finite.
    #[inline(always)]
    pub fn set(
        &mut self,
        leg: &Leg<T>,
        place: &Place<'_, T>,
        asked: &Asked<T>,
        damping: T,
    ) -> Option<()> {
        let Place { central, body, screws } = place;
        let from_body = central.tr_mul(&body.pose.rotation);
        let moments = leg.foot.limits.patch.moments();
        let [x, y, z] = moments;
        let directions = [true, true, true, x, y, z];
        let rotation = match moments {
            [true, true, true] => from_body * leg.axes,
            // The ground is level.
            [false, false, false] => central.transpose(),
            _ => edge_axes(
                central,
                &(from_body * leg.axes),
                leg.foot.limits.patch.half_x > T::zero(),
            ),
        };
        let r = leg.foot.reference;
        let position = central.tr_mul(&(body.pose.position + body.pose.rotation * r));
        // The point's velocity and acceleration in the body's axes, then in those of the sole.
        let (v, a) = (body.velocity, body.acceleration);
        let w = v.angular;
        let velocity = v.linear + w.cross(&r);
        let acceleration = a.linear + a.angular.cross(&r) + w.cross(&velocity);
        let picked = |linear: Vector3<T>, angular: Vector3<T>| {
            let (l, w) = (rotation.tr_mul(&linear), rotation.tr_mul(&angular));
            pick(&directions, [l.x, l.y, l.z, w.x, w.y, w.z])
        };
        let bias = picked(from_body * acceleration, from_body * a.angular);
        let mut asked = match asked {
            Asked::Rest(rate) => {
                picked(from_body * velocity, from_body * w).map(|creep| -creep * *rate)
            }
            Asked::Move { linear, angular } => {
                picked(central.tr_mul(linear), central.tr_mul(angular))
            }
        };
        for (asked, bias) in asked.iter_mut().zip(&bias) {
            *asked -= *bias;
        }
        let mut scaled = [[T::zero(); DIRECTIONS]; MOST_LEG_JOINTS];
        let per_reach = T::one() / leg.reach;
        for ((column, scaled), screw) in
            self.columns.iter_mut().zip(&mut scaled).zip(screws).take(leg.count)
        {
            *column = picked(screw.linear + screw.angular.cross(&position), screw.angular);
            let [x, y, z, a, b, c] = *column;
            *scaled = [x * per_reach, y * per_reach, z * per_reach, a, b, c];
        }
        let found = leg_inverse(&scaled, leg.count, &directions, damping)?;
        let rows = self.inverse.iter_mut().zip(&mut self.per_base).zip(&found.inverse);
        for ((to, per_base), row) in rows.take(leg.count) {
            let [x, y, z, a, b, c] = *row;
            *to = [x * per_reach, y * per_reach, z * per_reach, a, b, c];
            let w = Wrench::from_array(*to);
            let w = Wrench { force: rotation * w.force, torque: rotation * w.torque };
            *per_base = -w.shifted(position);
        }
        (self.rotation, self.position) = (rotation, position);
        (self.joints, self.count) = (leg.joints, leg.count);
        (self.asked, self.directions, self.damping) = (asked, directions, found.damping);
        Some(())
    }

    /// `J⁺ (a − b)` of (1) by joint.
    #[inline(always)]
    pub fn correction(&self) -> [T; MOST_LEG_JOINTS] {
        self.moving(&self.asked)
    }

    /// `J⁺ a` by joint, of an acceleration in sole axes.
    #[inline(always)]
    pub fn moving(&self, a: &[T; DIRECTIONS]) -> [T; MOST_LEG_JOINTS] {
        self.inverse.map(|row| row.iter().zip(a).fold(T::zero(), |sum, (x, a)| sum + *x * *a))
    }

    /// What a joint's acceleration is per acceleration of the foot, sole axes: a row of `J⁺`.
    #[inline(always)]
    pub fn per_foot(&self, joint: usize) -> [T; DIRECTIONS] {
        self.inverse.get(joint).copied().unwrap_or([T::zero(); DIRECTIONS])
    }

    /// `J⁺ᵀ t`, in sole axes.
    #[inline(always)]
    pub fn gathered(&self, t: &[T; MOST_LEG_JOINTS]) -> [T; DIRECTIONS] {
        let mut sum = [T::zero(); DIRECTIONS];
        for (row, t) in self.inverse.iter().zip(t) {
            for (sum, x) in sum.iter_mut().zip(row) {
                *sum += *x * *t;
            }
        }
        sum
    }

    /// The wrench (sole axes, about p) of the ground that would hold the leg against the torques `t` of
    /// its joints: `J⁺ᵀ t`, in frame 1's axes.
    #[inline(always)]
    pub fn holding(&self, torques: &[T; MOST_LEG_JOINTS]) -> Wrench<T> {
        self.in_frame(&self.gathered(torques))
    }

    /// A wrench in sole axes, in frame 1's.
    #[inline(always)]
    pub fn in_frame(&self, w: &[T; DIRECTIONS]) -> Wrench<T> {
        let w = Wrench::from_array(*w);
        Wrench { force: self.rotation * w.force, torque: self.rotation * w.torque }
    }

    /// The same about frame 1's origin.
    #[inline(always)]
    pub fn on_base(&self, w: &[T; DIRECTIONS]) -> Wrench<T> {
        self.in_frame(w).shifted(self.position)
    }

    /// A twist at frame 1's origin, seen from p, in sole axes.
    #[inline(always)]
    pub fn seen(&self, twist: &Twist<T>) -> [T; DIRECTIONS] {
        let linear = self.rotation.tr_mul(&(twist.linear + twist.angular.cross(&self.position)));
        let angular = self.rotation.tr_mul(&twist.angular);
        [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z]
    }

    /// What the foot does of itself where its leg cannot hold it: the acceleration in the contact's
    /// directions, less the one asked for, at `x` and `joints` on top of the posture's accelerations.
    /// Sole axes, m/s² and rad/s².
    pub fn given_up(&self, x: Twist<T>, joints: &[T; MOST_LEG_JOINTS]) -> Twist<T> {
        let mut sum = pick(&self.directions, self.seen(&x));
        for (sum, asked) in sum.iter_mut().zip(&self.asked) {
            *sum -= *asked;
        }
        for (column, joint) in self.columns.iter().zip(joints) {
            for (sum, x) in sum.iter_mut().zip(column) {
                *sum += *x * *joint;
            }
        }
        Twist::from_array(sum)
    }
}

/// The directions that exist.
#[inline(always)]
fn pick<T: Real>(directions: &[bool; DIRECTIONS], mut all: [T; DIRECTIONS]) -> [T; DIRECTIONS] {
    for (x, exists) in all.iter_mut().zip(directions) {
        if !exists {
            *x = T::zero();
        }
    }
    all
}

/// Axes of an edge along the sole's x (or y) on level ground: that axis as it is, and a normal that is as
/// upright as it can be; the sole's own where the edge stands on its end.
#[inline(always)]
pub(crate) fn edge_axes<T: Real>(
    central: &Matrix3<T>,
    sole: &Matrix3<T>,
    along_x: bool,
) -> Matrix3<T> {
    let up = Vector3::new(central.m31, central.m32, central.m33);
    let edge: Vector3<T> = if along_x { sole.column(0).into() } else { sole.column(1).into() };
    let across = up.cross(&edge);
    let length = across.norm();
    if !(length > T::of(0.1)) {
        return *sole;
    }
    let across = across / length;
    let normal = edge.cross(&across);
    if along_x {
        Matrix3::from_columns(&[edge, across, normal])
    } else {
        Matrix3::from_columns(&[-across, edge, normal])
    }
}
