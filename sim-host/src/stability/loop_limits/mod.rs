//! The limits of a control loop: how fast a block may be, how slow the controller, how smooth the floor,
//! and how the loop fails beyond.
//!
//! ```text
//! Scene ─► Survey ─► Cell (quantity × footing) ─► search at h, h/2, … ─► Trial: run, judge
//!             │ └──► Store: finished cells, kept at once      └──► Found: limit, or why there is none
//!             └──► cells in the order of the table
//! ```
//! A value works if the run meets the [`Criterion`]. It is looked for from the easy end of its
//! [`Ladder`] outward, and bisected between the first value that fails and the one before; islands beyond
//! are not looked for. Each limit is that of a step of the simulator that may be halved without moving it
//! by more than the search's [`Tolerance`]; where there is none down to a sixty-fourth, the cell says
//! so.

mod cell;
mod criterion;
mod manner;
mod quantity;
mod resume;
mod search;
mod survey;
mod trial;

pub use cell::{Cell, HALVINGS, Level};
pub use criterion::Criterion;
pub use manner::{BEFORE_S, Ending, LEANING_DEG, Manner, RUNAWAY, RUNAWAY_TICKS, SLIP_M};
pub(super) use manner::{has_flat_sole, runs_away};
pub use quantity::{ACCELEROMETER_NOISE, GYROSCOPE_NOISE, Quantity};
pub(crate) use resume::fingerprint;
pub use resume::{Store, StoreError};
pub use search::{Found, Ladder, Tolerance, search};
pub use survey::{Survey, SurveyError};
pub use trial::{Footing, Loop, Trial, play};
