//! What accuracy costs: each method on each problem, from coarse steps to fine ones.
//!
//! ```text
//! scene ─► Problem ─┬► Contender (method) ─ play, time ─► Measurement ─► Curve ─► ranked ─► advice
//!                   └► Reference: two methods that share nothing ──┘         └► charts, page
//! ```
//! The same for the controller: [`controller_precision`], errors of torques and of the motion.
//!
//! Errors are distances of places at [`problem::SAMPLES`] times from the reference's, over how far its motion
//! reaches. All but times is deterministic.

mod advice;
mod catalogue;
mod chapter;
mod closed_loop;
mod contender;
mod controller;
mod controller_figures;
mod controller_form;
mod course;
mod figures;
mod measure;
mod mechanism_contenders;
mod peers;
mod problem;
mod recommend;
mod reference;
mod sentences;
mod slope;
mod survey;
mod sweep;
mod table;
mod tick_count;
mod touch_down;
mod tree_contenders;

pub use advice::{Advice, AdviceError, Among, RECORDED, advise};
pub use catalogue::{CatalogueError, PROBLEMS, problem};
pub use chapter::{PrecisionChapterFailure, chapter as precision_chapter, file_of};
pub use contender::{Contender, Foretell, Runs, Start};
pub use controller::{
    ControllerPrecision, FASTEST_HZ, TorqueError, TrackingError, controller_precision,
};
pub use controller_figures::controller_figures;
pub use controller_form::ControllerForm;
pub use course::{Conserved, Course};
pub use figures::{PrecisionFigure, figures};
pub use measure::{Failed, Level, Measurement, Played, Span, Timing, distance};
pub use peers::{MUJOCO_INTEGRATORS, Mujoco, MujocoModel, NoModel, NoMujoco, mujoco_model};
pub use problem::{ClosedForm, Omission, Problem, SAMPLES};
pub use recommend::{Choice, ERROR_MARGIN, STEP_MARGIN, longest, ranked};
pub use reference::{NoReference, Reference, reference};
pub use sentences::{cost, step};
pub use slope::{Fit, fitted};
pub use survey::{Survey, SurveyError, survey};
pub use sweep::{Curve, Effort, measured, sweep, timed};
pub use table::{machine, write_rows};
pub use tick_count::{pass, read_states};
pub use tree_contenders::{AT_MIDPOINTS, WITH_CONSTRAINTS};
