//! §5.4.

mod forces;
mod limits;
mod loops;
mod lumped;
mod merged;
mod models;
mod motion;
mod oracle;
mod planar;
mod reference;
mod rerooted;
mod resume;
mod solver;
mod strikes;
mod throws;
mod trees;
