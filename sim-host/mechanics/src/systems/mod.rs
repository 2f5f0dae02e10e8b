//! The systems of §2.4, and one without constraints, each with its Lagrangian, constraints, and what is conserved.

mod free_rigid_body;
mod pendulum;
mod planet;

pub use free_rigid_body::FreeRigidBody;
pub use pendulum::{DoubleSphericalPendulum, Pendulum, PolarAngles};
pub use planet::Planet;
