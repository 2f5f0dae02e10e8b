//! Moments of a run.

use serde::Serialize;

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// s
    pub time_s: f64,
    /// What.
    pub kind: EventKind,
    /// Where: "left foot", "right foot" or "central body"; or "point 3", counted from 1.
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
    /// The heel's last corner leaves the floor while the toe is down.
    HeelOff,
    /// The heel's first corner touches the floor again while the toe is down.
    HeelDown,
    /// The toe's last corner leaves the floor while the heel is down.
    ToeOff,
    /// The toe's first corner touches the floor again while the heel is down.
    ToeDown,
    /// A thrown block strikes the body.
    Strike,
    /// It parts from the body.
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
            Self::HeelDown => "sets down its heel",
            Self::ToeOff => "raises its toe",
            Self::ToeDown => "sets down its toe",
            Self::Strike => "is struck by the block",
            Self::StrikeEnd => "is rid of the block",
        })
    }
}
