//! Quadratic programs of some tens of unknowns with soft inequalities, solved within a budget.
//!
//! ```text
//! minimise  ½ (x − x₀)ᵀ H (x − x₀) + (1/2δ) ‖s‖²    subject to    A x ≥ b − s
//! ```
//! Knows no physics. A program of this form always has exactly one answer with exactly one set of
//! multipliers `λ`, whatever the rows demand: a row gives way by `s = δ λ`, and rows that contradict
//! each other share what they give. With δ small it is the program with hard rows where that has an
//! answer.
//!
//! - [`solve`]: the dual active set, from no row or from the last call's ([`ActiveRows`]), with a
//!   typed [`Status`] and a budget of work that is kept by construction.
//! - [`Program`]: what the solver has to know. [`DenseProgram`] is a Hessian and rows as numbers; a
//!   program with a structure implements it itself, as
//!   [`ContactProgram`](crate::balance::ContactProgram) does.
//!
//! In f32 the rows' terms times `H⁻¹` should stay below 10⁶ δ, or rows that depend on each other are
//! told apart by round-off alone: multipliers are then wrong among those, x is not.
//!
//! ```
//! use surefoot::qp::{ActiveRows, DenseProgram, Settings, Status, solve};
//!
//! // The point of the unit simplex nearest to (1, 1): x ≥ 0, y ≥ 0, x + y ≤ 1.
//! let program = DenseProgram {
//!     minimum: [1.0, 1.0],
//!     hessian: [[1.0, 0.0], [0.0, 1.0]],
//!     normals: [[1.0, 0.0], [0.0, 1.0], [-1.0, -1.0]],
//!     bounds: [0.0, 0.0, -1.0],
//! };
//! let mut active = ActiveRows::<f64, 2>::new();
//! let settings = Settings::new(1e-9);
//! let first = solve(&program, &mut active, &settings)?;
//! assert_eq!(first.status, Status::Solved);
//! assert!((first.x[0] - 0.5).abs() < 1e-8 && (first.x[1] - 0.5).abs() < 1e-8);
//! let (row, multiplier) = active.iter().next().unwrap();
//! assert!(row == 2 && (multiplier - 0.5).abs() < 1e-8);
//!
//! // The next program is nearly the same, and begins with the rows of this answer.
//! let program = DenseProgram { minimum: [1.1, 1.0], ..program };
//! let next = solve(&program, &mut active, &settings)?;
//! assert_eq!(next.changes, 0);
//!
//! // A budget is kept; what is broken is reported, and the next call goes on.
//! let hurried = Settings { work: 20, ..settings };
//! let answer = solve(&program, &mut ActiveRows::<f64, 2>::new(), &hurried)?;
//! assert_eq!(answer.status, Status::BudgetSpent);
//! assert!(answer.work <= 20 && answer.violation.unwrap().amount > 1.0);
//! # Ok::<(), surefoot::qp::Fault>(())
//! ```

mod active_rows;
mod answer;
mod dense;
mod factors;
mod ldl;
mod program;
mod solver;

pub use active_rows::ActiveRows;
pub use answer::{Fault, Settings, Solution, Status};
pub use dense::DenseProgram;
pub use ldl::Ldl;
pub use program::{Program, ProgramCost, RowSet, Search, Violation};
pub use solver::solve;

/// Multiplications, the measure of work.
pub type Work = u32;
