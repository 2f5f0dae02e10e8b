//! The systems of §2.4, each with its Lagrangian, constraints, and what is conserved.

mod double_spherical_pendulum;
mod free_rigid_body;
mod spherical_pendulum;

pub use double_spherical_pendulum::{DoubleSphericalPendulum, PendulumAngles};
pub use free_rigid_body::FreeRigidBody;
pub use spherical_pendulum::{PolarAngles, SphericalPendulum};
