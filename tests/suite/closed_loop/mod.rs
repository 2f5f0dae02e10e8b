//! The controller in the loop with a plant.

mod error_dynamics;
mod experiment_1;
mod limits;
mod plants;
