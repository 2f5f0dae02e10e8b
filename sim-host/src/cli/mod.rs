//! The command line of `surefoot`.
//!
//! Results go to stdout, progress and messages to stderr. Exit status: 0 done; 1 the run failed for a stated reason, or
//! stdout could not be written; 2 bad usage or input, or a file that cannot be written; 130 interrupted, with what there
//! is kept; 141 the reader of stdout has gone away.

mod advise;
mod benchmarks;
mod certify;
mod certify_files;
mod chart;
mod controller;
mod count_steps;
mod count_ticks;
mod dynamics;
mod files;
mod import;
mod interrupt;
mod list;
mod model;
mod output;
mod recommended;
mod report;
mod reproduce;
mod run;
mod run_mechanism;
mod show;

use clap::{Parser, Subcommand};
use output::{complain, print, say};
use std::process::ExitCode;

/// Balance control for articulated robots: simulate, close the loop, look.
#[derive(Debug, Parser)]
#[command(name = "surefoot", version)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scene and report (default: experiment-1)
    Run(run::Options),
    /// Print a built-in scene as a file to start from
    Show(show::Options),
    /// Reproduce the dissertation's tables and figures: ours beside the printed ones
    Reproduce(reproduce::Options),
    /// Chart what methods can do
    Chart(chart::Options),
    /// What `chart parsimony` runs under callgrind
    #[command(hide = true)]
    CountSteps(count_steps::Options),
    /// What `chart work-precision` runs under callgrind
    #[command(hide = true)]
    CountTicks(count_ticks::Options),
    /// Advise on a method and a step for a scene and an accuracy
    Advise(advise::Options),
    /// Tell how often a controller fails, and what makes it fail
    Certify(certify::Options),
    /// Import a robot from URDF or MJCF: robot.toml, and robot.rs for firmware
    Import(import::Options),
    /// Kinematics and dynamics of a robot for the states of a file
    Dynamics(dynamics::Options),
    /// List scenes, integrators and robots
    List(list::Options),
}

/// Bad input: said on stderr, or as a JSON document, with exit status 2.
const BAD_INPUT: u8 = 2;
/// A run that failed for a stated reason.
const RUN_FAILED: u8 = 1;

/// Parses the command line and does what it says.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        // Bad usage, on stderr and with status 2; or help, on stdout.
        Err(answer) => {
            let status = ExitCode::from(u8::try_from(answer.exit_code()).unwrap_or(BAD_INPUT));
            return answer.print().map_or_else(|error| output::lost(&error), |()| status);
        }
    };
    match cli.command {
        None => run::run(&run::Options::parse_from(["run"])),
        Some(Command::Run(options)) => run::run(&options),
        Some(Command::Show(options)) => show::show(&options),
        Some(Command::Reproduce(options)) => reproduce::reproduce(&options),
        Some(Command::Chart(options)) => chart::chart(&options),
        Some(Command::CountSteps(options)) => count_steps::count_steps(&options),
        Some(Command::CountTicks(options)) => count_ticks::count_ticks(&options),
        Some(Command::Advise(options)) => advise::advise(&options),
        Some(Command::Certify(options)) => certify::certify(&options),
        Some(Command::Import(options)) => import::run(&options),
        Some(Command::Dynamics(options)) => dynamics::run(&options),
        Some(Command::List(options)) => list::list(&options),
    }
}

/// Reports bad input.
fn bad_input(message: &str, json: bool) -> ExitCode {
    if json {
        let document = serde_json::json!({ "error": { "kind": "bad-input", "message": message } });
        // The status says the same, whoever reads this.
        let _ = print(&format!("{document:#}\n"));
    }
    complain(format_args!("error: {message}"));
    ExitCode::from(BAD_INPUT)
}
