//! One joint with its outboard body, as the recursions read it.

use super::{Axis, JointKind};
use crate::spatial::{RigidInertia, SymmetricMatrix3};
use nalgebra::{Matrix3, Vector3};

/// A joint and its outboard body, in the joint frame.
///
/// The joint frame is fixed to the outboard body with its origin on the joint and a coordinate axis
/// along the joint's. In it a joint map is a unit vector, and the offset to the inboard frame is
/// constant, often zero; that is where the speed of the recursions comes from. Body frames (centre
/// of mass, the user's axes) are what the public interface speaks; `center` and `body_rotation`
/// lead from one to the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<T> {
    pub kind: JointKind,
    /// Whether the joint's axis points against its frame's, so that the user's coordinate, rate and
    /// torque are the negative of those in this frame. The public functions turn them round on their
    /// way in and out; the recursions know nothing of it.
    pub is_reversed: bool,
    /// Index of the inboard node; `None` for the inertial frame.
    pub inboard: Option<usize>,
    /// Whether joints hang from this body that are not the next of its limb.
    pub is_branch: bool,
    /// How many joints the limb has that begins with this one: revolute joints, each inboard of the
    /// next alone. Zero inside a limb, for other joints, and for the second of twin limbs.
    pub limb: usize,
    /// Where the second limb begins that has joints of the same kinds; zero where there is none.
    pub twin: usize,
    /// First coordinate and first velocity of the joint.
    pub position_start: usize,
    pub velocity_start: usize,
    /// Origin of this frame in the inboard frame, at home.
    pub offset: Vector3<T>,
    /// Whether `offset` differs from zero.
    pub is_offset: bool,
    /// Inboard from this frame at home, where they are not parallel.
    pub home_rotation: Option<Matrix3<T>>,
    /// The frame's axes at home in the describing frame, where they are not parallel.
    pub home_axes: Option<Matrix3<T>>,
    /// Of the joint's rotor, reflected to the joint: kg·m², or kg where it slides.
    pub rotor_inertia: T,
    /// Of the outboard body.
    pub inertia: RigidInertia<T>,
    /// Whether the centre of mass is away from the joint.
    pub is_eccentric: bool,
    /// What is known of the inertia about the joint.
    pub shape: InertiaShape,
    /// Centre of mass.
    pub center: Vector3<T>,
    /// This frame from the body frame, where they are not parallel.
    pub body_rotation: Option<Matrix3<T>>,
}

/// Structure of a body's inertia about its joint that saves work: most robots' links have some.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InertiaShape {
    /// The same about every axis, as of a ball in the joint.
    Isotropic,
    /// No products of inertia.
    Diagonal,
    /// Nothing special.
    Full,
}

impl<T: crate::Real> Node<T> {
    /// The axis of a revolute joint.
    #[inline(always)]
    pub(crate) fn hinge(&self) -> Option<Axis> {
        match &self.kind {
            JointKind::Revolute(axis) => Some(*axis),
            _ => None,
        }
    }

    /// The axis of a revolute joint whose frame is parallel to its inboard one at home: what robots
    /// are made of.
    #[inline(always)]
    pub(crate) fn plain_hinge(&self) -> Option<Axis> {
        match (&self.kind, &self.home_rotation) {
            (JointKind::Revolute(axis), None) => Some(*axis),
            _ => None,
        }
    }

    /// `J v`.
    #[inline(always)]
    pub(crate) fn rotational_product(&self, v: Vector3<T>) -> Vector3<T> {
        let j = &self.inertia.rotational;
        match self.shape {
            InertiaShape::Full => j.product(v),
            InertiaShape::Diagonal | InertiaShape::Isotropic => j.diagonal.component_mul(&v),
        }
    }

    /// `ω × J ω`.
    #[inline(always)]
    pub(crate) fn gyroscopic_torque(&self, omega: Vector3<T>) -> Vector3<T> {
        if self.shape == InertiaShape::Isotropic {
            return Vector3::zeros();
        }
        omega.cross(&self.rotational_product(omega))
    }
}

/// What an array of nodes holds before it is filled.
pub(super) const EMPTY: Node<f64> = Node {
    kind: JointKind::Fixed,
    is_reversed: false,
    inboard: None,
    is_branch: false,
    limb: 0,
    twin: 0,
    position_start: 0,
    velocity_start: 0,
    offset: Vector3::new(0.0, 0.0, 0.0),
    is_offset: false,
    home_rotation: None,
    home_axes: None,
    rotor_inertia: 0.0,
    inertia: RigidInertia {
        mass: 0.0,
        first_moment: Vector3::new(0.0, 0.0, 0.0),
        rotational: SymmetricMatrix3 {
            diagonal: Vector3::new(0.0, 0.0, 0.0),
            off_diagonal: Vector3::new(0.0, 0.0, 0.0),
        },
    },
    is_eccentric: false,
    shape: InertiaShape::Full,
    center: Vector3::new(0.0, 0.0, 0.0),
    body_rotation: None,
};
