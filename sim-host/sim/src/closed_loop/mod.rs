//! The controller in the loop: sampled at its rate, its torques held between ticks.

mod acting;
mod aloft;
mod approximate;
mod askew;
mod at_rest;
mod carrying;
mod cause;
mod controller;
mod disturbance;
mod encoders;
mod errors;
mod estimate;
mod estimating;
mod events;
mod filter;
pub mod firmware;
mod friction;
mod gait;
mod inertial;
mod lag;
mod legs_apart;
mod limiting;
mod memory;
mod outcome;
mod plant;
mod run;
mod sensing;

mod supervised;
mod walking;
mod whole_body;
mod whole_body_settings;

pub use acting::{CutTorques, Motors};
pub use aloft::Flights;
pub use approximate::{ApproximateController, Approximation};
pub use at_rest::{RestError, rest_error};
pub use cause::{Cause, Remedy, Runaway, StepTrial, explain};
pub use controller::{
    Commanded, ControlFailure, Controller, Costs, HostController, Scalar, approximate_controller,
    bare_controller, controller, measured,
};
pub use estimating::{EstimateDoubt, EstimateTally};
pub use filter::{FilterPlace, Filtered, SensorReadings};
pub use gait::{Gait, GaitTally};
pub use limiting::{LimitTally, WorstLimit};
pub use outcome::{Failure, Outcome, Peak, Peaks};
pub use plant::plant;
pub use run::{Run, Stop, run, run_from, run_plant};
pub use sensing::Sensors;
pub use supervised::SupervisedController;
