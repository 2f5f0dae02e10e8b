//! Shared problems and fixtures of the suite.

pub mod chains;
pub mod vectors;
pub mod workloads;
