//! One parameter of a map.

use serde::Serialize;

/// A parameter, and the values at which it is tried.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// What it is, for people.
    pub name: &'static str,
    /// Its unit; empty for plain numbers.
    pub unit: &'static str,
    /// Factor from SI units to `unit`.
    pub shown: f64,
    /// Centre of the first cell, SI units.
    pub from: f64,
    /// Centre of the last cell.
    pub to: f64,
    /// How many cells; two at least.
    pub cells: usize,
    /// Whether neighbours have a ratio, in place of a distance.
    pub is_logarithmic: bool,
}

impl Axis {
    /// Neighbours in a ratio, in SI units. Both ends must be above zero.
    pub fn logarithmic(name: &'static str, unit: &'static str, [from, to]: [f64; 2]) -> Self {
        Self { name, unit, shown: 1.0, from, to, cells: 2, is_logarithmic: true }
    }

    /// Neighbours at a distance, in SI units.
    pub fn plain(name: &'static str, unit: &'static str, [from, to]: [f64; 2]) -> Self {
        Self { is_logarithmic: false, ..Self::logarithmic(name, unit, [from, to]) }
    }

    /// Shown times a factor.
    #[must_use]
    pub fn shown(self, shown: f64) -> Self {
        Self { shown, ..self }
    }

    /// With so many cells; at least two.
    #[must_use]
    pub fn cells(self, cells: usize) -> Self {
        Self { cells: cells.max(2), ..self }
    }

    /// Centres of all cells.
    pub fn values(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.cells).map(|cell| self.value(cell as f64))
    }

    /// The value so many cells from the first.
    pub fn value(&self, cell: f64) -> f64 {
        let share = cell / (self.cells - 1) as f64;
        if self.is_logarithmic {
            self.from * (self.to / self.from).powf(share)
        } else {
            self.from + (self.to - self.from) * share
        }
    }

    /// The inverse: how many cells from the first a value is. Values that have no place on a logarithmic
    /// axis are before everything.
    pub fn place(&self, value: f64) -> f64 {
        let share = if !self.is_logarithmic {
            (value - self.from) / (self.to - self.from)
        } else if value > 0.0 {
            (value / self.from).ln() / (self.to / self.from).ln()
        } else {
            f64::NEG_INFINITY
        };
        share * (self.cells - 1) as f64
    }

    /// Half way between two values, as the axis counts.
    pub fn between(&self, a: f64, b: f64) -> f64 {
        if self.is_logarithmic { (a * b).sqrt() } else { 0.5 * (a + b) }
    }
}
