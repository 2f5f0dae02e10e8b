//! All that a free body's motion needs to go on.

use crate::contact::ContactPoint;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::Progress;

/// What a body does in a step: the way of its centre of mass, world axes, m; and its turn, the vector part of a
/// unit quaternion in the body's axes at the step's beginning.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Move {
    pub way: Vector3<f64>,
    pub turn: Vector3<f64>,
}

impl Move {
    pub const NONE: Self =
        Self { way: Vector3::new(0.0, 0.0, 0.0), turn: Vector3::new(0.0, 0.0, 0.0) };

    /// The same in a step `ratio` times as long.
    pub fn scaled(&self, ratio: f64) -> Self {
        Self { way: self.way * ratio, turn: self.turn * ratio }
    }

    /// A guess of the next one, in a step `ratio` times as long: that it changes as it did from the one before.
    pub fn beyond(&self, before: &Self, ratio: f64) -> Self {
        let next =
            |last: &Vector3<f64>, before: &Vector3<f64>| (last + (last - before) * ratio) * ratio;
        Self { way: next(&self.way, &before.way), turn: next(&self.turn, &before.turn) }
    }
}

/// A free body's motion at one time. One that goes on from here makes the same bits as one that was never stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyCheckpoint {
    /// Of the centre of mass, m.
    pub(super) center: Vector3<f64>,
    /// World from body, scalar first.
    pub(super) orientation: [f64; 4],
    /// World axes, N·s and N·m·s.
    pub(super) momentum: Vector3<f64>,
    pub(super) spin: Vector3<f64>,
    /// The last two steps, and their length.
    pub(super) last: [Move; 2],
    pub(super) last_h: f64,
    /// By contact site.
    pub(super) memories: Vec<ContactPoint>,
    /// Mean forces on them in the last step, N, world frame.
    pub(super) forces: Vec<[f64; 3]>,
    pub(super) progress: Progress,
}

impl BodyCheckpoint {
    /// Takes another one's place without allocating.
    pub(super) fn copy_from(&mut self, other: &Self) {
        let (memories, forces) =
            (std::mem::take(&mut self.memories), std::mem::take(&mut self.forces));
        *self = Self { memories, forces, ..Self::without_contacts(other) };
        self.memories.copy_from_slice(&other.memories);
        self.forces.copy_from_slice(&other.forces);
    }

    fn without_contacts(other: &Self) -> Self {
        // An empty vector does not allocate.
        Self { memories: Vec::new(), forces: Vec::new(), ..*other }
    }
}
