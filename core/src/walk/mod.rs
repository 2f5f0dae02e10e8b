//! Walking, planned in closed form: where and when to step, how a foot swings, where the ground is to
//! press. It knows no dynamics: it sees an [`ObservedMotion`](crate::balance::ObservedMotion) and asks for
//! a [`MotionTask`](crate::balance::MotionTask), which
//! [`whole_body_motion_tick`](crate::balance::whole_body_motion_tick) turns into torques.
//!
//! ```text
//! model, standing ─► Stature ─► Gait                                     (once)
//! observed, forces, command ─► plan ─► wanted centre of pressure, height, feet     (each tick)
//!
//!         command to walk, or a push throws the capture point off the feet
//!   Standing ───────────────────────────► Single ──── touch-down ───► Double
//!      ▲                                     ▲                          │  feet abreast, capture point
//!      │                                     └──────── T_d later ───────┤  inside, command to stand
//!      └────────────────────────────────────────────────────────────────┘
//! ```
//! From standing a robot jumps too (`Phase::Jump`: crouch, push, flight, landing, and again), and where it is to run, it goes on
//! from double support in `Phase::Run`: a stance, a flight, a stance of the other side; a touch-down leads back to `Single`.
//!
//! A step is taken by a *side*: one foot of a biped, a diagonal pair of a quadruped (which then trots). The
//! plan sees the mean point of a side's feet.
//!
//! # Notation
//! Plane coordinates in the heading frame, forward and left; `s = +1` for a stance on the left.
//!
//! ```text
//! c, z, L     centre of mass, its height above the feet, angular momentum about it
//! m, g        mass, gravity;  ω = √(g/z) of the height standing
//! ξ           divergent component of motion (capture point): see `capture`
//! e           ξ from the stance point
//! T_s, T_d    time on one side, on both;  E_s = exp(ω T_s), E_d = exp(ω T_d), κ = (E_d − 1)/(ω T_d)
//! u, W        step from stance point to stance point; its lateral part in place
//! a, b        ξ from the old stance point at touch-down, from the new one at the other side's lift-off
//! p, p*       centre of pressure, and the wanted one
//! ```
//!
//! # Sources
//! - J. Englsberger, C. Ott, A. Albu-Schäffer, "Three-dimensional bipedal walking control based on
//!   divergent component of motion", T-RO 31 (2015): ξ, and its course while the centre of pressure moves
//!   from foot to foot (sections III and V).
//! - M. Khadiv, A. Herzog, S. A. A. Moosavian, L. Righetti, "Walking control based on step timing
//!   adaptation", T-RO 36 (2020): the offset `b`, and the time of a step as a free variable (section III).
//! - Y. Gong, J. Grizzle, "Angular momentum about the contact point for control of bipedal locomotion"
//!   (2020): momentum about the contact in the place of the centre of mass's velocity.
//! - J. Pratt, J. Carff, S. Drakunov, A. Goswami, "Capture point: a step toward humanoid push recovery",
//!   Humanoids 2006.
//! - M. Raibert, *Legged robots that balance* (1986), chapter 2: speed by foot placement.
//!   Running by the same source's three laws (chapters 2 and 3).
//! - D. Orin, A. Goswami, S.-H. Lee, "Centroidal dynamics of a humanoid robot", *Auton. Robots* 35 (2013): the angular
//!   momentum that a jump takes along.
//! - T. Flash, N. Hogan, "The coordination of arm movements", J. Neurosci. 5 (1985): minimum jerk.
//!
//! The equations here were derived from these and checked against a program in Python on another
//! simulator's robots, from which the constants of [`Gait`] come as well.
//!
//! # Bounds
//! No loop is longer than the feet, or nine times of a step. A plan's arithmetic is some 300 operations, 1200
//! while it searches.

mod asked;
mod ballistic;
mod bounded;
mod capture;
mod check;
mod command;
mod fault;
mod gait;
mod heading;
mod height;
mod jump;
mod memory;
mod orientation;
mod periodic;
mod plan;
mod run;
mod seen;
mod speed;
mod stature;
mod step;
mod stepping;
mod support;
mod swing;

pub use ballistic::{take_off_speed, time_aloft};
pub use capture::capture_point;
pub use command::{JumpOrder, PlaneMotion, WalkCommand};
pub use fault::{StatureFault, WalkFault, WalkInput};
pub use gait::Gait;
pub use jump::{JumpPhase, JumpStage};
pub use memory::{Phase, TouchDown, WalkMemory};
pub use periodic::{PeriodicStep, periodic_step};
pub use plan::{Leeway, Planner, WalkTask};
pub use run::RunPhase;
pub use stature::{Side, StandingRobot, Stature, SteppingFoot};
pub use step::{PlannedStep, StepQuery, next_step};
pub use swing::SwingFoot;

/// Rates that are believed of the joints of a robot that walks, over what its motors reach: a sole that lands
/// on an edge turns its ankle faster for a tick (G1's at 39 rad/s, its motor 30; Go1's calf 20.5 and 20.06).
pub const LANDING_RATE: f32 = 2.0;

/// A robot that walks keeps its joints by this within the ranges that its encoders read, rad (m): what a landing moves an
/// ankle in a tick.
pub const RANGE_MARGIN: f32 = 0.02;
