//! Algorithm 5.1 against a dense solution of the same equations.

use nalgebra::{DMatrix, DVector};
use num_dual::Dual64;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot_mechanics::jacobian;
use surefoot_multibody::{
    Correction, Equations, Joint, JointConstraint, SingularJoint, TreeEquations,
};

const COUNTS: [usize; 6] = [0, 3, 4, 5, 5, 6];

/// A tree of random equations: positive definite stiffness with some asymmetry, any number of
/// constraints, rows at the step's beginning and end alike but for some hundredths. Rows of one body are
/// orthonormal at first, as a joint's nearly are; six random ones of seven would often be dependent.
fn random_tree(random: &mut Pcg64Mcg, nodes: usize) -> Vec<Equations> {
    let mut uniform = |low: f64, high: f64| random.random_range(low..high);
    (0..nodes)
        .map(|k| {
            let inboard = (k > 0).then(|| (uniform(0.0, 1.0) * k as f64) as usize);
            let constraints = COUNTS[(uniform(0.0, 6.0)) as usize];
            let mut node = Equations::new(inboard, constraints);
            for i in 0..7 {
                for j in 0..7 {
                    node.stiffness[i][j] = uniform(-0.2, 0.2) + if i == j { 2.0 } else { 0.0 };
                }
                node.force[i] = uniform(-1.0, 1.0);
            }
            let rows: [[f64; 7]; 7] = orthonormal(&mut uniform);
            node.norm[0] = rows[0];
            node.norm[1] = rows[0].map(|x| x * uniform(0.98, 1.02));
            node.norm_error = uniform(-1.0, 1.0);
            for c in 0..constraints {
                for i in 0..7 {
                    node.outboard_rows[0][c][i] = rows[1 + c][i];
                    node.outboard_rows[1][c][i] =
                        node.outboard_rows[0][c][i] + uniform(-0.02, 0.02);
                    node.inboard_rows[0][c][i] = uniform(-1.0, 1.0);
                    node.inboard_rows[1][c][i] = node.inboard_rows[0][c][i] + uniform(-0.02, 0.02);
                }
                node.error[c] = uniform(-1.0, 1.0);
            }
            node
        })
        .collect()
}

/// Seven random directions at right angles, by Gram and Schmidt.
fn orthonormal(uniform: &mut impl FnMut(f64, f64) -> f64) -> [[f64; 7]; 7] {
    let mut rows = [[0.0; 7]; 7];
    for k in 0..7 {
        let mut row: [f64; 7] = std::array::from_fn(|_| uniform(-1.0, 1.0));
        // Twice, as once leaves round-off of nearly dependent ones.
        for _ in 0..2 {
            for known in &rows[..k] {
                let along: f64 = row.iter().zip(known).map(|(a, b)| a * b).sum();
                row = std::array::from_fn(|i| row[i] - along * known[i]);
            }
        }
        let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        rows[k] = row.map(|x| x / length);
    }
    rows
}

/// (5.13) as one matrix.
fn dense(nodes: &[Equations]) -> (DMatrix<f64>, DVector<f64>, Vec<usize>) {
    let mut at = Vec::new();
    let mut size = 0;
    for node in nodes {
        at.push(size);
        size += 8 + node.constraints;
    }
    let (mut a, mut b) = (DMatrix::zeros(size, size), DVector::zeros(size));
    for (node, at_k) in nodes.iter().zip(&at) {
        let k = *at_k;
        for i in 0..7 {
            for j in 0..7 {
                a[(k + i, k + j)] = node.stiffness[i][j];
            }
            a[(k + i, k + 7)] = -node.norm[0][i];
            a[(k + 7, k + i)] = node.norm[1][i];
            b[k + i] = -node.force[i];
            for c in 0..node.constraints {
                let row = k + 8 + c;
                a[(k + i, row)] = -node.outboard_rows[0][c][i];
                a[(row, k + i)] = node.outboard_rows[1][c][i];
                if let Some(inboard) = node.inboard {
                    a[(at[inboard] + i, row)] = -node.inboard_rows[0][c][i];
                    a[(row, at[inboard] + i)] = node.inboard_rows[1][c][i];
                }
            }
        }
        b[k + 7] = -node.norm_error;
        for c in 0..node.constraints {
            b[k + 8 + c] = -node.error[c];
        }
    }
    (a, b, at)
}

#[test]
fn the_tree_solver_is_a_dense_solver() {
    let mut random = Pcg64Mcg::seed_from_u64(51);
    let mut worst = 0.0_f64;
    for tree in 0..200 {
        let nodes = random_tree(&mut random, 1 + tree % 30);
        let (a, b, at) = dense(&nodes);
        let exact = a.clone().lu().solve(&b).expect("regular");
        // What round-off may do to either solution, by the matrix's condition.
        let singular = a.singular_values();
        let condition = singular.max() / singular.min();
        let mut all = vec![Correction::default(); nodes.len()];
        let mut equations = TreeEquations::new(nodes);
        equations.solve(&mut all).expect("regular");
        let mut error = 0.0_f64;
        for (correction, k) in all.iter().zip(&at) {
            for i in 0..7 {
                error = error.max((correction.coordinates[i] - exact[k + i]).abs());
            }
            error = error.max((correction.norm_multiplier - exact[k + 7]).abs());
        }
        let relative = error / exact.amax();
        assert!(relative < 1e-10, "tree {tree}: {relative}, condition {condition}");
        worst = worst.max(relative);
    }
    println!("worst relative error {worst:.1e}");
}

#[test]
fn a_singular_joint_is_named() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let mut nodes = random_tree(&mut random, 6);
    nodes[3].constraints = 3;
    // Twice the same constraint.
    for rows in &mut nodes[3].outboard_rows {
        rows[1] = rows[0];
    }
    let mut all = vec![Correction::default(); nodes.len()];
    let found = TreeEquations::new(nodes).solve(&mut all);
    assert_eq!(found, Err(SingularJoint { joint: 3 }));
    let mut lost = random_tree(&mut random, 3);
    lost[2].stiffness[0][0] = f64::NAN;
    assert!(TreeEquations::new(lost).solve(&mut all[..3]).is_err());
}

/// Joints' rows are the derivatives of their constraints, for quaternions of any length.
#[test]
fn rows_of_joints_are_the_automatic_ones() {
    let mut random = Pcg64Mcg::seed_from_u64(8);
    let mut uniform = |low: f64, high: f64| random.random_range(low..high);
    for _ in 0..50 {
        let mut vector = || std::array::from_fn(|_| uniform(-1.0, 1.0));
        let (axis, u) = (vector(), vector());
        let home = [0.5, -0.5, 0.1, 0.7];
        for constraint in [
            JointConstraint::Floating,
            JointConstraint::Spherical,
            JointConstraint::Universal { outboard_axis: axis, inboard_axis: u },
            JointConstraint::Revolute { axis },
            JointConstraint::Prismatic { axis },
            JointConstraint::Fixed,
        ] {
            let joint = Joint { outboard: vector(), inboard: vector(), home, constraint };
            let [o, i]: [[f64; 7]; 2] = [(); 2]
                .map(|()| [vector(), vector(), vector()].concat()[..7].try_into().expect("7"));
            let rows = joint.rows(&o, &i);
            let still = [o, i].map(|x| x.map(Dual64::from_re));
            let (error, by_o) = jacobian(&o, |x| joint.evaluate(x, &still[1]));
            let (_, by_i) = jacobian(&i, |x| joint.evaluate(&still[0], x));
            assert_eq!(rows.error, error);
            let pairs = [(rows.outboard, by_o), (rows.inboard, by_i)];
            for (ours, exact) in pairs {
                for (a, b) in ours.as_flattened().iter().zip(exact.as_flattened()) {
                    assert!((a - b).abs() < 1e-13, "{constraint:?}: {ours:?}, {exact:?}");
                }
            }
        }
    }
}
