//! Chapter 2.

mod convergence;
mod equivalence;
mod forces;
mod forecasts;
mod invariants;
mod limits;
mod maps;
mod stability;
mod systems;
mod tables;
