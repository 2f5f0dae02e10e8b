//! What the equations of motion tell that the model does not know: loads, a centre of mass that is elsewhere, the
//! ground's forces.
//!
//! ```text
//! state, torques sent ─► residual of the equations of motion ─► ground's force on each foot ─► contact, tilt
//!                                                     └──────► wrench from outside ─► dynamics, set point
//! ```
//! A [`DisturbanceObserver`] runs these one after another; each stage is public. A robot that uses none
//! of it runs no instruction of it.

mod balance_point;
mod external_wrench;
mod fault;
mod force_contact;
mod friction;
mod ground_forces;
mod observer;
mod residual;

pub use balance_point::{BalancePoint, BalancePointSettings};
pub use external_wrench::{ExternalWrench, ExternalWrenchSettings};
pub use fault::ObserverFault;
pub use force_contact::{ForceContact, ForceThresholds};
pub use friction::{friction_compensation, seen_friction};
pub use ground_forces::{FootForce, ground_forces};
pub use observer::{Disturbance, DisturbanceObserver, DisturbanceSettings};
pub use residual::{Residual, ResidualReading};
