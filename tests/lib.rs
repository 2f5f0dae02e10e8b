//! Shared problems and fixtures of the suite.

pub mod chains;
pub mod contact_problems;
pub mod legged_trees;
pub mod motions;
pub mod quadruped;
pub mod random_trees;
pub mod vectors;
pub mod workloads;
