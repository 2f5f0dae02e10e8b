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
pub use surefoot_tests::legged_trees::feet_f32;
use surefoot_tests::legged_trees::near_stance as state;
use surefoot_tests::random_trees::symmetric;

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
