//! The simulator of `surefoot`: robots, scenes, plants, closed loops and their records.
//!
//! ```text
//! scene file ─► Scene ─► Plant ─► step ─► Record ─► summary, CSV, MCAP, pictures
//!                 │        ▲ torques, held between ticks
//!                 └──► Controller (host f32 or f64, firmware)
//! ```
//! Scenes without a controller run by [`mechanism`]. All of it in f64, but for a controller in f32. A plant
//! allocates when it is built, never in a step.

pub mod closed_loop;
pub mod follow;
pub mod mechanism;
pub mod picture;
pub mod plant;
pub mod record;
pub mod robot;
pub mod scene;
pub mod written;
