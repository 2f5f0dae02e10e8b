//! Smaller systems for the same motion: no more bodies and joints than it needs.
//!
//! - [`merged`]: links on fixed joints become one rigid body with what they are fixed to. The motion is the
//!   same, to round-off.
//! - [`lumped`]: small bodies between hinges whose axes meet in a point are given to their neighbours, and the
//!   hinges become one universal or spherical joint, with the same motors. The motion differs in proportion to
//!   the inertia that turns with another body than its own: it tends to that of the larger system with it.

mod composite;
mod frame;
mod lumped;
mod merged;
mod rebuild;
mod reduced;

pub use frame::Frame;
pub use lumped::{Side, lumped};
pub use merged::merged;
pub use reduced::Reduced;
