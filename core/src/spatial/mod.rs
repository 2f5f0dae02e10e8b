//! Rigid-body maths of Appendix A: orientations, poses, twists, wrenches and inertias.
//!
//! Conventions: quaternions scalar first; twists and wrenches as structs with named parts, in body
//! frames unless a name says otherwise; poses map coordinates of the second frame in their name to
//! those of the first (`pose_world_from_body`).

mod articulated_inertia;
mod orientation_error;
mod pose;
mod quaternion;
mod rigid_inertia;
mod rotation;
mod symmetric;
mod twist;
mod wrench;

pub use articulated_inertia::ArticulatedInertia;
pub use orientation_error::orientation_error;
pub use pose::Pose;
pub use quaternion::Quaternion;
pub use rigid_inertia::RigidInertia;
pub use rotation::{AxisTurn, Rotation};
pub use symmetric::SymmetricMatrix3;
pub use twist::Twist;
pub use wrench::Wrench;

/// For the constants of robots.
pub use nalgebra::Vector3;
