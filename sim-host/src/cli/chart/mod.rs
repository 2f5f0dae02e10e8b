//! `surefoot chart`

mod limits;
mod limits_table;
mod map_picture;
mod maps;
mod parsimony;
mod precision;
mod stability;
mod steps;

use crate::stability::loop_limits::Quantity;
use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

/// Options of `chart`.
#[derive(Debug, Parser)]
pub struct Options {
    /// What to chart
    #[arg(value_enum)]
    what: What,
    /// A robot's scene, built in or a TOML file: of stability, the limits of its control loop, in place of
    /// methods' steps; of parsimony, the motion (default: experiment-1)
    #[arg(long)]
    scene: Option<String>,
    /// Of stability, with `--scene`: only this limit; may be given more than once
    #[arg(long, value_enum, requires = "scene")]
    only: Vec<Quantity>,
    /// Without `--scene`: only the longest steps, or only the maps
    #[arg(long, value_enum, conflicts_with = "scene")]
    part: Option<Part>,
    /// Cells along each side of a map
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u16).range(2..=200))]
    cells: u16,
    /// Forget what an earlier call has found
    #[arg(long)]
    fresh: bool,
    /// Of `work-precision`: only this problem; may be given more than once
    #[arg(long)]
    problem: Vec<String>,
    /// Of `work-precision`: MuJoCo too, on the same models in the same run
    #[arg(long)]
    peers: bool,
    /// Where the tables go
    #[arg(long, default_value = "out/chart")]
    out: PathBuf,
    /// One JSON document instead of a table
    #[arg(long)]
    json: bool,
}

/// What can be charted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum What {
    /// The longest step of each method on each problem, how it fails beyond, and what was foretold, with maps in
    /// two parameters; of a robot's scene, how far its control loop goes
    Stability,
    /// What models of different size cost for one motion, and how far they are off
    Parsimony,
    /// Error against computing time, step and evaluations, of each method on each problem
    WorkPrecision,
    /// Everything that needs no scene: half an hour at most
    All,
}

/// A part of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Part {
    /// The longest step of each method on each problem
    Steps,
    /// The maps in two parameters
    Maps,
}

/// Charts.
pub fn chart(options: &Options) -> ExitCode {
    match (options.what, &options.scene) {
        (What::Stability, None) => stability::chart_stability(options),
        (What::Stability, Some(scene)) => limits::find_limits(scene, options),
        (What::Parsimony, _) => parsimony::chart_parsimony(options),
        (What::WorkPrecision, _) => precision::work_precision(options),
        (What::All, _) => {
            let charts =
                [stability::chart_stability, precision::work_precision, parsimony::chart_parsimony];
            let failed =
                charts.map(|chart| chart(options)).into_iter().find(|c| *c != ExitCode::SUCCESS);
            failed.unwrap_or(ExitCode::SUCCESS)
        }
    }
}
