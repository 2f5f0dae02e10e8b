//! What lumping saves, and what it cannot: told from the counted instructions.

use super::ladder::Row;
use super::play::Rung;
use serde::Serialize;

/// Two models of one motion that differ in their bodies only: their velocities, contact points and constraints are the
/// same in number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Saving {
    /// The larger one.
    pub full: Rung,
    /// The smaller one.
    pub lumped: Rung,
    /// Instructions of a step with the smaller one, as a share of the larger one's.
    pub share: f64,
    /// Bodies that go.
    pub bodies: usize,
    /// Instructions that each of them took.
    pub each: f64,
    /// What of the smaller one's instructions its bodies do not account for, at that rate: what is the same in both.
    pub common: f64,
    /// What a body would have to take for the smaller one to cost half.
    pub each_for_half: f64,
}

/// Pairs of models. With welded feet the two have not as many velocities and constraints: they are no pair.
const PAIRS: [(Rung, Rung); 2] =
    [(Rung::FlightFull, Rung::FlightLumped), (Rung::FloorFull, Rung::FloorLumped)];

impl Saving {
    /// Of all pairs whose instructions have been counted.
    pub fn all(rows: &[Row]) -> Vec<Self> {
        let find = |rung: Rung| {
            let row = rows.iter().find(|row| row.rung == rung)?;
            Some((row.instructions? as f64, row.bodies))
        };
        let of = |(full, lumped): (Rung, Rung)| {
            let ((large, many), (small, few)) = (find(full)?, find(lumped)?);
            let bodies = many.checked_sub(few).filter(|gone| *gone > 0)?;
            let each = (large - small) / bodies as f64;
            Some(Self {
                full,
                lumped,
                share: small / large,
                bodies,
                each,
                common: small - each * few as f64,
                each_for_half: 0.5 * large / bodies as f64,
            })
        };
        PAIRS.into_iter().filter_map(of).collect()
    }
}
