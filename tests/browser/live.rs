//! The page that runs the controller and its plant.

use crate::chromium::{document, screenshot};
use crate::picture::is_body;
use std::path::{Path, PathBuf};
use surefoot_web::{Live, Request};

/// Where `cargo xtask page` puts it.
fn page() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/page/surefoot.html")
}

/// What follows a word of the page's text, up to a character.
fn after<'a>(text: &'a str, word: &str, end: char) -> &'a str {
    let from = text.find(word).unwrap_or_else(|| panic!("the page has no {word}")) + word.len();
    text[from..].split(end).next().unwrap_or_default()
}

fn state(document: &str) -> &str {
    after(document, "id=\"word\"", '<').split('>').next_back().unwrap_or_default()
}

/// Equal bits in the browser's machine and in this one, of the plant in double and the controller in single precision.
#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn the_page_has_the_bits_of_the_host() {
    for (scene, push, word) in [("stand", 20.0, "balances"), ("walk", 0.0, "walks")] {
        let fragment = format!("#scene={scene}&push={push}&tenths=20");
        let document = document(&page(), &fragment, 500);
        assert_eq!(state(&document), word, "{scene}");
        let request = format!(
            r#"{{"scene": "{scene}", "friction": {}, "load_kg": 0, "gain": 1, "rate_hz": 500 {}}}"#,
            if scene == "walk" { 0.6 } else { 0.3 },
            if scene == "walk" { r#", "speed_mps": 0.5"# } else { "" },
        );
        let request = Request::read(request.as_bytes()).expect("JSON");
        let mut live = Live::start(&request).expect("a scene");
        live.push([0.0, push, 0.0]);
        for _ in 0..20 {
            live.advance(0.1);
        }
        let here = live.frame().expect("a configuration").poses[0];
        let there: Vec<f64> = after(&document, "data-pose=\"", '"')
            .split(' ')
            .map(|number| number.parse().expect("a number"))
            .collect();
        assert_eq!(there, here, "{scene}");
    }
}

#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn a_fall_and_a_scene_that_is_none_are_told() {
    let state_at = |fragment: &str| state(&document(&page(), fragment, 200)).to_owned();
    assert!(["stopped", "ended"].contains(&&*state_at("#scene=stand&push=200&tenths=30")));
    assert_eq!(state_at("#scene=nonsense"), "refused");
}

/// The robot is seen in a wide window and in one as narrow as a telephone's, which nothing overflows.
#[test]
#[ignore = "needs Chromium: `cargo xtask test --only browser`"]
fn the_robot_is_seen_at_any_width() {
    for (window, least) in [((1280, 900), 5_000), ((390, 800), 2_000)] {
        let picture = screenshot(&page(), "#scene=stand", window);
        let body = picture.count(is_body);
        assert!(body > least, "{body} pixels of the body in {window:?}");
    }
}
