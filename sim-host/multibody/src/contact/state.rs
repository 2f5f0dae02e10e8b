//! The six-state machine of figure 5.1, as one table.

use serde::{Deserialize, Serialize};

/// State of a contact point. States 1, 2 and 4 last; 3, 5 and 6 are left before the next step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactState {
    /// 1: above the floor.
    Free,
    /// 2: in the floor, moving along it.
    Sliding,
    /// 3: has come to rest; its anchor is set.
    SlidingToSticking,
    /// 4: held by its anchor.
    Sticking,
    /// 5: has torn loose; its friction is clipped.
    StickingToSliding,
    /// 6: in the floor but leaving so fast that damping would pull it back.
    NegativeNormalForce,
}

/// What the transitions ask of a point. Not all mean something in every state; the table asks only
/// for those that do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Conditions {
    /// `p_n < 0`
    pub below_floor: bool,
    /// `F_n < 0`
    pub pulls: bool,
    /// `|ṗ_t| ≤ zvt`
    pub slow: bool,
    /// `|F_t| > μ_s F_n`, with `F_t` of the anchor
    pub slips: bool,
}

/// Condition of a row.
type When = fn(Conditions) -> bool;

/// Rows (from, condition, to); of a state's rows the first that holds is taken, so that their order
/// is the printed priority a, b, c. A state with no row that holds stays.
///
/// The text lets a point return to state 1 only by way of figure 5.1, which is lost; that states 2
/// and 4 return when `p_n ≥ 0`, before anything else, is the reading that reproduces §5.3.
pub const TRANSITIONS: [(ContactState, When, ContactState); 10] = {
    use ContactState::{
        Free, NegativeNormalForce, Sliding, SlidingToSticking, Sticking, StickingToSliding,
    };
    [
        (Free, |c| c.below_floor, Sliding),
        (Sliding, |c| !c.below_floor, Free),
        (Sliding, |c| c.pulls, NegativeNormalForce),
        (Sliding, |c| c.slow, SlidingToSticking),
        (Sticking, |c| !c.below_floor, Free),
        (Sticking, |c| c.pulls, NegativeNormalForce),
        (Sticking, |c| c.slips, StickingToSliding),
        // Left before the next step, whatever holds.
        (SlidingToSticking, |_| true, Sticking),
        (StickingToSliding, |_| true, Sliding),
        (NegativeNormalForce, |_| true, Sliding),
    ]
};

impl ContactState {
    /// The state that follows.
    pub fn next(self, conditions: Conditions) -> Self {
        TRANSITIONS
            .iter()
            .find(|(from, when, _)| *from == self && when(conditions))
            .map_or(self, |(_, _, to)| *to)
    }

    /// The state in which the next step begins.
    pub fn settled(self) -> Self {
        match self {
            Self::Free | Self::Sliding | Self::Sticking => self,
            _ => self.next(Conditions::default()),
        }
    }

    /// Number in figure 5.1.
    pub fn number(self) -> u8 {
        match self {
            Self::Free => 1,
            Self::Sliding => 2,
            Self::SlidingToSticking => 3,
            Self::Sticking => 4,
            Self::StickingToSliding => 5,
            Self::NegativeNormalForce => 6,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ContactState::{
        Free, NegativeNormalForce, Sliding, SlidingToSticking, Sticking, StickingToSliding,
    };
    use super::*;

    const IN_FLOOR: Conditions =
        Conditions { below_floor: true, pulls: false, slow: false, slips: false };

    /// Every transition of figure 5.1 and every way to stay, one by one.
    #[test]
    fn transitions_one_by_one() {
        let above = Conditions { below_floor: false, ..IN_FLOOR };
        let pulls = Conditions { pulls: true, ..IN_FLOOR };
        let slow = Conditions { slow: true, ..IN_FLOOR };
        let slips = Conditions { slips: true, ..IN_FLOOR };
        for (from, conditions, to) in [
            (Free, above, Free),
            (Free, IN_FLOOR, Sliding),
            (Sliding, IN_FLOOR, Sliding),
            (Sliding, above, Free),
            (Sliding, pulls, NegativeNormalForce),
            (Sliding, slow, SlidingToSticking),
            (Sliding, slips, Sliding),
            (Sticking, IN_FLOOR, Sticking),
            (Sticking, slow, Sticking),
            (Sticking, above, Free),
            (Sticking, pulls, NegativeNormalForce),
            (Sticking, slips, StickingToSliding),
        ] {
            assert_eq!(from.next(conditions), to, "{from:?} with {conditions:?}");
        }
    }

    #[test]
    fn priorities() {
        let all = Conditions { below_floor: false, pulls: true, slow: true, slips: true };
        let in_floor = Conditions { below_floor: true, ..all };
        for state in [Sliding, Sticking] {
            assert_eq!(state.next(all), Free);
            assert_eq!(state.next(in_floor), NegativeNormalForce);
        }
    }

    #[test]
    fn transition_states_end_with_the_step() {
        assert_eq!(SlidingToSticking.settled(), Sticking);
        assert_eq!(StickingToSliding.settled(), Sliding);
        assert_eq!(NegativeNormalForce.settled(), Sliding);
        for steady in [Free, Sliding, Sticking] {
            assert_eq!(steady.settled(), steady);
        }
    }
}
