//! Why a robot file is refused.

use std::fmt;
use std::sync::Arc;

/// A line of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// As the user named it, or as an include does.
    pub file: Arc<str>,
    /// From 1.
    pub line: u32,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

/// Why there is no robot.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// A file cannot be read or written.
    #[error("{file}: {cause}")]
    File {
        /// Which.
        file: String,
        /// What the system says.
        cause: std::io::Error,
    },
    /// A file is not what its format asks for.
    #[error("{place}: {element}: expected {expected}, found {found}")]
    Malformed {
        /// Where.
        place: Place,
        /// The element with its name.
        element: String,
        /// What should stand there.
        expected: String,
        /// What does.
        found: String,
    },
    /// A robot file in TOML is not one; the message has the line.
    #[error("{file}: {message}")]
    Toml {
        /// Which.
        file: String,
        /// What the reader says.
        message: String,
    },
    /// The file is sound, but the robot cannot be imported as it is.
    #[error("{}{subject}: {refusal}", .place.as_ref().map(|p| format!("{p}: ")).unwrap_or_default())]
    Refused {
        /// Where, if the subject has a line.
        place: Option<Place>,
        /// The link, joint or option that is at fault.
        subject: String,
        /// Why.
        refusal: Refusal,
    },
}

impl ImportError {
    /// A refusal of `subject`.
    pub(crate) fn refused(place: Option<&Place>, subject: String, refusal: Refusal) -> Self {
        Self::Refused { place: place.cloned(), subject, refusal }
    }

    /// Where, if the error has a line.
    pub fn place(&self) -> Option<&Place> {
        match self {
            Self::Malformed { place, .. } => Some(place),
            Self::Refused { place, .. } => place.as_ref(),
            Self::File { .. } | Self::Toml { .. } => None,
        }
    }

    /// One word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::File { .. } => "file",
            Self::Malformed { .. } | Self::Toml { .. } => "malformed",
            Self::Refused { .. } => "refused",
        }
    }
}

/// Why a sound file gives no robot, and what the user can do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// No distribution of mass has this inertia.
    #[error("no body has this inertia: {inequality}")]
    Inertia {
        /// What does not hold, with its numbers.
        inequality: String,
    },
    /// A joint that moves nothing has no acceleration.
    #[error(
        "it moves no mass: the inertia about its axis is {inertia:e}; give its links one, or --lock {joint}"
    )]
    MovesNothing {
        /// The joint's name.
        joint: String,
        /// kg m² or kg.
        inertia: f64,
    },
    /// Core refuses the tree.
    #[error("{reason}")]
    Tree {
        /// Why.
        reason: String,
    },
    /// Every link is fixed to the world.
    #[error("no link of it moves")]
    NothingMoves,
    /// A joint follows one that is not there.
    #[error(
        "there is no such joint{nearest}; take joints that follow others as free ones with --free-couplings"
    )]
    NoLeader {
        /// What may be meant.
        nearest: String,
    },
    /// Joints that a tree of independent joints cannot have.
    #[error(
        "it is tied to {leader}: --lock {joint} or {leader}, or take tied joints as free ones with \
         --free-couplings"
    )]
    Coupled {
        /// The joint's name.
        joint: String,
        /// What it follows.
        leader: String,
    },
    /// A constraint that closes a loop or ties bodies.
    #[error("constraints between bodies are not imported; leave it out with --free-couplings")]
    Constraint,
    /// A feature of the format that has no counterpart here.
    #[error("{what} is not supported: {advice}")]
    Unsupported {
        /// The feature.
        what: String,
        /// What to do instead.
        advice: String,
    },
    /// More than the algorithms are compiled for.
    #[error(
        "{degrees_of_freedom} degrees of freedom, and at most {most} are possible: lock joints with --lock"
    )]
    TooLarge {
        /// Of the robot.
        degrees_of_freedom: usize,
        /// Of the largest tree.
        most: usize,
    },
    /// An option names what the robot does not have.
    #[error("the robot has no {what} of this name{nearest}")]
    NoSuch {
        /// A link, a joint.
        what: &'static str,
        /// What may be meant.
        nearest: String,
    },
    /// A foot has nothing that touches the floor.
    #[error("{reason}; state its sole with --sole LINK=X_MIN,X_MAX,Y_MIN,Y_MAX,Z")]
    NoSole {
        /// Why no point was found.
        reason: String,
    },
}
