//! Joint maps of joints with other than one degree of freedom, and how a joint adds to `ω` and `a`.
//!
//! # Notation
//! Everything in the outboard joint frame; `ω_t = Rᵀ ω_{k.i}` the transported angular velocity.
//! - `V_r = (v_r, ω_r) = H β` relative twist (3.8)
//! - `(v̇_r, ω̇_r) = H β̇ + Ḣ β`
//! - angular velocity `ω = ω_t + ω_r` (1)
//! - velocity products `c = (2 ω_t × v_r + ω_r × v_r, ω_t × ω_r) + Ḣ β` (2), which with `H β̇` and
//!   the transported inboard acceleration make the classical acceleration of the outboard frame.

use super::joint_poses::coordinates;
use crate::Real;
use crate::model::{JointKind, Node};
use crate::spatial::Twist;

/// The joint map and rate terms of one joint.
#[derive(Clone, Copy)]
pub(super) struct JointMotion<T> {
    /// Columns of `H`; those from `degrees_of_freedom` on are zero.
    pub map: [Twist<T>; 6],
    pub degrees_of_freedom: usize,
    /// Whether `H` is the identity.
    is_free: bool,
    /// `Ḣ β`.
    pub map_rate: Twist<T>,
}

impl<T: Real> JointMotion<T> {
    /// Of any joint, in the general form (revolute and prismatic joints have shorter ways).
    #[inline]
    pub fn new<const NQ: usize>(node: &Node<T>, positions: &[T; NQ], beta: &[T; 6]) -> Self {
        let mut map = [Twist::zero(); 6];
        let mut map_rate = Twist::zero();
        let one = T::one();
        match &node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(axis) => map[0].angular[*axis as usize % 3] = one,
            JointKind::Prismatic(axis) => map[0].linear[*axis as usize % 3] = one,
            JointKind::Spherical => {
                map[0].angular.x = one;
                map[1].angular.y = one;
                map[2].angular.z = one;
            }
            JointKind::Floating => {
                map[0].linear.x = one;
                map[1].linear.y = one;
                map[2].linear.z = one;
                map[3].angular.x = one;
                map[4].angular.y = one;
                map[5].angular.z = one;
            }
            JointKind::General(joint) => {
                let motion = joint.motion(&coordinates(node, positions), beta);
                for (to, from) in map.iter_mut().zip(motion.map).take(joint.degrees_of_freedom) {
                    *to = from;
                }
                map_rate = motion.map_rate;
            }
        }
        Self {
            map,
            degrees_of_freedom: node.kind.degrees_of_freedom(),
            is_free: matches!(node.kind, JointKind::Floating),
            map_rate,
        }
    }

    /// `H x`.
    #[inline]
    pub fn relative(&self, x: &[T; 6]) -> Twist<T> {
        if self.is_free {
            return Twist::from_array(*x);
        }
        self.map.iter().zip(x).fold(Twist::zero(), |sum, (h, x)| sum + *h * *x)
    }

    /// `c` of (2).
    #[inline]
    pub fn velocity_product(&self, transported: nalgebra::Vector3<T>, beta: &[T; 6]) -> Twist<T> {
        let relative = self.relative(beta);
        let (v, w) = (relative.linear, relative.angular);
        self.map_rate
            + Twist {
                linear: (transported * T::of(2.0) + w).cross(&v),
                angular: transported.cross(&w),
            }
    }
}

/// The joint's own velocities (or accelerations, or torques), padded with zeros.
#[inline(always)]
pub(super) fn own<T: Real, const NV: usize>(node: &Node<T>, all: &[T; NV]) -> [T; 6] {
    let mut beta = [T::zero(); 6];
    let own = all.iter().skip(node.velocity_start).take(node.kind.degrees_of_freedom());
    for (b, x) in beta.iter_mut().zip(own) {
        *b = *x;
    }
    beta
}

/// The one velocity (or acceleration, or torque) of a revolute or prismatic joint.
#[inline(always)]
pub(super) fn own_one<T: Real, const NV: usize>(node: &Node<T>, all: &[T; NV]) -> T {
    all.get(node.velocity_start).copied().unwrap_or(T::zero())
}
