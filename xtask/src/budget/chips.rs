//! What the firmware takes on each chip that it has an image for, and whether it has the host's bits there.

use super::Instructions;
use crate::firmware::{Robot, Variant};
use crate::step::Step;
use crate::{image, workspace};
use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Limits of a chip, from the file.
#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ChipBudget {
    instructions: u64,
    limited_instructions: u64,
    stack_bytes: u64,
    flash_bytes: u64,
}

/// What the example `chips` measures over the link.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Measured {
    core: String,
    ticks: u64,
    instructions: Instructions,
    limited_instructions: Instructions,
    stack_bytes: u64,
    bits_equal: bool,
}

/// A chip's part of the document of `--json`.
#[derive(Serialize)]
pub struct Chip {
    core: String,
    target: &'static str,
    /// In both scenes.
    ticks: u64,
    /// Of a tick in Experiment 1.
    instructions: Instructions,
    /// Of a tick within limits of ground and motors, pushed so that they bind.
    limited_instructions: Instructions,
    /// Of the whole firmware.
    stack_bytes: u64,
    /// Of the image.
    flash_bytes: u64,
    /// Panicking functions that the tick's handler can reach.
    panic_paths: Vec<String>,
    /// Torques, wrenches, stops and what limits made of each tick, beside the host's controller.
    bits_equal: bool,
}

/// Measures the images that have been built.
pub fn measure(robot: &Robot) -> Result<BTreeMap<&'static str, Chip>> {
    // What the host does between ticks costs the target nothing.
    let program = workspace::example("chips", workspace::Built::WithTests)?;
    let document = Step::new(program, [""; 0]).run_and_read()?;
    let mut measured: BTreeMap<String, Measured> =
        serde_json::from_str(&document).context("the example's document")?;
    let mut chips = BTreeMap::new();
    for variant in [Variant::Emulation].iter().chain(&Variant::OTHERS) {
        let Measured { core, ticks, instructions, limited_instructions, stack_bytes, bits_equal } =
            measured.remove(variant.name()).context("an image that the example does not run")?;
        // The reference board has an image of its own, without the emulator's part.
        let (name, shipped) = match variant {
            Variant::Emulation => ("stm32f405", Variant::Board),
            other => (other.name(), *other),
        };
        let path = shipped.path(robot);
        let contents = std::fs::read(&path).with_context(|| path.display().to_string())?;
        let image = image::parse(&contents)?;
        let panic_paths = image::reachable_panics(&image, handler(*variant))?;
        let flash_bytes = image::flash_bytes(&image);
        let target = variant.target();
        chips.insert(
            name,
            Chip {
                core,
                target,
                ticks,
                instructions,
                limited_instructions,
                stack_bytes,
                flash_bytes,
                panic_paths,
                bits_equal,
            },
        );
    }
    ensure!(measured.is_empty(), "the example runs images that are none");
    Ok(chips)
}

/// What makes a tick in the image.
fn handler(variant: Variant) -> &'static str {
    match variant {
        Variant::Mps2An505 | Variant::Mps2An500 => "PendSV",
        Variant::VirtRv32 => "MachineSoft",
        _ => "TIM2",
    }
}

/// What is over its limit.
pub fn broken(
    chips: &BTreeMap<&'static str, Chip>,
    budgets: &BTreeMap<String, ChipBudget>,
) -> Vec<String> {
    let mut broken = Vec::new();
    for (name, chip) in chips {
        if !chip.bits_equal {
            broken.push(format!("{name} has not the host's bits"));
        }
        if let Some(function) = chip.panic_paths.first() {
            broken.push(format!("{name}: the tick can reach {function}"));
        }
        let Some(budget) = budgets.get(*name) else {
            broken.push(format!("{name} has no budget"));
            continue;
        };
        for (what, value, limit) in [
            ("instructions", chip.instructions.max, budget.instructions),
            ("limited_instructions", chip.limited_instructions.max, budget.limited_instructions),
            ("stack_bytes", chip.stack_bytes, budget.stack_bytes),
            ("flash_bytes", chip.flash_bytes, budget.flash_bytes),
        ] {
            if value > limit {
                broken.push(format!("{name}: {what} {value} > {limit}"));
            }
        }
    }
    broken
}

/// As a table of Markdown, which `docs/chips.md` has.
pub fn table(chips: &BTreeMap<&'static str, Chip>) -> String {
    let mut table = "| core | board | instructions a tick, mean | slowest | within limits, slowest | stack, bytes | \
                     flash, bytes | bits of the host |\n|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for (name, chip) in chips {
        let bits = if chip.bits_equal { "yes" } else { "NO" };
        table += &format!(
            "| {} | {name} | {:.0} | {} | {} | {} | {} | {bits} |\n",
            chip.core,
            chip.instructions.mean,
            chip.instructions.max,
            chip.limited_instructions.max,
            chip.stack_bytes,
            chip.flash_bytes,
        );
    }
    table
}
