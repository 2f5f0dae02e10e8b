//! Mechanical integrators, one method a file behind one trait, and all of them by name.

mod branch;
mod composition;
mod constrained_drift;
mod dormand_prince;
mod energy_momentum;
mod implicit_midpoint;
mod integrator;
mod lie_group;
mod method;
mod projection;
mod rattle;
mod runge_kutta;
mod scale;
mod semi_implicit_euler;
mod shake;
mod start;
mod step_error;
mod variational;

pub use composition::{Composition, YOSHIDA_4, YOSHIDA_6, longest_stage};
pub use dormand_prince::DormandPrince;
pub use energy_momentum::EnergyMomentum;
pub use implicit_midpoint::ImplicitMidpoint;
pub use integrator::{Integrator, Progress};
pub use lie_group::LieGroup;
pub use method::Method;
pub use rattle::Rattle;
pub use runge_kutta::RungeKutta;
pub use semi_implicit_euler::SemiImplicitEuler;
pub use shake::{Form, Shake};
pub use start::ADAPTIVE_TOLERANCE;
pub use start::{Motion, StartError, start_free_body, start_lagrangian, start_natural};
pub use step_error::{StepError, StepFailure};
pub use variational::Variational;
