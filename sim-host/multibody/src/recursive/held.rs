//! What the world does to trees that hang from it.

use super::node::Kind;
use super::simulation::Simulation;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A tree's joint to the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Hold {
    /// Momentum of all that hangs there, N·s.
    momentum: Vector3<f64>,
    /// Impulse of the world at the last step's beginning, N·s.
    impulse: Vector3<f64>,
}

impl Hold {
    /// Of nothing yet.
    pub const NOTHING: Self =
        Self { momentum: Vector3::new(0.0, 0.0, 0.0), impulse: Vector3::new(0.0, 0.0, 0.0) };
}

impl Simulation {
    /// Links that hang from the world.
    pub(super) fn hanging(&self) -> Vec<usize> {
        let nodes = self.nodes.iter().enumerate();
        let hangs = |(k, node): (usize, &super::node::Node)| {
            (node.inboard.is_none() && node.kind != Kind::Floating).then_some(k)
        };
        nodes.filter_map(hangs).collect()
    }

    /// Takes the world's impulses from a step that is solved: the trial's ends hold `Σ w⁻` of all outboard, of
    /// which the tree's momentum is there already.
    pub(super) fn note_impulses(&mut self) {
        for (hold, k) in self.at.holds.iter_mut().zip(&self.hanging) {
            hold.impulse = self.trial.ends[*k].all.linear - hold.momentum;
        }
    }

    /// The momentum that they act on next: the trial's ends hold `Σ w⁺`.
    pub(super) fn note_momenta(&mut self) {
        for (hold, k) in self.at.holds.iter_mut().zip(&self.hanging) {
            hold.momentum = self.trial.ends[*k].all.linear;
        }
    }

    /// Impulse of the world on a link that hangs from it by a joint, at the last step's beginning, N·s, world
    /// frame: over a step's length, the force there. Zero for all others.
    pub fn world_impulse(&self, link: usize) -> [f64; 3] {
        let found = self.hanging.iter().zip(&self.at.holds).find(|(k, _)| **k == link);
        found.map_or([0.0; 3], |(_, hold)| hold.impulse.into())
    }
}
