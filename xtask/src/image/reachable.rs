//! Which functions an image's function can reach, by the relocations that the linker has kept.
//!
//! Calls through tables of addresses are not followed; the control tick has none.

use super::Image;
use super::panicking::{is_panicking, readable};
use anyhow::{Context, Result};
use object::{Object, ObjectSection, ObjectSymbol, RelocationTarget, SectionKind};
use std::collections::{BTreeMap, BTreeSet};

/// Address of a function by its symbol's name.
pub fn function(image: &Image<'_>, name: &str) -> Result<u32> {
    let symbol = image
        .symbols()
        .find(|symbol| symbol.is_definition() && symbol.name() == Ok(name))
        .with_context(|| format!("the image has no function {name}"))?;
    Ok(u32::try_from(start(&symbol))?)
}

/// Names of the panicking functions that can be reached from a function.
pub fn reachable_panics(image: &Image<'_>, from: &str) -> Result<Vec<String>> {
    let functions = functions(image);
    let calls = calls(image, &functions);
    let mut seen = BTreeSet::from([u64::from(function(image, from)?)]);
    let mut open: Vec<u64> = seen.iter().copied().collect();
    while let Some(function) = open.pop() {
        for &callee in calls.get(&function).into_iter().flatten() {
            if seen.insert(callee) {
                open.push(callee);
            }
        }
    }
    let names = seen.iter().filter_map(|start| Some(functions.get(start)?.1.clone()));
    Ok(names.filter(|name| is_panicking(name)).collect())
}

/// Bit 0 of a function's address says that it is in the Thumb instruction set.
fn start<'a>(symbol: &impl ObjectSymbol<'a>) -> u64 {
    symbol.address() & !1
}

/// Functions by address, with their sizes and names.
fn functions(image: &Image<'_>) -> BTreeMap<u64, (u64, String)> {
    image
        .symbols()
        .filter(|symbol| symbol.is_definition() && symbol.size() > 0)
        .filter_map(|symbol| Some((start(&symbol), (symbol.size(), readable(symbol.name().ok()?)))))
        .collect()
}

/// For each function those that it calls, or takes the address of.
fn calls(
    image: &Image<'_>,
    functions: &BTreeMap<u64, (u64, String)>,
) -> BTreeMap<u64, BTreeSet<u64>> {
    let containing = |address: u64| {
        let (start, (size, _)) = functions.range(..=address).next_back()?;
        (address < start + size).then_some(*start)
    };
    let mut calls: BTreeMap<_, BTreeSet<_>> = BTreeMap::new();
    for section in image.sections().filter(|section| section.kind() == SectionKind::Text) {
        for (address, relocation) in section.relocations() {
            if let RelocationTarget::Symbol(callee) = relocation.target()
                && let Ok(callee) = image.symbol_by_index(callee)
                && let Some(caller) = containing(address)
            {
                calls.entry(caller).or_default().insert(start(&callee));
            }
        }
    }
    calls
}
