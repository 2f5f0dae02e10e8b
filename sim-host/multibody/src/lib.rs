//! The symplectic simulator of multibody systems (§5.4).
//!
//! ```text
//! Body, Joint ─► System ─┬► merged, lumped ─► Reduced: a smaller system, and how its bodies carry the others
//!                        ├► rerooted ─► Rerooted: the same bodies, hanging from those that the world holds
//!                        ├► Simulation: joint coordinates, which play every scene with bodies
//!                        ├► PlanarSimulation: the same of what stays in a plane; SingleBody: of one free body
//!                        └► ConstrainedSimulation: as the text has it (5.11), (5.13), Alg. 5.1; the oracle
//! ```
#![doc = include_str!("../../../docs/your-own-bodies.md")]

mod body;
mod chain;
mod closure;
mod constrained;
pub mod contact;
mod gimbal;
mod joint;
mod joint_law;
mod planar;
mod recursive;
mod reduction;
mod robot;
mod scale;
mod single_body;
mod start_check;
mod stepping;
mod striker;
mod system;
mod system_error;
mod system_measures;

pub use body::{Body, BodyState};
pub use chain::{Chain, ChainJoint};
pub use closure::{Closing, ClosingMotors, Closure, ConstraintFunction};
pub use constrained::{ConstrainedSimulation, Correction, Equations, SingularJoint, TreeEquations};
pub use gimbal::Gimbal;
pub use joint::{Joint, JointConstraint, MOST_CONSTRAINTS, Rows};
pub use joint_law::{CREEP, JointLaw, Stops};
pub use planar::{NotPlanar, PlanarCheckpoint, PlanarError, PlanarSimulation, Plane};
pub use recursive::{Checkpoint, Simulation, StepForecast};
pub use reduction::{Frame, Reduced, Rerooted, Seat, Side, lumped, merged, rerooted};
pub use robot::{PrincipalAxes, principal_system_of_tree, states_of_tree, system_of_tree};
pub use single_body::{BodyCheckpoint, NotSingle, SingleBody, SingleBodyError};
pub use striker::{BOX_POINTS, CORNERS, Striker};
pub use system::{Link, Site, System};
pub use system_error::SystemError;
