//! The host simulator of `surefoot`: plants, contact, scenes, closed loops, records and charts.
//!
//! ```text
//! scene file ─► Scene ─► Plant ─► step ─► Record ─► summary, CSV, MCAP, charts, report
//!                 │        ▲ torques, held between ticks
//!                 └──► Controller (host f32 or f64)
//! ```
//! Beside it stands chapter 2: [`mechanics`] (Lagrangians, discrete and not), [`newton`] (the one
//! nonlinear solver), [`integrators`], [`stability`] (how long their steps may be) and [`precision`]
//! (what accuracy costs); of chapter 5 [`multibody`]. Scenes of either run by [`mechanism`]; what models of a
//! motion cost is [`parsimony`]'s.
//!
//! All of it in f64, but for a controller in f32. A plant allocates when it is built, never in a
//! step.

pub mod callgrind;
pub mod chart;
pub mod cli;
pub mod closed_loop;
pub mod contact;
pub mod experiments;
pub mod follow;
pub mod integrators;
pub mod mechanics;
pub mod mechanism;
pub mod multibody;
pub mod newton;
pub mod parsimony;
pub mod picture;
pub mod plant;
pub mod precision;
pub mod record;
pub mod report;
pub mod robot;
pub mod scene;
pub mod stability;
pub mod written;
