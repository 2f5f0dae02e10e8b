//! Experiment 1 (§4.3): what the text prints.
//!
//! Its peaks are those of a robot whose torques wait for the floor: with torques from t = 0 the
//! controller asks for 1359.5 N, −36.8 N·m, 152 N·m at the first instant, as a calculation by hand
//! from the printed state does; after a drop of 4.6 mm it asks for what is printed, within 4 %.

use super::Comparison;
use crate::closed_loop::{Peaks, Run};

/// Index of the right knee among the joints.
const RIGHT_KNEE: usize = 9;

/// Printed figures of Experiment 1 beside those of a run; empty for a run without samples.
pub fn experiment_1(run: &Run) -> Vec<Comparison> {
    let Some(peaks) = Peaks::of(&run.samples) else { return Vec::new() };
    let mut rows = vec![
        Comparison::new("largest desired vertical force", "N", peaks.force_z.value, 1687.0),
        Comparison::new("largest desired torque about y", "N·m", peaks.torque[1].value, -49.0),
        Comparison::new(
            "largest right knee torque",
            "N·m",
            peaks.joints[RIGHT_KNEE].value.abs(),
            192.0,
        ),
    ];
    if let Some(last) = run.samples.last() {
        let final_force = last.desired_wrench[2];
        rows.push(Comparison::new("final desired vertical force", "N", final_force, 594.0));
    }
    rows
}
