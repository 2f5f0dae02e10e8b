//! The simulator as §5.4 has it: seven coordinates a body, joints as constraints with multipliers, solved by
//! Algorithm 5.1. [`super::Simulation`] makes the same motion for less, and is tested against this one.

mod scales;
mod simulation;
pub(super) mod tree_solver;
mod trial;

pub use simulation::ConstrainedSimulation;
pub use tree_solver::{Correction, Equations, SingularJoint, TreeEquations};
