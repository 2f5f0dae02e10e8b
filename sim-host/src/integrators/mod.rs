//! Mechanical integrators, one method a file.

mod composition;
mod energy_momentum;
mod rattle;
mod runge_kutta;
mod step_error;
mod variational;

pub use composition::{Composition, YOSHIDA_4, YOSHIDA_6};
pub use energy_momentum::EnergyMomentum;
pub use rattle::Rattle;
pub use runge_kutta::RungeKutta;
pub use step_error::{StepError, StepFailure};
pub use variational::Variational;
