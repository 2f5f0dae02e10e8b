//! Whether a robot comes to stand on its soles: the beginning of its run on the floor.
//!
//! In the air the controller's torques, made for feet that are held, turn and drive feet of 1.5 kg, which rebound
//! from the floor and come down on their edges. What that leaves behind has grown, or is gone, when a fall would
//! have grown by a factor e; so long is looked at, and not whether the robot then gets to where it should.

use super::ground::FALLING_S;
use crate::stability::loop_limits::{Loop, has_flat_sole, play, runs_away};
use surefoot_sim::scene::{Feet, Scene};

/// What is looked at: a fall's time after one fourth of it, in which all that drops has touched down.
const BEGINNING_S: f64 = 1.25 * FALLING_S;
/// Steps of the beginning that may be made in shorter ones: half of what a whole run may.
const MOST_SPLITS: u64 = 5;

/// Whether a scene should come to stand on its floor. Welded feet stand.
///
/// # Cost
/// A run of 0.4 s.
pub fn should_land(scene: &Scene) -> bool {
    if matches!(scene.feet, Feet::Welded {}) {
        return true;
    }
    let mut beginning = scene.clone();
    beginning.duration_s = BEGINNING_S;
    let (run, _) = play(&beginning, Loop::Bare);
    let limits = &scene.robot().limits;
    let last_s = 0.5 * BEGINNING_S;
    run.failure.is_none()
        && run.progress.is_none_or(|progress| progress.split_steps <= MOST_SPLITS)
        && !run.samples.iter().any(|sample| runs_away(sample, limits))
        && run.samples.iter().any(|sample| sample.time_s >= last_s && has_flat_sole(sample))
}
