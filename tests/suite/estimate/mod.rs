//! The state estimator.

mod hostile;
mod motion;
mod oracle;
mod precision;
mod symmetry;
