//! Why a motion does not stay in a plane, or is not known to.

use super::super::system_error::SystemError;

/// Why a motion does not stay in a plane, or is not known to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotPlanar {
    /// A joint that turns about more than one axis.
    #[error("link {link} turns about more than one axis of its joint")]
    Joint {
        /// Which one.
        link: usize,
    },
    /// Hinges with different directions.
    #[error("the hinge of link {link} is not parallel to the others")]
    Axis {
        /// Which one.
        link: usize,
    },
    /// A prismatic joint out of the plane.
    #[error("link {link} slides out of the plane")]
    Slide {
        /// Which one.
        link: usize,
    },
    /// A free body that leaves the plane.
    #[error("link {link} floats, and starts out of the plane")]
    Start {
        /// Which one.
        link: usize,
    },
    /// A body of a tree that floats has no principal axis along the normal.
    #[error("link {link} floats, and no principal axis of it is normal to the plane")]
    Inertia {
        /// Which one.
        link: usize,
    },
    /// A body of a tree that floats lies beside the others.
    #[error("link {link} floats, and its centre of mass lies beside the plane of the others")]
    Beside {
        /// Which one.
        link: usize,
    },
    /// A tree that floats turns about its middle axis of inertia: whatever disturbs it tips it over.
    #[error(
        "link {link} floats, with the middle one of the moments of inertia about the plane's normal"
    )]
    Tips {
        /// The tree's first.
        link: usize,
    },
    /// Weight pulls a free body out of the plane.
    #[error("link {link} floats, and its weight is not in the plane")]
    Weight {
        /// Which one.
        link: usize,
    },
    /// The floor is not at a right angle to the plane.
    #[error("the floor is not at a right angle to the plane")]
    Floor,
    /// A contact point of a tree that floats has no mirror image beyond the plane.
    #[error("contact site {site} is beside the plane, without a mirror image")]
    Site {
        /// Which one.
        site: usize,
    },
    /// Slopes are stood on in space only.
    #[error("floors that are not level are stood on in space")]
    Terrain,
    /// Loops are solved in space only.
    #[error("closed loops are solved in space")]
    Loops,
    /// Thrown bodies are met in space only.
    #[error("bodies that strike others are met in space")]
    Strikers,
}

/// Why there is no planar motion.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PlanarError {
    /// It is no system, or no start of it.
    #[error(transparent)]
    System(#[from] SystemError),
    /// It does not stay in a plane.
    #[error(transparent)]
    NotPlanar(#[from] NotPlanar),
}
