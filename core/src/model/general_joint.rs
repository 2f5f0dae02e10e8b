//! Joints that a user defines by their kinematics (§3.2.2, general joints).

use crate::Real;
use crate::spatial::{Pose, Twist};

/// What a general joint says about one state (θ, β) of itself.
#[derive(Clone, Copy, Debug)]
pub struct GeneralMotion<T> {
    /// `g_{k.i,k.o}(θ)`, of the outboard joint frame in the inboard one; the identity where the
    /// robot is in its home configuration.
    pub pose: Pose<T>,
    /// Columns of the joint map `H(θ)` (3.8), in the outboard joint frame; those from the joint's
    /// number of degrees of freedom on are not read.
    pub map: [Twist<T>; 6],
    /// `Ḣ(θ, β) β`, in the outboard joint frame.
    pub map_rate: Twist<T>,
    /// `dθ/dt = B(θ) β` (3.6); entries from the joint's number of coordinates on are not read.
    pub position_rates: [T; 7],
}

/// Kinematics in one precision: coordinates `θ` and velocities `β`, padded with zeros, to motion.
type Kinematics<T> = fn(positions: &[T; 7], velocities: &[T; 6]) -> GeneralMotion<T>;

/// A joint defined by a function. The two joint frames lie at the joint's home point, with the axes
/// in which the tree was described; they coincide in the home configuration.
#[derive(Clone, Copy, Debug)]
pub struct GeneralJoint {
    /// Number of velocity variables `d`, 1 to 6.
    pub degrees_of_freedom: usize,
    /// Number of configuration variables `e`, `d` to 7.
    pub coordinates: usize,
    /// The kinematics in single precision.
    pub motion_f32: Kinematics<f32>,
    /// The kinematics in double precision.
    pub motion_f64: Kinematics<f64>,
}

impl GeneralJoint {
    /// A joint with `d` velocity and `e` configuration variables. Write the kinematics once, generic
    /// in [`Real`], and pass both instances.
    pub const fn new(
        degrees_of_freedom: usize,
        coordinates: usize,
        motion_f32: Kinematics<f32>,
        motion_f64: Kinematics<f64>,
    ) -> Self {
        assert!(
            1 <= degrees_of_freedom && degrees_of_freedom <= 6,
            "a general joint has 1 to 6 degrees of freedom"
        );
        assert!(
            degrees_of_freedom <= coordinates && coordinates <= 7,
            "a general joint has at least as many coordinates as degrees of freedom, at most 7"
        );
        Self { degrees_of_freedom, coordinates, motion_f32, motion_f64 }
    }

    /// The joint's motion in the precision asked for.
    #[inline]
    pub(crate) fn motion<T: Real>(
        &self,
        positions: &[T; 7],
        velocities: &[T; 6],
    ) -> GeneralMotion<T> {
        T::general_motion(self, positions, velocities)
    }
}
