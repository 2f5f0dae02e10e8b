//! `cargo xtask budget`: what the firmware takes on its target, and whether that is within
//! `tests/budgets.toml`.

mod chips;
mod cycles;
mod document;
mod trace;

use crate::emulator;
use crate::firmware::{self, Robot, Variant};
use crate::image::{self, reachable_panics};
use crate::step::Step;
use crate::toolchain::{TARGET, Toolchain};
use crate::workspace;
use anyhow::{Context, Result, bail, ensure};
use chips::{Chip, ChipBudget};
use clap::Args;
use cycles::{Cycles, MODEL};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How to say it.
#[derive(Args)]
pub struct Options {
    /// Print one JSON document on stdout, and nothing else.
    #[arg(long)]
    json: bool,
    /// Also write the table of chips into docs/chips.md.
    #[arg(long)]
    document: bool,
}

/// Limits, from the file.
#[derive(Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    tick_instructions: u64,
    spread_percent: f64,
    limited_free_instructions: u64,
    limited_mean_instructions: u64,
    limited_tick_instructions: u64,
    tick_cycles: u64,
    stack_bytes: u64,
    flash_bytes: u64,
    ram_bytes: u64,
    panic_paths: usize,
    filter_instructions: u64,
    observer_instructions: u64,
    sensing_stack_bytes: u64,
    walk_mean_instructions: u64,
    walk_tick_instructions: u64,
    walk_stack_bytes: u64,
    /// Of G1, 29 joints, measured by the tests of robots on the target.
    pub g1_stand_instructions: u64,
    /// By chip.
    targets: BTreeMap<String, ChipBudget>,
}

/// The table for compilers that have none of their own.
const OTHER: &str = "other";

/// What the example `budget` measures over the link.
#[derive(Deserialize)]
struct Measured {
    ticks: u64,
    instructions: Instructions,
    limited_ticks: u64,
    limited_free: Instructions,
    limited_active: Instructions,
    per_stage: BTreeMap<String, u64>,
    per_stage_big_base: BTreeMap<String, u64>,
    stack_bytes: u64,
    traced_ticks: usize,
    sensing: Sensing,
    walk: Walk,
}

/// Of an image that estimates the state.
#[derive(Clone, Copy, Deserialize, Serialize)]
struct Sensing {
    /// What the filter takes of a tick, mean.
    filter: f64,
    /// What the observer takes.
    observer: f64,
    /// Of `stand-loaded`, with both.
    tick: Instructions,
    stack_bytes: u64,
}

/// Of an image that walks.
#[derive(Clone, Copy, Deserialize, Serialize)]
struct Walk {
    /// Of `walk`.
    tick: Instructions,
    stack_bytes: u64,
}

/// Instructions of a tick.
#[derive(Clone, Copy, Deserialize, Serialize)]
pub struct Instructions {
    min: u64,
    mean: f64,
    /// Of the slowest tick.
    pub max: u64,
}

/// The document of `--json`.
#[derive(Serialize)]
pub struct Report {
    target: &'static str,
    machine: String,
    compiler: String,
    scalar: &'static str,
    ticks: u64,
    /// Of a tick, over all ticks.
    pub instructions: Instructions,
    spread_percent: f64,
    /// Ticks within limits of ground and motors, pushed.
    limited_ticks: u64,
    /// Of those in which no limit bound.
    limited_free: Instructions,
    /// Of those in which one did.
    limited_active: Instructions,
    per_stage: BTreeMap<String, u64>,
    per_stage_big_base: BTreeMap<String, u64>,
    cycles_estimate: Estimate,
    stack_bytes: u64,
    flash_bytes: u64,
    ram_bytes: u64,
    panic_paths: Vec<String>,
    sensing: Sensing,
    walk: Walk,
    /// By chip.
    targets: BTreeMap<&'static str, Chip>,
    budget: Budget,
}

#[derive(Serialize)]
struct Estimate {
    max: u64,
    microseconds_at_168_mhz: f64,
    load_percent_at_1_khz: f64,
    instructions_by_class: BTreeMap<&'static str, u64>,
    model: &'static str,
}

impl Report {
    /// What is over its limit.
    pub fn broken(&self) -> Vec<String> {
        let budget = &self.budget;
        let mut broken = Vec::new();
        let mut check = |what: &str, value: f64, limit: f64| {
            if value > limit {
                broken.push(format!("{what} {value} > {limit}"));
            }
        };
        check("tick_instructions", self.instructions.max as f64, budget.tick_instructions as f64);
        check("spread_percent", self.spread_percent, budget.spread_percent);
        let (free, active) = (self.limited_free, self.limited_active);
        check("limited_free_instructions", free.mean, budget.limited_free_instructions as f64);
        let mean = budget.limited_mean_instructions;
        check("limited_mean_instructions", active.mean, mean as f64);
        let slowest = budget.limited_tick_instructions;
        check("limited_tick_instructions", active.max as f64, slowest as f64);
        check("tick_cycles", self.cycles_estimate.max as f64, budget.tick_cycles as f64);
        check("stack_bytes", self.stack_bytes as f64, budget.stack_bytes as f64);
        check("flash_bytes", self.flash_bytes as f64, budget.flash_bytes as f64);
        check("ram_bytes", self.ram_bytes as f64, budget.ram_bytes as f64);
        check("panic_paths", self.panic_paths.len() as f64, budget.panic_paths as f64);
        let Sensing { filter, observer, stack_bytes, .. } = self.sensing;
        check("filter_instructions", filter, budget.filter_instructions as f64);
        check("observer_instructions", observer, budget.observer_instructions as f64);
        check("sensing_stack_bytes", stack_bytes as f64, budget.sensing_stack_bytes as f64);
        let Walk { tick, stack_bytes } = self.walk;
        check("walk_mean_instructions", tick.mean, budget.walk_mean_instructions as f64);
        check("walk_tick_instructions", tick.max as f64, budget.walk_tick_instructions as f64);
        check("walk_stack_bytes", stack_bytes as f64, budget.walk_stack_bytes as f64);
        broken.extend(chips::broken(&self.targets, &budget.targets));
        broken
    }
}

/// Measures and prints; an error if something is over its limit.
pub fn run(options: &Options) -> Result<()> {
    let arm = Toolchain::provide(TARGET)?;
    let robot = Robot::of_the_text()?;
    firmware::build(&arm, &robot)?;
    firmware::build_variants(&arm)?;
    firmware::build_for_other_chips(&robot)?;
    let report = measure(&arm)?;
    if options.json {
        println!("{}", serde_json::to_string_pretty(&report)?);
    } else {
        print(&report);
    }
    if options.document {
        document::write(&chips::table(&report.targets))?;
    }
    match report.broken() {
        broken if broken.is_empty() => Ok(()),
        broken => bail!("over budget: {}", broken.join("; ")),
    }
}

/// The limits for this compiler.
pub fn limits(arm: &Toolchain) -> Result<Budget> {
    let path = workspace::root().join("tests/budgets.toml");
    let text = std::fs::read_to_string(&path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let budgets: BTreeMap<String, Budget> =
        toml::from_str(&text).with_context(|| format!("{}", path.display()))?;
    let budget = budgets.get(&arm.release()?).or_else(|| budgets.get(OTHER));
    budget.cloned().with_context(|| format!("{} has no table [{OTHER}]", path.display()))
}

/// Measures the images that have been built with this compiler.
pub fn measure(arm: &Toolchain) -> Result<Report> {
    let machine = format!("{}, netduinoplus2, -icount shift=4", emulator::provide(emulator::ARM)?);
    let (budget, release) = (limits(arm)?, arm.release()?);

    let trace = workspace::root().join("target/firmware/trace.log");
    // What the host does between ticks costs the target nothing.
    let program = workspace::example("budget", workspace::Built::WithTests)?;
    let document = Step::new(program, [&trace]).run_and_read()?;
    let measured: Measured = serde_json::from_str(&document).context("the example's document")?;

    let robot = Robot::of_the_text()?;
    let contents = std::fs::read(Variant::Emulation.path(&robot))?;
    let emulated = image::parse(&contents)?;
    let ticks = trace::ticks(&trace, image::function(&emulated, "TIM2")?, measured.traced_ticks)?;
    std::fs::remove_file(&trace)?;
    let Cycles { most, classes } = cycles::of(&ticks)?;

    let contents = std::fs::read(Variant::Board.path(&robot))?;
    let board = image::parse(&contents)?;
    ensure!(
        !reachable_panics(&board, "main")?.is_empty(),
        "the search for panicking functions is broken: it finds none from the image's start, from \
         where there are some"
    );
    // None in the tick of any of the images.
    let mut panic_paths = reachable_panics(&board, "TIM2")?;
    for robot in firmware::variants()? {
        let contents = std::fs::read(Variant::Emulation.path(&robot))?;
        panic_paths.extend(reachable_panics(&image::parse(&contents)?, "TIM2")?);
    }
    let Instructions { mean, max, .. } = measured.instructions;
    Ok(Report {
        target: TARGET,
        machine,
        compiler: format!("rustc {release}, {arm}"),
        scalar: "f32",
        ticks: measured.ticks,
        instructions: measured.instructions,
        spread_percent: 100.0 * (max as f64 / mean - 1.0),
        limited_ticks: measured.limited_ticks,
        limited_free: measured.limited_free,
        limited_active: measured.limited_active,
        per_stage: measured.per_stage,
        per_stage_big_base: measured.per_stage_big_base,
        cycles_estimate: Estimate {
            max: most,
            microseconds_at_168_mhz: most as f64 / 168.0,
            load_percent_at_1_khz: 100.0 * most as f64 / 168e3,
            instructions_by_class: classes,
            model: MODEL,
        },
        stack_bytes: measured.stack_bytes,
        flash_bytes: image::flash_bytes(&board),
        ram_bytes: image::ram_bytes(&board),
        panic_paths,
        sensing: measured.sensing,
        walk: measured.walk,
        targets: chips::measure(&robot)?,
        budget,
    })
}

/// What the documents say otherwise.
pub fn outdated(report: &Report) -> Result<Option<String>> {
    document::outdated(&chips::table(&report.targets))
}

/// As a table.
pub fn print(report: &Report) {
    let Report { budget, instructions, cycles_estimate, .. } = report;
    println!("{} · {} · {}", report.target, report.machine, report.scalar);
    println!("compiled by {}", report.compiler);
    let row = |what: &str, value: String, limit: String| {
        println!("{what:<34}{value:>12}{limit:>12}");
    };
    row("", "now".into(), "budget".into());
    row(
        "slowest tick, instructions",
        instructions.max.to_string(),
        budget.tick_instructions.to_string(),
    );
    row("mean tick, instructions", format!("{:.1}", instructions.mean), String::new());
    row(
        "slowest above mean, %",
        format!("{:.2}", report.spread_percent),
        budget.spread_percent.to_string(),
    );
    let limited = &report.limited_active;
    row(
        "within limits, none binds: mean",
        format!("{:.1}", report.limited_free.mean),
        budget.limited_free_instructions.to_string(),
    );
    row(
        "within limits, some bind: mean",
        format!("{:.1}", limited.mean),
        budget.limited_mean_instructions.to_string(),
    );
    row(
        "within limits: slowest",
        limited.max.to_string(),
        budget.limited_tick_instructions.to_string(),
    );
    row("tick, cycles (estimate)", cycles_estimate.max.to_string(), budget.tick_cycles.to_string());
    row(
        "  in µs at 168 MHz",
        format!("{:.1}", cycles_estimate.microseconds_at_168_mhz),
        String::new(),
    );
    row("stack, bytes", report.stack_bytes.to_string(), budget.stack_bytes.to_string());
    row("flash, bytes", report.flash_bytes.to_string(), budget.flash_bytes.to_string());
    row("RAM, bytes", report.ram_bytes.to_string(), budget.ram_bytes.to_string());
    row(
        "panicking functions in the tick",
        report.panic_paths.len().to_string(),
        budget.panic_paths.to_string(),
    );
    for function in &report.panic_paths {
        println!("  {function}");
    }
    let Sensing { filter, observer, tick, stack_bytes } = &report.sensing;
    row("filter, mean", format!("{filter:.0}"), budget.filter_instructions.to_string());
    row("observer, mean", format!("{observer:.0}"), budget.observer_instructions.to_string());
    row("with both, loaded: slowest tick", tick.max.to_string(), String::new());
    row("  stack, bytes", stack_bytes.to_string(), budget.sensing_stack_bytes.to_string());
    let Walk { tick, stack_bytes } = &report.walk;
    row("walk, mean", format!("{:.1}", tick.mean), budget.walk_mean_instructions.to_string());
    row("walk, slowest", tick.max.to_string(), budget.walk_tick_instructions.to_string());
    row("  stack, bytes", stack_bytes.to_string(), budget.walk_stack_bytes.to_string());
    for (title, stages) in
        [("fixed foot", &report.per_stage), ("big base", &report.per_stage_big_base)]
    {
        println!("stages, instructions ({title}, each alone)");
        for (stage, cost) in stages {
            println!("  {stage:<32}{cost:>12}");
        }
    }
    println!("instructions by class");
    for (class, count) in &cycles_estimate.instructions_by_class {
        println!("  {class:<32}{count:>12}");
    }
    println!("cycles are an estimate: {}", cycles_estimate.model);
    print!("{}", chips::table(&report.targets));
    println!("over {} ticks, and {} within limits", report.ticks, report.limited_ticks);
}
