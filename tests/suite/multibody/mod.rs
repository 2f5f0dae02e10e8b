//! §5.4.

mod forces;
mod limits;
mod loops;
mod lumped;
mod merged;
mod motion;
mod models;
mod oracle;
mod planar;
mod reference;
mod resume;
mod solver;
mod strikes;
mod throws;
mod trees;
