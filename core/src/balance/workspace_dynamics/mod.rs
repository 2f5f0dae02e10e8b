//! Workspace dynamics: how the central body answers a wrench while the feet stand still.
//!
//! `F_1 = P_1 V̇_1 + z_1` (4.2), in frame 1, with `V̇_1` the component derivative of the body twist.
//! Two forms: the printed [`big_base`], and an exactly fixed foot, as inertia and bias
//! ([`fixed_foot_dynamics`]) or, at a third of the cost, as the wrench for one acceleration
//! ([`fixed_foot_wrench`]), which is all that a tick needs.

mod big_base;
mod fixed_foot;
mod hanging_leg;
mod inertial;

pub use big_base::big_base;
pub use fixed_foot::{fixed_foot_dynamics, fixed_foot_wrench};
pub(super) use fixed_foot::{fixed_foot_wrench_of_legs, leg_wrench};
pub(super) use hanging_leg::hanging_leg;
pub(super) use inertial::inertial_wrench;

use crate::Real;
use crate::spatial::{ArticulatedInertia, Twist, Wrench};

/// `P_1` and `z_1`.
#[derive(Clone, Copy, Debug)]
pub struct WorkspaceDynamics<T> {
    /// `P_1`, symmetric and positive definite.
    pub inertia: ArticulatedInertia<T>,
    /// `z_1`
    pub bias: Wrench<T>,
}

impl<T: Real> WorkspaceDynamics<T> {
    /// `P_1 X + z_1` (4.3).
    #[inline(always)]
    pub fn wrench(&self, x: Twist<T>) -> Wrench<T> {
        self.inertia.product(x) + self.bias
    }
}
