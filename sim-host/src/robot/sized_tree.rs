//! Core's trees by their number of legs: the one place that tells sizes apart.

use crate::multibody::{BodyState, Frame, System, principal_system_of_tree, states_of_tree};
use crate::plant::StepFailure;
use nalgebra::{UnitQuaternion, Vector3};
use surefoot::dynamics::{DynamicsFault, body_poses, joint_poses};
use surefoot::model::{BodyShape, Link, Tree, TreeFault};
use surefoot::spatial::{Pose, Quaternion};

/// Joints of a leg.
pub const LEG: usize = 6;
/// Legs that the controller is compiled for: two to four.
pub const MOST_LEGS: usize = 4;

/// A floating body on two, three or four legs of six joints.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "a program holds a few of them")]
pub enum SizedTree {
    /// On two legs.
    Two(Tree<f64, 13, 19, 18>),
    /// On three.
    Three(Tree<f64, 19, 25, 24>),
    /// On four.
    Four(Tree<f64, 25, 31, 30>),
}

/// Evaluates an expression with a [`SizedTree`]'s tree, and with the number of its legs as a constant.
macro_rules! with_tree {
    ($sized:expr, $tree:ident => $result:expr) => {
        match $sized {
            $crate::robot::SizedTree::Two($tree) => $result,
            $crate::robot::SizedTree::Three($tree) => $result,
            $crate::robot::SizedTree::Four($tree) => $result,
        }
    };
    ($sized:expr, $tree:ident, $legs:ident => $result:expr) => {
        match $sized {
            $crate::robot::SizedTree::Two($tree) => {
                const $legs: usize = 2;
                $result
            }
            $crate::robot::SizedTree::Three($tree) => {
                const $legs: usize = 3;
                $result
            }
            $crate::robot::SizedTree::Four($tree) => {
                const $legs: usize = 4;
                $result
            }
        }
    };
}
pub(crate) use with_tree;

/// Where a tree's motion begins in the simulator.
#[derive(Clone, Debug)]
pub struct Start {
    /// Links in the tree's order.
    pub system: System,
    /// The bodies' frames in the links'.
    pub frames: Vec<Frame>,
    /// Of the links.
    pub states: Vec<BodyState>,
    /// Of the links.
    pub rates: Vec<BodyState>,
}

impl SizedTree {
    /// Of a floating link and six a leg; `None` for another number of them.
    ///
    /// # Errors
    /// A [`TreeFault`] where they are no tree.
    pub fn try_new(links: &[Link], gravity: [f64; 3]) -> Option<Result<Self, TreeFault>> {
        fn sized<const N: usize, const NQ: usize, const NV: usize>(
            links: &[Link],
            gravity: [f64; 3],
        ) -> Option<Result<Tree<f64, N, NQ, NV>, TreeFault>> {
            let links: [Link; N] = links.try_into().ok()?;
            Some(Tree::try_new(links).map(|tree| tree.with_gravity(gravity)))
        }
        match links.len() {
            13 => sized(links, gravity).map(|tree| tree.map(Self::Two)),
            19 => sized(links, gravity).map(|tree| tree.map(Self::Three)),
            25 => sized(links, gravity).map(|tree| tree.map(Self::Four)),
            _ => None,
        }
    }

    /// Where all bodies are, world from body, at position, quaternion and angles.
    ///
    /// # Errors
    /// A [`DynamicsFault`] for what is no configuration of the tree.
    pub fn body_poses(&self, positions: &[f64]) -> Result<Vec<Pose<f64>>, DynamicsFault> {
        with_tree!(self, tree => {
            Ok(body_poses(tree, &joint_poses(tree, &sized(positions))?).to_vec())
        })
    }

    /// The system that moves as the tree does, with the states and rates of its links at a configuration, and the
    /// bodies' frames of the tree in those of the links, which are along principal axes.
    ///
    /// # Errors
    /// As for [`principal_system_of_tree`], and a [`DynamicsFault`] for what is no configuration of the tree.
    pub fn start(&self, positions: &[f64], velocities: &[f64]) -> Result<Start, StepFailure> {
        with_tree!(self, tree => {
            let (system, axes) = principal_system_of_tree(tree)?;
            let (mut states, mut rates) =
                states_of_tree(tree, &sized(positions), &sized(velocities))?;
            let mut frames = vec![Frame::IDENTITY; axes.len()];
            for (k, axes) in axes.iter().enumerate() {
                let Some(axes) = axes else { continue };
                let turn = UnitQuaternion::from_rotation_matrix(axes);
                let turn = Quaternion::from_array([turn.w, turn.i, turn.j, turn.k]);
                for all in [&mut states, &mut rates] {
                    let of_body = Quaternion::from_array(std::array::from_fn(|i| all[k][3 + i]));
                    all[k][3..].copy_from_slice(&of_body.product(turn).to_array());
                }
                frames[k].orientation = turn.conjugate();
            }
            Ok(Start { system, frames, states, rates })
        })
    }

    /// How many bodies it has.
    pub fn bodies(&self) -> usize {
        match self {
            Self::Two(_) => 13,
            Self::Three(_) => 19,
            Self::Four(_) => 25,
        }
    }

    /// A body's mass, inertia and joint.
    pub fn body_shape(&self, body: usize) -> Option<BodyShape<f64>> {
        with_tree!(self, tree => tree.body_shape(body))
    }

    /// Of a body, kg; 0 where there is none.
    pub fn body_mass(&self, body: usize) -> f64 {
        with_tree!(self, tree => tree.body_mass(body)).unwrap_or(0.0)
    }

    /// Of all bodies, kg.
    pub fn mass(&self) -> f64 {
        with_tree!(self, tree => tree.mass())
    }

    /// m/s²
    pub fn gravity(&self) -> Vector3<f64> {
        with_tree!(self, tree => tree.gravity())
    }
}

/// As many numbers as a tree has; a missing one is NaN, which core refuses.
fn sized<const N: usize>(numbers: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(f64::NAN))
}
