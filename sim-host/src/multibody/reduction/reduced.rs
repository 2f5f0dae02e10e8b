//! A smaller system, and how its bodies carry those of the larger one.

use super::super::{BodyState, System};
use super::frame::Frame;

/// A reduced system.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The smaller system.
    pub system: System,
    /// By link of the larger system: the link that carries it, and where in it. None for small bodies that
    /// have been given to a neighbour, whose own turn is not known any more.
    pub(super) carried: Vec<Option<(usize, Frame)>>,
    /// By link of the smaller system: the link of the larger one that it hangs by, and its frame in it.
    pub(super) roots: Vec<(usize, Frame)>,
}

impl Reduced {
    /// The link that carries a link of the larger system, and where in it.
    pub fn carrier(&self, link: usize) -> Option<(usize, Frame)> {
        self.carried.get(link).copied().flatten()
    }

    /// States and rates of the smaller system from those of the larger one; allocates.
    pub fn start(
        &self,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> (Vec<BodyState>, Vec<BodyState>) {
        self.roots.iter().map(|(link, frame)| frame.carried(&states[*link], &rates[*link])).unzip()
    }

    /// State of a body of the larger system, if it is still told.
    pub fn state(&self, link: usize, states: &[BodyState]) -> Option<BodyState> {
        let (carrier, frame) = self.carrier(link)?;
        Some(frame.carried(&states[carrier], &[0.0; 7]).0)
    }

    /// States and rates of all bodies of the larger system that are still told; allocates.
    pub fn expanded(
        &self,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Vec<Option<(BodyState, BodyState)>> {
        let each = self.carried.iter();
        each.map(|at| at.map(|(link, frame)| frame.carried(&states[link], &rates[link]))).collect()
    }
}
