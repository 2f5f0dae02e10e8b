//! What `run` says: as text for people, as JSON for programs.

use super::controller::Place;
use crate::experiments::{printed_figures, reading};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;
use surefoot_sim::closed_loop::{
    Costs, CutTorques, Gait, Outcome, Peaks, Run, Scalar, WorstLimit, rest_error,
};
use surefoot_sim::record::{Sample, WorstErrors};
use surefoot_sim::scene::{Scene, TorquesFrom};

/// All that a report is made from.
pub struct Report<'a> {
    /// The scene as run.
    pub scene: &'a Scene,
    /// Why it has this method and this step.
    pub reason: &'a str,
    /// What the user should know of the scene.
    pub warnings: &'a [String],
    /// Precision of the controller.
    pub scalar: Scalar,
    /// Where the controller ran.
    pub controller: Place,
    /// The run.
    pub run: &'a Run,
    /// The run in the other reading of the first instant.
    pub other: Option<&'a (TorquesFrom, Run)>,
}

impl<'a> Report<'a> {
    /// The same for the page.
    pub fn page(&self) -> crate::report::Report<'a> {
        let controller = match (self.controller, self.scalar) {
            (Place::Host, Scalar::F32) => "f32, on the host",
            (Place::Host, Scalar::F64) => "f64, on the host",
            (Place::Bare, Scalar::F32) => "f32, on the host, without its supervisor",
            (Place::Bare, Scalar::F64) => "f64, on the host, without its supervisor",
            (Place::Firmware, _) => "f32, on the target",
        };
        crate::report::Report { scene: self.scene, controller, run: self.run, other: self.other }
    }
}

/// The time of the record's last row, s.
fn reached(run: &Run) -> f64 {
    run.samples.last().map_or(0.0, |last| last.time_s)
}

/// Says so where a run ends at another time than its scene's, by more than round-off.
pub(super) fn other_end(wanted_s: f64, reached_s: f64, h: f64, what: &str) -> Option<String> {
    ((wanted_s - reached_s).abs() > 1e-9 * wanted_s)
        .then(|| format!("ended at {reached_s:.6} s, not at {wanted_s} s, in {what} of {h} s"))
}

/// Unknowns of a step: velocities, and constraints beside the tree; none where there is no plant.
fn unknowns(scene: &Scene) -> Option<usize> {
    surefoot_sim::closed_loop::plant(scene).ok().map(|plant| plant.unknowns())
}

/// The summary.
pub fn text(report: &Report<'_>, files: &[PathBuf]) -> String {
    let Report { scene, run, .. } = report;
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = lines(&mut out, report);
    for event in run.events.iter().take(SHOWN_EVENTS) {
        let _ = writeln!(out, "  {:7.4} s  {} {}", event.time_s, event.place, event.kind);
    }
    if run.events.len() > SHOWN_EVENTS {
        let more = run.events.len() - SHOWN_EVENTS;
        let _ = writeln!(out, "  and {more} more events (--json lists all)");
    }
    let _ = tables(&mut out, report);
    let _ = writeln!(out, "\n{}: files", scene.name);
    for file in files {
        let _ = writeln!(out, "  {}", file.display());
    }
    out
}

/// Events that fit a screen.
pub(super) const SHOWN_EVENTS: usize = 12;

fn lines(out: &mut String, report: &Report<'_>) -> std::fmt::Result {
    let Report { scene, run, .. } = report;
    let word = match run.outcome {
        Outcome::Balanced => "BALANCED",
        Outcome::Completed if run.gait.is_some() => "WALKED without a fall",
        Outcome::Completed => "COMPLETED, but not at the set point",
        Outcome::Stopped => "STOPPED by its supervisor",
        Outcome::Interrupted => "INTERRUPTED",
        Outcome::Fell => "FELL",
        Outcome::Failed => "FAILED",
    };
    writeln!(out, "{}: {word}", scene.name)?;
    writeln!(out, "  {}", scene.description)?;
    if let Some(failure) = &run.failure {
        writeln!(out, "  at {:.4} s: {}", failure.time_s, failure.place)?;
        writeln!(out, "  advice: {}", failure.advice)?;
    }
    let tick = 1.0 / scene.controller.rate_hz;
    if let Some(line) = other_end(scene.duration_s, reached(run), tick, "ticks") {
        writeln!(out, "  {line}")?;
    }
    for warning in report.warnings {
        writeln!(out, "  warning: {warning}")?;
    }
    let per_step = run.wall.as_secs_f64() * 1e6 / run.steps.max(1) as f64;
    writeln!(
        out,
        "  {} steps of {} s in {:.2} s ({per_step:.1} µs a step, control included), {}",
        run.steps,
        scene.integrator.step_s,
        run.wall.as_secs_f64(),
        reading(scene.controller.torques_from),
    )?;
    writeln!(out, "  method: {}; {}", scene.integrator.name, report.reason)?;
    let rung = scene.rung();
    let robot = scene.robot();
    let bodies = robot.bodies_of(rung.model);
    writeln!(out, "  model: {}, {bodies} bodies; {}", rung.model, rung.reason)?;
    if let Some(costs) = &run.costs {
        let Costs { unit, per_second, min, mean, max } = *costs;
        write!(out, "  controller on the target: {min} to {max} {unit} a tick")?;
        write!(out, ", {mean:.0} on average")?;
        // What an emulator calls a second is its own affair.
        if unit == "cycles" {
            let slowest = 1e6 * f64::from(max) / f64::from(per_second);
            write!(out, ", {slowest:.0} µs at most")?;
        }
        writeln!(out)?;
    }
    if let Some(gait) = &run.gait {
        let Gait { speed_m_s, steps, distance_m, cost_of_transport, tilt_deg, .. } = gait;
        write!(
            out,
            "  walked {distance_m:.2} m in {steps} steps, {speed_m_s:.3} m/s in the second half"
        )?;
        if let Some(cost) = cost_of_transport {
            write!(out, "; cost of transport {cost:.2}")?;
        }
        writeln!(out, "; tilted by {tilt_deg:.1}° at most")?;
    } else if let Some(last) = run.samples.last() {
        writeln!(
            out,
            "  final error: {:.4} mm, {:.5}°   (asked for: 1 mm, 0.1°)",
            1e3 * last.error_distance(),
            last.error_angle().to_degrees(),
        )?;
    }
    if let Some(WorstErrors { last, worst }) = WorstErrors::of(&run.samples) {
        writeln!(
            out,
            "  estimate: off by {:.2} mm, {:.3}° of tilt at the end; {:.2} mm, {:.3}° at most",
            1e3 * last.position_error_m,
            last.tilt_error_rad.to_degrees(),
            1e3 * worst.position_error_m,
            worst.tilt_error_rad.to_degrees(),
        )?;
    }
    if let Some(first) = run.estimate.as_ref().and_then(|tally| tally.first.as_ref()) {
        writeln!(out, "  the estimator doubts from {:.3} s on: {}", first.time_s, first.what)?;
    }
    let peaks = Peaks::of(&run.samples);
    if let Some((joint, peak)) = peaks.as_ref().and_then(|peaks| peaks.largest_joint(&robot)) {
        writeln!(out, "  largest torque: {joint}, {:.1} N·m at {:.3} s", peak.value, peak.time_s)?;
    }
    if let CutTorques { joint_ticks, first_s: Some(first) } = run.cut_torques {
        writeln!(out, "  torques cut to the motors' limits: {joint_ticks}, from {first} s on")?;
    }
    if let Some(limits) = &run.limits {
        write!(
            out,
            "  limits of floor and motors bound in {:.2} % of the ticks",
            100.0 * limits.active_share
        )?;
        if let Some(WorstLimit { limit, leg, joint, time_s, .. }) = &limits.worst {
            let joint = joint.map_or_else(String::new, |joint| format!(" of joint {joint}"));
            write!(out, ", most of all: {limit}{joint}, {leg}, at {time_s:.3} s")?;
        }
        writeln!(out)?;
    }
    if let Some(progress) = &run.progress {
        writeln!(
            out,
            "  Newton iterations: {:.2} on average, {} at most; {} steps made in shorter ones",
            progress.mean_iterations(),
            progress.most_iterations,
            progress.split_steps,
        )?;
    }
    if run.constraint_max > 0.0 {
        writeln!(out, "  constraints: {:.2e} at most (m or rad)", run.constraint_max)?;
    }
    Ok(())
}

fn tables(out: &mut String, report: &Report<'_>) -> std::fmt::Result {
    let Report { scene, run, other, .. } = report;
    let mut readings = vec![(scene.controller.torques_from, *run)];
    readings.extend(other.iter().map(|(from, run)| (*from, run)));
    for (from, run) in readings {
        let rows = printed_figures(&scene.name, run);
        if rows.is_empty() {
            continue;
        }
        writeln!(out, "\n  {:<34}{:>12}{:>12}{:>9}", reading(from), "ours", "printed", "diff")?;
        for row in rows {
            writeln!(
                out,
                "  {:<34}{:>12}{:>12}{:>9}",
                row.figure,
                row.ours_text(),
                format!("{} {}", row.printed, row.unit),
                percent(row.relative_difference),
            )?;
        }
    }
    Ok(())
}

/// A relative difference, if it means something.
pub fn percent(difference: Option<f64>) -> String {
    difference.map_or_else(|| "–".to_owned(), |difference| format!("{:.1}%", 100.0 * difference))
}

/// The document of `--json`. Keys that have no meaning for a plant are null.
pub fn json(report: &Report<'_>, files: &[PathBuf]) -> Value {
    let Report { scene, scalar, controller, run, other, reason, warnings } = report;
    let (robot, peaks) = (scene.robot(), Peaks::of(&run.samples));
    let last = run.samples.last();
    let rest = last.and_then(|last| rest_error(scene, last));
    let largest = peaks.as_ref().and_then(|peaks| peaks.largest_joint(&robot));
    let peak_torque = largest
        .map(|(joint, peak)| json!({ "value": peak.value, "joint": joint, "time_s": peak.time_s }));
    let other_reading = other.map(|(from, run)| {
        json!({
            "torques_from": from,
            "outcome": run.outcome,
            "printed": printed_figures(&scene.name, run),
        })
    });
    json!({
        "scene": scene.name,
        "integrator": scene.integrator.name,
        "step_s": scene.integrator.step_s,
        "integrator_reason": reason,
        "duration_s": reached(run),
        "requested_duration_s": scene.duration_s,
        "warnings": warnings,
        "scalar": scalar,
        "controller": controller,
        "target": run.costs,
        "torques_from": scene.controller.torques_from,
        "model": scene.rung(),
        "steps": run.steps,
        "outcome": run.outcome,
        "failure": run.failure,
        "cause": run.cause,
        "wall_s": run.wall.as_secs_f64(),
        "wall_us_per_step": run.wall.as_secs_f64() * 1e6 / run.steps.max(1) as f64,
        "newton": run.progress.map(|progress| json!({
            "mean": progress.mean_iterations(),
            "max": progress.most_iterations,
            "split_steps": progress.split_steps,
        })),
        "unknowns_per_step": unknowns(scene),
        "energy": energy(&run.samples),
        "momentum": Value::Null,
        "constraint_max": run.constraint_max,
        "peak_torque_nm": peak_torque,
        "cut_torques": run.cut_torques,
        "limits": run.limits,
        "gait": run.gait,
        "estimate": WorstErrors::of(&run.samples).map(|errors| json!({
            "final": errors.last,
            "worst": errors.worst,
            "feet_made_anew": run.estimate.as_ref().map(|tally| tally.feet_made_anew),
            "doubtful_ticks": run.estimate.as_ref().map(|tally| tally.doubtful_ticks),
            "first_doubt": run.estimate.as_ref().and_then(|tally| tally.first.as_ref()),
        })),
        "supervisor": (*controller != Place::Bare).then(|| json!({
            "stopped": run.stop.is_some(),
            "time_s": run.stop.map(|stop| stop.time_s),
            "reason": run.stop.map(|stop| stop.reason.to_string()),
        })),
        "desired_force_z_n": {
            "max": peaks.map(|peaks| peaks.force_z.value),
            "final": last.map(|sample| sample.desired_wrench[2]),
        },
        "final": {
            "position_error_m": last.map(Sample::error_distance),
            "orientation_error_rad": last.map(Sample::error_angle),
            "com_error_m": rest.map(|rest| rest.center_of_mass[0].hypot(rest.center_of_mass[1])),
            "tilt_error_rad": rest.map(|rest| rest.tilt),
        },
        "events": run.events,
        "printed": printed_figures(&scene.name, run),
        "other_reading": other_reading,
        "files": files,
    })
}

/// Band and slope of the total energy over all samples: a controlled robot's motors do work, so that
/// these say nothing about the method here, but the keys are the same for every scene.
fn energy(samples: &[Sample]) -> Value {
    let totals: Vec<(f64, f64)> =
        samples.iter().map(|s| (s.time_s, s.energy[0] + s.energy[1])).collect();
    let Some(&(_, initial)) = totals.first() else { return Value::Null };
    let high = totals.iter().fold(f64::NEG_INFINITY, |m, (_, e)| m.max(*e));
    let low = totals.iter().fold(f64::INFINITY, |m, (_, e)| m.min(*e));
    let n = totals.len() as f64;
    let mean_t = totals.iter().map(|(t, _)| t).sum::<f64>() / n;
    let mean_e = totals.iter().map(|(_, e)| e).sum::<f64>() / n;
    let covariance: f64 = totals.iter().map(|(t, e)| (t - mean_t) * (e - mean_e)).sum();
    let variance: f64 = totals.iter().map(|(t, _)| (t - mean_t).powi(2)).sum();
    let slope = if variance > 0.0 { Some(covariance / variance) } else { None };
    json!({ "initial_j": initial, "band_j": high - low, "slope_j_per_s": slope })
}
