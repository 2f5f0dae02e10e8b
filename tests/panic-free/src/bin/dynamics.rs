//! The rest of core: kinematics and dynamics of a tree with every kind of joint have no panicking
//! path either.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;
use nalgebra::Vector3;
use surefoot::dynamics::{
    bias_forces, body_poses, body_velocities, forward_dynamics, forward_kinematics,
    inverse_dynamics, joint_poses, mass_matrix, position_rates,
};
use surefoot::model::Tree;
use surefoot::model::robots::{biped, branching};
use surefoot::spatial::Wrench;

/// All algorithms on one tree, with and without external wrenches.
#[inline(always)]
fn opaque_dynamics<const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f32, N, NQ, NV>,
    positions: [f32; NQ],
) {
    let positions = black_box(positions);
    let rates = black_box([0.1; NV]);
    let efforts = black_box([0.2; NV]);
    let pushes = [Wrench { force: Vector3::zeros(), torque: Vector3::zeros() }; N];
    let external = black_box(Some(&pushes));
    black_box(position_rates(tree, &positions, &rates));
    let Ok(poses) = joint_poses(tree, &positions) else { return };
    black_box(body_poses(tree, &poses));
    black_box(body_velocities(tree, &poses, &rates));
    black_box(forward_kinematics(tree, &poses, &rates, &efforts));
    black_box(inverse_dynamics(tree, &poses, &rates, &efforts, external));
    black_box(bias_forces(tree, &poses, &rates, external));
    black_box(mass_matrix(tree, &poses));
    let _ = black_box(forward_dynamics(tree, &poses, &rates, &efforts, external));
}

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    // Floating and revolute joints; then prismatic, spherical, fixed and general ones.
    opaque_dynamics(black_box(&biped::TREE_F32), [0.0; 19]);
    opaque_dynamics(black_box(&branching::TREE_F32), [0.0; 8]);
    panic_free::halt()
}
