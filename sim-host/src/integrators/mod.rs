//! Mechanical integrators, one method a file.

mod composition;
mod energy_momentum;
mod variational;

pub use composition::{Composition, YOSHIDA_4, YOSHIDA_6};
pub use energy_momentum::EnergyMomentum;
pub use variational::{StepError, Variational};
