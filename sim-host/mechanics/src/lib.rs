//! Discrete mechanics (chapter 2): Lagrangians and constraints written once, and everything that
//! follows from them.
//!
//! ```text
//! Lagrangian L(v, v̇), constraints g(v) ─ Midpoint (2.23) or Endpoint (2.45) ─► 𝕃(y, x)
//!      𝕃, g ─ exact derivatives ─► discrete Euler–Lagrange equations, Jacobian, momenta
//! ```
#![doc = include_str!("../../../docs/your-own-system.md")]

mod acceleration;
mod action;
mod differentiation;
mod discrete_lagrangian;
pub mod forecast;
mod generalized;
pub mod integrators;
mod lagrangian;
mod natural;
pub mod newton;
mod scalar;
mod symplectic_form;
pub mod systems;

pub use acceleration::{acceleration, saddle};
pub use action::action_sum;
pub use differentiation::{Momenta, augmented, bend, hessian, jacobian};
pub use discrete_lagrangian::{DiscreteLagrangian, Endpoint, Midpoint};
pub use generalized::{Chart, Generalized};
pub use lagrangian::Lagrangian;
pub use natural::Natural;
pub use natural::potential_force;
pub use scalar::Scalar;
pub use symplectic_form::{Displacement, symplectic_form};
