//! The symplectic simulator of multibody systems (§5.4), faithful to the text: a position and a unit
//! quaternion for each body, joints as constraints, Newton steps in linear time.
//!
//! ```text
//! Body, Joint ─► System ─► Simulation ─ residual (5.11), Jacobian (5.13) ─► TreeEquations ─ Alg. 5.1 ─► step
//! ```

mod body;
mod chain;
mod joint;
mod simulation;
mod system;
mod tree_solver;
mod trial;

pub use body::{Body, BodyState};
pub use chain::{Chain, ChainJoint};
pub use joint::{Joint, JointConstraint, MOST_CONSTRAINTS, Rows};
pub use simulation::Simulation;
pub use system::{Link, System, SystemError};
pub use tree_solver::{Correction, Equations, SingularJoint, TreeEquations};
