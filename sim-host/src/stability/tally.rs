//! How many forecasts hold, of how many.

use super::scan::Agreement;
use serde::Serialize;
use std::iter::Sum;
use std::ops::Add;

/// Counts of forecasts beside what was found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// All.
    pub forecasts: usize,
    /// Those within a factor of two.
    pub within_a_factor_of_two: usize,
    /// Those that are too long by more than a tenth.
    pub unsafe_by_more_than_a_tenth: usize,
}

impl Tally {
    /// Whether nine of ten are within a factor of two, and none is on the unsafe side.
    pub fn holds(&self) -> bool {
        10 * self.within_a_factor_of_two >= 9 * self.forecasts
            && self.unsafe_by_more_than_a_tenth == 0
    }

    /// For people.
    pub fn words(&self) -> String {
        format!(
            "foretold within a factor of two: {} of {}; on the unsafe side by more than 10 %: {}",
            self.within_a_factor_of_two, self.forecasts, self.unsafe_by_more_than_a_tenth,
        )
    }
}

impl FromIterator<Agreement> for Tally {
    fn from_iter<I: IntoIterator<Item = Agreement>>(all: I) -> Self {
        all.into_iter()
            .map(|agreement| Self {
                forecasts: 1,
                within_a_factor_of_two: usize::from(agreement.is_near()),
                unsafe_by_more_than_a_tenth: usize::from(agreement.is_unsafe()),
            })
            .sum()
    }
}

impl Add for Tally {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            forecasts: self.forecasts + other.forecasts,
            within_a_factor_of_two: self.within_a_factor_of_two + other.within_a_factor_of_two,
            unsafe_by_more_than_a_tenth: self.unsafe_by_more_than_a_tenth
                + other.unsafe_by_more_than_a_tenth,
        }
    }
}

impl Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), Add::add)
    }
}
