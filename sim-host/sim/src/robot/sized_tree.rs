//! Core's trees by their size: the one place that tells sizes apart.
//!
//! Robots on two legs of six joints have trees of their own size. All others are compiled for two sizes, as
//! each takes long to compile, and take the smaller that they fit: the rest is filled with sliding bodies on the
//! world, at rest, which share no number with the robot's and leave its bits alone.

use crate::plant::StepFailure;
use nalgebra::{UnitQuaternion, Vector3};
use surefoot::dynamics::{DynamicsFault, body_poses, joint_poses};
use surefoot::model::{BodyShape, Link, Tree, TreeFault};
use surefoot::spatial::{Pose, Quaternion};
use surefoot_multibody::{BodyState, Frame, System, principal_system_of_tree, states_of_tree};

/// Joints of a leg.
pub const LEG: usize = 6;
/// Feet of a robot at most.
pub const MOST_LEGS: usize = 4;

/// A floating body on two legs of six joints, or with other joints.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "a program holds a few of them")]
pub enum SizedTree {
    /// On two legs.
    Two(Tree<f64, 13, 19, 18>),
    /// With other joints, up to 18; how many bodies are the robot's.
    Few(Box<Tree<f64, 19, 25, 24>>, usize),
    /// The same, up to 42.
    Many(Box<Tree<f64, 43, 49, 48>>, usize),
}

/// Joints of a robot at most.
pub const MOST_JOINTS: usize = 42;

/// Evaluates an expression with a [`SizedTree`]'s tree; with the number of its legs as a constant where all have six
/// joints, and else another one, with the number of rows of six joints that the tree has room for.
macro_rules! with_tree {
    ($sized:expr, $tree:ident => $result:expr) => {
        match $sized {
            $crate::robot::SizedTree::Two($tree) => $result,
            $crate::robot::SizedTree::Few(boxed, _) => {
                let $tree = &**boxed;
                $result
            }
            $crate::robot::SizedTree::Many(boxed, _) => {
                let $tree = &**boxed;
                $result
            }
        }
    };
    ($sized:expr, $tree:ident, $legs:ident => $result:expr, $any:ident, $rows:ident => $other:expr) => {
        match $sized {
            $crate::robot::SizedTree::Two($tree) => {
                const $legs: usize = 2;
                $result
            }
            $crate::robot::SizedTree::Few(boxed, _) => {
                const $rows: usize = 3;
                let $any = &**boxed;
                $other
            }
            $crate::robot::SizedTree::Many(boxed, _) => {
                const $rows: usize = 7;
                let $any = &**boxed;
                $other
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
    /// Of a floating link and twelve on two legs; `None` for another number of them.
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
            _ => None,
        }
    }

    /// Of a floating link and others on joints of one degree of freedom; `None` for more than 42 joints.
    ///
    /// # Errors
    /// A [`TreeFault`] where they are no tree.
    pub fn of_any(links: &[Link], gravity: [f64; 3]) -> Option<Result<Self, TreeFault>> {
        fn filled<const N: usize, const NQ: usize, const NV: usize>(
            links: &[Link],
            gravity: [f64; 3],
        ) -> Result<Box<Tree<f64, N, NQ, NV>>, TreeFault> {
            let filling = Link::prismatic(0, [1.0, 0.0, 0.0]).body(1.0, [1.0; 3], [0.0; 3]);
            let all: [Link; N] = std::array::from_fn(|k| links.get(k).copied().unwrap_or(filling));
            Tree::try_new(all).map(|tree| Box::new(tree.with_gravity(gravity)))
        }
        let bodies = links.len();
        match bodies {
            0..=19 => Some(filled(links, gravity).map(|tree| Self::Few(tree, bodies))),
            20..=43 => Some(filled(links, gravity).map(|tree| Self::Many(tree, bodies))),
            _ => None,
        }
    }

    /// Whether all that moves is a floating body on two legs of six joints.
    pub fn is_six_jointed(&self) -> bool {
        matches!(self, Self::Two(_))
    }

    /// Where all bodies are, world from body, at position, quaternion and angles.
    ///
    /// # Errors
    /// A [`DynamicsFault`] for what is no configuration of the tree.
    pub fn body_poses(&self, positions: &[f64]) -> Result<Vec<Pose<f64>>, DynamicsFault> {
        with_tree!(self, tree => {
            let poses = body_poses(tree, &joint_poses(tree, &self.sized(positions, 7))?);
            Ok(poses[..self.bodies()].to_vec())
        })
    }

    /// The system that moves as the tree does, with the states and rates of its links at a configuration, and the
    /// bodies' frames of the tree in those of the links, which are along principal axes.
    ///
    /// # Errors
    /// As for [`principal_system_of_tree`], and a [`DynamicsFault`] for what is no configuration of the tree.
    pub fn start(&self, positions: &[f64], velocities: &[f64]) -> Result<Start, StepFailure> {
        with_tree!(self, tree => {
            let bodies = self.bodies();
            let (system, mut axes) = principal_system_of_tree(tree, bodies)?;
            let (mut states, mut rates) =
                states_of_tree(tree, &self.sized(positions, 7), &self.sized(velocities, 6))?;
            axes.truncate(bodies);
            states.truncate(bodies);
            rates.truncate(bodies);
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
            Self::Few(_, bodies) | Self::Many(_, bodies) => *bodies,
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
        (0..self.bodies()).fold(0.0, |sum, body| sum + self.body_mass(body))
    }

    /// As many numbers as the tree has: those given, of which the central body has so many and each joint one, and
    /// zeros for what is not the robot's. A missing one is NaN, which core refuses.
    pub(crate) fn sized<const M: usize>(&self, numbers: &[f64], central: usize) -> [f64; M] {
        let own = central + self.bodies() - 1;
        std::array::from_fn(|i| match numbers.get(i) {
            Some(number) if i < own => *number,
            None if i < own => f64::NAN,
            _ => 0.0,
        })
    }

    /// m/s²
    pub fn gravity(&self) -> Vector3<f64> {
        with_tree!(self, tree => tree.gravity())
    }
}
