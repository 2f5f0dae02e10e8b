//! `surefoot chart`

mod limits;
mod limits_table;
mod map_picture;
mod maps;
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
    /// A robot's scene, built in or a TOML file: the limits of its control loop, in place of methods' steps
    #[arg(long)]
    scene: Option<String>,
    /// With `--scene`: only this limit; may be given more than once
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
    let What::Stability = options.what;
    match &options.scene {
        None => stability::chart_stability(options),
        Some(scene) => limits::find_limits(scene, options),
    }
}
