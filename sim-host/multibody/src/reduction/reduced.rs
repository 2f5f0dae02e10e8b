//! A smaller system, and how its bodies carry those of the larger one.

use super::super::system::WORLD;
use super::super::{BodyState, System};
use super::frame::Frame;

/// What carries a link: a link of the smaller system, or the world, and the carried frame in it.
pub(super) type Carrier = (Option<usize>, Frame);

/// A reduced system.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The smaller system.
    pub system: System,
    /// By link of the larger system: the link that carries it, and where in it. None for small bodies that
    /// have been given to a neighbour, whose own turn is not known any more.
    pub(super) carried: Vec<Option<Carrier>>,
    /// By link of the smaller system: the link of the larger one that it hangs by, and its frame in it.
    pub(super) roots: Vec<(usize, Frame)>,
    /// J
    pub(super) still: f64,
}

impl Reduced {
    /// The link that carries a link of the larger system, and where in it; no link for one that is part of the
    /// world now. None for small bodies that have been given to a neighbour.
    pub fn carrier(&self, link: usize) -> Option<(Option<usize>, Frame)> {
        self.carried.get(link).copied().flatten()
    }

    /// Potential energy of gravity that links have which are part of the world now, J; the smaller system has it
    /// not.
    pub fn still_energy(&self) -> f64 {
        self.still
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
        let state = carrier.map_or(&WORLD, |link| &states[link]);
        Some(frame.carried(state, &[0.0; 7]).0)
    }

    /// States and rates of all bodies of the larger system that are still told; allocates.
    pub fn expanded(
        &self,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Vec<Option<(BodyState, BodyState)>> {
        let still: BodyState = [0.0; 7];
        let told = |(carrier, frame): Carrier| {
            let (x, v) = carrier.map_or((&WORLD, &still), |k| (&states[k], &rates[k]));
            frame.carried(x, v)
        };
        self.carried.iter().map(|at| at.map(told)).collect()
    }
}
