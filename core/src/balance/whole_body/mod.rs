//! A controller for any legged robot: legs of three to seven revolute or prismatic joints on feet that
//! are points, edges or soles, and other limbs that move.
//!
//! ```text
//! state ─► posture ─► feet ─► joints of pressing legs eliminated ─► P X + z = Σ G_i w_i
//!                              │                                          │
//!                              └────────► torques ◄── wrenches within limits (quadratic program)
//! ```
//! # What is asked for
//! - The central body follows a [`Reference`](super::Reference), as in [`tick`](super::tick).
//! - A pressing foot keeps still: its leg's joints follow from that, in the directions that its contact
//!   has. A leg with more joints uses the rest for its posture; near a singular posture (a straight knee)
//!   the direction that is lost is given up, without a jump.
//! - All other joints track a posture. Their inertia is in the dynamics, their torques in the command.
//! - Ground and motors, those of waist and arms as well, are limits: rows of a quadratic program whose
//!   objective is [`ContactProgram`](super::ContactProgram)'s. While none binds, the answer is the
//!   least-norm split of what each leg does not carry by itself; with legs of six joints and soles this is
//!   [`tick`](super::tick)'s, to round-off.
//!
//! # Cost
//! In f32 on x86 (callgrind), nothing binding and with limits in force: the biped 49 000 and 76 000
//! instructions, Go1 (twelve joints, four points) 56 000 and 74 000, G1 (29 joints, two soles) 132 000
//! and 153 000.
//!
//! # What it is told
//! A [`Tree`](crate::model::Tree) whose first body floats, its feet ([`WholeBodyFoot`]), in which
//! [`WholeBody`] finds the legs, and [`WholeBodySettings`] (with documented starting values by mass and
//! height).
//!
//! A leg that does not press tracks its posture in [`whole_body_tick`]; in [`whole_body_motion_tick`], for
//! a planner's [`MotionTask`], its foot follows an acceleration.

mod contact;
mod fault;
mod joint_line;
mod leg_inverse;
mod measured;
mod motion;
mod observed;
mod program;
mod reduced;
mod report;
mod robot;
mod settings;
mod task;
mod tick;

pub(crate) use contact::edge_axes;
pub use fault::WholeBodyRobotFault;
pub use motion::{MotionWeights, whole_body_motion_tick, whole_body_motion_tick_under};
pub use observed::{ObservedBody, observe};
pub use program::WholeBodyLimit;
pub use report::{WholeBodyCommand, WholeBodyMemory, WholeBodyReport, WholeBodyState};
pub(crate) use robot::Leg;
pub use robot::{MOST_JOINTS, MOST_LEG_JOINTS, WHOLE_BODY_FEET, WholeBody, WholeBodyFoot};
pub use settings::WholeBodySettings;
pub use task::{AngularTask, FootTask, LinearTask, MotionTask, ObservedFoot, ObservedMotion};
pub use tick::{WholeBodyController, whole_body_tick, whole_body_tick_under};
