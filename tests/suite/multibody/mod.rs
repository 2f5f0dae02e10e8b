//! §5.4.

mod forces;
mod limits;
mod loops;
mod motion;
mod oracle;
mod reference;
mod resume;
mod solver;
mod throws;
mod trees;
