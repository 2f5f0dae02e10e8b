//! What the project's tables say of its code is so.

use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace")
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Cells of a table's rows, heads left out.
fn rows(document: &str) -> Vec<Vec<&str>> {
    document
        .lines()
        .filter(|line| line.starts_with('|') && !line.starts_with("|---"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .filter(|cells: &Vec<&str>| !["symbol", "where"].contains(&cells[0]))
        .collect()
}

/// Everything in backticks.
fn names(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).step_by(2).collect()
}

/// Whether Rust source declares this name.
fn declares(source: &str, name: &str) -> bool {
    source.lines().any(|line| {
        ["fn ", "struct ", "enum ", "trait ", "const ", "type ", "pub "].iter().any(|keyword| {
            line.match_indices(&format!("{keyword}{name}")).any(|(at, found)| {
                !line[at + found.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
            })
        })
    })
}

fn rust_files(folder: PathBuf, all: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path()) {
        if entry.is_dir() {
            rust_files(entry, all);
        } else if entry.extension().is_some_and(|e| e == "rs") {
            all.push(entry);
        }
    }
}

#[test]
fn every_name_in_the_notation_exists() {
    let document = read("NOTATION.md");
    let rows = rows(&document);
    assert!(rows.len() > 30, "the table was read");
    for row in rows {
        let [_, _, name, file] = row[..] else { panic!("{row:?} has not four cells") };
        let source = read(file);
        for name in names(name) {
            assert!(declares(&source, name), "{file} declares no {name}");
        }
    }
}

#[test]
fn every_guard_of_a_deviation_exists() {
    let mut files = Vec::new();
    for folder in ["core/src", "sim-host", "tests/suite"] {
        rust_files(root().join(folder), &mut files);
    }
    let sources: Vec<String> = files.into_iter().map(read).collect();
    let document = read("DEVIATIONS.md");
    let mut guards = 0;
    for row in rows(&document) {
        let guarding = names(row.last().expect("a cell"));
        assert!(!guarding.is_empty(), "{row:?} is guarded by nothing");
        for guard in guarding {
            let test = format!("#[test]\nfn {guard}() {{");
            let inner = format!("#[test]\n    fn {guard}() {{");
            assert!(
                sources.iter().any(|s| s.contains(&test) || s.contains(&inner)),
                "there is no test {guard}"
            );
            guards += 1;
        }
    }
    assert!(guards > 20, "the tables were read");
}
