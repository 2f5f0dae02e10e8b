//! §5.4.

mod forces;
mod limits;
mod loops;
mod motion;
mod oracle;
mod parsimony;
mod reference;
mod resume;
mod solver;
mod strikes;
mod throws;
mod trees;
