//! Smaller systems for the same motion: no more bodies and joints than it needs.
//!
//! - [`merged`]: links on fixed joints become one rigid body with what they are fixed to, or part of the world.
//!   The motion is the same, to round-off.
//! - [`rerooted`]: a floating tree that the world holds at some links hangs from them, in place of constraints
//!   beside it; what stands still is then merged with the world. The motion is the same, to round-off.
//! - [`lumped`]: small bodies between hinges whose axes meet in a point are given to their neighbours, and the
//!   hinges become one universal or spherical joint, with the same motors. The motion differs in proportion to
//!   the inertia that turns with another body than its own: it tends to that of the larger system with it.

mod composite;
mod frame;
mod lumped;
mod merged;
mod rebuild;
mod reduced;
mod rerooted;
mod reversal;

pub use frame::Frame;
pub use lumped::{Side, lumped};
pub use merged::merged;
pub use reduced::Reduced;
pub use rerooted::{Rerooted, Seat, rerooted};
