//! Relative poses of all joints, `g_{k.i,k.o}(θ_k)`: (3.7), (3.12).

use super::DynamicsFault;
use super::reversed::reverse_positions;
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{AxisTurn, Pose, Quaternion, Rotation};
use nalgebra::{Matrix3, Vector3};

/// The joints' relative poses at one configuration, from [`joint_poses`].
///
/// Sines and cosines are kept, the rest is put together where it is used: that is a few loads for a
/// revolute joint, and keeps this result small enough to be passed by value.
#[derive(Clone, Copy, Debug)]
pub struct JointPoses<T, const N: usize, const NQ: usize> {
    /// Of the joint's angle; of no meaning for joints without one.
    pub(super) turns: [AxisTurn<T>; N],
    /// Coordinates along the frames' axes, with quaternions scaled to unit norm.
    pub(super) positions: [T; NQ],
}

/// Outboard frame in the inboard frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointPose<T> {
    pub rotation: Rotation<T>,
    pub translation: Vector3<T>,
    /// Whether the translation differs from zero by the joint's construction.
    pub is_translated: bool,
}

/// Evaluates the joints' poses at coordinates `positions`.
///
/// Quaternions are scaled to unit norm if they are within 1 in 1000 of it.
///
/// # Errors
/// [`DynamicsFault::PositionNotFinite`], [`DynamicsFault::QuaternionNotUnit`].
///
/// # Cost
/// One sine and cosine per revolute joint; O(N).
#[inline]
pub fn joint_poses<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    positions: &[T; NQ],
) -> Result<JointPoses<T, N, NQ>, DynamicsFault> {
    // One pass without branches; which coordinate it was is only asked when there is one.
    let finite = positions.iter().fold(true, |all, x| all & x.is_finite());
    if !finite {
        let index = positions.iter().position(|x| !x.is_finite()).unwrap_or(NQ);
        return Err(DynamicsFault::PositionNotFinite { index });
    }
    let mut poses = JointPoses {
        turns: [AxisTurn { cosine: T::one(), sine: T::zero() }; N],
        positions: *positions,
    };
    if tree.has_reversed {
        reverse_positions(tree, &mut poses.positions);
    }
    turns(tree, &poses.positions, &mut poses.turns);
    for (joint, node) in tree.nodes.iter().enumerate() {
        let quaternion = match &node.kind {
            JointKind::Spherical => node.position_start,
            JointKind::Floating => node.position_start + 3,
            _ => continue,
        };
        normalize(&mut poses.positions, quaternion)
            .ok_or(DynamicsFault::QuaternionNotUnit { joint })?;
    }
    Ok(poses)
}

/// How many angles go together.
const BLOCK: usize = if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) { 8 } else { 1 };

/// Sines and cosines of all revolute joints. Those of the others are of an angle of zero: one loop
/// without branches over all is what processors with wide registers do fastest.
#[inline]
fn turns<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    positions: &[T; NQ],
    turns: &mut [AxisTurn<T>; N],
) {
    let mut angles = [T::zero(); N];
    for (angle, node) in angles.iter_mut().zip(&tree.nodes) {
        if let JointKind::Revolute(_) = node.kind {
            *angle = coordinate(node, positions);
        }
    }
    if angles.iter().fold(true, |all, angle| all & angle.is_near()) {
        // Blocks of one length, the last one filled up, so that the compiler knows how many there are.
        for (turns, angles) in turns.chunks_mut(BLOCK).zip(angles.chunks(BLOCK)) {
            let mut block = [T::zero(); BLOCK];
            for (to, angle) in block.iter_mut().zip(angles) {
                *to = *angle;
            }
            let mut sines = [T::zero(); BLOCK];
            for (sine, angle) in sines.iter_mut().zip(&mut block) {
                (*sine, *angle) = angle.near_sine_cosine();
            }
            for ((turn, sine), cosine) in turns.iter_mut().zip(sines).zip(block) {
                *turn = AxisTurn { cosine, sine };
            }
        }
    } else {
        for (turn, angle) in turns.iter_mut().zip(angles) {
            *turn = AxisTurn::new(angle);
        }
    }
}

/// Scales the four numbers from `start` on to unit norm, if they are near it.
fn normalize<T: Real, const NQ: usize>(positions: &mut [T; NQ], start: usize) -> Option<()> {
    let own = positions.get_mut(start..)?.first_chunk_mut::<4>()?;
    let q = Quaternion::from_array(*own);
    let error = q.norm_squared() - T::one();
    if error.abs() < T::of(2e-3) {
        *own = q.normalized()?.to_array();
        Some(())
    } else {
        None
    }
}

impl<T: Real, const N: usize, const NQ: usize> JointPoses<T, N, NQ> {
    /// To be filled.
    pub(crate) fn home() -> Self {
        let turn = AxisTurn { cosine: T::one(), sine: T::zero() };
        Self { turns: [turn; N], positions: [T::zero(); NQ] }
    }

    /// The relative pose of joint `k`.
    #[inline(always)]
    pub(super) fn pose(&self, k: usize, node: &Node<T>) -> Option<JointPose<T>> {
        self.turns.get(k).map(|turn| relative(node, *turn, &self.positions))
    }

    /// The joints of a tree with their relative poses, inboard ones first.
    #[inline(always)]
    pub(super) fn joints<'a>(
        &'a self,
        nodes: &'a [Node<T>; N],
    ) -> impl DoubleEndedIterator<Item = (usize, &'a Node<T>, JointPose<T>)> + ExactSizeIterator
    {
        nodes
            .iter()
            .zip(&self.turns)
            .enumerate()
            .map(|(k, (node, turn))| (k, node, relative(node, *turn, &self.positions)))
    }
}

/// The joint's own coordinates, padded with zeros.
#[inline(always)]
pub(super) fn coordinates<T: Real, const NQ: usize>(node: &Node<T>, positions: &[T; NQ]) -> [T; 7] {
    let mut theta = [T::zero(); 7];
    let own = positions.iter().skip(node.position_start).take(node.kind.coordinates());
    for (t, x) in theta.iter_mut().zip(own) {
        *t = *x;
    }
    theta
}

/// The one coordinate of a revolute or prismatic joint.
#[inline(always)]
fn coordinate<T: Real, const NQ: usize>(node: &Node<T>, positions: &[T; NQ]) -> T {
    positions.get(node.position_start).copied().unwrap_or(T::zero())
}

/// `g_{k.i,k.o}` of one joint.
#[inline(always)]
pub(super) fn relative<T: Real, const NQ: usize>(
    node: &Node<T>,
    turn: AxisTurn<T>,
    positions: &[T; NQ],
) -> JointPose<T> {
    let fixed =
        |rotation| JointPose { rotation, translation: node.offset, is_translated: node.is_offset };
    match &node.kind {
        JointKind::Fixed => fixed(turned(node, Rotation::Identity)),
        JointKind::Revolute(Axis::X) => fixed(turned(node, Rotation::X(turn))),
        JointKind::Revolute(Axis::Y) => fixed(turned(node, Rotation::Y(turn))),
        JointKind::Revolute(Axis::Z) => fixed(turned(node, Rotation::Z(turn))),
        _ => unusual(node, positions),
    }
}

/// The same for joints that are neither fixed nor revolute.
#[inline(never)]
fn unusual<T: Real, const NQ: usize>(node: &Node<T>, positions: &[T; NQ]) -> JointPose<T> {
    let own = coordinates(node, positions);
    let home = turned(node, Rotation::Identity);
    let (pose, is_translated) = match &node.kind {
        JointKind::Fixed | JointKind::Revolute(_) => (Pose::identity(), false),
        JointKind::Prismatic(axis) => {
            let mut slide = Vector3::zeros();
            match axis {
                Axis::X => slide.x = own[0],
                Axis::Y => slide.y = own[0],
                Axis::Z => slide.z = own[0],
            }
            (Pose { rotation: Matrix3::identity(), position: slide }, true)
        }
        JointKind::Spherical => {
            let [s, x, y, z, ..] = own;
            let rotation = Quaternion::from_array([s, x, y, z]).to_matrix();
            (Pose { rotation, position: Vector3::zeros() }, node.is_offset)
        }
        JointKind::Floating => {
            let [px, py, pz, s, x, y, z] = own;
            let rotation = Quaternion::from_array([s, x, y, z]).to_matrix();
            (Pose { rotation, position: Vector3::new(px, py, pz) }, true)
        }
        JointKind::General(joint) => (joint.motion(&own, &[T::zero(); 6]).pose, true),
    };
    // The joint frames coincide at home: R_home stands before R(θ), and a joint's own translation is
    // given in the inboard joint frame.
    JointPose {
        rotation: turned(node, Rotation::General(pose.rotation)),
        translation: node.offset + home.inboard(pose.position),
        is_translated,
    }
}

/// `R_home R(θ)`.
#[inline(always)]
fn turned<T: Real>(node: &Node<T>, rotation: Rotation<T>) -> Rotation<T> {
    match &node.home_rotation {
        None => rotation,
        Some(home) => Rotation::General(rotation.compose(home)),
    }
}

impl<T: Real> JointPose<T> {
    /// Inboard from outboard, as a matrix.
    #[inline]
    pub(crate) fn rotation_matrix(&self) -> Matrix3<T> {
        self.rotation.to_matrix()
    }
}
