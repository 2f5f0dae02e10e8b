//! Which robots the controller can balance: a floating body on serial legs of six revolute joints.

use crate::model::{JointKind, Node, Tree, vector_to_f32};
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
/// const ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32();
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
    /// Whether some joint's coordinate counts against its frame's axis.
    pub(crate) has_reversed: bool,
    /// Whether some joint has a rotor.
    pub(crate) has_rotors: bool,
    pub(crate) gravity: Vector3<T>,
}

impl<const LEGS: usize> LeggedRobot<f64, LEGS> {
    /// Takes the robot from a tree.
    ///
    /// # Panics
    /// At compile time, when used in a `const`, where [`LeggedRobot::try_new`] gives a fault. For a
    /// tree that is known only when the program runs, use that one.
    pub const fn new<const N: usize, const NQ: usize, const NV: usize>(
        tree: &Tree<f64, N, NQ, NV>,
    ) -> Self {
        match Self::try_new(tree) {
            Ok(robot) => robot,
            Err(fault) => panic!("{}", fault.message()),
        }
    }

    /// The same for a tree from a file or a program.
    ///
    /// # Errors
    /// A [`LeggedRobotFault`] where the tree is not a floating body with `LEGS` serial legs of six
    /// revolute joints.
    pub const fn try_new<const N: usize, const NQ: usize, const NV: usize>(
        tree: &Tree<f64, N, NQ, NV>,
    ) -> Result<Self, LeggedRobotFault> {
        if LEGS == 0 || N != 1 + LEG * LEGS {
            return Err(LeggedRobotFault::Bodies { given: N, needed: 1 + LEG * LEGS });
        }
        if !matches!(tree.nodes[0].kind, JointKind::Floating) {
            return Err(LeggedRobotFault::CentralBody);
        }
        let mut legs = [[tree.nodes[0]; LEG]; LEGS];
        let mut reach = [0.0; LEGS];
        let mut i = 1;
        while i < N {
            let (leg, k) = ((i - 1) / LEG, (i - 1) % LEG);
            let inboard = if k == 0 { 0 } else { i - 1 };
            if !matches!(tree.nodes[i].inboard, Some(j) if j == inboard) {
                return Err(LeggedRobotFault::NoChain { body: i });
            }
            if !matches!(tree.nodes[i].kind, JointKind::Revolute(_)) {
                return Err(LeggedRobotFault::NotRevolute { body: i });
            }
            legs[leg][k] = tree.nodes[i];
            if k > 0 {
                let [x, y, z] = tree.nodes[i].offset.data.0[0];
                let squared = x * x + y * y + z * z;
                if !squared.is_finite() {
                    return Err(LeggedRobotFault::Reach { leg });
                }
                reach[leg] += crate::model::square_root(squared);
            }
            if k == LEG - 1 && reach[leg] == 0.0 {
                return Err(LeggedRobotFault::Reach { leg });
            }
            i += 1;
        }
        Ok(Self {
            central: tree.nodes[0],
            legs,
            reach,
            has_reversed: tree.has_reversed,
            has_rotors: tree.has_rotors,
            gravity: tree.gravity,
        })
    }

    /// The same robot in single precision, every number rounded to the nearest.
    pub const fn to_f32(&self) -> LeggedRobot<f32, LEGS> {
        let mut robot = LeggedRobot {
            central: self.central.rounded(),
            legs: [[self.central.rounded(); LEG]; LEGS],
            reach: [0.0; LEGS],
            has_reversed: self.has_reversed,
            has_rotors: self.has_rotors,
            gravity: vector_to_f32(&self.gravity),
        };
        let mut leg = 0;
        while leg < LEGS {
            robot.reach[leg] = self.reach[leg] as f32;
            let mut k = 0;
            while k < LEG {
                robot.legs[leg][k] = self.legs[leg][k].rounded();
                k += 1;
            }
            leg += 1;
        }
        robot
    }
}

/// Why a tree is no robot that this controller balances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeggedRobotFault {
    /// It has not a central body and six links a leg, or no leg.
    Bodies {
        /// Bodies of the tree.
        given: usize,
        /// One and six a leg.
        needed: usize,
    },
    /// Its first link does not float.
    CentralBody,
    /// Leg after leg, a first link hangs from the central body and each other from the one before:
    /// this body does not.
    NoChain {
        /// Index of the body.
        body: usize,
    },
    /// This body's joint is not revolute.
    NotRevolute {
        /// Index of the body.
        body: usize,
    },
    /// All joints of this leg lie in one point, so that it cannot stand, or too far away to compute
    /// with.
    Reach {
        /// Number of the leg.
        leg: usize,
    },
}

impl LeggedRobotFault {
    const fn message(self) -> &'static str {
        match self {
            Self::Bodies { .. } => "a legged robot is a central body and six links a leg",
            Self::CentralBody => "the first link of a legged robot is its floating central body",
            Self::NoChain { .. } => {
                "a leg is a chain: its first link hangs from the central body, each other from the one before"
            }
            Self::NotRevolute { .. } => "the joints of a leg are revolute",
            Self::Reach { .. } => {
                "a leg whose joints all lie in one point (or at no finite distance) cannot stand"
            }
        }
    }
}

impl core::fmt::Display for LeggedRobotFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let message = self.message();
        match self {
            Self::Bodies { given, needed } => {
                write!(f, "{message}, here {needed} bodies: the tree has {given}")
            }
            Self::CentralBody => f.write_str(message),
            Self::NoChain { body } | Self::NotRevolute { body } => {
                write!(f, "{message}: body {body} (from 0) is not so")
            }
            Self::Reach { leg } => write!(f, "{message}: leg {leg} (from 0)"),
        }
    }
}

impl core::error::Error for LeggedRobotFault {}
