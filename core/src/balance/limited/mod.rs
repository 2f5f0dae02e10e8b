//! A tick within what the ground and the motors can give.
//!
//! ```text
//! state ─► kinematics ─► desired wrench ─► printed split ─► nothing binds? ─► torques of `tick`
//!                                               └─► something binds: ContactProgram ─► torques, cut
//! ```
//! [`limited_tick`] asks for the wrench that [`tick`](super::tick) asks for. While the ground and the
//! motors can give the printed split of it (4.29), that is what is given, to the bit, and limits cost
//! their test alone. Where one binds, the wrenches are those of [`ContactProgram`](super::ContactProgram)
//! around the printed split, so that torques do not leap as limits come and go.
//!
//! Limits are about what the *ground* gives a foot: the wrench of its leg's joints and what the leg's
//! links weigh and resist.
//!
//! # What creeps
//! A foot that bears little slides, and the wrench for feet that stand still would let it go on as it
//! does. Where limits bind, feet are asked to come to rest at [`WrenchLimits::rest_rate`], from the tick
//! after they began to on: until the wrench for feet that stand still is within them again.
//!
//! # Feet in the air
//! A foot that its caller says to be in the air carries nothing: the others share the wrench, which then
//! carries that leg as well, and its joints come to rest where they are. With no foot on the ground all
//! of the wrench is given up.
//!
//! # Bounded
//! A tick spends at most [`WrenchLimits::MOST_WORK`] multiplications on limits, of which every operation
//! makes a fixed number. Where that is not enough, the limits found so far are kept in [`LimitMemory`]
//! for the next tick, torques are cut to the motors' limits, and [`LimitReport::broken`] says what the
//! wrenches break.

mod limits;
mod loads;
mod memory;
mod outside;
mod report;
mod tick;

pub use limits::{Ground, WrenchLimits, WrenchLimitsFault};
pub use memory::{BindingRows, LimitMemory};
pub use report::{BrokenLimit, LimitReport, LimitSet, LimitedCommand};
pub use tick::{limited_tick, limited_tick_under};
