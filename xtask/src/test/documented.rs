//! Commands of the documents that take minutes, or other simulators.

use crate::step::Step;
use crate::workspace;
use anyhow::{Context, Result, ensure};
use std::fs;

/// A line each: by whom, a tab, and what.
const LIST: &str = "sim-host/tests/command_line/documented.txt";

/// Runs them as they stand.
///
/// # Returns
/// How many there were.
pub fn run() -> Result<String> {
    let path = workspace::root().join(LIST);
    let list = fs::read_to_string(&path).with_context(|| format!("cannot read {LIST}"))?;
    let mut made = 0;
    for command in list.lines().filter_map(|line| line.strip_prefix("documented\t")) {
        let mut words = command.split_whitespace();
        let program = words.next().unwrap_or_default();
        Step::new(program, words).run()?;
        made += 1;
    }
    ensure!(made > 0, "{LIST} has no command of this stage");
    Ok(format!("{made} commands of the documents"))
}
