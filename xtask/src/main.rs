//! `cargo xtask …`: everything about the project that a script would do.
//!
//! - `test`: installs what is missing, runs every test, compiles core for the target and proves
//!   there that the tick cannot panic.
//! - `firmware`: the firmware's images.
//! - `c`: the controller as a library for C.
//! - `budget`: what the firmware takes on its target, against `tests/budgets.toml`.
//! - `instructions`: instruction counts per call of each algorithm, repeatable to the last digit.
//! - `page`: the controller and its plant in one page of a browser.
//! - `peers`: the multibody simulator beside MuJoCo.
//!
//! Progress goes to stderr, results to stdout. Exit status: 0 all well, 1 something failed and was
//! named, 2 bad usage.

mod apt;
mod budget;
mod c_library;
mod emulator;
mod firmware;
mod image;
mod instructions;
mod page;
mod peers;
mod step;
mod test;
mod tool;
mod toolchain;
mod workspace;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Chores of the surefoot workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", version)]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Run all tests, compile core for the target, and prove that the tick cannot panic there.
    Test(test::Options),
    /// Build the firmware's images of a robot: for a board, and for the emulator.
    Firmware(firmware::Options),
    /// Build the controller of a robot as a library for C, with its headers.
    C(c_library::Options),
    /// Measure what the firmware takes on its target, and compare that with its budget.
    Budget(budget::Options),
    /// Count the instructions of one call of each algorithm, by callgrind.
    Instructions(instructions::Options),
    /// Build the page in which a browser runs the controller and its plant.
    Page,
    /// Time the multibody simulator beside MuJoCo, on the same models in one run.
    Peers(peers::Options),
}

fn main() -> ExitCode {
    let result = match Arguments::parse().chore {
        Chore::Test(options) => test::run(&options),
        Chore::Firmware(options) => firmware::run(&options),
        Chore::C(options) => c_library::run(&options),
        Chore::Budget(options) => budget::run(&options),
        Chore::Instructions(options) => instructions::run(&options),
        Chore::Page => page::run(),
        Chore::Peers(options) => peers::run(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
