//! Rotor inertia: against MuJoCo's armature, a closed form, and the identities of dynamics.

use super::identities::check_mass_matrix;
use surefoot::dynamics::{
    bias_forces, forward_dynamics, inverse_dynamics, joint_poses, mass_matrix,
};
use surefoot::model::{Link, LinkFault, Tree, TreeFault};
use surefoot_tests::random_trees::{N, grounded_with, positions, random, symmetric};
use surefoot_tests::vectors::{self, array, matrix, relative_error};

/// The links of `model::robots::arm`, each with a rotor.
fn geared_arm(rotors: [f64; 7]) -> Tree<f64, 7, 7, 7> {
    let z = [0.0, 0.0, 1.0];
    let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let tensor = [0.002, 0.003, 0.003, 0.0004, 0.0002, -0.0003];
    let links = [
        Link::revolute(0, z, [0.0, 0.0, 0.10]).body(4.0, [0.03, 0.03, 0.02], [0.0, 0.0, 0.20]),
        Link::revolute(1, y, [0.0, 0.0, 0.30]).body(3.5, [0.06, 0.06, 0.01], [0.0, 0.03, 0.50]),
        Link::revolute(2, y, [0.0, 0.0, 0.70]).body(2.5, [0.02, 0.03, 0.02], [0.15, 0.0, 0.70]),
        Link::revolute(3, x, [0.30, 0.0, 0.70]).body(1.5, [0.003, 0.008, 0.008], [0.38, 0.0, 0.71]),
        Link::revolute(4, [0.0, 1.0, 1.0], [0.45, 0.0, 0.70]).body_with_products(
            1.0,
            tensor,
            [0.48, 0.01, 0.70],
        ),
        Link::revolute(5, x, [0.50, 0.0, 0.70])
            .body(0.6, [0.0006, 0.0009, 0.0009], [0.55, 0.0, 0.70])
            .oriented([0.8, 0.0, 0.6, 0.0]),
        Link::prismatic(6, x).body(0.2, [0.0001; 3], [0.60, 0.02, 0.70]),
    ];
    let mut k = 0;
    Tree::new(links.map(|link| {
        k += 1;
        link.rotor_inertia(rotors[k - 1])
    }))
}

#[test]
fn rotors_are_the_armature_of_mujoco() {
    let file = vectors::rotors();
    let tree = geared_arm(array(&file["rotors"]));
    let single = tree.to_f32();
    let (mut worst, mut worst_single) = ([0.0_f64; 3], 0.0_f64);
    for state in file["states"].as_array().expect("states") {
        let [q, v, tau] = ["q", "v", "tau"].map(|name| array::<7>(&state[name]));
        let poses = joint_poses(&tree, &q).expect("finite");
        let m = mass_matrix(&tree, &poses);
        let theirs: [[f64; 7]; 7] = matrix(&state["mass_matrix"]);
        let bias = bias_forces(&tree, &poses, &v, None);
        let found = forward_dynamics(&tree, &poses, &v, &tau, None).expect("regular");
        let acceleration: [f64; 7] = array(&state["acceleration"]);
        for (all, error) in worst.iter_mut().zip([
            relative_error(m.as_flattened(), theirs.as_flattened()),
            relative_error(&bias, &array::<7>(&state["bias"])),
            relative_error(&found, &acceleration),
        ]) {
            *all = all.max(error);
        }
        let poses = joint_poses(&single, &q.map(|x| x as f32)).expect("finite");
        let found =
            forward_dynamics(&single, &poses, &v.map(|x| x as f32), &tau.map(|x| x as f32), None);
        let found = found.expect("regular").map(f64::from);
        worst_single = worst_single.max(relative_error(&found, &acceleration));
    }
    println!("mass matrix, bias, acceleration {worst:?}; acceleration in f32 {worst_single:e}");
    // Measured: 3.4e-15 and 1.2e-7.
    assert!(worst.iter().all(|e| *e < 2e-14), "{worst:?}");
    assert!(worst_single < 1e-6, "{worst_single:e}");
}

/// `θ̈ = −m g l sin θ / (I + m l² + I_r)`.
#[test]
fn a_pendulum_with_a_rotor() {
    let (m, l, i, rotor) = (2.0, 0.4, 0.03, 0.25);
    // About y, hanging along −z: gravity's torque at θ is −m g l sin θ about y.
    let tree: Tree<f64, 1, 1, 1> = Tree::new([Link::revolute(0, [0.0, 1.0, 0.0], [0.0; 3])
        .body(m, [i; 3], [0.0, 0.0, -l])
        .rotor_inertia(rotor)]);
    for theta in [-2.0, -0.3, 0.0, 0.7, 1.6] {
        let poses = joint_poses(&tree, &[theta]).expect("finite");
        let [found] = forward_dynamics(&tree, &poses, &[1.3], &[0.0], None).expect("regular");
        let expected = -m * 9.81 * l * f64::sin(theta) / (i + m * l * l + rotor);
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
}

/// Random trees with a rotor on each joint that can have one.
#[test]
fn identities_hold_with_rotors() {
    let mut rng = random(41);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let rotors: [f64; N] = symmetric(&mut rng).map(|x: f64| x.abs());
        let state = rng.clone();
        let (plain, _) = grounded_with(&mut state.clone(), [0.0; N]);
        let (tree, _) = grounded_with(&mut rng, rotors);
        check_mass_matrix(&mut rng, &tree);

        let q = positions(&mut rng, &tree);
        let (v, a) = (symmetric(&mut rng), symmetric::<12>(&mut rng));
        let poses = joint_poses(&tree, &q).expect("a valid state");
        let torques = inverse_dynamics(&tree, &poses, &v, &a, None);
        let found = forward_dynamics(&tree, &poses, &v, &torques, None).expect("regular");
        worst = worst.max(relative_error(&found, &a));

        // τ gains I θ̈ and nothing else.
        let without = inverse_dynamics(&plain, &poses, &v, &a, None);
        for k in 0..N {
            let shape = tree.body_shape(k).expect("a body");
            let (_, i) = tree.starts(k).expect("a body");
            if shape.rotor_inertia > 0.0 {
                let gained = torques[i] - without[i];
                assert!((gained - shape.rotor_inertia * a[i]).abs() < 1e-12, "{gained}");
            } else if tree.joint(k).is_some_and(|kind| kind.degrees_of_freedom() > 0) {
                assert_eq!(torques[i], without[i]);
            }
        }
    }
    println!("largest error {worst:e}");
    // Measured: 4.4e-13; the mass matrix' condition reaches some 1000.
    assert!(worst < 4e-12, "{worst:e}");
}

/// Motors' power is the rate of all kinetic energy, that of the rotors included: `τ·v = d/dt ½ vᵀ𝕄v`
/// along the motion that `τ` makes, by a central difference of fourth order.
#[test]
fn power_becomes_kinetic_energy() {
    let tree = geared_arm([0.4, 0.3, 0.2, 0.05, 0.02, 0.01, 0.7]).with_gravity([0.0; 3]);
    let mut rng = random(42);
    let mut worst = 0.0_f64;
    for _ in 0..50 {
        let (q, v): ([f64; 7], [f64; 7]) = (symmetric(&mut rng), symmetric(&mut rng));
        let torques: [f64; 7] = symmetric(&mut rng);
        let poses = joint_poses(&tree, &q).expect("finite");
        let a = forward_dynamics(&tree, &poses, &v, &torques, None).expect("regular");
        let h = 1e-3;
        let energy = |s: f64| {
            let t = s * h;
            let q: [f64; 7] = std::array::from_fn(|i| q[i] + t * v[i] + 0.5 * t * t * a[i]);
            let v: [f64; 7] = std::array::from_fn(|i| v[i] + t * a[i]);
            let m = mass_matrix(&tree, &joint_poses(&tree, &q).expect("finite"));
            (0..7).map(|i| 0.5 * v[i] * (0..7).map(|j| m[i][j] * v[j]).sum::<f64>()).sum::<f64>()
        };
        let rate = (8.0 * (energy(1.0) - energy(-1.0)) - (energy(2.0) - energy(-2.0))) / (12.0 * h);
        let power: f64 = torques.iter().zip(v).map(|(t, v)| t * v).sum();
        worst = worst.max((rate - power).abs());
    }
    println!("largest difference of power {worst:e} W");
    // Measured: 2.1e-9.
    assert!(worst < 2e-8, "{worst:e}");
}

#[test]
fn rotors_that_are_none() {
    let fault = |link: Link, rotor: f64| {
        let link = link.body(1.0, [0.1; 3], [0.0; 3]).rotor_inertia(rotor);
        Tree::<f64, 1, 1, 1>::try_new([link]).map(|_| ())
    };
    let refused = Err(TreeFault::Link { index: 0, reason: LinkFault::RotorInertia });
    let hinge = Link::revolute(0, [0.0, 1.0, 0.0], [0.0; 3]);
    for bad in [-1e-9, f64::NAN, f64::INFINITY] {
        assert_eq!(fault(hinge, bad), refused);
    }
    for joint in [Link::fixed(0), Link::floating(0), Link::spherical(0, [0.0; 3])] {
        assert_eq!(fault(joint, 0.1), refused);
    }
    assert_eq!(fault(hinge, 0.1), Ok(()));
    assert_eq!(fault(Link::prismatic(0, [0.0, 1.0, 0.0]), 0.1), Ok(()));
    // A flywheel alone, without a body of its own.
    let flywheel = Tree::<f64, 1, 1, 1>::try_new([hinge.rotor_inertia(0.5)]).expect("a flywheel");
    let poses = joint_poses(&flywheel, &[0.0]).expect("finite");
    assert_eq!(forward_dynamics(&flywheel, &poses, &[0.0], &[2.0], None), Ok([4.0]));
}
