//! The simulator in joint coordinates: the discrete trajectory of [`super::ConstrainedSimulation`], to
//! round-off, without its constraints and multipliers.
//!
//! ```text
//! Coordinates ─ place ─► Place (a step's beginning) ─┐
//!      ▲                                             ├─► Trial ─ evaluate ─► residuals
//!      └ moved ─ Increment ◄─ corrections ◄─ Elimination ◄── stiffness ◄──────┘
//! ```

mod accept;
mod bond;
mod checkpoint;
mod closing_rows;
mod coordinates;
mod driven_loops;
mod elimination;
mod end;
mod equations;
mod forecast;
mod guess;
mod held;
mod loops;
mod motors;
mod node;
mod rates;
mod readings;
mod scales;
mod simulation;
mod stages;
mod step;
mod stiffness;
mod strike;
mod trial;
mod turn;
mod watched;

pub use checkpoint::Checkpoint;
pub use forecast::StepForecast;
pub use simulation::Simulation;
