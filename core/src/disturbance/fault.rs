//! What an observer of disturbances cannot be made of.

/// A number that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObserverFault {
    /// The period is not positive and finite.
    Period,
    /// A rate is negative, not finite, or faster than one tick.
    Rate,
    /// A bound is negative or NaN.
    Bound,
    /// The mass, gravity or height is not positive and finite.
    Robot,
}

impl core::fmt::Display for ObserverFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Period => "the period between ticks is not positive",
            Self::Rate => "a rate is negative, or its time constant shorter than a tick",
            Self::Bound => "a bound is negative or no number",
            Self::Robot => "mass, gravity and height of a robot are positive",
        })
    }
}

impl core::error::Error for ObserverFault {}
