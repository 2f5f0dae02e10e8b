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
    /// How it goes at these speeds.
    #[serde(default)]
    pub gait: GaitName,
    /// It stands, and then jumps so that its centre of mass rises by this after take-off, m; 0: it does not.
    #[serde(default)]
    pub jump_m: f64,
    /// How many jumps, one after the other.
    #[serde(default = "one")]
    pub hops: u8,
}

/// Gaits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GaitName {
    /// With a side on the ground at any time.
    #[default]
    Walk,
    /// With both in the air between two stances.
    Run,
}

fn one() -> u8 {
    1
}

impl WalkCommand {
    /// Whether it is to go nowhere.
    pub fn stands(&self) -> bool {
        self.stand || self.jump_m > 0.0
    }
}

/// A jump is refused that is higher than this, m: what no legged robot does from standing.
const HIGHEST: f64 = 2.0;

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
        if !(command.jump_m >= 0.0 && command.jump_m <= HIGHEST) {
            let expected = format!("zero to {HIGHEST} m");
            return Err(wrong(scene, &field("jump_m"), command.jump_m, expected));
        }
        if command.hops == 0 || (command.hops > 1 && command.jump_m == 0.0) {
            let expected = "1 without `jump_m`, 1 or more with it";
            return Err(wrong(scene, &field("hops"), command.hops, expected));
        }
        let moves = [command.forward_mps, command.left_mps, command.turn_deg_per_s];
        let goes = command.gait == GaitName::Run || moves.iter().any(|x| *x != 0.0);
        if command.stands() && goes {
            let what = if command.stand { "stand" } else { "jump_m" };
            let value = if command.stand { "true".into() } else { command.jump_m.to_string() };
            return Err(wrong(scene, &field(what), value, "no speed and no gait beside it"));
        }
    }
    if !scene.walk.is_empty() && matches!(scene.feet, Feet::Welded {}) {
        return Err(wrong(scene, "feet", "welded", "a floor for a robot that walks"));
    }
    Ok(())
}
