//! What the page's tables say.

use super::Report;
use crate::experiments::{Comparison, printed_figures, reading};
use surefoot_sim::closed_loop::{Gait, Peaks, Run};
use surefoot_sim::record::{Event, Settling};
use surefoot_sim::robot::Robot;
use surefoot_sim::scene::{Feet, TorquesFrom};

/// A line of the summary.
pub(super) struct Fact {
    pub(super) name: &'static str,
    pub(super) value: String,
}

/// The summary.
pub(super) fn facts(report: &Report<'_>) -> Vec<Fact> {
    let Report { scene, controller, run, .. } = report;
    let mut facts = Vec::new();
    let mut add = |name, value: String| facts.push(Fact { name, value });
    if let Some(gait) = &run.gait {
        let Gait { speed_m_s, steps, distance_m, tilt_deg, cost_of_transport, .. } = gait;
        add("walked", format!("{distance_m:.2} m in {steps} steps"));
        add("speed", format!("{speed_m_s:.2} m/s over the second half of the walk"));
        add("largest tilt", format!("{tilt_deg:.1}°"));
        if let Some(cost) = cost_of_transport {
            add("cost of transport", format!("{cost:.2} (work over weight and way)"));
        }
    } else if let Some(last) = run.samples.last() {
        let (distance, angle) = (1e3 * last.error_distance(), last.error_angle().to_degrees());
        add("final error", format!("{distance:.4} mm, {angle:.5}° (asked for: 1 mm, 0.1°)"));
        let Settling { position_s, orientation_s } = Settling::of(&run.samples);
        let settled = |time: Option<f64>| match time {
            Some(time) if time >= last.time_s => "not settled".to_owned(),
            Some(time) => format!("from {time:.3} s on"),
            None => "from the start".to_owned(),
        };
        add("position within 1 mm", settled(position_s));
        add("orientation within 0.1°", settled(orientation_s));
    }
    add("simulated", format!("{} s, {}", scene.duration_s, reading(scene.controller.torques_from)));
    let (method, step) = (scene.integrator.name.name(), 1e3 * scene.integrator.step_s);
    add("method", format!("{method}, steps of {step} ms"));
    if let Some(progress) = &run.progress {
        let (mean, most) = (progress.mean_iterations(), progress.most_iterations);
        add("Newton iterations", format!("{mean:.2} on average, {most} at most"));
    }
    add("controller", format!("{controller}, {} Hz", scene.controller.rate_hz));
    if let Some(costs) = &run.costs {
        add("on the target", format!("{} to {} {} a tick", costs.min, costs.max, costs.unit));
    }
    let seconds = run.wall.as_secs_f64();
    let per_step = 1e6 * seconds / run.steps.max(1) as f64;
    add("cost", format!("{} steps in {seconds:.2} s: {per_step:.1} µs a step", run.steps));
    add("feet", feet(&scene.feet));
    facts
}

fn feet(feet: &Feet) -> String {
    match feet {
        Feet::Floor { outline, floor } => {
            let soles = outline.map_or(String::new(), |outline| format!(", soles {outline:?}"));
            format!("on a floor with friction {}{soles}", floor.static_friction)
        }
        Feet::Welded {} => "held where they start".to_owned(),
    }
}

/// Peaks of the desired wrench and of all joints: name, value and time.
pub(super) fn peaks(robot: &Robot, run: &Run) -> Vec<[String; 3]> {
    let Some(peaks) = Peaks::of(&run.samples) else { return Vec::new() };
    let row = |name: String, peak: surefoot_sim::closed_loop::Peak, unit: &str| {
        let value = with_minus(&format!("{:.1} {unit}", peak.value));
        [name, value, format!("{:.3} s", peak.time_s)]
    };
    let mut rows = vec![row("desired force along z".to_owned(), peaks.force_z, "N")];
    for (axis, peak) in ["x", "y", "z"].iter().zip(peaks.torque) {
        rows.push(row(format!("desired torque about {axis}"), peak, "N·m"));
    }
    for (joint, peak) in robot.joints.iter().zip(peaks.joints) {
        rows.push(row(joint.clone(), peak, "N·m"));
    }
    rows
}

/// A printed figure beside ours.
pub(super) struct Printed {
    pub(super) name: String,
    pub(super) printed: String,
    /// One a reading.
    pub(super) ours: Vec<Ours>,
}

/// Ours, and how far from the printed figure.
pub(super) struct Ours {
    pub(super) value: String,
    pub(super) difference: String,
}

/// Printed figures beside those of each reading's run; empty where the text prints none.
pub(super) fn printed(scene: &str, runs: &[(TorquesFrom, &Run)]) -> Vec<Printed> {
    let columns: Vec<Vec<Comparison>> =
        runs.iter().map(|(_, run)| printed_figures(scene, run)).collect();
    let Some(first) = columns.iter().find(|rows| !rows.is_empty()) else { return Vec::new() };
    let of_row = |row: &Comparison| Printed {
        name: row.figure.clone(),
        printed: with_minus(&format!("{} {}", row.printed, row.unit)),
        // A run without samples has no rows.
        ours: columns
            .iter()
            .map(|rows| ours(rows.iter().find(|other| other.figure == row.figure)))
            .collect(),
    };
    first.iter().map(of_row).collect()
}

fn ours(row: Option<&Comparison>) -> Ours {
    let Some(row) = row else { return Ours { value: String::new(), difference: String::new() } };
    Ours {
        value: with_minus(&row.ours_text()),
        difference: row.relative_difference.map_or_else(
            || "–".to_owned(),
            |difference| with_minus(&format!("{:+.1}%", 100.0 * difference)),
        ),
    }
}

/// With a minus sign as wide as the figures.
pub(super) fn with_minus(number: &str) -> String {
    number.replace('-', "−")
}

/// Events of one place.
pub(super) struct Place {
    pub(super) name: String,
    pub(super) events: Vec<Moment>,
}

/// An event.
pub(super) struct Moment {
    pub(super) time: String,
    pub(super) what: String,
}

/// Events by place, in the order in which places come up.
pub(super) fn places(events: &[Event]) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::new();
    for event in events {
        let moment = Moment { time: format!("{:.4}", event.time_s), what: event.kind.to_string() };
        match places.iter_mut().find(|place| place.name == event.place) {
            Some(place) => place.events.push(moment),
            None => places.push(Place { name: event.place.clone(), events: vec![moment] }),
        }
    }
    places
}
