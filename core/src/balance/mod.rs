//! The recursive workspace controller (chapter 4), for a floating central body on serial legs of six
//! revolute joints.
//!
//! ```text
//! state ─► leg kinematics ─► workspace dynamics ─► desired wrench ─► distribution ─► joint torques
//!           (Alg. 4.1, 4.2)   (4.3, or fixed foot)  (4.4)             (4.5)           (4.6)
//! ```
//! [`tick`] runs all of it; the stages are public, each on the results of those before it. Between it
//! and the motors stands the [`Supervisor`].
//!
//! # One frame
//! Everything is expressed in the frame of the central body ("frame 1"): its axes, and positions from
//! its centre of mass. There the Jacobian's columns are the joint axes themselves, forces add without
//! being transformed, and Alg. 4.6 is one product per joint. The dissertation's link frames appear
//! only at the surface: foot wrenches are reported in the feet's body frames.

mod contact_wrenches;
mod controller;
mod desired_wrench;
mod fault;
mod fingerprint;
mod foot_limits;
mod gains;
mod ground_wrench;
mod joint_torques;
mod least_norm;
mod leg_jacobian;
mod leg_kinematics;
mod limited;
mod robot;
pub(crate) mod square;
mod state;
mod supervisor;
mod tick;
mod whole_body;
mod workspace_dynamics;
mod wrench_distribution;

pub use contact_wrenches::{
    ContactFoot, ContactLimit, ContactLimits, ContactPatch, ContactProgram, ContactWeights, Reason,
};
pub use controller::{Controller, WorkspaceForm};
pub use desired_wrench::{DesiredAcceleration, desired_acceleration};
pub use fault::{Fault, FootLimit, Input};
pub use fingerprint::whole_body_fingerprint;
pub use foot_limits::{FootLimits, FootLimitsFault, Sole};
pub use gains::Gains;
pub use ground_wrench::{FixedFootWrenches, fixed_foot_wrenches, sole_axes};
pub use joint_torques::joint_torques;
pub use leg_jacobian::LegJacobian;
pub use leg_kinematics::{CentralBody, LegKinematics, central_body, leg_kinematics};
pub use limited::{
    BindingRows, BrokenLimit, Ground, LimitMemory, LimitReport, LimitSet, LimitedCommand,
    WrenchLimits, WrenchLimitsFault, limited_tick, limited_tick_under,
};
pub use robot::{LeggedRobot, LeggedRobotFault};
pub use state::{Reference, RobotState};
pub use supervisor::{
    Before, JointDamping, JointLimits, LimitError, LimitFault, LimitField, Mode, SafetyLimits,
    StopReason, Supervised, Supervisor, SupervisorMemory, Thresholds,
};
pub use tick::{Command, tick};
pub use whole_body::{
    AngularTask, FootTask, LinearTask, MOST_JOINTS, MOST_LEG_JOINTS, MotionTask, MotionWeights,
    ObservedBody, ObservedFoot, ObservedMotion, WHOLE_BODY_FEET, WholeBody, WholeBodyCommand,
    WholeBodyController, WholeBodyFoot, WholeBodyLimit, WholeBodyMemory, WholeBodyReport,
    WholeBodyRobotFault, WholeBodySettings, WholeBodyState, observe, whole_body_motion_tick,
    whole_body_motion_tick_under, whole_body_tick, whole_body_tick_under,
};
pub(crate) use whole_body::{Leg, edge_axes};
pub use workspace_dynamics::{WorkspaceDynamics, big_base, fixed_foot_dynamics, fixed_foot_wrench};
pub use wrench_distribution::{FootWrenches, wrench_distribution};
