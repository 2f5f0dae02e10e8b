//! Workspace dynamics against the full equations of motion with fixed feet, solved densely: apply a
//! wrench to the central body with free joints, and look how it accelerates.

use nalgebra::{SMatrix, SVector, Vector3};
use surefoot::Real;
use surefoot::balance::{
    LeggedRobot, RobotState, big_base, central_body, fixed_foot_dynamics, fixed_foot_wrench,
    leg_kinematics,
};
use surefoot::dynamics::{
    bias_forces, body_velocities, forward_kinematics, joint_poses, mass_matrix,
};
use surefoot::model::Tree;
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot_tests::quadruped;
use surefoot_tests::random_trees::{random, symmetric};

pub const BIPED: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
const BIPED_F32: LeggedRobot<f32, 2> = BIPED.to_f32();

/// Bent knees, anything else at random; at rest.
pub fn random_state<const LEGS: usize>(rng: &mut rand_pcg::Pcg64) -> RobotState<f64, LEGS> {
    let axis = Vector3::from(symmetric(rng));
    RobotState {
        position: Vector3::from(symmetric(rng)),
        orientation: Quaternion::from_rotation_vector(axis),
        velocity: Twist::zero(),
        joint_angles: std::array::from_fn(|_| {
            let [a, b, c, d, e, f]: [f64; 6] = symmetric(rng);
            // Joint 3 or 4 is the knee, of the quadruped or the biped; both stay bent, and the
            // ankle's middle axis away from its gimbal lock.
            [0.4 * a, 0.5 * b, 0.7 + 0.2 * c, -1.0 + 0.4 * d, 0.4 * e, 0.5 + 0.3 * f]
        }),
        joint_rates: [[0.0; 6]; LEGS],
    }
}

fn positions<const LEGS: usize, const NQ: usize>(state: &RobotState<f64, LEGS>) -> [f64; NQ] {
    let mut q = [0.0; NQ];
    q[..3].copy_from_slice(state.position.as_slice());
    q[3..7].copy_from_slice(&state.orientation.to_array());
    for (to, from) in q[7..].iter_mut().zip(state.joint_angles.as_flattened()) {
        *to = *from;
    }
    q
}

/// Unknowns of the dense system: velocities and constraints.
fn check<const LEGS: usize, const N: usize, const NQ: usize, const NV: usize, const C: usize>(
    rng: &mut rand_pcg::Pcg64,
    robot: &LeggedRobot<f64, LEGS>,
    tree: &Tree<f64, N, NQ, NV>,
    feet: [usize; LEGS],
) -> f64 {
    assert_eq!(C, 6 * LEGS);
    let mut state: RobotState<f64, LEGS> = random_state(rng);
    let relative = joint_poses(tree, &positions(&state)).expect("a valid state");

    // Joint rates with which the feet stand still while the central body moves.
    let jacobian = {
        let mut j = SMatrix::<f64, C, NV>::zeros();
        for column in 0..NV {
            let mut unit = [0.0; NV];
            unit[column] = 1.0;
            let twists = body_velocities(tree, &relative, &unit);
            for (foot, body) in feet.iter().enumerate() {
                for (row, x) in twists[*body].to_array().into_iter().enumerate() {
                    j[(6 * foot + row, column)] = x;
                }
            }
        }
        j
    };
    state.velocity = Twist::from_array(symmetric(rng));
    let base = jacobian.fixed_columns::<6>(0) * SVector::from(state.velocity.to_array());
    let mut beta = [0.0; NV];
    beta[..6].copy_from_slice(&state.velocity.to_array());
    // The joints' part is block diagonal: one 6 × 6 solve a leg.
    for leg in 0..LEGS {
        let block = jacobian.fixed_view::<6, 6>(6 * leg, 6 + 6 * leg).into_owned();
        let rates = block.lu().solve(&-base.fixed_rows::<6>(6 * leg)).expect("a regular leg");
        state.joint_rates[leg] = rates.into();
        beta[6 + 6 * leg..12 + 6 * leg].copy_from_slice(rates.as_slice());
    }

    // 𝕄 β̇ + ℂ = (F, 0) + Jᵀλ, J β̇ = −(acceleration at β̇ = 0), by elimination of λ.
    let mass = SMatrix::<f64, NV, NV>::from_fn(|i, j| mass_matrix(tree, &relative)[i][j]);
    let mass = nalgebra::Cholesky::new(mass).expect("positive definite");
    let bias = SVector::from(bias_forces(tree, &relative, &beta, None));
    let still = forward_kinematics(tree, &relative, &beta, &[0.0; NV]);
    let gamma =
        SVector::<f64, C>::from_fn(|i, _| still[feet[i / 6]].acceleration.to_array()[i % 6]);
    let wrench = symmetric::<6>(rng).map(|x| 300.0 * x);
    let mut force = -bias;
    for (f, w) in force.iter_mut().zip(wrench) {
        *f += w;
    }
    let response = mass.solve(&jacobian.transpose());
    let compliance = nalgebra::Cholesky::new(jacobian * response).expect("independent feet");
    let lambda = compliance.solve(&(-(gamma + jacobian * mass.solve(&force))));
    let beta_dot = mass.solve(&force) + response * lambda;
    let acceleration: [f64; 6] = std::array::from_fn(|i| beta_dot[i]);

    // P₁ V̇ + z₁ must be that wrench.
    let central = central_body(robot, &state).expect("a unit quaternion");
    let legs = leg_kinematics(robot, &central, &state);
    let dynamics = fixed_foot_dynamics(robot, &central, &legs, 1e-6).expect("regular");
    let x = Twist::from_array(acceleration);
    let by_inertia = dynamics.wrench(x).to_array();
    let direct = fixed_foot_wrench(robot, &central, &legs, 1e-6, x).expect("regular").to_array();
    let scale = wrench.iter().fold(1.0_f64, |m, w| m.max(w.abs()));
    by_inertia
        .iter()
        .chain(&direct)
        .zip(wrench.iter().chain(&wrench))
        .map(|(a, b)| (a - b).abs() / scale)
        .fold(0.0, f64::max)
}

#[test]
fn fixed_foot_is_the_constrained_robot() {
    let mut rng = random(21);
    let mut worst = [0.0_f64; 2];
    for _ in 0..100 {
        let biped = check::<2, 13, 19, 18, 12>(&mut rng, &BIPED, &biped::TREE, biped::FEET);
        let quadruped = check::<4, 25, 31, 30, 24>(
            &mut rng,
            &quadruped::ROBOT,
            &quadruped::TREE,
            quadruped::FEET,
        );
        worst = [worst[0].max(biped), worst[1].max(quadruped)];
    }
    println!("largest relative error: biped {:e}, quadruped {:e}", worst[0], worst[1]);
    assert!(worst.iter().all(|e| *e < 1e-9));
}

/// The biped with rotors on all joints.
const GEARED: Tree<f64, 13, 19, 18> = {
    let mut links = [biped::CENTRAL; 13];
    let (left, right) = (biped::leg(2, [0.0, -0.15]), biped::leg(8, [0.0, 0.15]));
    let mut k = 0;
    while k < 6 {
        let rotor = 0.02 + 0.03 * k as f64;
        links[1 + k] = left[k].rotor_inertia(rotor);
        links[7 + k] = right[k].rotor_inertia(1.5 * rotor);
        k += 1;
    }
    Tree::new(links)
};

/// Rotors belong to what the legs resist with: `P₁ X + z₁` with them is the constrained robot's, and
/// differs from that without.
#[test]
fn fixed_foot_with_rotors_is_the_constrained_robot() {
    const ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&GEARED);
    let mut rng = random(24);
    let mut worst = 0.0_f64;
    for _ in 0..100 {
        worst = worst.max(check::<2, 13, 19, 18, 12>(&mut rng, &ROBOT, &GEARED, biped::FEET));
    }
    let mut state: RobotState<f64, 2> = random_state(&mut rng);
    state.joint_rates = [symmetric(&mut rng), symmetric(&mut rng)];
    let inertia = |robot: &LeggedRobot<f64, 2>| {
        let central = central_body(robot, &state).expect("unit");
        let legs = leg_kinematics(robot, &central, &state);
        fixed_foot_dynamics(robot, &central, &legs, 1e-6).expect("regular").inertia
    };
    let (with, without) = (inertia(&ROBOT), inertia(&BIPED));
    // The big base tends to the same, with rotors too.
    let central = central_body(&ROBOT, &state).expect("unit");
    let legs = leg_kinematics(&ROBOT, &central, &state);
    let big = big_base(&ROBOT, &central, &legs, 1e6).expect("positive").inertia;
    let relative =
        (big.linear.to_matrix() - with.linear.to_matrix()).norm() / with.linear.to_matrix().norm();
    println!("largest relative error {worst:e}; big base {relative:e}");
    // Measured: 4.5e-15 and 9.0e-8, which is the big base's own.
    assert!(worst < 1e-13);
    assert!(relative < 1e-6);
    assert!(with.linear.diagonal.z > 1.05 * without.linear.diagonal.z);
}

/// The big base tends to the fixed foot as 1/factor, until round-off takes over.
#[test]
fn the_big_base_tends_to_the_fixed_foot() {
    let mut rng = random(22);
    let mut state: RobotState<f64, 2> = random_state(&mut rng);
    state.velocity = Twist::from_array(symmetric(&mut rng));
    state.joint_rates = [symmetric(&mut rng), symmetric(&mut rng)];
    let central = central_body(&BIPED, &state).expect("a unit quaternion");
    let legs = leg_kinematics(&BIPED, &central, &state);
    let exact = fixed_foot_dynamics(&BIPED, &central, &legs, 1e-6).expect("regular");
    let x = Twist::from_array(symmetric(&mut rng));
    let error = |factor: f64| {
        let approximate = big_base(&BIPED, &central, &legs, factor).expect("positive");
        let difference = (approximate.wrench(x) - exact.wrench(x)).to_array();
        difference.iter().fold(0.0_f64, |m, d| m.max(d.abs()))
    };
    let (e3, e4, e5) = (error(1e3), error(1e4), error(1e5));
    println!("{e3:e} {e4:e} {e5:e}");
    assert!((8.0..12.0).contains(&(e3 / e4)) && (8.0..12.0).contains(&(e4 / e5)));
}

/// What single precision does to each form, on random states: the fixed foot keeps six digits.
#[test]
fn fixed_foot_is_well_conditioned_in_f32() {
    let mut rng = random(23);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let state: RobotState<f64, 2> = random_state(&mut rng);
        let narrow = RobotState {
            position: state.position.map(|x| x as f32),
            orientation: Quaternion::from_array(state.orientation.to_array().map(|x| x as f32)),
            velocity: Twist::zero(),
            joint_angles: state.joint_angles.map(|leg| leg.map(|x| x as f32)),
            joint_rates: [[0.0; 6]; 2],
        };
        let central = central_body(&BIPED, &state).expect("unit");
        let legs = leg_kinematics(&BIPED, &central, &state);
        let exact = fixed_foot_dynamics(&BIPED, &central, &legs, 1e-3).expect("regular");
        let central = central_body(&BIPED_F32, &narrow).expect("unit");
        let legs = leg_kinematics(&BIPED_F32, &central, &narrow);
        let single = fixed_foot_dynamics(&BIPED_F32, &central, &legs, 1e-3).expect("regular");
        let (a, b) = (exact.inertia.to_array(), single.inertia.to_array());
        let scale = a.as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (x, y) in a.as_flattened().iter().zip(b.as_flattened()) {
            worst = worst.max((x - y.to_f64()).abs() / scale);
        }
    }
    println!("largest error of P in f32: {worst:e}");
    assert!(worst < 1e-5);
}
