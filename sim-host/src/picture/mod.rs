//! The robot as a thing to look at: solids on its bodies, stills, the poses that a replay plays.

mod frames;
mod placed;
mod shown;
mod solid;
mod still;
mod view;

pub use frames::frames;
pub use shown::{DESIRED_FORCE_LENGTH, FORCE_LENGTH, Shown, TORQUE_LENGTH};
pub use solid::Solid;
pub use still::still;
