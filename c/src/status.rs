//! What a call says.

/// What became of a call.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurefootStatus {
    /// It is done.
    Ok = 0,
    /// A pointer that must not be null is.
    NullPointer = 1,
    /// The controller was not made by `surefoot_init`, or that has failed.
    NotMade = 2,
    /// A number of the settings is none that can be used: the period, a gain.
    BadSettings = 3,
    /// Limits are asked for that the robot cannot have: it has no flat soles, or the ground's numbers contradict each
    /// other.
    BadLimits = 4,
    /// A pose that is not finite, or whose quaternion has not unit length.
    BadPose = 5,
}
