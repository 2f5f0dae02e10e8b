//! Runs of mechanisms that nobody controls (chapter 2), under any method.

mod cause;
mod composed;
mod joint_motion;
mod layout;
mod merged;
mod model;
mod moving;
mod named_joint;
mod reactions;
mod run;
mod smaller;
mod start;
mod tree;

pub use cause::Cause;
pub use joint_motion::JointMotion;
pub use layout::{Layout, LayoutKind, NamedPoint, Rods};
pub use merged::NotMerged;
pub use model::{ChosenModel, MechanismModel, Started};
pub use moving::Moving;
pub use named_joint::{JointKind, NamedJoint};
pub use reactions::Reaction;
pub use run::{Earlier, MechanismRun, MechanismSample, run, run_from, run_model};
pub use start::{StartFailure, start, start_bodies, start_model, start_within};
