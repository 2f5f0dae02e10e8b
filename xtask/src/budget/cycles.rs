//! How many cycles instructions take on a Cortex-M4F: an estimate from its reference manual.

use super::trace::Executed;
use anyhow::{Result, bail};
use std::collections::BTreeMap;

/// The model in a line, for reports.
pub const MODEL: &str = "Cortex-M4 r0p1 technical reference manual, tables 3-1 and 7-1, per \
    instruction class, as if each load waited for its data (2 cycles) and each jump refilled the \
    pipeline in 2 cycles; no wait states of the flash";

/// Estimates.
pub struct Cycles {
    /// Of the slowest of the ticks.
    pub most: u64,
    /// Instructions of that tick by class.
    pub classes: BTreeMap<&'static str, u64>,
}

/// Of some ticks.
pub fn of(ticks: &[Vec<Executed>]) -> Result<Cycles> {
    let mut slowest = Cycles { most: 0, classes: BTreeMap::new() };
    for tick in ticks {
        let mut cycles = 0;
        let mut classes = BTreeMap::new();
        for instruction in tick {
            let (class, cost) = class(instruction)?;
            cycles += cost;
            *classes.entry(class).or_insert(0) += 1;
        }
        if cycles > slowest.most {
            slowest = Cycles { most: cycles, classes };
        }
    }
    Ok(slowest)
}

/// Cycles to refill the pipeline: 1 to 3, by what the manual says.
const REFILL: u64 = 2;

/// Class and cycles of one instruction.
fn class(instruction: &Executed) -> Result<(&'static str, u64)> {
    let Executed { mnemonic, operands, is_jump } = instruction;
    // `vmul.f32`, `ldr.w`: what follows the point says how it is encoded, or which numbers it takes.
    let name = mnemonic.split('.').next().unwrap_or_default();
    let starts = |prefixes: &[&str]| prefixes.iter().any(|prefix| name.starts_with(prefix));
    let refill = if *is_jump { REFILL } else { 0 };
    Ok(if starts(&["vldm", "vstm", "vpush", "vpop"]) {
        ("floating-point load or store, several", 1 + registers(operands))
    } else if starts(&["vldr", "vstr"]) {
        // A double register is two words.
        ("floating-point load or store", if operands.starts_with('d') { 3 } else { 2 })
    } else if starts(&["vdiv", "vsqrt"]) {
        ("floating-point division or root", 14)
    } else if starts(&["vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnma", "vfnms"]) {
        ("floating-point multiply and add", 3)
    } else if starts(&["vmrs", "vmsr", "vmov", "vcmp", "vabs", "vneg", "vcvt", "vsel"]) {
        ("floating-point move or compare", 1)
    } else if starts(&["vadd", "vsub", "vmul", "vnmul"]) {
        ("floating-point arithmetic", 1)
    } else if starts(&["ldm", "pop", "stm", "push", "ldrd", "strd"]) {
        let several = if starts(&["ldrd", "strd"]) { 2 } else { registers(operands) };
        ("load or store, several", 1 + several + refill)
    } else if starts(&["ldr"]) {
        ("load", 2 + refill)
    } else if starts(&["str"]) {
        ("store", 2)
    } else if starts(&["sdiv", "udiv"]) {
        ("integer division", 12)
    } else if starts(&["tbb", "tbh"]) {
        ("jump", 2 + REFILL)
    } else if starts(&["b", "cbz", "cbnz"]) && !starts(&["bic", "bfi", "bfc"]) {
        ("jump", 1 + refill)
    } else if starts(&["mrs", "msr", "isb", "dsb", "dmb"]) {
        ("special", 4)
    } else if INTEGER.iter().any(|prefix| name.starts_with(prefix)) {
        ("integer", 1 + refill)
    } else {
        bail!("no class for the instruction `{mnemonic} {operands}`")
    })
}

/// One-cycle instructions of the integer unit.
const INTEGER: [&str; 39] = [
    "adc", "add", "adr", "and", "asr", "bfc", "bfi", "bic", "clz", "cmn", "cmp", "eor", "it",
    "lsl", "lsr", "mla", "mls", "mov", "mul", "mvn", "neg", "nop", "orn", "orr", "rbit", "rev",
    "ror", "rrx", "rsb", "sbc", "sbfx", "smla", "smul", "sub", "sxt", "teq", "tst", "u", "ssat",
];

/// Registers in `{r4, r5-r7}`, or `sp!, {d8, d9}`; a double one counts twice.
fn registers(operands: &str) -> u64 {
    let list = operands.split_once('{').map_or("", |(_, list)| list).trim_end_matches('}');
    let number =
        |register: &str| register.trim().trim_start_matches(['r', 's', 'd']).parse::<u64>();
    list.split(',')
        .map(|part| {
            let words = if part.trim().starts_with('d') { 2 } else { 1 };
            match part.split_once('-') {
                None => words,
                Some((first, last)) => match (number(first), number(last)) {
                    (Ok(first), Ok(last)) => words * (last.saturating_sub(first) + 1),
                    _ => words,
                },
            }
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::{Executed, class};

    #[test]
    fn instructions_cost_what_the_manual_says() {
        for (mnemonic, operands, is_jump, cycles) in [
            ("vmul.f32", "s0, s1, s2", false, 1),
            ("vdiv.f32", "s0, s1, s2", false, 14),
            ("vldr", "s0, [r0]", false, 2),
            ("vpush", "{d8, d9, d10}", false, 7),
            ("push", "{r4, r5, r6, lr}", false, 5),
            ("pop", "{r4, pc}", true, 5),
            ("ldm.w", "r0, {r1-r4}", false, 5),
            ("bne", "#0x800", false, 1),
            ("bne", "#0x800", true, 3),
            ("bic", "r0, r1, #1", false, 1),
            ("it", "ne", false, 1),
            ("uxtb", "r0, r1", false, 1),
        ] {
            let (mnemonic, operands) = (mnemonic.to_owned(), operands.to_owned());
            let executed = Executed { mnemonic, operands, is_jump };
            let found = class(&executed).expect("a class").1;
            assert_eq!(found, cycles, "{} {}", executed.mnemonic, executed.operands);
        }
        let unknown = Executed { mnemonic: "svc".into(), operands: String::new(), is_jump: false };
        assert!(class(&unknown).is_err());
    }
}
