//! Simulators by others, on the same models in the same run.

mod contenders;
mod mjcf;
mod mujoco;

pub(super) use contenders::peer_contenders;
pub use mjcf::{MujocoModel, NoModel, mujoco_model};
pub use mujoco::{Mujoco, NoMujoco};

/// Integrators of MuJoCo, with their orders, and evaluations of the equations of motion in a step.
pub const MUJOCO_INTEGRATORS: [(&str, u32, u64); 3] =
    [("Euler", 1, 1), ("implicitfast", 1, 1), ("RK4", 4, 4)];
