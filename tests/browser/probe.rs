//! The page in a frame, whose width a headless window's lower limit does not touch, and whose controls a
//! script works.

use crate::chromium::document;
use crate::pages;
use std::path::Path;

/// What the script of `probe.html` found in a page, by name.
struct Findings(String);

impl Findings {
    fn of(page: &Path, width: u32) -> Self {
        let probe = page.with_file_name(format!("probe-{width}.html"));
        let text = include_str!("probe.html").replace("WIDTH", &width.to_string());
        std::fs::write(&probe, text).expect("writable");
        let findings = Self(document(&probe, "", 5000));
        assert_eq!(findings.get("done"), "yes");
        findings
    }

    fn get(&self, name: &str) -> &str {
        let attribute = format!(" data-{name}=\"");
        let (_, rest) = self.0.split_once(&attribute).unwrap_or_else(|| panic!("no {name}"));
        rest.split('"').next().expect("a value")
    }

    fn number(&self, name: &str) -> f64 {
        self.get(name).trim_end_matches(" s").parse().expect("a number")
    }
}

#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn no_width_makes_the_page_scroll_sideways() {
    for page in [pages::experiment_1(), pages::with_a_block()] {
        for width in [320, 390, 768, 1280] {
            fits(page, width);
        }
    }
    for (_, page) in pages::mechanisms() {
        for width in [390, 1280] {
            fits(page, width);
        }
    }
}

fn fits(page: &Path, width: u32) {
    let findings = Findings::of(page, width);
    assert_eq!(findings.number("client-width"), f64::from(width));
    let wide = findings.number("scroll-width");
    assert!(wide <= f64::from(width), "{}: {wide} at {width} px", page.display());
    assert_eq!(findings.get("error"), "none");
}

/// The controls of a mechanism's page are those of a robot's.
#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn a_mechanism_s_replay_is_worked_like_a_robot_s() {
    for (name, page) in pages::mechanisms().iter().filter(|(name, _)| *name != "four-bar") {
        let findings = Findings::of(page, 800);
        // A second, in whole steps.
        assert!((findings.number("end") - 1.0).abs() < 0.02, "{name}");
        assert_eq!(findings.get("orbited"), "true", "{name}");
        assert_eq!(findings.get("reset"), "true", "{name}");
        assert_eq!(findings.number("sought"), 0.32, "{name}");
        assert!(findings.number("played") > 0.5, "{name}");
        assert_eq!(findings.get("error"), "none", "{name}");
    }
}

#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn keys_drags_and_the_address_move_the_replay() {
    let findings = Findings::of(pages::with_a_block(), 800);
    assert_eq!(findings.number("start"), 0.0);
    assert!((0.001..0.011).contains(&findings.number("stepped")));
    assert_eq!(findings.number("end"), 3.0);
    assert_eq!(findings.get("orbited"), "true");
    assert_eq!(findings.get("reset"), "true");
    assert_eq!(findings.number("sought"), 0.32);
    // 0.6 s of the page's time at half the speed.
    let played = findings.number("played") - 0.32;
    assert!((0.25..0.35).contains(&played), "{played} s");
    assert!(findings.number("ticks") >= 7.0);
    assert_eq!(findings.get("error"), "none");
}
