//! The simulator in joint coordinates: the discrete trajectory of [`super::ConstrainedSimulation`], to
//! round-off, without its constraints and multipliers.
//!
//! ```text
//! Coordinates ─ place ─► Place (a step's beginning) ─┐
//!      ▲                                             ├─► Trial ─ evaluate ─► residuals
//!      └ moved ─ Increment ◄─ corrections ◄─ Elimination ◄── stiffness ◄──────┘
//! ```

mod bond;
mod checkpoint;
mod coordinates;
mod elimination;
mod end;
mod forecast;
mod loops;
mod motors;
pub(super) mod newton;
mod node;
mod rates;
mod simulation;
mod stages;
mod step;
mod stiffness;
mod strike;
mod trial;
mod turn;

pub use checkpoint::Checkpoint;
pub use forecast::StepForecast;
pub use simulation::Simulation;
