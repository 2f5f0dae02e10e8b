//! The systems of §2.4, each with its Lagrangian, constraints, and what is conserved.

mod free_rigid_body;
mod pendulum;

pub use free_rigid_body::FreeRigidBody;
pub use pendulum::{DoubleSphericalPendulum, Pendulum, PolarAngles};
