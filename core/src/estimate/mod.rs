//! Where the robot is and how it moves, from what it can sense: an inertial sensor with biases, joint
//! encoders and foot switches, in an error-state Kalman filter.
//!
//! ```text
//! inertial sample ─► predict ───────────────► r v R b_f b_w and their covariance
//!                                                │          ▲
//! encoders ─► pose of each foot ─► touch-down ───┤          │ inject
//! switches and plan ──────────────┘              └► update: rows of one foot
//! ```
//! # Notation
//! - `r, v`: position and velocity of the inertial sensor, world axes; `R`: world from body
//! - `b_f, b_w`: biases of accelerometer and gyroscope, body axes; `f, w`: what is left of the samples
//! - `p_i, Φ_i`: position of foot `i` and world from its sole, world axes
//! - `s_i, Z_i`: the same in the body's frame, from the sensor's point, by encoders and kinematics
//! - `δr δv δθ δb_f δb_w δp_i δφ_i`: errors, three numbers each; `R = R̂ exp(δθ)`, `Φ = exp(δφ) Φ̂`
//! - `P`: their covariance, in blocks of 3 × 3, of which the lower triangle is kept
//! - `g`: gravity; `h`: seconds a tick; `e₃`: up; `[x]`: matrix of `x ×`
//!
//! # Equations
//! Prediction, from the samples' means over the last tick (Bloesch et al. 2013, sec. IV; error algebra as in
//! Solà 2017, sec. 5.4):
//! ```text
//! f = acc − b_f    w = gyro − b_w    a = R f − g e₃                                        (1)
//! r ← r + h v + h² a/2    v ← v + h a    R ← R exp(h w)                                    (2)
//! δr' = δr + h δv    δv' = δv − h R ([f] δθ + δb_f)    δθ' = exp(h w)ᵀ δθ − h δb_w          (3)
//! ```
//! Measurements of a foot that stands (position: Bloesch 2013; orientation: Rotella et al. 2014), with
//! `m_i = Rᵀ (p_i − r)`:
//! ```text
//! s_i − m_i        = −Rᵀ δr + [m_i] δθ + Rᵀ δp_i + noise                                   (4)
//! log(Z_i Φ_iᵀ R)  = −δθ + Rᵀ δφ_i + noise                                                 (5)
//! ```
//! Touch-down: no wide variances, but what is known of the body (6), the foot's rows of `P` from those of `δr, δθ`:
//! ```text
//! p_i = r + R s_i    Φ_i = R Z_i    δp_i = δr − R [s_i] δθ + noise    δφ_i = R δθ + noise    (6)
//! ```
//! Options: a floor that is known to be level, `n = Φ_i e₃` (7); its height, `p_i,z` (8); and where up is by
//! the force `F` of all feet on a robot at rest, body axes (9):
//! ```text
//! (n_y, −n_x) = δφ_i,xy + noise (7)    z₀ − p_i,z = δp_i,z + noise (8)    f − |f| F/|F| = b_f, x and y only (9)
//! ```
//! # What it cannot know
//! Biases `b_f` across gravity are the tilt: an accelerometer that is off by 0.1 m/s², or a sensor askew by
//! 0.6°, is a tilt of 0.6° for good, unless (7) or (9) say otherwise. Position and heading drift. A start that
//! is 10° wrong is never recovered; it shows as `|b_f|` beyond its bound ([`Health`]).
//!
//! # Cost
//! Of [`Estimator::step`] with two feet, f32, instructions on a Cortex-M4F: two soles of which one is used each
//! tick ([`Turn::One`]) 22 300, both ([`Turn::All`]) 38 000; one that stands while the other swings 17 700, its
//! touch-down's tick 25 100; with (9) 27 400, with (7) and (8) 29 900. Two points in turn 11 800. A foot that swings
//! and one that is absent cost nothing. [`foot_poses`] of two legs of six joints take 2 000. In f32 the estimate is within 1 µm and 0.01 mm/s of f64's.
//!
//! # Supervision
//! Estimates move by what the filter finds, beside what velocities do: a supervisor of measured states takes larger
//! steps of them ([`VELOCITY_STEPS`], [`ANGULAR_VELOCITY_STEPS`]).
//!
//! # Sources
//! M. Bloesch et al., "State estimation for legged robots: consistent fusion of leg kinematics and IMU",
//! Robotics: Science and Systems VIII (MIT Press 2013). N. Rotella, M. Bloesch, L. Righetti, S. Schaal, "State
//! estimation for a humanoid robot", IROS 2014. J. Solà, "Quaternion kinematics for the error-state Kalman
//! filter", arXiv:1711.02508 (2017).

mod answer;
mod covariance;
mod fault;
mod foot_pose;
mod health;
mod measurement;
mod predict;
mod readings;
mod settings;
mod start;
mod state;
mod step;
mod touch_down;
mod update;
mod watch;

/// By how much more than a measured one an estimated velocity may step for a supervisor: position moves by 0.7 mm a
/// tick as feet rock on ground that yields, which is a step of 0.7 m/s. What the filter finds itself of readings that
/// cannot be is its own to say.
pub const VELOCITY_STEPS: f32 = 20.0;
/// The same of an angular velocity: orientation moves by 0.9 mrad a tick, a step of 0.9 rad/s.
pub const ANGULAR_VELOCITY_STEPS: f32 = 4.0;

pub use answer::{Estimate, EstimateReport, Innovation};
pub use fault::{EstimateFault, EstimateInput};
pub use foot_pose::{FootPose, foot_poses};
pub use health::{Concern, Health, OutOfBounds};
pub use readings::{FootReading, ImuReading, Readings};
pub use settings::{Bounds, Estimator, Floor, FootKind, SensorNoise, Turn};
pub use start::StartPose;
pub use state::{EstimatorState, FootState};
pub use watch::EstimateWatch;
