//! One limit: a search at a step, and again at half of it, until both agree.

use super::manner::Manner;
use super::quantity::Quantity;
use super::search::{Found, search};
use super::trial::{Footing, Loop, Trial};
use serde::{Deserialize, Serialize};
use surefoot_sim::scene::SceneError;

/// The shortest step that is tried, as a share of the first: 1/2⁴.
pub const HALVINGS: usize = 6;

/// What a search finds with steps of a length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// The simulator's steps are the longest not above this that go into a control period, s.
    pub longest_step_s: f64,
    /// What is found.
    pub found: Found<Manner>,
}

/// A limit in one quantity on one footing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Of what.
    pub quantity: Quantity,
    /// On which feet.
    pub footing: Footing,
    /// In which loop.
    pub control: Loop,
    /// Searches, each with half the step of the one before: two or more.
    pub levels: Vec<Level>,
}

impl Cell {
    /// Searches with the scene's step, and with half of it; as long as these two differ by more than the
    /// search's tolerance, it halves on. `None` where the scene has no such quantity.
    ///
    /// # Errors
    /// A [`SceneError`] for values that the scene's check refuses.
    pub fn find(trial: &Trial) -> Result<Option<Self>, SceneError> {
        let Trial { quantity, footing, control, .. } = *trial;
        let Some(ladder) = quantity.ladder(trial.scene) else { return Ok(None) };
        let mut cell = Self { quantity, footing, control, levels: Vec::new() };
        let mut longest_step_s = trial.scene.integrator.step_s;
        while cell.levels.len() <= HALVINGS && !cell.agrees() {
            let attempt = |value| trial.attempt(value, longest_step_s);
            let found = search(ladder, quantity.tolerance(), attempt)?;
            cell.levels.push(Level { longest_step_s, found });
            longest_step_s *= 0.5;
        }
        Ok(Some(cell))
    }

    /// Whether the last halving has changed the limit by no more than the tolerance.
    pub fn agrees(&self) -> bool {
        match self.levels.as_slice() {
            [.., a, b] => a.found.agrees(&b.found, self.quantity.tolerance()),
            _ => false,
        }
    }

    /// The limit and its step; the longer of the last two steps.
    pub fn limit(&self) -> Option<&Level> {
        self.levels.iter().nth_back(1)
    }

    /// What half of that step makes of it.
    pub fn at_half_step(&self) -> Option<&Level> {
        self.levels.last()
    }

    /// Least and greatest value over all steps.
    pub fn spread(&self) -> (f64, f64) {
        let values = self.levels.iter().map(|level| level.found.value());
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    }
}
