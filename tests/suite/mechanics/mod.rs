//! Chapter 2.

mod convergence;
mod equivalence;
mod invariants;
mod limits;
mod systems;
mod tables;
