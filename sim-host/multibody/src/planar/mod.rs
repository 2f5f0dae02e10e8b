//! The simulator of motions that stay in a plane: the discrete trajectory of [`super::Simulation`], to round-off,
//! with three coordinates a body in place of seven, and 3 × 3 matrices in place of 6 × 6 ones.
//!
//! ```text
//! System, start ─ Plane::of ─► Plane, or NotPlanar: the reason
//!                   └─► nodes ─► Trial ─ evaluate ─► residuals ─ Elimination ─► corrections
//! ```

mod algebra;
mod checkpoint;
mod elimination;
mod node;
mod not_planar;
mod plane;
mod rates;
mod scales;
mod simulation;
mod step;
mod stepping;
mod touch;

pub use checkpoint::PlanarCheckpoint;
pub use not_planar::{NotPlanar, PlanarError};
pub use plane::Plane;
pub use simulation::PlanarSimulation;
