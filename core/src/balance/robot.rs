//! Which robots the controller can balance: a floating body on serial legs of six revolute joints.

use crate::model::{JointKind, Node, Tree};
use nalgebra::Vector3;

/// Joints, and bodies, of a leg.
pub(crate) const LEG: usize = 6;

/// A floating central body with `LEGS` serial legs, each of six revolute joints, as constant data
/// taken from a [`Tree`] whose links are numbered as the dissertation numbers its biped: the central
/// body, then leg after leg from hip to foot.
///
/// ```
/// use surefoot::balance::LeggedRobot;
/// use surefoot::model::robots::biped;
/// const ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
/// const ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32(&biped::TREE_F32);
/// # let _ = ROBOT_F32;
/// ```
/// ```compile_fail
/// use surefoot::balance::LeggedRobot;
/// use surefoot::model::robots::arm;
/// // An arm on a fixed base has no floating body: error at compile time.
/// const ROBOT: LeggedRobot<f64, 1> = LeggedRobot::new(&arm::TREE);
/// let _ = &ROBOT;
/// ```
#[derive(Clone, Copy, Debug)]
pub struct LeggedRobot<T, const LEGS: usize> {
    pub(crate) central: Node<T>,
    pub(crate) legs: [[Node<T>; LEG]; LEGS],
    /// Sum of the distances between a leg's joints, m: the length that makes its Jacobian
    /// dimensionless.
    pub(crate) reach: [T; LEGS],
    pub(crate) gravity: Vector3<T>,
}

impl<const LEGS: usize> LeggedRobot<f64, LEGS> {
    /// Takes the robot from a tree.
    ///
    /// # Panics
    /// At compile time, when used in a `const`, where the tree is not a floating body with `LEGS`
    /// serial legs of six revolute joints.
    pub const fn new<const N: usize, const NQ: usize, const NV: usize>(
        tree: &Tree<f64, N, NQ, NV>,
    ) -> Self {
        let mut robot = assemble(tree, 0.0);
        let mut leg = 0;
        while leg < LEGS {
            let mut reach = 0.0;
            let mut k = 1;
            while k < LEG {
                let [x, y, z] = robot.legs[leg][k].offset.data.0[0];
                reach += crate::model::square_root(x * x + y * y + z * z);
                k += 1;
            }
            assert!(reach > 0.0, "a leg whose joints all lie in one point cannot stand");
            robot.reach[leg] = reach;
            leg += 1;
        }
        robot
    }

    /// The same robot in single precision, from the tree in single precision.
    pub const fn to_f32<const N: usize, const NQ: usize, const NV: usize>(
        &self,
        tree: &Tree<f32, N, NQ, NV>,
    ) -> LeggedRobot<f32, LEGS> {
        let mut robot = assemble(tree, 0.0);
        let mut leg = 0;
        while leg < LEGS {
            robot.reach[leg] = self.reach[leg] as f32;
            leg += 1;
        }
        robot
    }
}

const fn assemble<T: Copy, const LEGS: usize, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    reach: T,
) -> LeggedRobot<T, LEGS> {
    assert!(
        LEGS > 0 && N == 1 + LEG * LEGS,
        "a legged robot is a central body and six links a leg"
    );
    assert!(
        matches!(tree.nodes[0].kind, JointKind::Floating),
        "the first link of a legged robot is its floating central body"
    );
    let mut legs = [[tree.nodes[0]; LEG]; LEGS];
    let mut i = 1;
    while i < N {
        let (leg, k) = ((i - 1) / LEG, (i - 1) % LEG);
        let inboard = if k == 0 { 0 } else { i - 1 };
        assert!(
            matches!(tree.nodes[i].inboard, Some(j) if j == inboard),
            "a leg is a chain: its first link hangs from the central body, each other from the one before"
        );
        assert!(
            matches!(tree.nodes[i].kind, JointKind::Revolute(_)),
            "the joints of a leg are revolute"
        );
        legs[leg][k] = tree.nodes[i];
        i += 1;
    }
    LeggedRobot { central: tree.nodes[0], legs, reach: [reach; LEGS], gravity: tree.gravity }
}
