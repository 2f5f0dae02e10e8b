//! What is wrong with a system, or with its start.

/// Why there is no such system, or no such start.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// A link's inboard body does not come before it.
    #[error("link {link}: its inboard link {inboard} does not come before it")]
    Order {
        /// Which one.
        link: usize,
        /// What it names.
        inboard: usize,
    },
    /// A mass or an inertia is none.
    #[error("link {link}: a mass and three inertias above zero are needed")]
    Inertia {
        /// Which one.
        link: usize,
    },
    /// Not a state for each link.
    #[error("{given} states for {links} links")]
    Length {
        /// How many there are.
        given: usize,
        /// How many there should be.
        links: usize,
    },
    /// A number is not finite.
    #[error("link {link}: coordinate {coordinate} or its rate is not finite")]
    NotFinite {
        /// Which one.
        link: usize,
        /// Which one.
        coordinate: usize,
    },
    /// A start violates a constraint.
    #[error("link {link}: the start violates a constraint by {value:.1e}")]
    OffManifold {
        /// Which one.
        link: usize,
        /// By how much, itself or its rate.
        value: f64,
    },
    /// A joint cannot have this law.
    #[error(
        "link {link}: a spring, a damper or stops need a revolute or prismatic joint, and finite numbers, zero or more"
    )]
    Law {
        /// Which one.
        link: usize,
    },
    /// A link cannot have a gimbal's motors.
    #[error("link {link}: motors of a gimbal need a spherical joint that has none yet")]
    Gimbal {
        /// Which one.
        link: usize,
    },
    /// A start in which a gimbal's motors cannot be told apart.
    #[error("link {link}: the middle motor of its gimbal is within 5 degrees of a quarter turn")]
    GimbalLock {
        /// Which one.
        link: usize,
    },
    /// A contact site is on no body, or not at finite coordinates.
    #[error("contact site {site}: a link that exists and finite coordinates are needed")]
    Site {
        /// Which one.
        site: usize,
    },
    /// A plane under a link without contact sites, or a second one.
    #[error("link {link} has no contact sites, or stands on another plane already")]
    Terrain {
        /// Which one.
        link: usize,
    },
    /// A striker is no free body after all others, or a number of it is not finite.
    #[error(
        "striker {striker}: it must be a floating link after all that do not strike, with nothing on it, and \
         finite points and a box with a size are needed"
    )]
    Striker {
        /// Which one.
        striker: usize,
    },
    /// A floor's parameter cannot be used.
    #[error("the floor's {parameter} is {value}: expected {expected}")]
    Floor {
        /// Which one.
        parameter: &'static str,
        /// What it is.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// A loop is closed between bodies that are not there, or with itself.
    #[error("loop {closure}: it must join two links that exist, or one and the world")]
    Closure {
        /// Which one.
        closure: usize,
    },
    /// A joint that closes a loop cannot have motors, or has some.
    #[error(
        "loop {closure}: motors need a revolute, universal or spherical joint that has none yet, and their axes if \
         it is spherical"
    )]
    ClosingMotors {
        /// Which one.
        closure: usize,
    },
    /// A start violates a loop's constraint.
    #[error("loop {closure}: the start violates its constraint by {value:.1e}")]
    OpenLoop {
        /// Which one.
        closure: usize,
        /// By how much, itself or its rate.
        value: f64,
    },
    /// Loops have more constraints than can be solved.
    #[error("loops have {constraints} constraints, and {most} at most can be solved")]
    TooManyLoops {
        /// How many there are.
        constraints: usize,
        /// How many there may be.
        most: usize,
    },
    /// Something that the simulator has no model of.
    #[error("link {link}: {what} is needed")]
    Unsupported {
        /// Which one.
        link: usize,
        /// What it would take.
        what: &'static str,
    },
    /// A checkpoint of another system, model or step.
    #[error("the checkpoint belongs to another system, to another model of it, or to another step")]
    OtherCheckpoint,
    /// The step is no time.
    #[error("a step of {h} s: a positive number is needed")]
    Step {
        /// s
        h: f64,
    },
}
