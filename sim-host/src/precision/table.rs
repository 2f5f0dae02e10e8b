//! Measurements as rows, and the machine that they are of.

use super::survey::Survey;
use serde::Serialize;
use std::io::Write;
use std::path::Path;

#[derive(Serialize)]
struct Row<'a> {
    problem: &'a str,
    method: &'a str,
    step_s: f64,
    tolerance: Option<f64>,
    error: Option<f64>,
    seconds_per_simulated_second: Option<f64>,
    least_seconds: Option<f64>,
    spread: Option<f64>,
    repeats: Option<u32>,
    evaluations_per_simulated_second: f64,
    newton_mean: Option<f64>,
    newton_most: Option<u32>,
    split_steps: u64,
    energy_band_j: Option<f64>,
    energy_slope_j_per_s: Option<f64>,
    momentum_drift: Option<f64>,
    constraint: Option<f64>,
    failure: Option<&'a str>,
}

/// Writes all measurements as CSV.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_rows(path: &Path, surveys: &[Survey]) -> Result<(), String> {
    surefoot_sim::written::write_rows(path, |writer| rows(writer, surveys))
}

fn rows<W: Write>(writer: &mut csv::Writer<W>, surveys: &[Survey]) -> Result<(), csv::Error> {
    for survey in surveys {
        for curve in survey.curves.iter().chain(&survey.peers) {
            for m in &curve.measurements {
                writer.serialize(Row {
                    problem: &survey.problem,
                    method: &curve.method,
                    step_s: m.step_s,
                    tolerance: m.tolerance,
                    error: m.error,
                    seconds_per_simulated_second: m.time.map(|time| time.median),
                    least_seconds: m.time.map(|time| time.least),
                    spread: m.time.map(|time| time.spread),
                    repeats: m.time.map(|time| time.repeats),
                    evaluations_per_simulated_second: m.evaluations,
                    newton_mean: m.newton_mean,
                    newton_most: m.newton_most,
                    split_steps: m.split_steps,
                    energy_band_j: m.energy_band_j,
                    energy_slope_j_per_s: m.energy_slope_j_s,
                    momentum_drift: m.momentum_drift,
                    constraint: m.constraint,
                    failure: m.failure.as_ref().map(|failure| failure.reason.as_str()),
                })?;
            }
        }
    }
    Ok(())
}

/// This machine and this program, in a line.
pub fn machine() -> String {
    let cpu = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let build = if cfg!(debug_assertions) { "checked" } else { "optimized" };
    format!(
        "surefoot {}, {build} build; {} ({} cores, {} {}); times of one core, which others may share",
        env!("CARGO_PKG_VERSION"),
        cpu.as_deref().unwrap_or("a processor that does not tell its name"),
        cores,
        std::env::consts::OS,
        std::env::consts::ARCH,
    )
}
