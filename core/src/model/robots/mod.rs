//! Example robots: the dissertation's biped, an arm on a fixed base, a branching tree.

pub mod arm;
pub mod biped;
pub mod branching;
