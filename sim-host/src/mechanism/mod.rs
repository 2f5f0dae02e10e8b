//! Runs of mechanisms that nobody controls (chapter 2), under any method.

mod cause;
mod composed;
mod joint_motion;
mod layout;
mod merged;
mod model;
mod moving;
mod reactions;
mod run;
mod smaller;
mod start;
mod tree;

pub use cause::Cause;
pub use joint_motion::JointMotion;
pub use layout::{JointKind, Layout, LayoutKind, NamedJoint, NamedPoint, Rods};
pub use merged::NotMerged;
pub use model::{ChosenModel, MechanismModel, Started};
pub use moving::Moving;
pub use reactions::Reaction;
pub use run::{Earlier, MechanismRun, MechanismSample, run, run_from, run_model};
pub use start::{StartFailure, start, start_bodies, start_model, start_within};
