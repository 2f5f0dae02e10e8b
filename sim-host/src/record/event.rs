//! Moments of a run.

use serde::Serialize;

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// s
    pub time_s: f64,
    /// What.
    pub kind: EventKind,
    /// Where: "left foot" or "right foot"; or "point 3", counted from 1.
    #[serde(rename = "where")]
    pub place: String,
}

/// Kinds of events.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EventKind {
    /// The first corner of a sole touches the floor.
    TouchDown,
    /// The last corner leaves it.
    LiftOff,
    /// A corner starts to slide while others of its foot are down.
    SlipStart,
    /// No corner of the foot slides any more.
    SlipEnd,
    /// A heel leaves the floor while its toe stays.
    HeelOff,
    /// A heel comes back to the floor.
    HeelDown,
    /// A toe leaves the floor while its heel stays.
    ToeOff,
    /// A toe comes back to the floor.
    ToeDown,
    /// A thrown block strikes the central body.
    Strike,
    /// It leaves it.
    StrikeEnd,
}

impl std::fmt::Display for EventKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::TouchDown => "touches down",
            Self::LiftOff => "lifts off",
            Self::SlipStart => "starts to slip",
            Self::SlipEnd => "stops slipping",
            Self::HeelOff => "raises its heel",
            Self::HeelDown => "puts its heel down",
            Self::ToeOff => "raises its toe",
            Self::ToeDown => "puts its toe down",
            Self::Strike => "is struck",
            Self::StrikeEnd => "is left by the block",
        })
    }
}
