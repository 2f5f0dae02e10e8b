//! The contact model of §5.2: points against a horizontal floor, or the faces of a box, each with a state of
//! its own.
//!
//! [`ContactPoint::evaluate`] gives the force at an instant, for explicit methods;
//! [`ContactPoint::over_step`] that of a step of an implicit one, with its derivative. A [`GroundPlane`] gives the
//! same for a floor that is not level.

mod floor;
mod plane;
mod point;
mod state;
mod step_force;
mod yielding_box;

pub use floor::Floor;
pub use plane::GroundPlane;
pub use point::{ContactPoint, PointForce};
pub use state::{Conditions, ContactState, TRANSITIONS};
pub use step_force::{StepForce, Switching};
pub use yielding_box::{BoxForce, BoxPoint, Face, YieldingBox};
