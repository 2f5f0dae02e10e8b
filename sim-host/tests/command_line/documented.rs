//! Every command in the documents runs: here, or where a list says.

use crate::program::{folder, said, surefoot};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Run elsewhere: a line each, by whom and what.
const ELSEWHERE: &str = include_str!("documented.txt");

/// Made shorter here by these arguments; as they stand they take minutes.
const SHORTENED: [(&str, &[&str]); 11] = [
    ("certify experiment-2 --vary vary.toml", FEW_RUNS),
    ("certify experiment-2 --vary vary.toml --shard 1/2 --out shard-1", FEW_RUNS),
    ("certify experiment-2 --vary vary.toml --shard 2/2 --out shard-2", FEW_RUNS),
    ("certify merge shard-1 shard-2 --out all", &["--search", "0"]),
    ("advise my-scene.toml --accuracy 1e-4", &["--duration", "0.1"]),
    ("run stand-loaded", &["--duration", "0.5"]),
    ("chart work-precision", &["--problem", "touch-down"]),
    (
        "chart stability",
        &["--only", "set-point-height", "--scene", "experiment-1-welded", "--fresh"],
    ),
    ("chart stability --scene experiment-2", &["--only", "set-point-height"]),
    ("chart parsimony", &["--scene", "hinged-chain"]),
    ("reproduce", &["table-2.1"]),
];

const FEW_RUNS: &[&str] = &["--samples", "2", "--search", "0"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn documents() -> Vec<(String, String)> {
    let docs = std::fs::read_dir(root().join("docs")).expect("documents");
    let mut paths: Vec<_> = docs.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "md"));
    paths.push(root().join("README.md"));
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        (name, std::fs::read_to_string(&path).expect("readable"))
    };
    paths.into_iter().map(read).collect()
}

/// Fenced blocks of a language, and the text without any.
fn fenced(document: &str, language: &str) -> (Vec<String>, String) {
    let (mut blocks, mut text, mut inside) = (Vec::new(), String::new(), None);
    for line in document.lines() {
        match (line.strip_prefix("```"), &mut inside) {
            (Some(of), None) => inside = Some((of.trim() == language, String::new())),
            (Some(_), Some((is_wanted, block))) => {
                if *is_wanted {
                    blocks.push(std::mem::take(block));
                }
                inside = None;
            }
            (None, Some((_, block))) => *block += &format!("{line}\n"),
            (None, None) => text += &format!("{line}\n"),
        }
    }
    assert!(inside.is_none(), "a fence is closed");
    (blocks, text)
}

/// Commands in blocks of `sh`, and in the text.
fn commands(document: &str) -> BTreeSet<String> {
    let (blocks, text) = fenced(document, "sh");
    let lines = blocks.iter().flat_map(|block| block.lines());
    let lines = lines.map(|line| line.split(" #").next().unwrap_or_default().to_owned());
    let spans = text.split('`').skip(1).step_by(2).map(str::to_owned);
    let spans = spans.filter(|span| {
        let mut words = span.split_whitespace();
        matches!((words.next(), words.next()), (Some("cargo" | "surefoot" | "probe-rs"), Some(_)))
    });
    lines
        .chain(spans)
        .map(|command| command.split_whitespace().collect::<Vec<_>>().join(" "))
        .filter(|command| !command.is_empty() && !command.starts_with('#'))
        // A pattern, and whole families of commands, are none.
        .filter(|command| !command.contains('…') && command != "cargo xtask")
        .collect()
}

/// What the program is given by a command that starts it.
fn arguments(command: &str) -> Option<Vec<&str>> {
    let rest = ["cargo run --release", "surefoot"]
        .iter()
        .find_map(|start| command.strip_prefix(start))
        .filter(|rest| rest.is_empty() || rest.starts_with(' '))?;
    let words: Vec<&str> = rest.split_whitespace().collect();
    Some(words.strip_prefix(&["--"]).map_or(words.clone(), <[&str]>::to_vec))
}

#[test]
fn every_command_in_the_documents_runs() {
    let folder = folder("documented");
    // Scenes that the documents speak of.
    let own = include_str!("../../scenes/experiment-1-welded.toml");
    std::fs::write(folder.join("my-scene.toml"), own).expect("writable");
    let listed: Vec<(&str, &str)> = ELSEWHERE
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty())
        .map(|line| line.split_once('\t').expect("by whom, a tab, and what"))
        .collect();
    let (mut ran, mut found) = (BTreeSet::new(), BTreeSet::new());
    for (name, document) in documents() {
        if name == "your-own-bodies.md" {
            let (blocks, _) = fenced(&document, "toml");
            std::fs::write(folder.join("arm.toml"), &blocks[0]).expect("writable");
        }
        if name == "certify.md" {
            let (blocks, _) = fenced(&document, "toml");
            std::fs::write(folder.join("vary.toml"), &blocks[0]).expect("writable");
            for out in ["shard-1", "shard-2", "all", "out/certify-experiment-2"] {
                // What an earlier test left.
                let _ = std::fs::remove_dir_all(folder.join(out));
            }
        }
        for command in commands(&document) {
            found.insert(command.clone());
            if listed.iter().any(|(_, other)| *other == command) {
                continue;
            }
            let arguments = arguments(&command).unwrap_or_else(|| {
                panic!("{name}: `{command}` is run by nothing: see documented.txt")
            });
            let plain = arguments.join(" ");
            if !ran.insert(plain.clone()) {
                continue;
            }
            let more =
                SHORTENED.iter().find(|(long, _)| *long == plain).map_or(&[][..], |(_, m)| m);
            let begun = std::time::Instant::now();
            let output = surefoot(&folder, &[&arguments[..], more].concat());
            let (status, _, stderr) = said(&output);
            println!("{:5.1} s  {name}: {command}", begun.elapsed().as_secs_f64());
            assert_eq!(status, Some(0), "{name}: `{command}`: {stderr}");
        }
    }
    assert!(ran.len() > 15, "the documents were read: {ran:?}");
    for (by, command) in listed {
        assert!(found.contains(command), "no document has `{command}` ({by})");
    }
}
