//! What can be read of a motion at any time.

use super::super::body::BodyState;
use super::simulation::Simulation;
use crate::contact::{BoxPoint, ContactPoint};
use std::ops::Range;

impl Simulation {
    /// A body's state.
    pub fn state(&self, link: usize) -> BodyState {
        let place = &self.places[link];
        let [s, x, y, z] = place.orientation.to_array();
        [place.center.x, place.center.y, place.center.z, s, x, y, z]
    }

    /// All bodies' states.
    pub fn states(&self) -> Vec<BodyState> {
        (0..self.nodes.len()).map(|k| self.state(k)).collect()
    }

    /// Angle of a joint, rad; the way of a prismatic one, m; the first of a universal one. Zero for others.
    pub fn angle(&self, link: usize) -> f64 {
        self.at.coordinates[link].angles[0]
    }

    /// Columns of a joint, among all of [`Self::column_rates`] and [`Self::observed_rates`].
    pub fn columns(&self, link: usize) -> Range<usize> {
        self.nodes[link].columns.clone()
    }

    /// Memories of the contact sites, in the system's order.
    pub fn contacts(&self) -> &[ContactPoint] {
        &self.at.memories
    }

    /// Mean forces on the contact sites in the last step, N, world frame.
    pub fn contact_forces(&self) -> &[[f64; 3]] {
        &self.at.forces
    }

    /// Memories of strikers' points, striker after striker.
    pub fn strikes(&self) -> &[BoxPoint] {
        &self.at.strikes
    }

    /// Mean forces of the bodies that they strike on strikers in the last step, N, world frame.
    pub fn strike_forces(&self) -> &[[f64; 3]] {
        &self.at.strike_forces
    }

    /// Impulses of the loops' constraints in the last step, closure after closure: N·s for points.
    pub fn loop_impulses(&self) -> &[f64] {
        &self.at.multipliers
    }
}
