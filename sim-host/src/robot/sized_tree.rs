//! Core's trees by their number of legs: the one place that tells sizes apart.

use crate::multibody::{BodyState, System, SystemError, states_of_tree, system_of_tree};
use nalgebra::Vector3;
use surefoot::dynamics::{DynamicsFault, body_poses, joint_poses};
use surefoot::model::{BodyShape, Link, Tree, TreeFault};
use surefoot::spatial::Pose;

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

    /// The system that moves as the tree does.
    ///
    /// # Errors
    /// As for [`system_of_tree`].
    pub fn system(&self) -> Result<System, SystemError> {
        with_tree!(self, tree => system_of_tree(tree))
    }

    /// States and rates of all bodies.
    ///
    /// # Errors
    /// A [`DynamicsFault`] for what is no configuration of the tree.
    pub fn states(
        &self,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<(Vec<BodyState>, Vec<BodyState>), DynamicsFault> {
        with_tree!(self, tree => states_of_tree(tree, &sized(positions), &sized(velocities)))
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

/// As many numbers as a tree has; those that are not there are none, which core refuses.
fn sized<const N: usize>(numbers: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(f64::NAN))
}
