//! All that a motion needs to go on: what it remembers of its past.

use super::coordinates::{Coordinates, Increment};
use super::guess::Guess;
use super::held::Hold;
use super::motors::Turned;
use super::watched::Moved;
use crate::contact::{BoxPoint, ContactPoint};
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::Progress;

/// A motion at one time. One that goes on from here makes the same numbers, to the last bit, as one that
/// was never stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    pub(super) coordinates: Vec<Coordinates>,
    /// By column.
    pub(super) momenta: Vec<f64>,
    /// Increments of the last two steps, and their length.
    pub(super) last: [Vec<Increment>; 2],
    pub(super) last_h: f64,
    /// Where Newton's method begins the next step.
    pub(super) guess: Guess,
    /// Impulses of loops.
    pub(super) multipliers: Vec<f64>,
    /// By contact site.
    pub(super) memories: Vec<ContactPoint>,
    /// Mean forces on them in the last step, N.
    pub(super) forces: Vec<[f64; 3]>,
    /// By striker, point after point.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) strikes: Vec<BoxPoint>,
    /// Mean forces on strikers in the last step, N.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) strike_forces: Vec<[f64; 3]>,
    /// By spherical joint with motors, then by loop that is driven.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) turned: Vec<Turned>,
    /// By body that is watched.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) watched: Vec<Moved>,
    /// By link that hangs from the world.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) holds: Vec<Hold>,
    /// Largest speed so far, m/s, where something may strike something: how far a step may lead.
    pub(super) fastest: f64,
    pub(super) progress: Progress,
}

impl Checkpoint {
    /// Takes another one's place without allocating.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.coordinates.copy_from_slice(&other.coordinates);
        self.momenta.copy_from_slice(&other.momenta);
        for (to, from) in self.last.iter_mut().zip(&other.last) {
            to.copy_from_slice(from);
        }
        self.last_h = other.last_h;
        self.guess.copy_from(&other.guess);
        self.multipliers.copy_from_slice(&other.multipliers);
        self.memories.copy_from_slice(&other.memories);
        self.forces.copy_from_slice(&other.forces);
        self.strikes.copy_from_slice(&other.strikes);
        self.strike_forces.copy_from_slice(&other.strike_forces);
        self.turned.copy_from_slice(&other.turned);
        self.watched.copy_from_slice(&other.watched);
        self.holds.copy_from_slice(&other.holds);
        self.fastest = other.fastest;
        self.progress = other.progress;
    }

    /// Whether it has the sizes of another.
    pub(super) fn fits(&self, other: &Self) -> bool {
        let sizes = |c: &Self| {
            (
                c.coordinates.len(),
                c.momenta.len(),
                (c.last.each_ref().map(Vec::len), c.guess.sizes()),
                c.multipliers.len(),
                c.memories.len(),
                c.forces.len(),
                [c.strikes.len(), c.strike_forces.len()],
                [c.turned.len(), c.watched.len(), c.holds.len()],
            )
        };
        sizes(self) == sizes(other) && self.progress.h == other.progress.h
    }
}
