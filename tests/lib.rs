//! Shared problems and fixtures of the suite.

pub mod vectors;
