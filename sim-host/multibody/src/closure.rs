//! Joints that close loops, and constraints of a user's own.

use super::body::BodyState;
use super::gimbal::Gimbal;
use super::joint::{Joint, JointConstraint, Rows};
use super::system::WORLD;
use num_dual::Dual64;
use std::sync::Arc;

/// Constraints between two bodies, written once and differentiated exactly.
pub trait ConstraintFunction: std::fmt::Debug + Send + Sync {
    /// How many constraints: 1 to 6.
    fn constraints(&self) -> usize;

    /// What should be zero for these states (position, then unit quaternion, scalar first) of the outboard
    /// and the inboard body, the world being at the origin; entries beyond the constraints are ignored.
    fn evaluate(&self, outboard: &[Dual64; 7], inboard: &[Dual64; 7]) -> [Dual64; 6];
}

/// What a closure keeps.
#[derive(Clone, Debug)]
pub enum Closing {
    /// What a joint does.
    Joint(Joint),
    /// Anything else.
    General(Arc<dyn ConstraintFunction>),
}

/// A constraint beside the tree: it closes a loop.
#[derive(Clone, Debug)]
pub struct Closure {
    /// One link.
    pub outboard: usize,
    /// The other; none for the world.
    pub inboard: Option<usize>,
    /// What it keeps.
    pub closing: Closing,
}

/// Motors of a joint that closes a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosingMotors {
    /// The closure's number.
    pub closure: usize,
    /// Axes of a spherical joint's motors; none for other joints.
    pub gimbal: Option<Gimbal>,
}

impl ClosingMotors {
    /// Whether a closure can have them.
    pub(super) fn fit(&self, closure: &Closure) -> bool {
        let Closing::Joint(joint) = &closure.closing else { return false };
        match joint.constraint {
            JointConstraint::Revolute { .. } | JointConstraint::Universal { .. } => {
                self.gimbal.is_none()
            }
            JointConstraint::Spherical => self.gimbal.is_some(),
            _ => false,
        }
    }
}

impl Closure {
    /// How many constraints it has.
    pub fn constraints(&self) -> usize {
        match &self.closing {
            Closing::Joint(joint) => joint.constraints(),
            Closing::General(function) => function.constraints().min(6),
        }
    }

    /// The two bodies' states or rates out of all; `world` for the world's.
    pub(super) fn ends<'a>(
        &self,
        all: &'a [BodyState],
        world: &'a BodyState,
    ) -> (&'a BodyState, &'a BodyState) {
        (&all[self.outboard], self.inboard.map_or(world, |i| &all[i]))
    }

    /// Constraints and their derivatives where all bodies are.
    pub(super) fn at(&self, states: &[BodyState]) -> Rows {
        let (outboard, inboard) = self.ends(states, &WORLD);
        self.rows(outboard, inboard)
    }

    /// Constraints and their derivatives.
    pub(super) fn rows(&self, outboard: &BodyState, inboard: &BodyState) -> Rows {
        let function = match &self.closing {
            Closing::Joint(joint) => return joint.rows(outboard, inboard),
            Closing::General(function) => function,
        };
        let mut rows = Rows { error: [0.0; 6], outboard: [[0.0; 7]; 6], inboard: [[0.0; 7]; 6] };
        let constraints = self.constraints();
        for i in 0..14 {
            let seeded = |x: &BodyState, first: usize| -> [Dual64; 7] {
                std::array::from_fn(|k| Dual64::new(x[k], f64::from(u8::from(first + k == i))))
            };
            let g = function.evaluate(&seeded(outboard, 0), &seeded(inboard, 7));
            for c in 0..constraints {
                rows.error[c] = g[c].re;
                if i < 7 {
                    rows.outboard[c][i] = g[c].eps;
                } else {
                    rows.inboard[c][i - 7] = g[c].eps;
                }
            }
        }
        rows
    }
}
