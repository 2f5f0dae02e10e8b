//! `cargo xtask`: everything a script would do, in Rust.

mod arm_toolchain;
mod instructions;
mod panic_free;
mod shell;
mod test;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    command: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Install what is missing, then build and test everything
    Test,
    /// Build core for thumbv7em-none-eabihf and look for panicking paths in its tick
    Target,
    /// Count instructions per call of each algorithm, with callgrind
    Instructions(instructions::Options),
}

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Task::Test => test::test(),
        Task::Target => panic_free::target(),
        Task::Instructions(options) => instructions::instructions(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}
