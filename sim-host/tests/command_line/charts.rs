//! Charts, and pages of them.

use crate::program::{changed_scene, folder, said, surefoot};
use serde_json::Value;

/// Limits of a loop: the same document from a survey, from what it left, and from a fresh one.
#[test]
fn limits_are_charted_and_taken_up_again() {
    let folder = folder("limits");
    let scene =
        changed_scene(&folder, &[("1.10]", "1.165]"), ("duration_s = 3.0", "duration_s = 1.0")]);
    let all = ["chart", "stability", "--scene", &scene, "--only", "set-point-height", "--json"];
    let chart = |more: &[&str]| said(&surefoot(&folder, &[&all, more].concat()));
    let (status, first, messages) = chart(&["--fresh"]);
    assert_eq!(status, Some(0), "{messages}");
    assert!(!messages.contains("taken up"), "{messages}");
    let document: Value = serde_json::from_str(&first).expect("one document and nothing else");
    let limit = &document["limits"][0];
    assert_eq!(limit["quantity"], "set-point-height");
    assert_eq!(limit["footing"], "welded");
    assert!(limit["value"].as_f64().is_some_and(|z| (1.165..1.2).contains(&z)), "{limit}");
    // Its legs get straight.
    assert_eq!(limit["manner"], "singular leg");
    let (status, second, messages) = chart(&[]);
    assert_eq!((status, &second), (Some(0), &first));
    assert!(messages.contains("2 of 2 limits taken up"), "{messages}");

    for (arguments, word) in [
        (&["chart", "stability", "--scene", "chain"], "nobody controls"),
        (&["chart", "stability", "--scene", "experiment-3"], "no scene"),
        (&["chart", "stability", "--only", "friction"], "--scene"),
    ] {
        let (status, _, stderr) = said(&surefoot(&folder, arguments));
        assert_eq!(status, Some(2));
        assert!(stderr.contains(word), "{stderr}");
    }
}

/// A page of charts shows its drawings, needs no network, and all it links to is there.
#[test]
fn a_page_of_charts_is_whole() {
    let folder = folder("chart-page");
    let asked = ["chart", "work-precision", "--problem", "touch-down", "--json"];
    let (status, stdout, messages) = said(&surefoot(&folder, &asked));
    assert_eq!(status, Some(0), "{messages}");
    let document: Value = serde_json::from_str(&stdout).expect("one document and nothing else");
    let page = folder.join(document["page"].as_str().expect("a path"));
    let text = std::fs::read_to_string(&page).expect("a page");
    assert!(!text.contains("http://") && !text.contains("https://"), "the page needs the network");
    assert!(text.matches("<svg").count() >= 6, "a drawing for each figure");
    let links: Vec<&str> = text
        .split("href=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .filter(|link| !link.starts_with('#'))
        .collect();
    assert!(links.iter().any(|link| link.ends_with(".csv")), "{links:?}");
    assert!(links.iter().any(|link| link.ends_with(".json")), "{links:?}");
    for link in links {
        let file = page.with_file_name(link);
        assert!(file.is_file(), "{} is not there", file.display());
    }
    let anchors = text.split("href=\"#").skip(1).filter_map(|rest| rest.split('"').next());
    for anchor in anchors {
        assert!(text.contains(&format!("id=\"{anchor}\"")), "nothing is at #{anchor}");
    }
}

/// The ladder of bodies and joints: instructions, where valgrind counts them, fall at every rung, and no body is
/// elsewhere.
#[test]
fn cost_falls_at_every_rung() {
    let folder = folder("rungs");
    let (status, stdout, stderr) =
        said(&surefoot(&folder, &["chart", "parsimony", "--scene", "hinged-chain", "--json"]));
    assert_eq!(status, Some(0), "{stderr}");
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    let rows = document["ladder"]["rows"].as_array().expect("rows");
    let names: Vec<_> = rows.iter().filter_map(|row| row["rung"].as_str()).collect();
    assert_eq!(names, ["multipliers", "joint-coordinates", "merged", "planar"]);
    assert!(rows.iter().all(|row| row["deviation_m"].as_f64().is_some_and(|m| m < 1e-10)));
    let counts: Vec<u64> = rows.iter().filter_map(|row| row["instructions"].as_u64()).collect();
    println!("{counts:?}");
    if counts.is_empty() {
        let failure = rows[0]["failure"].as_str().expect("the reason");
        assert!(failure.contains("valgrind"), "{failure}");
        return;
    }
    assert_eq!(counts.len(), rows.len());
    assert!(counts.is_sorted_by(|dearer, cheaper| dearer > cheaper), "{counts:?}");
    // In the plane a step takes less than half of what it takes in space.
    assert!(2 * counts[3] < counts[2], "{counts:?}");
}
