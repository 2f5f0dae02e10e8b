//! Foot wrenches within limits: Algorithm 4.5 as a quadratic program.
//!
//! # Notation
//! Frame 1. `w_i = (f, n)`: wrench on foot i that its leg's torques make, moment about its reference
//! point; `c_i`: what the ground gives beside it, because it carries the leg and the foot too; `G`:
//! the feet's wrenches to the one on the central body; `F_d` the desired one; `R̄₀₁` to world axes.
//! ```text
//! minimise  ½ ‖diag(ω) R̄₀₁ (G w − F_d)‖² + ½ ε ‖w − w₀‖²_R + (1/2δ) ‖s‖²           (1)
//! a · (w_i + c_i) ≥ b − s  (contact),    a · w_i ≥ b − s  (torques)                (2)
//! ‖w‖²_R = Σ |f_i|² + |n_i|²/ℓ²;    w₀ the least of this norm with G w₀ = F_d      (3)
//! ```
//! At `w₀` both first terms of (1) are zero, so that where no limit binds the answer is the printed
//! split (4.29) for every ε, with ℓ = 1 m to the bit, and nothing of (1) is computed.
//!
//! Edges and points have fewer unknowns ([`ContactPatch`]). Where they leave a moment that no foot can
//! make, it is not asked for: what is made differs from `F_d` by it.
//!
//! "Limited" is no fault. A fault is a row that gives way by more than its margin
//! ([`Status::Contradiction`](crate::qp::Status)): the legs are too weak for the limits of their feet.
//!
//! # Validity
//! One to eight feet, legs of at most seven joints. f32 with ε = 0.01, δ = 1e-3: w within 1e-3 of its
//! greatest number in 99 % of harsh programs (half: 1e-5); with ε = 1e-3 in 98 %.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use surefoot::balance::{
//!     ContactFoot, ContactLimit, ContactLimits, ContactPatch, ContactProgram, ContactWeights,
//! };
//! use surefoot::qp::{ActiveRows, Settings, solve};
//! use surefoot::spatial::{Twist, Wrench};
//!
//! // Two soles on a floor of friction 0.3, legs that set no limit.
//! let limits = ContactLimits {
//!     least_force: 20.0,
//!     greatest_force: 1200.0,
//!     friction: 0.3,
//!     patch: ContactPatch::sole([-0.1, 0.1], [-0.05, 0.05], -0.03),
//!     torques: [500.0; 6],
//! };
//! let foot = |y| ContactFoot {
//!     rotation: Matrix3::identity(),
//!     position: Vector3::new(0.0, y, -0.9),
//!     joints: [Twist::zero(); 6],
//!     carried: Wrench::zero(),
//!     limits: &limits,
//! };
//! let feet = [Some(foot(-0.15)), Some(foot(0.15))];
//! let (weights, world) = (ContactWeights::standing(), Matrix3::identity());
//! // More sideways force than the floor holds.
//! let force = Vector3::new(0.0, 200.0, 700.0);
//! let desired = Wrench { force, torque: Vector3::new(180.0, 0.0, 0.0) };
//! let program = ContactProgram::new(&feet, &weights, &world, desired).expect("feet nearby");
//! let mut active = ActiveRows::<f64, 16>::new();
//! let solution = solve(&program, &mut active, &Settings::new(1e-3))?;
//! let reason = program.reason(&solution.x, &active).expect("limited");
//! assert!(matches!(reason.limit, ContactLimit::Slip | ContactLimit::Tip));
//! assert!(program.achieved(&solution.x).force.y < 160.0);
//! # Ok::<(), surefoot::qp::Fault>(())
//! ```

mod foot;
mod metric;
mod program;
mod relief;
mod rows;

pub use foot::{ContactFoot, ContactLimits, ContactPatch};
pub use program::ContactProgram;
pub use relief::Reason;
pub(in crate::balance) use relief::{greatest, reliefs};
pub use rows::ContactLimit;
pub(in crate::balance) use rows::{CONTACT_ROWS, first_row, split_row};

use crate::Real;

/// What the split of a wrench is measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactWeights<T> {
    /// `ω`: weights of the wrench's error in world axes, force (1/N) before moment (1/(N·m)).
    pub task: [T; 6],
    /// `ε`: weight of the distance from the least-norm split.
    pub regularization: T,
    /// `ℓ`, m: a moment counts as a force at this length.
    pub norm_length: T,
}

impl<T: Real> ContactWeights<T> {
    /// Vertical force and tilt first, a moment counted with 1/(0.1 … 0.2 m); ε = 0.01; ℓ = 0.1 m, half
    /// a sole, which shifts load between the feet before it tips one.
    pub fn standing() -> Self {
        Self {
            task: [1.0, 1.0, 2.0, 10.0, 10.0, 4.0].map(T::of),
            regularization: T::of(0.01),
            norm_length: T::of(0.1),
        }
    }
}
