//! A map, and one column of it.

use super::axis::Axis;
use super::outcome::{Failure, Outcome};
use crate::stability::Agreement;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::forecast::{FailureKind, Forecast};

/// Everything that is asked at one value of `x`.
pub struct Stack {
    /// Where the edge is foretold.
    pub foretold: Foretold,
    /// What becomes of a value of `y`.
    pub attempt: Box<dyn Fn(f64) -> Outcome>,
}

/// A grid of outcomes in two parameters.
pub struct Map {
    /// Its name in files.
    pub name: &'static str,
    /// What it shows, for people.
    pub title: String,
    /// What works, and what was foretold how, for people.
    pub note: &'static str,
    /// Across.
    pub x: Axis,
    /// Upwards, the easy end first.
    pub y: Axis,
    /// What a column is made from.
    pub stack: Box<dyn Fn(f64) -> Stack + Send + Sync>,
}

/// Where an edge is foretold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", content = "at", rename_all = "kebab-case")]
pub enum Foretold {
    /// Here.
    At(f64),
    /// Nothing should work.
    NothingWorks,
    /// Nothing should limit it.
    Unlimited,
}

/// What was found at one value of `x`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// The value.
    pub x: f64,
    /// Where the edge was foretold.
    pub foretold: Foretold,
    /// The last value of `y` found to work before the first that fails; none if the first cell fails.
    pub works_to: Option<f64>,
    /// The first found to fail; none if all cells work.
    pub fails_from: Option<f64>,
    /// Cells' outcomes, the easy end first.
    pub cells: Vec<Outcome>,
}

impl From<Forecast> for Foretold {
    fn from(forecast: Forecast) -> Self {
        match (forecast.step_s, forecast.kind) {
            (Some(step_s), _) => Self::At(step_s),
            (None, Some(_)) => Self::NothingWorks,
            (None, None) => Self::Unlimited,
        }
    }
}

/// Bisections of the edge between two cells.
const BISECTIONS: usize = 4;

impl Stack {
    /// Where there is nothing to try: a parameter is not a number that can be used.
    pub fn not_finite() -> Self {
        Self {
            foretold: Foretold::NothingWorks,
            attempt: Box::new(|_| Outcome::Fails(Failure::Motion(FailureKind::NotFinite))),
        }
    }
}

impl Map {
    /// All of one column.
    ///
    /// # Cost
    /// One attempt a cell, four more, and a forecast.
    pub fn column(&self, x: f64) -> Column {
        let Stack { foretold, attempt } = (self.stack)(x);
        let values: Vec<f64> = self.y.values().collect();
        let cells: Vec<Outcome> = values.iter().map(|y| attempt(*y)).collect();
        let first = cells.iter().position(|cell| *cell != Outcome::Works);
        let mut works_to = match first {
            Some(first) => first.checked_sub(1).map(|last| values[last]),
            None => values.last().copied(),
        };
        let mut fails_from = first.map(|first| values[first]);
        for _ in 0..BISECTIONS {
            let (Some(works), Some(fails)) = (works_to, fails_from) else { break };
            let middle = self.y.between(works, fails);
            match attempt(middle) {
                Outcome::Works => works_to = Some(middle),
                Outcome::Fails(_) => fails_from = Some(middle),
            }
        }
        Column { x, foretold, works_to, fails_from, cells }
    }

    /// A forecast beside what was found, as far as the axis goes.
    pub fn agreement(&self, column: &Column) -> Agreement {
        let [bottom, top] = [self.y.from, self.y.to];
        match (column.works_to, column.fails_from, column.foretold) {
            (_, None, Foretold::Unlimited) => Agreement::Unlimited,
            // The edge is above the axis: only a forecast far below its end is known to be too low.
            (_, None, Foretold::At(at)) if at >= 0.5 * top => Agreement::Unlimited,
            (_, None, _) => Agreement::TooCautious,
            (Some(works), _, Foretold::At(at)) => Agreement::Ratio(works / at),
            (Some(_), _, Foretold::NothingWorks) => Agreement::TooCautious,
            (None, _, Foretold::NothingWorks) => Agreement::NoneWorks,
            // It is below the axis.
            (None, _, Foretold::At(at)) if at <= bottom => Agreement::NoneWorks,
            (None, _, Foretold::At(at)) => Agreement::Ratio(bottom / at),
            (_, Some(_), Foretold::Unlimited) => Agreement::TooBold,
        }
    }
}

impl Column {
    /// How often each failure is met, in the order of first meeting.
    pub fn count_failures(columns: &[Self]) -> Vec<(Failure, usize)> {
        let mut all: Vec<(Failure, usize)> = Vec::new();
        for cell in columns.iter().flat_map(|column| &column.cells) {
            let Outcome::Fails(failure) = cell else { continue };
            match all.iter_mut().find(|(known, _)| known.words() == failure.words()) {
                Some((_, count)) => *count += 1,
                None => all.push((*failure, 1)),
            }
        }
        all.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        all
    }
}
