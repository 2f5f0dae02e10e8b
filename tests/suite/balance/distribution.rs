//! Alg. 4.5 and 4.6 against dense linear algebra and the principle of virtual work.

use nalgebra::{Cholesky, SMatrix, SVector};
use surefoot::balance::{
    LegKinematics, LeggedRobot, RobotState, central_body, joint_torques, leg_kinematics,
    wrench_distribution,
};
use surefoot::spatial::{Pose, Wrench};
use surefoot_tests::quadruped;
use surefoot_tests::random_trees::{random, symmetric};

use super::workspace::{BIPED, random_state};

/// Columns `Ad^{-T}` of a pose, by carrying unit wrenches.
fn wrench_map(pose: &Pose<f64>) -> SMatrix<f64, 6, 6> {
    let mut map = SMatrix::<f64, 6, 6>::zeros();
    for i in 0..6 {
        let mut unit = [0.0; 6];
        unit[i] = 1.0;
        let column = pose.carry_wrench(Wrench::from_array(unit)).to_array();
        map.set_column(i, &SVector::from(column));
    }
    map
}

/// Largest difference to `Gᵀ(GGᵀ)⁻¹F`, relative.
fn check<const LEGS: usize>(legs: &[LegKinematics<f64>; LEGS], desired: [f64; 6]) -> f64 {
    let maps = legs.each_ref().map(|leg| wrench_map(&leg.foot));
    let gram = maps.iter().fold(SMatrix::<f64, 6, 6>::zeros(), |sum, g| sum + g * g.transpose());
    let multiplier = Cholesky::new(gram).expect("full row rank").solve(&SVector::from(desired));
    let ours = wrench_distribution(Wrench::from_array(desired), legs).expect("feet nearby");
    let mut worst = 0.0_f64;
    for (map, foot) in maps.iter().zip(&ours.in_foot_frames) {
        let expected = map.transpose() * multiplier;
        worst = worst.max((SVector::from(foot.to_array()) - expected).norm() / expected.norm());
    }
    worst
}

fn legs<const LEGS: usize>(
    robot: &LeggedRobot<f64, LEGS>,
    state: &RobotState<f64, LEGS>,
) -> [LegKinematics<f64>; LEGS] {
    leg_kinematics(robot, &central_body(robot, state).expect("a unit quaternion"), state)
}

#[test]
fn least_norm_of_two_and_four_feet() {
    let mut rng = random(11);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let desired = symmetric(&mut rng).map(|x: f64| 500.0 * x);
        let two = legs(&BIPED, &random_state(&mut rng));
        let four = legs(&quadruped::ROBOT, &random_state(&mut rng));
        worst = worst.max(check(&two, desired)).max(check(&four, desired));
    }
    println!("largest relative error {worst:e}");
    assert!(worst < 1e-12);
}

/// With the feet at rest, the power of the torques is that of the desired wrench on the central
/// body.
#[test]
fn torques_do_the_work_of_the_desired_wrench() {
    let mut rng = random(12);
    for _ in 0..200 {
        let state = random_state(&mut rng);
        let legs = legs(&quadruped::ROBOT, &state);
        let desired = Wrench::from_array(symmetric(&mut rng).map(|x: f64| 500.0 * x));
        let feet = wrench_distribution(desired, &legs).expect("feet nearby");
        let twist = surefoot::spatial::Twist::from_array(symmetric(&mut rng));
        let mut power = 0.0;
        for (leg, foot) in legs.iter().zip(&feet.in_central_axes) {
            // Rates with which the foot stays: J θ̇ = −V at the last joint.
            let o = leg.origins[5];
            let jacobian = SMatrix::<f64, 6, 6>::from_fn(|i, k| {
                let column = leg.axes[k].cross(&(o - leg.origins[k]));
                if i < 3 { column[i] } else { leg.axes[k][i - 3] }
            });
            let at = twist.linear + twist.angular.cross(&o);
            let v = SVector::from([
                -at.x,
                -at.y,
                -at.z,
                -twist.angular.x,
                -twist.angular.y,
                -twist.angular.z,
            ]);
            let rates = jacobian.lu().solve(&v).expect("a regular leg");
            let torques = joint_torques(leg, *foot);
            power += torques.iter().zip(rates.iter()).map(|(t, r)| t * r).sum::<f64>();
        }
        let expected = twist.power(desired);
        assert!((power - expected).abs() < 1e-9 * expected.abs().max(100.0), "{power} {expected}");
    }
}
