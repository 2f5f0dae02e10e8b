//! Experiment 1 (§4.3): what the text prints.
//!
//! Its peaks are those of a robot whose torques wait for the floor: with torques from t = 0 the
//! controller asks for 1359.5 N, −36.8 N·m, 152 N·m at the first instant, as a calculation by hand
//! from the printed state does; after a drop of 4.6 mm it asks for what is printed, within 4 %.

use super::comparison::{Asked, Comparison};
use super::foot_events::longest_apart;
use surefoot_sim::closed_loop::{Peaks, Run};
use surefoot_sim::record::EventKind;

/// Index of the right knee among the joints.
const RIGHT_KNEE: usize = 9;

/// Printed figures of Experiment 1 beside those of a run; empty for a run without samples.
pub fn experiment_1(run: &Run) -> Vec<Comparison> {
    let Some(peaks) = Peaks::of(&run.samples) else { return Vec::new() };
    let mut rows = force(run, &peaks);
    rows.insert(1, largest_torque_about_y(&peaks));
    rows.insert(2, knee(&peaks));
    rows.push(toe(run));
    rows
}

/// The rows that belong to one of the eight figures, by its place among them.
pub(super) fn rows_of_figure(figure: usize, run: &Run) -> Vec<Comparison> {
    let Some(peaks) = Peaks::of(&run.samples) else { return Vec::new() };
    match figure {
        0 => vec![toe(run)],
        1 => vec![knee(&peaks), Comparison::new("when", "s", peaks.joints[RIGHT_KNEE].time_s, 0.0)],
        2 => place(run),
        3 => direction(run),
        6 => force(run, &peaks),
        7 => torque(run, &peaks),
        _ => Vec::new(),
    }
}

fn toe(run: &Run) -> Comparison {
    let raised = longest_apart(run, "left foot", EventKind::ToeOff, EventKind::ToeDown);
    Comparison::new("left foot's toe rises", "s", raised.map(|(from, _)| from), 0.18)
}

fn knee(peaks: &Peaks) -> Comparison {
    let ours = peaks.joints[RIGHT_KNEE].value.abs();
    Comparison::new("largest right knee torque", "N·m", ours, 192.0)
}

fn place(run: &Run) -> Vec<Comparison> {
    let Some(last) = run.samples.last() else { return Vec::new() };
    let row = |name: &str, i: usize, printed: f64| {
        Comparison::new(format!("final {name}"), "cm", 1e2 * last.positions[i], printed)
            .asked(Asked::Absolute(0.1))
    };
    vec![row("x", 0, -1.0), row("y", 1, 0.0), row("z", 2, 110.0)]
}

fn direction(run: &Run) -> Vec<Comparison> {
    let Some(last) = run.samples.last() else { return Vec::new() };
    let row = |name: &str, i: usize, printed: f64| {
        Comparison::new(format!("final {name} part"), "", last.positions[3 + i], printed)
            .asked(Asked::Absolute(1e-3))
    };
    vec![row("scalar", 0, 0.99144486), row("x", 1, -0.13052619), row("y", 2, 0.0), row("z", 3, 0.0)]
}

fn force(run: &Run, peaks: &Peaks) -> Vec<Comparison> {
    let mut rows =
        vec![Comparison::new("largest desired vertical force", "N", peaks.force_z.value, 1687.0)];
    if let Some(last) = run.samples.last() {
        let final_force = last.desired_wrench[2];
        rows.push(Comparison::new("final desired vertical force", "N", final_force, 594.0));
    }
    rows
}

fn largest_torque_about_y(peaks: &Peaks) -> Comparison {
    Comparison::new("largest desired torque about y", "N·m", peaks.torque[1].value, -49.0)
}

fn torque(run: &Run, peaks: &Peaks) -> Vec<Comparison> {
    let about = |i: usize| run.samples.iter().map(move |sample| sample.desired_wrench[3 + i]);
    let (low, high) = (about(0).fold(0.0, f64::min), about(0).fold(0.0, f64::max));
    vec![
        largest_torque_about_y(peaks),
        Comparison::new("least desired torque about x", "N·m", low, -20.0),
        Comparison::new("greatest desired torque about x", "N·m", high, 0.0),
        Comparison::new("largest desired torque about z", "N·m", peaks.torque[2].value.abs(), 2.0),
    ]
}
