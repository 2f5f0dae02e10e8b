//! Mechanical integrators, one method a file.

mod energy_momentum;
mod variational;

pub use energy_momentum::EnergyMomentum;
pub use variational::{StepError, Variational};
