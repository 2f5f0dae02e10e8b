//! What stands on the simulator of `surefoot`: the command line, reports, charts and instruments.
//!
//! ```text
//! surefoot-mechanics ─► surefoot-multibody ─► surefoot-sim ─► here
//! ```
//! [`stability`] tells how long steps may be, [`precision`] what accuracy costs, [`parsimony`] what models of a
//! motion cost, [`experiments`] repeats those of the text.

pub mod callgrind;
pub mod chart;
pub mod cli;
pub mod experiments;
pub mod parsimony;
pub mod precision;
pub mod report;
pub mod stability;
