//! What the replay shows.

use crate::chromium::screenshot;
use crate::pages;
use crate::picture::{is_block, is_body};

/// Where the replay of a wide page is, at its top: so much of the window.
const TOP: usize = 700;

const WINDOW: (u32, u32) = (1280, 900);

#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn the_robot_is_seen_and_moves() {
    let page = pages::experiment_1();
    let at = |time: &str| screenshot(page, &format!("#t={time}"), WINDOW);
    let [first, middle, last] = ["0", "0.18", "3"].map(at);
    for picture in [&first, &middle, &last] {
        let body = picture.count(is_body);
        assert!(body > 5_000, "{body} pixels of the body: the canvas is blank");
        assert!(body < picture.pixels.len() / 4, "{body} pixels of the body");
    }
    for (a, b) in [(&first, &middle), (&middle, &last), (&first, &last)] {
        let changed = a.difference(b);
        assert!(changed > 2_000, "{changed} pixels differ between two moments");
    }
    // The same moment is the same picture.
    assert_eq!(at("0.18").difference(&middle), 0);
}

#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn a_block_is_seen_where_it_flies() {
    let page = pages::with_a_block();
    let block = |time: &str| screenshot(page, &format!("#t={time}"), WINDOW).count(is_block);
    assert!(block("0.05") > 300, "{} pixels of the block", block("0.05"));
    let without = screenshot(pages::experiment_1(), "#t=0.05", WINDOW).count(is_block);
    assert!(without < 100, "{without} pixels of a block that is not there");
}

/// Mechanisms are seen, and move: pictures of two moments differ where the replay is, those of one do not.
#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn mechanisms_are_seen_and_move() {
    for (name, page) in pages::mechanisms() {
        let window = (WINDOW.0, TOP as u32);
        let at = |time: &str| screenshot(page, &format!("#t={time}"), window);
        let (early, late) = if *name == "four-bar" { ("6.9", "7.3") } else { ("0.1", "0.5") };
        let (first, second) = (at(early), at(late));
        let body = first.count(is_body);
        assert!(body > 150, "{name}: {body} pixels of the first body");
        let changed = first.difference(&second);
        assert!(changed > 400, "{name}: {changed} pixels differ between two moments");
        assert_eq!(at(late).difference(&second), 0, "{name}");
    }
}
