//! The controller in the loop with a plant.

mod acting;
mod bad_ticks;
mod causes;
mod differences;
mod error_dynamics;
mod estimating;
mod experiment_1;
mod experiment_2;
mod falls;
mod hardware;
mod limits;
mod link;
mod loaded;
mod parsimony;
mod plants;
mod sensing;
mod stand;
mod stops;
mod supervised;
mod walks;
mod walks_by_sensors;
mod welded;
