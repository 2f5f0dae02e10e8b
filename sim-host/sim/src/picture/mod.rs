//! What moves as a thing to look at: solids on its bodies, stills, the poses that a replay plays.

mod frames;
mod moving;
mod of_mechanism;
mod palette;
mod placed;
mod shown;
mod solid;
mod still;
mod view;

pub use frames::frames;
pub use moving::moving;
pub use palette::OKABE_ITO;
pub use shown::{
    DESIRED_FORCE_LENGTH, FORCE_LENGTH, Framing, Moment, Shown, ShownBody, ShownPoint,
    TORQUE_LENGTH, Tracking,
};
pub use solid::Solid;
pub use still::still;
