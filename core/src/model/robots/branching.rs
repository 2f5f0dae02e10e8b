//! A branching tree on a sliding cart: a trunk on a spherical joint, which carries a hinged arm, a
//! fixed mast and, on the mast, a head with a universal joint written as a general joint.

use crate::Real;
use crate::model::{GeneralJoint, GeneralMotion, Link, Tree};
use crate::spatial::{AxisTurn, Pose, Rotation, Twist};
use nalgebra::{Matrix3, Vector3};

/// The tree in precision `T`.
pub type Branching<T> = Tree<T, 5, 8, 7>;

/// In double precision.
pub const TREE: Branching<f64> = Tree::new([
    Link::prismatic(0, [1.0, 0.0, 0.0]).body(5.0, [0.1, 0.1, 0.1], [0.0, 0.0, 0.1]),
    Link::spherical(1, [0.0, 0.0, 0.2]).body(3.0, [0.05, 0.06, 0.03], [0.0, 0.0, 0.5]),
    Link::revolute(2, [0.0, 1.0, 0.0], [0.0, 0.1, 0.7]).body(
        0.8,
        [0.004, 0.004, 0.001],
        [0.0, 0.15, 0.55],
    ),
    Link::fixed(2).body(0.4, [0.002, 0.002, 0.0005], [0.0, 0.0, 0.9]),
    Link::general(4, [0.0, 0.0, 1.0], UNIVERSAL).body(
        0.7,
        [0.003, 0.003, 0.002],
        [0.05, 0.0, 1.08],
    ),
]);

/// In single precision, for the target.
pub const TREE_F32: Branching<f32> = TREE.to_f32();

/// A universal joint: θ₁ about x, then θ₂ about the turned y.
pub const UNIVERSAL: GeneralJoint =
    GeneralJoint::new(2, 2, universal_motion::<f32>, universal_motion::<f64>);

/// `R = X(θ₁) Y(θ₂)`; the relative angular velocity in the outboard frame is
/// `ω = Yᵀ(θ₂) e_x β₁ + e_y β₂`, so that `H₁ = (0, Yᵀ e_x) = (0, (c₂, 0, s₂))`, `H₂ = (0, e_y)` and
/// `Ḣβ = (0, (−s₂, 0, c₂)) β₁ β₂`.
fn universal_motion<T: Real>(theta: &[T; 7], beta: &[T; 6]) -> GeneralMotion<T> {
    let turn = AxisTurn::new(theta[1]);
    let (c, s) = (turn.cosine, turn.sine);
    let zero = T::zero();
    let rotation = Rotation::Y(turn)
        .compose(&Rotation::X(AxisTurn::new(theta[0])).compose(&Matrix3::identity()));
    let mut map = [Twist::zero(); 6];
    map[0].angular = Vector3::new(c, zero, s);
    map[1].angular = Vector3::new(zero, T::one(), zero);
    let mut position_rates = [zero; 7];
    position_rates[0] = beta[0];
    position_rates[1] = beta[1];
    GeneralMotion {
        pose: Pose { rotation, position: Vector3::zeros() },
        map,
        map_rate: Twist {
            linear: Vector3::zeros(),
            angular: Vector3::new(-s, zero, c) * (beta[0] * beta[1]),
        },
        position_rates,
    }
}
