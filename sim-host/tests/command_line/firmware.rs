//! A scene with its controller on the emulated target.

use crate::program::{folder, said, surefoot};
use serde_json::Value;

/// Experiment 1 from its report's side: balanced, with what its ticks have cost.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn the_target_balances() {
    let folder = folder("firmware");
    let (status, stdout, stderr) =
        said(&surefoot(&folder, &["run", "--controller", "firmware", "--json"]));
    assert_eq!(status, Some(0), "{stderr}");
    let document: Value = serde_json::from_str(&stdout).expect("one document and nothing else");
    assert_eq!(document["outcome"], "balanced");
    let target = &document["target"];
    assert_eq!(target["unit"], "instructions");
    assert!(target["max"].as_u64().is_some_and(|most| most > 5_000), "{target}");
}
