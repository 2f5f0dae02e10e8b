//! Forward dynamics undoes inverse dynamics, and the mass matrix is what inverse dynamics says, on
//! random trees with all joint kinds.

use surefoot::dynamics::{
    bias_forces, forward_dynamics, inverse_dynamics, joint_poses, mass_matrix,
};
use surefoot::model::Tree;
use surefoot::spatial::Wrench;
use surefoot_tests::random_trees::{N, floating, grounded, positions, random, symmetric};
use surefoot_tests::vectors::relative_error;

fn wrenches(rng: &mut rand_pcg::Pcg64) -> [Wrench<f64>; N] {
    std::array::from_fn(|_| Wrench::from_array(symmetric::<6>(rng).map(|x| 5.0 * x)))
}

/// `FD(ID(β̇)) = β̇`, in f64 and in f32.
fn round_trip<const NQ: usize, const NV: usize>(
    rng: &mut rand_pcg::Pcg64,
    tree: &Tree<f64, N, NQ, NV>,
) -> [f64; 2] {
    let q = positions(rng, tree);
    let v = symmetric(rng);
    let a = symmetric(rng);
    let applied = wrenches(rng);
    let external = (q[0] > 0.0).then_some(&applied);
    let poses = joint_poses(tree, &q).expect("a valid state");
    let torques = inverse_dynamics(tree, &poses, &v, &a, external);
    let found = forward_dynamics(tree, &poses, &v, &torques, external).expect("regular");

    let single = tree.to_f32();
    let poses = joint_poses(&single, &q.map(|x| x as f32)).expect("a valid state");
    let (v, narrow) = (v.map(|x| x as f32), a.map(|x| x as f32));
    let torques = inverse_dynamics(&single, &poses, &v, &narrow, None);
    let again = forward_dynamics(&single, &poses, &v, &torques, None).expect("regular");
    [relative_error(&found, &a), relative_error(&again.map(f64::from), &a)]
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics_on_1000_random_trees() {
    let mut rng = random(1);
    let mut errors: Vec<[f64; 2]> = Vec::new();
    for _ in 0..500 {
        let (tree, _) = floating(&mut rng);
        errors.push(round_trip(&mut rng, &tree));
        let (tree, _) = grounded(&mut rng);
        errors.push(round_trip(&mut rng, &tree));
    }
    let largest = |i: usize| errors.iter().map(|e| e[i]).fold(0.0, f64::max);
    let mut single: Vec<f64> = errors.iter().map(|e| e[1]).collect();
    single.sort_by(f64::total_cmp);
    println!(
        "largest error f64 {:e}; f32 median {:e}, 99th percentile {:e}, largest {:e}",
        largest(0),
        single[500],
        single[990],
        largest(1)
    );
    assert!(largest(0) < 1e-9);
    // In f32 the error is ε = 6e-8 times the condition of the mass matrix, which on random trees
    // is 100 as a rule and reaches some 1000.
    assert!(single[500] < 2e-5 && largest(1) < 1e-3);
}

/// Column i of 𝕄 is the torque for unit acceleration i, at rest and without gravity; 𝕄 is symmetric
/// and positive definite; and torque = 𝕄 β̇ + ℂ.
pub(super) fn check_mass_matrix<const NQ: usize, const NV: usize>(
    rng: &mut rand_pcg::Pcg64,
    tree: &Tree<f64, N, NQ, NV>,
) {
    let q = positions(rng, tree);
    let weightless = tree.with_gravity([0.0; 3]);
    let poses = joint_poses(tree, &q).expect("a valid state");
    let m = mass_matrix(tree, &poses);
    for i in 0..NV {
        let mut unit = [0.0; NV];
        unit[i] = 1.0;
        let column = inverse_dynamics(&weightless, &poses, &[0.0; NV], &unit, None);
        for j in 0..NV {
            assert!((m[j][i] - column[j]).abs() < 1e-11, "{i} {j}: {} {}", m[j][i], column[j]);
            assert_eq!(m[i][j], m[j][i]);
        }
    }
    for _ in 0..20 {
        let x: [f64; NV] = symmetric(rng);
        let energy: f64 =
            (0..NV).map(|i| x[i] * (0..NV).map(|j| m[i][j] * x[j]).sum::<f64>()).sum();
        assert!(energy > 0.0, "not positive definite");
    }

    let (v, a) = (symmetric(rng), symmetric::<NV>(rng));
    let applied = wrenches(rng);
    let torques = inverse_dynamics(tree, &poses, &v, &a, Some(&applied));
    let bias = bias_forces(tree, &poses, &v, Some(&applied));
    let sum: Vec<f64> = m
        .iter()
        .zip(bias)
        .map(|(row, c)| c + row.iter().zip(&a).map(|(m, a)| m * a).sum::<f64>())
        .collect();
    assert!(relative_error(&torques, &sum) < 1e-12);
}

#[test]
fn the_mass_matrix_is_what_inverse_dynamics_says() {
    let mut rng = random(2);
    for _ in 0..100 {
        let (tree, _) = floating(&mut rng);
        check_mass_matrix(&mut rng, &tree);
        let (tree, _) = grounded(&mut rng);
        check_mass_matrix(&mut rng, &tree);
    }
}

/// `Ṁ − 2C` is skew-symmetric, with the C of Christoffel's symbols: for joints whose velocities are
/// the rates of their coordinates, `C(β)γ = ½ (b(β + γ) − b(β) − b(γ))` from the quadratic bias b.
#[test]
fn mass_matrix_rate_less_twice_coriolis_is_skew() {
    use surefoot::model::robots::arm;
    let tree = arm::TREE.with_gravity([0.0; 3]);
    let mut rng = random(3);
    for _ in 0..100 {
        let q: [f64; 7] = symmetric(&mut rng);
        let beta: [f64; 7] = symmetric(&mut rng);
        let poses = joint_poses(&tree, &q).expect("a valid state");
        let bias = |v: &[f64; 7]| bias_forces(&tree, &poses, v, None);
        let coriolis: [[f64; 7]; 7] = std::array::from_fn(|k| {
            let mut unit = [0.0; 7];
            unit[k] = 1.0;
            let both = std::array::from_fn(|i| beta[i] + unit[i]);
            let (b, b1, b2) = (bias(&both), bias(&beta), bias(&unit));
            std::array::from_fn(|i| 0.5 * (b[i] - b1[i] - b2[i]))
        });
        // Fourth-order central difference: error ~ h⁴ = 1e-12, round-off ~ 1e-16/h = 1e-13.
        let h = 1e-3;
        let at = |s: f64| {
            let moved = std::array::from_fn(|i| q[i] + s * h * beta[i]);
            mass_matrix(&tree, &joint_poses(&tree, &moved).expect("a valid state"))
        };
        let (m1, m2, p1, p2) = (at(-1.0), at(-2.0), at(1.0), at(2.0));
        for i in 0..7 {
            for j in 0..7 {
                let rate = (8.0 * (p1[i][j] - m1[i][j]) - (p2[i][j] - m2[i][j])) / (12.0 * h);
                // coriolis[k] is column k.
                let sum = 2.0 * rate - 2.0 * (coriolis[j][i] + coriolis[i][j]);
                assert!(sum.abs() < 1e-10, "{i} {j}: {sum}");
            }
        }
    }
}
