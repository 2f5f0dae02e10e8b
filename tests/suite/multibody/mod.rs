//! §5.4.

mod forces;
mod limits;
mod loops;
mod lumped;
mod merged;
mod motion;
mod oracle;
mod reference;
mod rerooted;
mod resume;
mod solver;
mod strikes;
mod throws;
mod trees;
