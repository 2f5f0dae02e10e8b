//! One free body, on a floor or above none: the discrete trajectory of [`super::Simulation`], to round-off, with
//! nothing of a tree.

mod checkpoint;
mod simulation;
mod step;

pub use checkpoint::BodyCheckpoint;
pub use simulation::{NotSingle, SingleBody, SingleBodyError};
