//! All that a planar motion needs to go on.

use super::node::Coordinates;
use crate::contact::ContactPoint;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::Progress;

/// Steps from which Newton's method guesses the next.
pub(super) const PAST: usize = 4;

/// A planar motion at one time. One that goes on from here makes the same bits as one that was never stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanarCheckpoint {
    pub(super) coordinates: Vec<Coordinates>,
    /// Of joints with laws, as these count: rad or m.
    pub(super) angles: Vec<f64>,
    /// By column.
    pub(super) momenta: Vec<f64>,
    /// Increments of the last steps by column, the last first, and their length.
    pub(super) last: [Vec<f64>; PAST],
    pub(super) last_h: f64,
    /// By point that is seen in the plane.
    pub(super) memories: Vec<ContactPoint>,
    /// Mean forces on each of the points that these stand for in the last step, N, world frame.
    pub(super) forces: Vec<[f64; 3]>,
    pub(super) progress: Progress,
}

impl PlanarCheckpoint {
    /// Takes another one's place without allocating.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.coordinates.copy_from_slice(&other.coordinates);
        self.angles.copy_from_slice(&other.angles);
        self.momenta.copy_from_slice(&other.momenta);
        for (to, from) in self.last.iter_mut().zip(&other.last) {
            to.copy_from_slice(from);
        }
        self.last_h = other.last_h;
        self.memories.copy_from_slice(&other.memories);
        self.forces.copy_from_slice(&other.forces);
        self.progress = other.progress;
    }

    /// Whether it has the sizes of another.
    pub(super) fn fits(&self, other: &Self) -> bool {
        let sizes = |c: &Self| {
            (
                c.coordinates.len(),
                c.angles.len(),
                c.momenta.len(),
                c.last.each_ref().map(Vec::len),
                c.memories.len(),
                c.forces.len(),
            )
        };
        sizes(self) == sizes(other) && self.progress.h == other.progress.h
    }
}
