//! Discrete mechanics (chapter 2): Lagrangians and constraints written once, and everything that
//! follows from them.
//!
//! ```text
//! Lagrangian L(v, v̇), constraints g(v) ─ Midpoint (2.23) or Endpoint (2.45) ─► 𝕃(y, x)
//!      𝕃, g ─ exact derivatives ─► discrete Euler–Lagrange equations, Jacobian, momenta
//! ```

mod discrete_lagrangian;
mod generalized;
mod lagrangian;
mod natural;
mod partials;
pub mod systems;
mod tangent;

pub use discrete_lagrangian::{DiscreteLagrangian, Endpoint, Midpoint};
pub use generalized::{Chart, Generalized};
pub use lagrangian::{Lagrangian, Scalar};
pub use natural::Natural;
pub use partials::{Momenta, augmented, hessian, jacobian, momenta};
pub use tangent::{Displacement, carried, symplectic_form};
