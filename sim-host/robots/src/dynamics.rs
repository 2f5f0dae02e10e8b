//! Kinematics and dynamics of a robot at the states of a file.

mod columns;
mod convention;
mod evaluate;
mod sized;
mod states;

pub use convention::Convention;
pub use evaluate::evaluate_file;
pub use sized::Precision;
pub use states::{FramePose, JointEntry, Results, State, StateResult};

use crate::error::{ImportError, Refusal};
use crate::robot::Robot;
use crate::tree;
use convention::JointMap;
use nalgebra::{DMatrix, DVector, Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use sized::{Evaluate, NoTree, Size, TreeState};
use surefoot::dynamics::DynamicsFault;
use surefoot::model::TreeFault;

/// Why a state has no dynamics.
#[derive(Debug, thiserror::Error)]
pub enum DynamicsError {
    /// A file of states is not one.
    #[error("{file}: {message}")]
    States {
        /// Which.
        file: String,
        /// What is wrong, with its line where it is the layout.
        message: String,
    },
    /// A quaternion, or cosine and sine, without unit norm.
    #[error("joint {joint}: its coordinates have norm {norm}, not 1")]
    NotUnit {
        /// Which.
        joint: String,
        /// What it has.
        norm: f64,
    },
    /// An algorithm gave no result.
    #[error("state {state}: {fault}{}", .joint.as_ref().map(|j| format!(" ({j})")).unwrap_or_default())]
    Fault {
        /// Index of the state.
        state: usize,
        /// The joint that it names.
        joint: Option<String>,
        /// Why.
        fault: DynamicsFault,
    },
    /// With the joints that follow others eliminated, nothing is moved by some joint.
    #[error("state {state}: the mass matrix is not positive definite")]
    Singular {
        /// Index of the state.
        state: usize,
    },
    /// The robot has no tree.
    #[error(transparent)]
    Robot(#[from] ImportError),
}

/// A robot's algorithms, compiled for a size that it fits.
pub struct Dynamics<'a> {
    robot: &'a Robot,
    home: Vec<Isometry3<f64>>,
    evaluate: Evaluate,
}

/// Results in a convention's coordinates.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// World from link, by links.
    pub poses: Vec<Isometry3<f64>>,
    /// Torques for the accelerations.
    pub inverse: DVector<f64>,
    /// Accelerations under the torques.
    pub forward: DVector<f64>,
    /// Mass matrix.
    pub mass_matrix: DMatrix<f64>,
}

/// One joint's numbers in each array, by links.
pub(crate) struct JointSlices<'s> {
    pub q: &'s [f64],
    pub v: &'s [f64],
    pub a: &'s [f64],
    pub tau: &'s [f64],
}

impl<'a> Dynamics<'a> {
    /// # Errors
    /// The robot has more joints than the algorithms are compiled for, or a link that core refuses.
    pub fn new(robot: &'a Robot, precision: Precision) -> Result<Self, ImportError> {
        let motions = || robot.links.iter().map(|link| link.joint.motion);
        let quaternions = motions().filter(|motion| !motion.has_axis()).count();
        let velocities = robot.degrees_of_freedom();
        let size = Size { links: robot.links.len(), velocities, quaternions };
        let links: Vec<_> = tree::home_links(robot).iter().map(|link| link.to_core()).collect();
        let evaluate =
            sized::compile(&links, size, robot.gravity, precision).map_err(|no_tree| {
                let (subject, refusal) = match no_tree {
                    NoTree::TooLarge => {
                        let (degrees_of_freedom, most) = (size.velocities, sized::MOST);
                        ("robot".into(), Refusal::TooLarge { degrees_of_freedom, most })
                    }
                    NoTree::Fault(TreeFault::Link { index, reason })
                        if index < robot.links.len() =>
                    {
                        let reason = reason.message().to_owned();
                        (format!("link {}", robot.links[index].name), Refusal::Tree { reason })
                    }
                    NoTree::Fault(fault) => {
                        ("robot".into(), Refusal::Tree { reason: fault.to_string() })
                    }
                };
                ImportError::refused(None, subject, refusal)
            })?;
        Ok(Self { robot, home: robot.home_poses(), evaluate })
    }

    /// All algorithms at one state, given joint by joint in the robot's order.
    ///
    /// # Errors
    /// A coordinate is not finite or a quaternion not of unit norm; the inertia that a joint moves is not
    /// positive.
    pub(crate) fn at(
        &self,
        convention: Convention,
        joints: &[JointSlices<'_>],
    ) -> Result<Evaluation, AtState> {
        let mut maps: Vec<JointMap> = Vec::with_capacity(joints.len());
        let mut state = TreeState {
            positions: Vec::new(),
            velocities: Vec::new(),
            accelerations: Vec::new(),
            torques: Vec::new(),
        };
        for ((link, home), joint) in self.robot.links.iter().zip(&self.home).zip(joints) {
            let map = convention.map(link, home, joint.q, joint.v)?;
            let n = joint.v.len();
            let s = map.velocity.view((0, 0), (n, n)).into_owned();
            let of = |x: &[f64]| &s * DVector::from_row_slice(x);
            state.positions.extend(&map.positions);
            state.velocities.extend(of(joint.v).iter());
            state
                .accelerations
                .extend(of(joint.a).iter().zip(map.acceleration).map(|(a, d)| a + d));
            // τ_tree = S⁻ᵀ τ
            let dual = s.transpose().lu().solve(&DVector::from_row_slice(joint.tau));
            state.torques.extend(dual.unwrap_or(DVector::zeros(n)).iter());
            maps.push(map);
        }
        let result = (self.evaluate)(&state)?;
        let forward = result.forward?;
        let n = state.velocities.len();
        let mut s = DMatrix::zeros(n, n);
        let mut d = DVector::zeros(n);
        let mut start = 0;
        for (map, joint) in maps.iter().zip(joints) {
            let own = joint.v.len();
            s.view_mut((start, start), (own, own))
                .copy_from(&map.velocity.view((0, 0), (own, own)));
            d.rows_mut(start, own).copy_from_slice(&map.acceleration[..own]);
            start += own;
        }
        let beta_dot = DVector::from_vec(forward) - d;
        let poses = result.poses.iter().zip(&self.robot.links).map(|(pose, link)| {
            let rotation = orthonormal(&pose.rotation);
            let origin: Vector3<f64> = pose.position - rotation * link.inertial.center;
            Isometry3::from_parts(origin.into(), rotation)
        });
        Ok(Evaluation {
            poses: poses.collect(),
            inverse: s.tr_mul(&DVector::from_vec(result.inverse)),
            // S is a rotation, or one and a shift: it has an inverse.
            forward: s.clone().lu().solve(&beta_dot).unwrap_or(beta_dot),
            mass_matrix: s.transpose() * result.mass_matrix * s,
        })
    }

    /// The name of joint `k` of the tree.
    pub(crate) fn joint_name(&self, k: usize) -> Option<String> {
        self.robot.links.get(k).map(|link| format!("joint {}", link.joint.name))
    }
}

/// Why one state failed, before it is known which it is.
#[derive(Debug)]
pub(crate) enum AtState {
    Input(DynamicsError),
    Fault(DynamicsFault),
}

impl From<DynamicsError> for AtState {
    fn from(error: DynamicsError) -> Self {
        Self::Input(error)
    }
}

impl From<DynamicsFault> for AtState {
    fn from(fault: DynamicsFault) -> Self {
        Self::Fault(fault)
    }
}

/// A product of rotations as a rotation.
fn orthonormal(matrix: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*matrix))
}
