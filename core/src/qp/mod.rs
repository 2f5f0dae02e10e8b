//! Quadratic programs.

mod active_rows;
mod dense;
mod factors;
mod ldl;
mod program;
mod solver;

pub use active_rows::ActiveRows;
pub use dense::DenseProgram;
pub use ldl::Ldl;
pub use program::{Program, ProgramCost, RowSet, Search, Violation};
pub use solver::{Fault, Settings, Solution, Status, solve};

/// Multiplications, the measure of work.
pub type Work = u32;
