//! Trees whose size is known when a file is read.
//!
//! Core's algorithms are compiled for numbers of bodies, coordinates and velocities. Here they are compiled
//! for two sizes, as each takes long to compile, and a robot takes the smaller that it fits: the rest is
//! filled with bodies of their own on the world, at rest, which share no number with the robot's.

use nalgebra::DMatrix;
use surefoot::Real;
use surefoot::dynamics::{
    DynamicsFault, body_poses, forward_dynamics, inverse_dynamics, joint_poses, mass_matrix,
};
use surefoot::model::{Link, Tree, TreeFault};
use surefoot::spatial::Pose;

/// Of the arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// Double, the host's.
    #[default]
    F64,
    /// Single, the firmware's.
    F32,
}

/// A state in a tree's own coordinates.
#[derive(Debug)]
pub(super) struct TreeState {
    pub positions: Vec<f64>,
    pub velocities: Vec<f64>,
    pub accelerations: Vec<f64>,
    pub torques: Vec<f64>,
}

/// What the algorithms give for it.
#[derive(Debug)]
pub(super) struct TreeResult {
    /// World from body: centre of mass, link's axes.
    pub poses: Vec<Pose<f64>>,
    pub inverse: Vec<f64>,
    pub forward: Result<Vec<f64>, DynamicsFault>,
    pub mass_matrix: DMatrix<f64>,
}

/// The algorithms on one tree.
pub(super) type Evaluate = Box<dyn Fn(&TreeState) -> Result<TreeResult, DynamicsFault>>;

/// What a robot's links need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub links: usize,
    pub velocities: usize,
    /// Joints with a quaternion, which have a coordinate more than velocities.
    pub quaternions: usize,
}

/// Velocities at most, whatever the joints.
pub(super) const MOST: usize = 128;

/// The algorithms for a tree of any size up to [`MOST`].
///
/// # Errors
/// It is larger, or core refuses a link.
pub(super) fn compile(
    links: &[Link],
    size: Size,
    gravity: [f64; 3],
    precision: Precision,
) -> Result<Evaluate, NoTree> {
    if size.velocities > MOST {
        return Err(NoTree::TooLarge);
    }
    // Bodies, coordinates, velocities; the difference is how many quaternions fit.
    macro_rules! smallest {
        ($(($n:literal, $nq:literal)),* $(,)?) => {
            $(if let Some(filled) = fill(links, size, $n, $nq - $n) {
                return sized::<$n, $nq, $n>(&filled, size, gravity, precision);
            })*
        };
    }
    smallest!((48, 52), (160, 168));
    Err(NoTree::TooLarge)
}

/// Why there is no tree.
#[derive(Clone, Copy, Debug)]
pub(super) enum NoTree {
    TooLarge,
    Fault(TreeFault),
}

/// The links, and others so that there are `n` with `n` velocities and `quaternions` quaternions; `None`
/// where they do not fit.
fn fill(links: &[Link], size: Size, n: usize, quaternions: usize) -> Option<Vec<Link>> {
    let body = |link: Link| link.body(1.0, [1.0; 3], [0.0; 3]);
    let balls = quaternions.checked_sub(size.quaternions)?;
    let slides = n.checked_sub(size.velocities + 3 * balls)?;
    let fixed = n.checked_sub(size.links + balls + slides)?;
    let mut all = links.to_vec();
    all.extend((0..balls).map(|_| body(Link::spherical(0, [0.0; 3]))));
    all.extend((0..slides).map(|_| body(Link::prismatic(0, [1.0, 0.0, 0.0]))));
    all.extend((0..fixed).map(|_| body(Link::fixed(0))));
    Some(all)
}

fn sized<const N: usize, const NQ: usize, const NV: usize>(
    links: &[Link],
    size: Size,
    gravity: [f64; 3],
    precision: Precision,
) -> Result<Evaluate, NoTree> {
    let tree: Tree<f64, N, NQ, NV> = Tree::try_new(std::array::from_fn(|i| links[i]))
        .map_err(NoTree::Fault)?
        .with_gravity(gravity);
    Ok(match precision {
        Precision::F64 => Box::new(move |state| evaluate(&tree, size, state)),
        Precision::F32 => {
            let tree = tree.to_f32();
            Box::new(move |state| evaluate(&tree, size, state))
        }
    })
}

fn evaluate<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    size: Size,
    state: &TreeState,
) -> Result<TreeResult, DynamicsFault> {
    // The fill's quaternions are the identity, all else of it is 0.
    let mut positions = [T::zero(); NQ];
    let own = size.velocities + size.quaternions;
    for ball in 0..NQ - NV - size.quaternions {
        positions[own + 4 * ball] = T::one();
    }
    for (to, from) in positions.iter_mut().zip(&state.positions) {
        *to = T::of(*from);
    }
    let padded = |from: &[f64]| {
        let mut to = [T::zero(); NV];
        to.iter_mut().zip(from).for_each(|(to, from)| *to = T::of(*from));
        to
    };
    let poses = joint_poses(tree, &positions)?;
    let velocities = padded(&state.velocities);
    let inverse = inverse_dynamics(tree, &poses, &velocities, &padded(&state.accelerations), None);
    let forward = forward_dynamics(tree, &poses, &velocities, &padded(&state.torques), None);
    let matrix = mass_matrix(tree, &poses);
    let plain = |all: &[T]| all.iter().take(size.velocities).map(|x| x.to_f64()).collect();
    Ok(TreeResult {
        poses: body_poses(tree, &poses)
            .iter()
            .take(size.links)
            .map(|pose| Pose {
                rotation: pose.rotation.map(|x| x.to_f64()),
                position: pose.position.map(|x| x.to_f64()),
            })
            .collect(),
        inverse: plain(&inverse),
        forward: forward.map(|a| plain(&a)),
        mass_matrix: DMatrix::from_fn(size.velocities, size.velocities, |i, j| {
            matrix[i][j].to_f64()
        }),
    })
}
