//! Why a list of links is no tree.

/// What [`Tree::try_new`](super::Tree::try_new) refuses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeFault {
    /// There is no link.
    Empty,
    /// `NQ` is not the number of joint coordinates of the links.
    Coordinates {
        /// `NQ`
        given: usize,
        /// The sum over the joints.
        needed: usize,
    },
    /// `NV` is not the number of joint velocities of the links.
    Velocities {
        /// `NV`
        given: usize,
        /// The sum over the joints.
        needed: usize,
    },
    /// A link is not what a body with a joint can be.
    Link {
        /// Its index in the list of links, from 0. (A [`Link`](super::Link)'s `inboard` counts from 1.)
        index: usize,
        /// What is wrong with it.
        reason: LinkFault,
    },
}

/// What is wrong with a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkFault {
    /// Its inboard link is itself or comes later.
    Inboard,
    /// It floats, but hangs from another link.
    FloatingInboard,
    /// Its joint's axis is zero, NaN or infinite.
    Axis,
    /// Its joint's point is NaN or infinite.
    Point,
    /// Its centre of mass is NaN, infinite, or so far away that its inertia about the joint is.
    Center,
    /// Its orientation is no unit quaternion (to 1 in 10⁶ of the squared norm).
    Orientation,
    /// Its general joint has not 1 to 6 degrees of freedom with as many to 7 coordinates.
    GeneralJoint,
    /// Its mass is negative, NaN or infinite.
    Mass,
    /// Its inertia is NaN or infinite.
    Inertia,
    /// It has an inertia but no mass.
    InertiaWithoutMass,
    /// A moment of inertia is negative, or exceeds the sum of the other two.
    Moments,
    /// Its products of inertia are too large for its moments.
    Products,
    /// Its rotor inertia is negative, NaN or infinite, or its joint does neither turn nor slide.
    RotorInertia,
    /// It is the last of its branch and has neither mass nor rotor, so that its joint can have no acceleration.
    LeafWithoutMass,
}

impl LinkFault {
    /// The reason in words.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Inboard => {
                "a link's inboard link comes before it (0 is the inertial frame, 1 the first link)"
            }
            Self::FloatingInboard => {
                "a floating joint carries a body relative to the inertial frame: its inboard link is 0"
            }
            Self::Axis => "a joint axis needs a length: it is zero or not finite",
            Self::Point => "the joint's point is not finite",
            Self::Center => "the centre of mass is not finite, or too far away to compute with",
            Self::Orientation => "a body's orientation must be a unit quaternion, scalar first",
            Self::GeneralJoint => {
                "a general joint has 1 to 6 degrees of freedom and as many to 7 coordinates"
            }
            Self::Mass => "a mass is finite and not negative",
            Self::Inertia => "an inertia is finite",
            Self::InertiaWithoutMass => "no body has an inertia but no mass",
            Self::Moments => {
                "no body has this inertia: one principal moment exceeds the sum of the other two"
            }
            Self::Products => {
                "no body has this inertia: its products are too large for its moments"
            }
            Self::RotorInertia => {
                "a rotor inertia is finite and not negative, of a joint that turns or slides"
            }
            Self::LeafWithoutMass => {
                "the last link of a branch needs a mass, or its joint can have no acceleration"
            }
        }
    }
}

impl TreeFault {
    /// What `Tree::new` says at compile time, where no number can be printed.
    pub(super) const fn message(self) -> &'static str {
        match self {
            Self::Empty => "a tree has at least one body",
            Self::Coordinates { .. } => "NQ is not the number of joint coordinates of these links",
            Self::Velocities { .. } => "NV is not the number of joint velocities of these links",
            Self::Link { reason, .. } => reason.message(),
        }
    }
}

impl core::fmt::Display for LinkFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.message())
    }
}

impl core::fmt::Display for TreeFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Empty => f.write_str(self.message()),
            Self::Coordinates { given, needed } => {
                write!(f, "the links have {needed} joint coordinates, not NQ = {given}")
            }
            Self::Velocities { given, needed } => {
                write!(f, "the links have {needed} joint velocities, not NV = {given}")
            }
            Self::Link { index, reason } => write!(f, "links[{index}]: {reason}"),
        }
    }
}

impl core::error::Error for TreeFault {}
impl core::error::Error for LinkFault {}
