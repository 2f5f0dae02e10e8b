//! The controller for any legged robot: what it promises against the equations of motion, the tick for
//! legs of six joints against it, and what it does where there is little or nothing to be done.

mod dynamics;
mod hostile;
mod limits;
mod motion;
mod singular;
mod six_joints;

use nalgebra::Vector3;
use rand_pcg::Pcg64;
use surefoot::Real;
use surefoot::balance::{
    Fault, Reference, WholeBody, WholeBodyCommand, WholeBodyController, WholeBodyFoot,
    WholeBodyMemory, WholeBodySettings, WholeBodyState, whole_body_tick,
};
use surefoot::model::Tree;
use surefoot::spatial::Quaternion;
use surefoot_tests::legged_trees::Legged;
use surefoot_tests::random_trees::symmetric;

/// Feet of precision `T`.
pub fn feet_f32(feet: &[Option<WholeBodyFoot<f64>>; 4]) -> [Option<WholeBodyFoot<f32>>; 4] {
    feet.map(|foot| {
        foot.map(|foot| WholeBodyFoot {
            body: foot.body,
            reference: foot.reference.map(|x| x as f32),
            axes: Quaternion::from_array(foot.axes.to_array().map(|x| x as f32)),
            limits: foot.limits.to_f32(),
        })
    })
}

/// Near the stance of a robot, level or not, moving or not.
fn state<const N: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    robot: &Legged<N, NQ, NV>,
    share: f64,
) -> WholeBodyState<f64, NQ, NV> {
    let mut positions = [0.0; NQ];
    let [x, y, z, a, b, c]: [f64; 6] = symmetric(rng);
    positions[..3].copy_from_slice(&[x, y, z]);
    let turned = Quaternion::from_rotation_vector(Vector3::new(a, b, c) * (0.5 * share));
    positions[3..7].copy_from_slice(&turned.to_array());
    for (to, at) in positions[7..].iter_mut().zip(&robot.stance[6..]) {
        let [off] = symmetric(rng);
        *to = *at + 0.15 * share * off;
    }
    let velocities = symmetric::<NV>(rng).map(|x| share * x);
    WholeBodyState { positions, velocities }
}

fn reference<T: Real>(rng: &mut Pcg64, share: f64) -> Reference<T> {
    let mut vector = |size: f64| Vector3::from(symmetric::<3>(rng).map(|x| T::of(size * x)));
    Reference {
        position: vector(1.0),
        velocity: vector(share),
        acceleration: vector(share),
        orientation: Quaternion::from_rotation_vector(vector(0.3 * share)),
        angular_velocity: vector(share),
        angular_acceleration: vector(share),
    }
}

/// One cold tick with all feet down.
fn command<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    feet: &[Option<WholeBodyFoot<T>>; 4],
    settings: &WholeBodySettings<T, NV>,
    state: &WholeBodyState<T, NQ, NV>,
    reference: &Reference<T>,
) -> Result<WholeBodyCommand<T, 4, NV>, Fault> {
    let robot = WholeBody::new(tree, feet).expect("a legged robot");
    let controller = WholeBodyController { tree, robot: &robot, settings };
    let mut memory = WholeBodyMemory::new();
    whole_body_tick(&controller, state, reference, &[true; 4], &mut memory)
}
