//! The controller in the loop: sampled at its rate, its torques held between ticks.

mod controller;
mod events;
mod outcome;
mod run;

pub use controller::{Commanded, Controller, HostController, Scalar, controller};
pub use outcome::{Failure, Outcome, Peak, Peaks};
pub use run::{Run, run};
