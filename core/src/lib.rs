//! Balance control and rigid-body dynamics for articulated robots, small enough for a
//! microcontroller: no standard library, no heap, no panic, bounded time, in `f32` and `f64`.
//!
//! The algorithms are those of J. M. Wendlandt, *Control and Simulation of Multibody Systems*
//! (PhD dissertation, U.C. Berkeley, 1997); section, equation and algorithm numbers refer to it, and
//! `DEVIATIONS.md` lists where and why this code differs.
//!
//! # Layers
//! - [`spatial`]: rotations, poses, twists, wrenches, inertias (Appendix A).
//! - [`model`]: robots as constant data, checked at compile time (§3.1, §3.2.2, §4.1).
//! - [`dynamics`]: forward kinematics, inverse and forward dynamics, mass matrix (Alg. 3.1 to 3.3,
//!   §3.3.4), linear in the number of bodies (but for the mass matrix).
//! - [`estimate`]: where the robot is and how it moves, from an inertial sensor, encoders and foot switches.
//! - [`qp`]: quadratic programs with soft rows, within a budget of work; no physics.
//! - [`balance`]: the recursive workspace controller (Alg. 4.1 to 4.6) as one
//!   [`tick`](balance::tick), from measured state to joint torques or a typed fault.
//! - [`walk`]: steps in closed form, and what they ask of the controller of whole bodies.
//! - [`disturbance`]: what the equations of motion tell that the model does not know.
//!
//! # Flow
//! A result is a small struct which the next function demands by reference:
//! ```
//! use surefoot::dynamics::{forward_dynamics, inverse_dynamics, joint_poses};
//! use surefoot::model::robots::arm;
//!
//! let angles = [0.1, -0.4, 0.9, 0.3, -0.2, 0.5, 0.02];
//! let rates = [0.5; 7];
//! let accelerations = [1.0, -1.0, 0.5, 0.0, 2.0, 0.1, 0.3];
//! let poses = joint_poses(&arm::TREE, &angles)?;
//! let torques = inverse_dynamics(&arm::TREE, &poses, &rates, &accelerations, None);
//! let recovered = forward_dynamics(&arm::TREE, &poses, &rates, &torques, None)?;
//! assert!(recovered.iter().zip(accelerations).all(|(a, b)| (a - b).abs() < 1e-9));
//! # Ok::<(), surefoot::dynamics::DynamicsFault>(())
//! ```
//! # Features
//! - `serde` (off): faults, modes, limits and reports can be sent. No feature changes a number.
#![no_std]
#![forbid(unsafe_code)]

pub mod balance;
pub mod disturbance;
pub mod dynamics;
pub mod estimate;
pub mod model;
pub mod qp;
mod scalar;
pub mod spatial;
pub mod walk;

/// Vectors and matrices of this crate's interface, in the version that it takes.
pub use nalgebra;
pub use scalar::Real;

/// The package's own page.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
