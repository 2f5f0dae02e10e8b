//! The table of chips in `docs/chips.md`: written by `cargo xtask budget --document`, and held to what is measured.

use crate::workspace;
use anyhow::{Context, Result};
use std::fs;
use std::path::PathBuf;

/// Where the table is, between these lines.
const DOCUMENT: &str = "docs/chips.md";
const BEGIN: &str = "<!-- from: cargo xtask budget -->\n";
const END: &str = "<!-- end -->\n";

/// Numbers of the document may be off by this share: a change of the code moves them by less, and compilers differ.
const SHARE: f64 = 0.05;

fn path() -> PathBuf {
    workspace::root().join(DOCUMENT)
}

/// What stands before the table, the table, and what stands after it.
fn parts(text: &str) -> Result<(&str, &str, &str)> {
    let split = || {
        let (before, rest) = text.split_once(BEGIN)?;
        let (table, after) = rest.split_once(END)?;
        Some((before, table, after))
    };
    split().with_context(|| format!("{DOCUMENT} has no table between `{BEGIN}` and `{END}`"))
}

/// Puts the table there.
pub fn write(table: &str) -> Result<()> {
    let text = fs::read_to_string(path()).with_context(|| format!("cannot read {DOCUMENT}"))?;
    let (before, _, after) = parts(&text)?;
    fs::write(path(), format!("{before}{BEGIN}{table}{END}{after}"))
        .with_context(|| format!("cannot write {DOCUMENT}"))
}

/// What of the table in the document is no longer so.
pub fn outdated(table: &str) -> Result<Option<String>> {
    let text = fs::read_to_string(path()).with_context(|| format!("cannot read {DOCUMENT}"))?;
    let (_, documented, _) = parts(&text)?;
    Ok(difference(documented, table).map(|what| {
        format!("{DOCUMENT} says {what}; `cargo xtask budget --document` writes it anew")
    }))
}

/// The first cells that differ, numbers by more than [`SHARE`].
fn difference(documented: &str, measured: &str) -> Option<String> {
    let cells = |table: &str| -> Vec<String> {
        table.lines().flat_map(|line| line.split('|')).map(|cell| cell.trim().to_owned()).collect()
    };
    let (documented, measured) = (cells(documented), cells(measured));
    if documented.len() != measured.len() {
        return Some("another table".to_owned());
    }
    let differ = |said: &str, is: &str| match (said.parse::<f64>(), is.parse::<f64>()) {
        (Ok(said), Ok(is)) => (said - is).abs() > SHARE * is.abs(),
        _ => said != is,
    };
    let pair = documented.iter().zip(&measured).find(|(said, is)| differ(said, is));
    pair.map(|(said, is)| format!("{said}, and it is {is}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_may_differ_a_little_and_words_not_at_all() {
        let table = "| M4 | 11000 | yes |\n";
        assert_eq!(difference(table, "| M4 | 11500 | yes |\n"), None);
        assert!(difference(table, "| M4 | 12000 | yes |\n").expect("one").contains("12000"));
        assert!(difference(table, "| M4 | 11000 | NO |\n").is_some());
        assert!(difference(table, "| M4 | 11000 | yes |\n| M7 | 1 | yes |\n").is_some());
    }

    #[test]
    fn the_document_has_a_place_for_the_table() {
        let text = fs::read_to_string(path()).expect("the document");
        parts(&text).expect("both marks");
    }
}
