//! Kinematics and dynamics of tree-structured systems (chapter 3).
//!
//! Every algorithm takes the constant [`Tree`](crate::model::Tree) and the [`JointPoses`] of one
//! configuration, whose sines and cosines are so taken once. Velocities `β`, accelerations `dβ/dt`
//! and torques `τ` are arrays over all joints, in the tree's order; a floating joint's six are twist
//! and wrench in the body frame, linear part first. External wrenches are given for each body at its
//! centre of mass, in its body frame; leaving them out costs nothing.
//!
//! # Inside
//! The recursions run in joint frames, where a joint map is a unit vector, and use the classical
//! acceleration of the frame's origin, `a = v̇ + ω × v`, in place of the component derivative `v̇`.
//! With it the velocity `v` drops out of the dynamics altogether, as it does from Newton's and
//! Euler's laws (Luh, Walker and Paul 1980): only `ω` is propagated. Gravity enters as an
//! acceleration `−g` of the inertial frame. Inputs and outputs are the dissertation's.

mod columns;
mod fault;
mod floating;
mod floating_root;
mod forward_dynamics;
mod forward_kinematics;
mod forward_limbs;
mod inverse_dynamics;
mod inverse_limbs;
mod joint_block;
mod joint_frames;
mod joint_motion;
mod joint_poses;
pub(crate) mod lanes;
mod limb_inertia;
mod limbs;
mod mass_matrix;
mod reversed;

pub use fault::DynamicsFault;
pub(crate) use floating::{floating_inverse_dynamics, legged_inverse_dynamics};
pub use forward_dynamics::forward_dynamics;
pub(crate) use forward_dynamics::project_turn;
pub(crate) use forward_kinematics::forward_kinematics_in;
pub use forward_kinematics::{
    BodyKinematics, Kinematics, body_poses, body_velocities, forward_kinematics, position_rates,
};
pub use inverse_dynamics::{bias_forces, inverse_dynamics};
pub(crate) use joint_frames::joint_frames;
pub use joint_poses::{JointPoses, joint_poses};
pub use mass_matrix::mass_matrix;
