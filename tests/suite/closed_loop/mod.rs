//! The controller in the loop with a plant.

mod acting;
mod error_dynamics;
mod experiment_1;
mod experiment_2;
mod hardware;
mod limits;
mod link;
mod parsimony;
mod plants;
mod sensing;
mod stops;
mod supervised;
mod welded;
