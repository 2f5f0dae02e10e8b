//! §5.4.

mod motion;
mod reference;
mod solver;
