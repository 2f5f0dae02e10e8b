//! A free tree keeps its momentum: whatever the joints do, the rates of linear and angular momentum
//! of all bodies sum to zero.

use nalgebra::{Matrix3, Vector3};
use surefoot::dynamics::{forward_dynamics, forward_kinematics, joint_poses};
use surefoot_tests::random_trees::{floating, positions, random, symmetric};

#[test]
fn internal_torques_change_no_momentum() {
    let mut rng = random(5);
    for _ in 0..200 {
        let (tree, bodies) = floating(&mut rng);
        let tree = tree.with_gravity([0.0; 3]);
        let q = positions(&mut rng, &tree);
        let v = symmetric(&mut rng);
        let mut torques: [f64; 15] = symmetric(&mut rng);
        // None on the floating body.
        torques[..6].fill(0.0);
        let poses = joint_poses(&tree, &q).expect("a valid state");
        let a = forward_dynamics(&tree, &poses, &v, &torques, None).expect("regular");
        let kinematics = forward_kinematics(&tree, &poses, &v, &a);
        let (mut linear, mut angular, mut scale) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        for (k, body) in bodies.iter().enumerate() {
            let pose = &kinematics[k].pose;
            let (v, a) = (kinematics[k].velocity, kinematics[k].acceleration);
            let inertia = Matrix3::from_diagonal(&Vector3::from(body.inertia));
            let force = pose.rotation * (a.linear + v.angular.cross(&v.linear)) * body.mass;
            let torque =
                pose.rotation * (inertia * a.angular + v.angular.cross(&(inertia * v.angular)));
            linear += force;
            angular += torque + pose.position.cross(&force);
            scale += force.norm() + torque.norm();
        }
        assert!(linear.norm() < 1e-12 * scale, "{linear:?} of {scale}");
        assert!(angular.norm() < 1e-12 * scale, "{angular:?} of {scale}");
    }
}
