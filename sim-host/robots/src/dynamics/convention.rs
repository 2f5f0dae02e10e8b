//! Between a file's coordinates and the tree's, joint by joint.
//!
//! # Notation
//! - `v` a file's velocities of one joint, `β` the tree's: `β = S v`, `β̇ = S v̇ + d`
//! - forces are dual: `τ = Sᵀ τ_tree`, and so `M = Sᵀ M_tree S`
//! - `R` world from link, `c` the centre of mass in the link's frame, `H` the link's orientation at home
//!
//! A floating joint of the tree has the pose and twist of the centre of mass, in the link's axes. With the
//! file's twist at the link's origin in the link's axes, as Pinocchio has it,
//! `S = (1, −[c]; 0, 1)`, `d = 0`; where its linear part is in the world's axes, as MuJoCo has it,
//! `S = (Rᵀ, −[c]; 0, 1)` and `d = (−ω × Rᵀ v, 0)`, since `d/dt (Rᵀ v) = Rᵀ v̇ − ω × Rᵀ v`.
//! A spherical joint's frame is parallel to the world's at home: `S = H`.

use super::DynamicsError;
use crate::robot::{RobotLink, RobotMotion};
use nalgebra::{Isometry3, Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3};

/// How a file writes floating and spherical joints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Convention {
    /// Quaternions x, y, z, w; linear velocity of a floating joint in the link's axes; a continuous joint is
    /// (cos θ, sin θ).
    #[default]
    Pinocchio,
    /// Quaternions w, x, y, z; linear velocity of a floating joint in the world's axes; a continuous joint
    /// is its angle.
    Mujoco,
}

/// How far from 1 the norm of a quaternion or of (cos θ, sin θ) may be.
const NORM_SLACK: f64 = 1e-6;

/// What one joint's numbers are to the tree.
#[derive(Debug)]
pub(super) struct JointMap {
    /// The tree's coordinates.
    pub positions: Vec<f64>,
    /// `S`, in its first rows and columns.
    pub velocity: Matrix6<f64>,
    /// `d`
    pub acceleration: [f64; 6],
}

impl Convention {
    /// Coordinates that a file has for a joint.
    pub(super) fn coordinates(self, motion: RobotMotion) -> usize {
        match motion {
            RobotMotion::Continuous if self == Self::Pinocchio => 2,
            RobotMotion::Revolute | RobotMotion::Continuous | RobotMotion::Prismatic => 1,
            RobotMotion::Spherical => 4,
            RobotMotion::Floating => 7,
        }
    }

    /// The map of the joint of `link`, whose frame is at `home` with all joints at 0, at a file's coordinates
    /// `q` and velocities `v`.
    pub(super) fn map(
        self,
        link: &RobotLink,
        home: &Isometry3<f64>,
        q: &[f64],
        v: &[f64],
    ) -> Result<JointMap, DynamicsError> {
        let mut velocity = Matrix6::identity();
        let mut acceleration = [0.0; 6];
        let positions = match (link.joint.motion, q) {
            (RobotMotion::Continuous, [cosine, sine]) => {
                let norm = cosine.hypot(*sine);
                unit(&link.joint.name, norm)?;
                vec![sine.atan2(*cosine)]
            }
            (RobotMotion::Spherical, [a, b, c, d]) => {
                let own = self.quaternion(&link.joint.name, [*a, *b, *c, *d])?;
                let h = home.rotation;
                let turned = h * own * h.inverse();
                velocity.fixed_view_mut::<3, 3>(0, 0).copy_from(h.to_rotation_matrix().matrix());
                vec![turned.w, turned.i, turned.j, turned.k]
            }
            (RobotMotion::Floating, [x, y, z, a, b, c, d]) => {
                let own = self.quaternion(&link.joint.name, [*a, *b, *c, *d])?;
                let center = link.inertial.center;
                let at = Vector3::new(*x, *y, *z) + own * center;
                let to_link = own.inverse().to_rotation_matrix();
                velocity.fixed_view_mut::<3, 3>(0, 3).copy_from(&-center.cross_matrix());
                if self == Self::Mujoco {
                    velocity.fixed_view_mut::<3, 3>(0, 0).copy_from(to_link.matrix());
                    let linear: Matrix3<f64> = *to_link.matrix();
                    let [vx, vy, vz, wx, wy, wz] = *v else { return Ok(unmapped(q)) };
                    let turning = linear * Vector3::new(vx, vy, vz);
                    let d = -Vector3::new(wx, wy, wz).cross(&turning);
                    acceleration[..3].copy_from_slice(d.as_slice());
                }
                vec![at.x, at.y, at.z, own.w, own.i, own.j, own.k]
            }
            _ => return Ok(unmapped(q)),
        };
        Ok(JointMap { positions, velocity, acceleration })
    }

    fn quaternion(self, joint: &str, q: [f64; 4]) -> Result<UnitQuaternion<f64>, DynamicsError> {
        let [w, x, y, z] = match self {
            Self::Pinocchio => [q[3], q[0], q[1], q[2]],
            Self::Mujoco => q,
        };
        let q = Quaternion::new(w, x, y, z);
        unit(joint, q.norm())?;
        Ok(UnitQuaternion::new_normalize(q))
    }
}

fn unmapped(q: &[f64]) -> JointMap {
    JointMap { positions: q.to_vec(), velocity: Matrix6::identity(), acceleration: [0.0; 6] }
}

fn unit(joint: &str, norm: f64) -> Result<(), DynamicsError> {
    if (norm - 1.0).abs() < NORM_SLACK {
        Ok(())
    } else {
        Err(DynamicsError::NotUnit { joint: joint.to_owned(), norm })
    }
}
