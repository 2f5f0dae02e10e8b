//! Certificates from the command line.

use crate::program::{folder, said, surefoot};
use serde_json::Value;
use std::path::Path;

const VARY: &str = "
[vary.\"block.mass_kg\"]
uniform = [1.0, 3.0]

[vary.\"block.velocity_mps\"]
uniform = [0.5, 1.5]
factor = true
";

/// A folder with experiment 2, cut to a fifth of a second, and what varies.
fn prepared(test: &str) -> std::path::PathBuf {
    let folder = folder(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    let (_, scene, _) = said(&surefoot(&folder, &["show", "experiment-2"]));
    let scene = scene.replace("duration_s = 3.0", "duration_s = 0.2");
    std::fs::write(folder.join("short.toml"), scene).expect("written");
    std::fs::write(folder.join("vary.toml"), VARY).expect("written");
    folder
}

fn certify(folder: &Path, more: &str) -> (Option<i32>, String, String) {
    let samples = if more.contains("--samples") { "" } else { "--samples 6" };
    let line = format!("certify short.toml --vary vary.toml --search 0 {samples} {more}");
    said(&surefoot(folder, &line.split_whitespace().collect::<Vec<_>>()))
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("one document and nothing else")
}

#[test]
fn a_certificate_is_one_json_document_and_a_page() {
    let folder = prepared("certificate");
    let (status, stdout, _) = certify(&folder, "--json --out all --workers 1");
    assert_eq!(status, Some(0));
    let document = json(&stdout);
    let probability = &document["failure_probability"];
    assert_eq!(document["samples"], 6);
    assert_eq!(probability["estimate"], 0.0);
    assert_eq!(probability["low"], 0.0);
    // 1 − 0.005^(1/6)
    let high = probability["high"].as_f64().expect("a number");
    assert!((high - 0.586_481_4).abs() < 1e-6, "{high}");
    let all = folder.join("all");
    let page = std::fs::read_to_string(all.join("report.html")).expect("a page");
    assert!(
        page.contains(
            "short fails in none of 6 runs: in at most 59 % of all, with 99 % confidence."
        )
    );
    for file in document["files"].as_array().expect("files") {
        assert!(folder.join(file.as_str().expect("a path")).is_file(), "{file}");
    }
    // Again on two processors, and in three shards that are put together: the same table and certificate.
    let table =
        |name: &str| std::fs::read_to_string(folder.join(name).join("runs.csv")).expect("a table");
    assert_eq!(certify(&folder, "--out two --workers 2").0, Some(0));
    assert_eq!(table("two"), table("all"));
    for shard in ["1/3", "2/3", "3/3"] {
        let out = format!("shard-{}", &shard[..1]);
        assert_eq!(certify(&folder, &format!("--shard {shard} --out {out}")).0, Some(0));
    }
    let merge = "certify merge shard-1 shard-2 shard-3 --out merged --search 0 --json";
    let (status, merged, _) = said(&surefoot(&folder, &merge.split(' ').collect::<Vec<_>>()));
    assert_eq!(status, Some(0));
    assert_eq!(table("merged"), table("all"));
    let without_files = |mut document: Value| {
        document["files"] = Value::Null;
        document
    };
    assert_eq!(without_files(json(&merged)), without_files(document));
    // More samples of the same study.
    let (status, _, stderr) = certify(&folder, "--out all --resume --samples 8");
    assert_eq!((status, table("all").lines().count()), (Some(0), 9), "{stderr}");
    assert!(table("all").starts_with(table("two").as_str()));
}

#[test]
fn what_is_wrong_is_told() {
    let folder = prepared("certificates-refused");
    for (more, expected) in [
        ("--confidence 99", "--confidence 99: expected a number between 0 and 1, as 0.99"),
        ("--shard 4/3", "expected k/n with k from 1 to n"),
        ("--samples 0", "0"),
        ("--controller bare", "expected host or firmware"),
    ] {
        let (status, _, stderr) = certify(&folder, more);
        assert_eq!(status, Some(2), "{more}");
        assert!(stderr.contains(expected), "{stderr}");
    }
    let (status, _, stderr) = said(&surefoot(&folder, &["certify", "short.toml"]));
    assert_eq!(status, Some(2));
    assert!(stderr.contains("--vary"), "{stderr}");
    let (status, _, stderr) = said(&surefoot(&folder, &["certify", "merge", "none"]));
    assert_eq!(status, Some(2));
    assert!(stderr.contains("none: no study.json"), "{stderr}");
}
