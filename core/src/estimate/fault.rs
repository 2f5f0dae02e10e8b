//! Why the filter gave no estimate.

/// An input of the filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimateInput {
    /// m/s²
    Accelerometer,
    /// rad/s
    Gyroscope,
    /// Position of foot number in the body, m.
    FootPosition(usize),
    /// Its orientation.
    FootOrientation(usize),
    /// Of all feet, N.
    FeetForce,
    /// Where the start is said to be.
    StartPose,
}

/// Why there is no estimate. The state is then that before the call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EstimateFault {
    /// An input is NaN or infinite, or far beyond what it can be: 1000 m/s², 100 rad/s, 100 m, 10⁷ N.
    NotUsable(EstimateInput),
    /// A quaternion is off unit norm by more than 1 in 1000.
    NotUnit(EstimateInput),
    /// At the start the accelerometer reads less than half or more than twice gravity: the robot is not at rest.
    NotAtRest,
    /// A setting cannot be; its name and range.
    Setting(&'static str),
    /// The state is not finite any more. Start again.
    Diverged,
}

impl core::fmt::Display for EstimateInput {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Accelerometer => f.write_str("the accelerometer"),
            Self::Gyroscope => f.write_str("the gyroscope"),
            Self::FootPosition(foot) => write!(f, "the position of foot {foot}"),
            Self::FootOrientation(foot) => write!(f, "the orientation of foot {foot}"),
            Self::FeetForce => f.write_str("the feet's force"),
            Self::StartPose => f.write_str("the start's pose"),
        }
    }
}

impl core::fmt::Display for EstimateFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotUsable(input) => write!(f, "{input} is no number that it can read"),
            Self::NotUnit(input) => write!(f, "{input} is no unit quaternion"),
            Self::NotAtRest => f.write_str(
                "the accelerometer reads less than half or more than twice gravity at the start",
            ),
            Self::Setting(what) => write!(f, "a setting of the estimator is out of range: {what}"),
            Self::Diverged => f.write_str("the estimate is not finite any more"),
        }
    }
}

impl core::error::Error for EstimateFault {}
