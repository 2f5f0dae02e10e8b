//! §5.4.

mod motion;
mod oracle;
mod reference;
mod solver;
mod trees;
