//! `cargo xtask peers`: the multibody simulator and MuJoCo, on the same models, in one run on one core.
//!
//! MuJoCo comes from Python's package index into a folder of its own under the target folder; nothing else
//! of the machine is touched. Times are of this machine and of this hour: what can be compared is what one
//! run gives.

mod lock_step;
mod peers_loop;

use crate::step::Step;
use crate::workspace;
use anyhow::{Context, Result};
use clap::Args;
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// How to say it.
#[derive(Args)]
pub struct Options {
    /// Print one JSON document on stdout, and nothing else.
    #[arg(long)]
    json: bool,
    /// Close the loop of a scene with MuJoCo as plant instead, and print the largest pushes that either survives.
    #[arg(long = "loop")]
    is_loop: bool,
    /// Let MuJoCo step the firmware in QEMU over the link instead, and compare each tick with the host's library.
    #[arg(long, conflicts_with = "is_loop")]
    lock_step: bool,
    /// The scene of the loop.
    #[arg(long, default_value = "stand", requires = "is_loop")]
    scene: String,
}

/// The version that the figures in the documents are of.
const MUJOCO: &str = "mujoco==4.0.0";
/// Seconds for the download, and for either side's runs.
const INSTALL_LIMIT: u64 = 600;
const RUN_LIMIT: u64 = 1200;

/// Ours: a row for each model, and for each long run.
#[derive(Deserialize)]
struct Ours {
    steps: Vec<OurStep>,
    energy: Vec<OurRun>,
}

#[derive(Deserialize)]
struct OurStep {
    model: String,
    us_per_step: f64,
    newton: f64,
}

#[derive(Deserialize)]
struct OurRun {
    step_s: f64,
    energy_error_j: f64,
    computing_s_per_s: f64,
}

/// Theirs.
#[derive(Deserialize)]
struct Theirs {
    version: String,
    steps: Vec<TheirStep>,
    energy: Vec<TheirRun>,
}

#[derive(Deserialize)]
struct TheirStep {
    model: String,
    integrator: String,
    us_per_step: f64,
}

#[derive(Deserialize)]
struct TheirRun {
    integrator: String,
    step_s: f64,
    seconds: f64,
    energy_error_j: Option<f64>,
    computing_s_per_s: f64,
}

/// Runs both sides and prints.
pub fn run(options: &Options) -> Result<()> {
    let folder = workspace::root().join("target").join("peers");
    std::fs::create_dir_all(&folder)?;
    let python = mujoco(&folder)?;
    if options.is_loop {
        return peers_loop::run(&options.scene, &folder, &python, options.json);
    }
    if options.lock_step {
        return lock_step::run(&folder, &python);
    }
    let build = ["build", "--release", "--package", "surefoot-tests", "--example", "peers"];
    let programs = workspace::executables(workspace::cargo(build), [])?;
    let program = programs.first().context("cargo has built no program")?;
    let models = folder.join("models");
    let ours = Step::new(program, [&models]).within(RUN_LIMIT).run_and_read()?;
    let our_file = folder.join("ours.json");
    std::fs::write(&our_file, &ours)?;
    let script = workspace::root().join("tests").join("peers").join("mujoco_rows.py");
    let theirs =
        Step::new(&python, [&script, &models, &our_file]).within(RUN_LIMIT).run_and_read()?;
    if options.json {
        let parse = |text: &str| serde_json::from_str::<Value>(text);
        let both = json!({ "surefoot": parse(&ours)?, "mujoco": parse(&theirs)? });
        println!("{}", serde_json::to_string_pretty(&both)?);
    } else {
        print(&serde_json::from_str(&ours)?, &serde_json::from_str(&theirs)?);
    }
    Ok(())
}

/// A Python with MuJoCo, which is installed into a folder of its own where it is missing.
fn mujoco(folder: &Path) -> Result<PathBuf> {
    let python = folder.join("python").join("bin").join("python");
    if !Step::new(&python, ["-c", "import mujoco"]).succeeds() {
        let place = folder.join("python");
        Step::new("python3", ["-m", "venv"]).args([&place]).within(INSTALL_LIMIT).run().context(
            "MuJoCo comes as a Python package: Python 3 with its module venv is needed for it",
        )?;
        Step::new(&python, ["-m", "pip", "install", "--quiet", MUJOCO])
            .within(INSTALL_LIMIT)
            .run_silently()?;
    }
    Ok(python)
}

fn print(ours: &Ours, theirs: &Theirs) {
    println!("µs a step of 1 ms, one core; MuJoCo {}", theirs.version);
    println!(
        "{:<14}{:>10}{:>9}{:>9}{:>14}{:>9}",
        "model", "surefoot", "(Newton)", "Euler", "implicitfast", "RK4"
    );
    for OurStep { model, us_per_step, newton } in &ours.steps {
        let of = |integrator: &str| {
            let row = theirs.steps.iter().find(|r| r.model == *model && r.integrator == integrator);
            row.map_or(f64::NAN, |row| row.us_per_step)
        };
        println!(
            "{model:<14}{us_per_step:>10.2}{newton:>9.2}{:>9.2}{:>14.2}{:>9.2}",
            of("Euler"),
            of("implicitfast"),
            of("RK4")
        );
    }
    println!(
        "\nlargest error of energy of the chain of ten over 1e5 of our steps, and computing time a"
    );
    println!(
        "simulated second; MuJoCo's cheapest run that is at least as accurate, over the same time"
    );
    for OurRun { step_s, energy_error_j, computing_s_per_s } in &ours.energy {
        println!(
            "surefoot at {step_s} s: {energy_error_j:.1e} J, {:.2} ms",
            1e3 * computing_s_per_s
        );
        for integrator in ["Euler", "implicitfast", "RK4"] {
            let same_time = |row: &&TheirRun| {
                row.integrator == integrator && (row.seconds / (step_s * 1e5) - 1.0).abs() < 1e-6
            };
            let as_good =
                |row: &&TheirRun| row.energy_error_j.is_some_and(|e| e <= *energy_error_j);
            let best = theirs
                .energy
                .iter()
                .filter(same_time)
                .filter(as_good)
                .min_by(|a, b| a.computing_s_per_s.total_cmp(&b.computing_s_per_s));
            match best {
                Some(row) => println!(
                    "  {integrator:<14}at {:.1e} s: {:.1e} J, {:.2} ms, {:.2} times ours",
                    row.step_s,
                    row.energy_error_j.unwrap_or(f64::NAN),
                    1e3 * row.computing_s_per_s,
                    row.computing_s_per_s / computing_s_per_s
                ),
                None => println!("  {integrator:<14}at no step tried"),
            }
        }
    }
}
