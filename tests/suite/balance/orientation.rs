//! The orientation error of §4.2.4, and a controller that does not unwind.

use nalgebra::{Unit, UnitQuaternion, Vector3};
use surefoot::balance::{Controller, tick};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, orientation_error};
use surefoot_tests::random_trees::{random, symmetric};

use super::workspace::{BIPED, random_state};

fn unit(v: [f64; 3]) -> Unit<Vector3<f64>> {
    Unit::new_normalize(Vector3::from(v))
}

/// Against nalgebra's own quaternions: the error is the rotation that takes desired to measured,
/// by the shorter way.
#[test]
fn the_error_is_the_shorter_rotation() {
    let mut rng = random(41);
    for _ in 0..1000 {
        let [a, b]: [f64; 2] = symmetric(&mut rng);
        let q = UnitQuaternion::from_axis_angle(&unit(symmetric(&mut rng)), 7.0 * a);
        let d = UnitQuaternion::from_axis_angle(&unit(symmetric(&mut rng)), 7.0 * b);
        let ours = |q: &UnitQuaternion<f64>| Quaternion::from_array([q.w, q.i, q.j, q.k]);
        let error = orientation_error(ours(&q), ours(&d));
        let expected = (q * d.inverse()).scaled_axis();
        let half = expected.norm() / 2.0;
        let vector = if half > 0.0 { expected * (half.sin() / (2.0 * half)) } else { expected };
        assert!((error.v - vector).norm() < 1e-12);
        assert!(error.s >= 0.0);
        // −q is the same orientation.
        let minus = Quaternion::from_array(ours(&q).to_array().map(|x| -x));
        assert_eq!(orientation_error(minus, ours(&d)), error);
    }
}

#[test]
fn q_and_minus_q_give_the_same_torques() {
    let mut rng = random(42);
    let controller = Controller::new(&BIPED);
    for _ in 0..100 {
        let state = random_state(&mut rng);
        let mut other = state;
        other.orientation = Quaternion::from_array(state.orientation.to_array().map(|x| -x));
        let reference = surefoot::balance::Reference::at_rest(
            Vector3::from(symmetric(&mut rng)),
            Quaternion::from_rotation_vector(Vector3::from(symmetric(&mut rng)) * 3.0),
        );
        let a = tick(&controller, &state, &reference).expect("regular");
        let b = tick(&controller, &other, &reference).expect("regular");
        for (x, y) in a.joint_torques.as_flattened().iter().zip(b.joint_torques.as_flattened()) {
            assert!((x - y).abs() < 1e-9 * x.abs().max(1.0), "{x} {y}");
        }
    }
}

/// Near half a turn the error's length is continuous (it is at its largest, 1), whichever sign.
#[test]
fn half_a_turn() {
    let desired = Quaternion::identity();
    for angle in [-1e-3, 0.0, 1e-3, 1e-2].map(|more| core::f64::consts::PI + more) {
        let q = Quaternion::from_axis_angle(Vector3::new(0.6, 0.0, 0.8), angle);
        let error = orientation_error(q, desired);
        assert!((error.v.norm() - (angle / 2.0f64).sin().abs()).abs() < 1e-12);
        assert!(error.s >= 0.0);
    }
}

/// The model the controller is made for is the one that the tree describes.
#[test]
fn printed_mass() {
    assert!((biped::TREE.mass() - 74.548).abs() < 1e-12);
    assert!((f64::from(biped::TREE_F32.mass()) - 74.548).abs() < 1e-5);
}
