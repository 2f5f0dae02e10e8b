//! The search for a limit along one quantity.
//!
//! From the easy end of its range a ladder of values is climbed until the first that fails; between that
//! and the last that works the limit is bisected. Whether something works again beyond the first failure
//! is not asked.

use serde::{Deserialize, Serialize};

/// Values in the order in which they are tried, the easy end first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Ladder {
    /// Each value is the one before, times a factor.
    Geometric {
        /// The easy end, above zero.
        from: f64,
        /// Above 1 to climb, below 1 to descend; never 1.
        ratio: f64,
        /// The far end, tried as well.
        to: f64,
    },
    /// Each value is the one before, and a distance more.
    Arithmetic {
        /// The easy end.
        from: f64,
        /// Not zero.
        step: f64,
        /// The far end, tried as well.
        to: f64,
    },
}

/// How near the last value that works and the first that fails must come.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", content = "value", rename_all = "kebab-case")]
pub enum Tolerance {
    /// A share of the value.
    Relative(f64),
    /// In the value's unit.
    Absolute(f64),
}

/// What a search finds. `F` says how something fails.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Found<F> {
    /// A limit, between these.
    Limit {
        /// The last value that works.
        works: f64,
        /// The first that fails.
        fails: f64,
        /// How it fails there.
        manner: F,
    },
    /// The easy end fails already.
    EasyEndFails {
        /// The easy end.
        at: f64,
        /// How it fails there.
        manner: F,
    },
    /// The far end still works.
    FarEndWorks {
        /// The far end.
        to: f64,
    },
}

impl Ladder {
    /// The easy end, and all that follows up to the far end.
    pub fn rungs(self) -> impl Iterator<Item = f64> {
        let (from, to) = self.ends();
        let rung = move |number: i32| match self {
            Self::Geometric { ratio, .. } => from * ratio.powi(number),
            Self::Arithmetic { step, .. } => from + step * f64::from(number),
        };
        let within = move |x: &f64| if to > from { *x < to } else { *x > to };
        (0..).map(rung).take_while(within).chain([to])
    }

    fn ends(self) -> (f64, f64) {
        match self {
            Self::Geometric { from, to, .. } | Self::Arithmetic { from, to, .. } => (from, to),
        }
    }

    /// Half way between two values, as the ladder counts.
    fn between(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Geometric { .. } => (a * b).sqrt(),
            Self::Arithmetic { .. } => 0.5 * (a + b),
        }
    }
}

impl Tolerance {
    /// Whether two values are as good as equal.
    pub fn holds(self, a: f64, b: f64) -> bool {
        let apart = (a - b).abs();
        match self {
            Self::Relative(share) => apart <= share * a.abs().max(b.abs()),
            Self::Absolute(distance) => apart <= distance,
        }
    }
}

/// Climbs a ladder and bisects; `attempt` says how a value fails, if it does.
///
/// # Errors
/// The first error of `attempt`.
pub fn search<F, E>(
    ladder: Ladder,
    tolerance: Tolerance,
    mut attempt: impl FnMut(f64) -> Result<Option<F>, E>,
) -> Result<Found<F>, E> {
    let mut last = None;
    for value in ladder.rungs() {
        match (attempt(value)?, last) {
            (None, _) => last = Some(value),
            (Some(manner), None) => return Ok(Found::EasyEndFails { at: value, manner }),
            (Some(manner), Some(works)) => {
                return bisect(ladder, tolerance, (works, value, manner), attempt);
            }
        }
    }
    Ok(Found::FarEndWorks { to: ladder.ends().1 })
}

fn bisect<F, E>(
    ladder: Ladder,
    tolerance: Tolerance,
    (mut works, mut fails, mut manner): (f64, f64, F),
    mut attempt: impl FnMut(f64) -> Result<Option<F>, E>,
) -> Result<Found<F>, E> {
    while !tolerance.holds(works, fails) {
        let middle = ladder.between(works, fails);
        // Neighbours of f64 have nothing between them.
        if middle == works || middle == fails {
            break;
        }
        match attempt(middle)? {
            None => works = middle,
            Some(how) => (fails, manner) = (middle, how),
        }
    }
    Ok(Found::Limit { works, fails, manner })
}

impl<F: Copy> Found<F> {
    /// The figure that stands for it: the last value that works, or the end of the ladder.
    pub fn value(&self) -> f64 {
        match *self {
            Self::Limit { works, .. } => works,
            Self::EasyEndFails { at, .. } => at,
            Self::FarEndWorks { to } => to,
        }
    }

    /// How it fails beyond; `None` where nothing has failed.
    pub fn manner(&self) -> Option<F> {
        match *self {
            Self::Limit { manner, .. } | Self::EasyEndFails { manner, .. } => Some(manner),
            Self::FarEndWorks { .. } => None,
        }
    }

    /// Whether two searches found the same limit, as near as they look.
    pub fn agrees(&self, other: &Self, tolerance: Tolerance) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
            && tolerance.holds(self.value(), other.value())
    }
}
