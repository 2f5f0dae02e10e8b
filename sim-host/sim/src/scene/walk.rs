//! Commands to a robot that walks.

use super::check::wrong;
use super::{Feet, Scene, SceneError};
use serde::{Deserialize, Serialize};

/// What a robot is to do from a time on. Before the first it stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WalkCommand {
    /// When, s.
    pub at_s: f64,
    /// Forward, m/s; backward where negative.
    #[serde(default)]
    pub forward_mps: f64,
    /// To the left, m/s.
    #[serde(default)]
    pub left_mps: f64,
    /// To the left, degrees per second.
    #[serde(default)]
    pub turn_deg_per_s: f64,
    /// How far below its standing height its centre of mass is carried at least, m.
    #[serde(default)]
    pub lowered_m: f64,
    /// It stands, as soon as it can.
    #[serde(default)]
    pub stand: bool,
}

pub(super) fn check_walk(scene: &Scene) -> Result<(), SceneError> {
    let mut before = 0.0;
    for (number, command) in scene.walk.iter().enumerate() {
        let field = |what: &str| format!("walk[{number}].{what}");
        if !(command.at_s.is_finite() && command.at_s >= before) {
            let expected = format!("a time of {before} s or later: commands stand in order");
            return Err(wrong(scene, &field("at_s"), command.at_s, expected));
        }
        before = command.at_s;
        for (what, number) in [
            ("forward_mps", command.forward_mps),
            ("left_mps", command.left_mps),
            ("turn_deg_per_s", command.turn_deg_per_s),
        ] {
            if !number.is_finite() {
                return Err(wrong(scene, &field(what), number, "a finite number"));
            }
        }
        if !(command.lowered_m.is_finite() && command.lowered_m >= 0.0) {
            return Err(wrong(scene, &field("lowered_m"), command.lowered_m, "zero or more"));
        }
        let moves = [command.forward_mps, command.left_mps, command.turn_deg_per_s];
        if command.stand && moves.iter().any(|x| *x != 0.0) {
            return Err(wrong(scene, &field("stand"), true, "no speed beside it"));
        }
    }
    if !scene.walk.is_empty() && matches!(scene.feet, Feet::Welded {}) {
        return Err(wrong(scene, "feet", "welded", "a floor for a robot that walks"));
    }
    Ok(())
}
