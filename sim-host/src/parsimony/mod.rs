//! What models of different size cost for one motion, and how far they are apart.
//!
//! ```text
//! scene ─► Rung::of(scene) ─ play(copies) ─► Played: path, steps, time
//!                          └ count ─► instructions a step, by callgrind on this program itself
//! ```

mod ladder;
mod mechanism_ladder;
mod play;
mod saving;
mod step_count;

pub use ladder::{Ladder, Row, climb};
pub use mechanism_ladder::{MechanismLadder, MechanismRow, MechanismRung, climb_mechanism};
pub use play::{PlayFailure, Played, Rung};
pub use saving::Saving;
pub use step_count::count;
