//! Where the algorithms have no answer: a typed fault, never a NaN.

use surefoot::dynamics::{DynamicsFault, forward_dynamics, joint_poses};
use surefoot::model::robots::{biped, branching};
use surefoot::model::{Link, Tree};
use surefoot_tests::workloads::biped_positions;

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[test]
fn positions_that_are_no_numbers() {
    for bad in BAD {
        for index in 0..19 {
            let mut q = biped_positions();
            q[index] = bad;
            let fault = joint_poses(&biped::TREE, &q).expect_err("not finite");
            assert_eq!(fault, DynamicsFault::PositionNotFinite { index });
            let fault =
                joint_poses(&biped::TREE_F32, &q.map(|x| x as f32)).expect_err("not finite");
            assert_eq!(fault, DynamicsFault::PositionNotFinite { index });
        }
    }
}

#[test]
fn quaternions_off_the_unit_sphere() {
    for scale in [0.0, 0.9, 1.1, 1e200] {
        let mut q: [f64; 19] = biped_positions();
        for x in &mut q[3..7] {
            *x *= scale;
        }
        let fault = joint_poses(&biped::TREE, &q).expect_err("not unit");
        assert_eq!(fault, DynamicsFault::QuaternionNotUnit { joint: 0 });
    }
    // The spherical joint of the branching tree is joint 1.
    let fault = joint_poses(&branching::TREE, &[0.1; 8]).expect_err("not unit");
    assert_eq!(fault, DynamicsFault::QuaternionNotUnit { joint: 1 });
    // Round-off of an integrator is no fault.
    let mut q: [f64; 19] = biped_positions();
    q[3] += 4e-4;
    assert!(joint_poses(&biped::TREE, &q).is_ok());
}

#[test]
fn velocities_and_torques_that_are_no_numbers() {
    let poses = joint_poses(&biped::TREE, &biped_positions()).expect("valid");
    for bad in BAD {
        for index in 0..18 {
            let mut x = [0.1; 18];
            x[index] = bad;
            let result = forward_dynamics(&biped::TREE, &poses, &x, &[0.0; 18], None);
            assert!(result.is_err(), "velocity {index} = {bad}");
            let result = forward_dynamics(&biped::TREE, &poses, &[0.0; 18], &x, None);
            assert!(result.is_err(), "torque {index} = {bad}");
        }
    }
    // Finite, but too large for the arithmetic.
    let result = forward_dynamics(&biped::TREE, &poses, &[1e200; 18], &[0.0; 18], None);
    assert!(result.is_err());
}

/// Angles of any size are angles: the pose repeats to the accuracy that such an angle has.
#[test]
fn huge_angles() {
    let mut q: [f64; 19] = biped_positions();
    let turn = core::f64::consts::TAU * 1e6;
    let near = joint_poses(&biped::TREE, &q).expect("valid");
    q[10] += turn;
    let far = joint_poses(&biped::TREE, &q).expect("valid");
    let a = surefoot::dynamics::body_poses(&biped::TREE, &near)[6];
    let b = surefoot::dynamics::body_poses(&biped::TREE, &far)[6];
    assert!((a.position - b.position).norm() < 1e-8);
    q[10] = 1e300;
    assert!(joint_poses(&biped::TREE, &q).is_ok());
}

/// A joint about the axis of a needle, which has no inertia about it.
#[test]
fn a_joint_with_nothing_to_move() {
    let tree: Tree<f64, 1, 1, 1> = Tree::new([Link::revolute(0, [1.0, 0.0, 0.0], [0.0; 3]).body(
        1.0,
        [0.0, 0.1, 0.1],
        [0.5, 0.0, 0.0],
    )]);
    let poses = joint_poses(&tree, &[0.3]).expect("finite");
    let fault = forward_dynamics(&tree, &poses, &[0.0], &[1.0], None).expect_err("no inertia");
    assert_eq!(fault, DynamicsFault::SingularInertia { joint: 0 });
}
