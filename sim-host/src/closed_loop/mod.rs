//! The controller in the loop: sampled at its rate, its torques held between ticks.

mod controller;
mod events;
pub mod firmware;
mod outcome;
mod run;

pub use controller::{
    Commanded, ControlFailure, Controller, Costs, HostController, Scalar, controller, measured,
};
pub use outcome::{Failure, Outcome, Peak, Peaks};
pub use run::{Run, run, run_from};
