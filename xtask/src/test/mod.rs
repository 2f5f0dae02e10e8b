//! `cargo xtask test`: every test of the workspace, stage after stage.

mod browser;
mod budget;
mod c_library;
mod doc_tests;
mod documented;
mod firmware;
mod packages;
mod panic_free;
mod record;
mod robots;
mod target;
mod tests;

use crate::instructions::nothing_unused_runs;
use crate::toolchain::{TARGET, Toolchain};
use crate::workspace::Built;
use anyhow::Result;
use clap::{Args, ValueEnum};
use record::Record;

/// Which stages to run.
#[derive(Args)]
pub struct Options {
    /// Run this stage only (may be given several times).
    #[arg(long, value_name = "STAGE")]
    only: Vec<Stage>,
    /// Leave out what needs a compiler for the target.
    #[arg(long)]
    skip_target: bool,
}

/// A part of the test that can be run on its own.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Stage {
    /// Unit tests and the suite, on the host.
    Tests,
    /// The examples in the documentation, on the host.
    DocTests,
    /// The crates that can be published are whole, and compile with the oldest compiler.
    Packages,
    /// The report's page and its replay, in a browser.
    Browser,
    /// The page in which the controller and its plant run, in a browser; only when named.
    Page,
    /// Robots of other projects, from Python's package index: import, and dynamics against Pinocchio and MuJoCo.
    Robots,
    /// The controller as a library for C: a program of C has the core's bits.
    CLibrary,
    /// Features that a scene does not have execute no instruction, on the host.
    Unused,
    /// Core compiles for the target.
    Target,
    /// No panicking path in the tick, nor in the rest of core, on the target.
    PanicFree,
    /// The firmware in the emulator: equal bits, bounded time, faults.
    Firmware,
    /// The firmware's instructions, stack, flash and RAM against their budget.
    Budget,
    /// Commands of the documents that take minutes or other simulators, each as it stands; only when named.
    Documented,
}

impl Options {
    fn wants(&self, stage: Stage) -> bool {
        let on_target = [Stage::Target, Stage::PanicFree, Stage::Firmware, Stage::Budget];
        let when_named = [Stage::Documented, Stage::Page];
        let is_default = self.only.is_empty() && !when_named.contains(&stage);
        let is_left_out = self.skip_target && on_target.contains(&stage);
        (is_default || self.only.contains(&stage)) && !is_left_out
    }
}

/// Runs the stages. One that fails does not keep the others from running.
pub fn run(options: &Options) -> Result<()> {
    let mut record = Record::default();
    if options.wants(Stage::Tests) {
        record.stage("tests", tests::run);
    }
    if options.wants(Stage::DocTests) {
        record.stage("doc-tests", doc_tests::run);
    }
    if options.wants(Stage::Packages) {
        record.stage("packages", packages::run);
    }
    if options.wants(Stage::Browser) {
        record.stage("browser", browser::run);
    }
    if options.wants(Stage::Page) {
        record.stage("page", browser::of_page);
    }
    if options.wants(Stage::Robots) {
        record.stage("robots", robots::run);
    }
    if options.wants(Stage::CLibrary) {
        record.stage("c-library", c_library::run);
    }
    if options.wants(Stage::Unused) {
        // Of the tests' own build, which is minutes quicker than the program as it ships.
        record.stage("unused", || nothing_unused_runs(Built::WithTests));
    }
    let on_target = [Stage::Target, Stage::PanicFree, Stage::Firmware, Stage::Budget];
    if on_target.into_iter().any(|stage| options.wants(stage)) {
        let arm = record.stage("toolchain", || Toolchain::provide(TARGET));
        if let Some(arm) = &arm {
            if options.wants(Stage::Target) {
                record.stage("target", || target::run(arm));
            }
            if options.wants(Stage::PanicFree) {
                record.stage("panic-free", || panic_free::run(arm));
            }
            if options.wants(Stage::CLibrary) {
                record.stage("c-library-target", c_library::on_target);
            }
            if options.wants(Stage::Firmware) {
                record.stage("firmware", || firmware::run(arm));
            }
            if options.wants(Stage::Budget) {
                record.stage("budget", || budget::run(arm));
            }
        }
    }
    if options.wants(Stage::Documented) {
        record.stage("documented", documented::run);
    }
    record.finish()
}
