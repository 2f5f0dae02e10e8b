//! The files as shipped, and the rows that take a second.

use super::references::references;
use super::*;

#[test]
fn every_scene_can_be_read_and_has_a_reference() {
    let known = references().expect("references");
    for benchmark in all() {
        match scene(benchmark) {
            Some(scene) => {
                scene.unwrap_or_else(|error| panic!("{}: {error}", benchmark.name));
                assert!(known.contains_key(benchmark.reference), "{}", benchmark.name);
            }
            None => assert!(benchmark.scene.is_err()),
        }
    }
}
