//! The contact model of §5.2: points against a horizontal floor, each with a state of its own.

mod floor;
mod point;
mod state;

pub use floor::Floor;
pub use point::{ContactPoint, PointForce};
pub use state::{Conditions, ContactState, TRANSITIONS};
