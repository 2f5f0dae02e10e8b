//! Instructions of steps: what a run with two copies of a model executes more than one with one copy is that
//! model's steps, and nothing else.

use crate::callgrind::{CountFailure, instructions};
use std::ffi::OsStr;

/// Instructions of one step, the mean over so many seconds of a motion: that of the scene which can be opened by
/// `name`, on the rung of this name.
///
/// # Errors
/// A [`CountFailure`].
pub fn count(name: &str, duration_s: f64, rung: &str, steps: u64) -> Result<u64, CountFailure> {
    let duration = duration_s.to_string();
    let total = |copies: &str| {
        let arguments = ["count-steps", name, rung, copies, "--duration", &duration];
        instructions(&arguments.map(OsStr::new))
    };
    let (one, two) = (total("1")?, total("2")?);
    Ok(two.saturating_sub(one) / steps.max(1))
}
