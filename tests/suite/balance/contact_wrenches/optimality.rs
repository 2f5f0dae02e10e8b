//! Conditions of an optimum, from rows and matrices that are written down anew.

use super::{ROOM, SOFTNESS, largest};
use nalgebra::{DMatrix, DVector, Matrix6, Vector3};
use surefoot::qp::{ActiveRows, Settings, Status};
use surefoot::spatial::Wrench;
use surefoot_tests::contact_problems::{Problem, random_problem};
use surefoot_tests::random_trees::random;

/// Rows written down from the corner's side: normals in sole axes with `b`, 18 and twice the joints.
fn rows_of<const FEET: usize>(problem: &Problem<f64, FEET>, foot: usize) -> Vec<([f64; 6], f64)> {
    let foot = &problem.feet[foot];
    let limits = &foot.limits;
    let [[x0, x1], [y0, y1]] = foot.sole;
    let z = foot.height;
    let (hx, hy, xc, yc) = ((x1 - x0) / 2.0, (y1 - y0) / 2.0, (x0 + x1) / 2.0, (y0 + y1) / 2.0);
    let mu = limits.friction / 2_f64.sqrt();
    let unit = |k: usize| -> [f64; 6] { std::array::from_fn(|i| f64::from(u8::from(i == k))) };
    let sum = |terms: &[(f64, [f64; 6])]| -> [f64; 6] {
        std::array::from_fn(|i| terms.iter().map(|(x, a)| x * a[i]).sum())
    };
    let (fx, fy, fz) = (unit(0), unit(1), unit(2));
    let mx = sum(&[(1.0, unit(3)), (z, fy), (-yc, fz)]);
    let my = sum(&[(1.0, unit(4)), (-z, fx), (xc, fz)]);
    let mz = sum(&[(1.0, unit(5)), (-xc, fy), (yc, fx)]);
    let mut rows = vec![
        (fz, limits.least_force),
        (sum(&[(-1.0, fz)]), -limits.greatest_force),
        (sum(&[(mu, fz), (-1.0, fx)]), 0.0),
        (sum(&[(mu, fz), (1.0, fx)]), 0.0),
        (sum(&[(mu, fz), (-1.0, fy)]), 0.0),
        (sum(&[(mu, fz), (1.0, fy)]), 0.0),
        (sum(&[(hx, fz), (1.0, my)]), 0.0),
        (sum(&[(hx, fz), (-1.0, my)]), 0.0),
        (sum(&[(hy, fz), (-1.0, mx)]), 0.0),
        (sum(&[(hy, fz), (1.0, mx)]), 0.0),
    ];
    for sign in [1.0, -1.0] {
        for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let terms = [
                (mu * (hx + hy), fz),
                (-sign, mz),
                (-s * hy, fx),
                (-s * sign * mu, mx),
                (-t * hx, fy),
                (-t * sign * mu, my),
            ];
            rows.push((sum(&terms), 0.0));
        }
    }
    // The ground's wrench is w + c.
    let carried = foot.carried.to_array();
    for (a, b) in &mut rows {
        *b -= a.iter().zip(carried).map(|(a, c)| a * c).sum::<f64>();
    }
    for sign in [1.0, -1.0] {
        for (twist, limit) in foot.joints.iter().zip(limits.torques) {
            let turn = |v: &Vector3<f64>| foot.rotation.tr_mul(v) * sign;
            let [l, a] = [turn(&twist.linear), turn(&twist.angular)];
            rows.push(([l.x, l.y, l.z, a.x, a.y, a.z], -limit));
        }
    }
    rows
}

/// Unknowns in sole axes: `G` of all feet, `H`, and the stationarity and row conditions.
fn optimality<const FEET: usize>(problem: &Problem<f64, FEET>) -> f64 {
    let mut active = ActiveRows::<f64, ROOM>::new();
    let solution = problem.solve(&mut active, &Settings::new(SOFTNESS)).expect("finite");
    assert_eq!(solution.status, Status::Solved);
    let n = 6 * FEET;
    let mut map = DMatrix::zeros(6, n);
    let mut norm = DMatrix::zeros(n, n);
    for (i, foot) in problem.feet.iter().enumerate() {
        for k in 0..6 {
            let mut unit = [0.0; 6];
            unit[k] = 1.0;
            let w = Wrench::from_array(unit);
            let turned =
                Wrench { force: foot.rotation * w.force, torque: foot.rotation * w.torque };
            let column = turned.shifted(foot.position).to_array();
            map.column_mut(6 * i + k).copy_from_slice(&column);
            let length = problem.weights.norm_length;
            norm[(6 * i + k, 6 * i + k)] = if k < 3 { 1.0 } else { length.powi(-2) };
        }
    }
    let mut weight = Matrix6::zeros();
    for block in [0, 3] {
        let omega = Vector3::from_fn(|k, _| problem.weights.task[block + k]);
        let turned = nalgebra::Matrix3::from_diagonal(&omega) * problem.world;
        weight.fixed_view_mut::<3, 3>(block, block).copy_from(&turned);
    }
    let task = weight * &map;
    let desired = DVector::from_column_slice(&problem.desired.to_array());
    let inverse = norm.map(|x| if x > 0.0 { 1.0 / x } else { 0.0 });
    let gram = &map * &inverse * map.transpose();
    let least_norm = &inverse * map.transpose() * gram.cholesky().expect("full").solve(&desired);
    let hessian = task.transpose() * &task + &norm * problem.weights.regularization;

    let x = DVector::from_vec(problem.in_sole_axes(&solution.x));
    let mut multipliers = [[0.0; 30]; FEET];
    for (row, multiplier) in active.iter() {
        multipliers[usize::from(row / 32)][usize::from(row % 32)] = multiplier;
    }
    let mut gradient = hessian * (&x - least_norm);
    let scale = largest(gradient.iter().copied()).max(1.0);
    let mut worst = 0.0_f64;
    for (i, multipliers) in multipliers.iter().enumerate() {
        for ((a, b), multiplier) in rows_of(problem, i).into_iter().zip(multipliers) {
            let slack =
                (0..6).map(|k| a[k] * x[6 * i + k]).sum::<f64>() - b + SOFTNESS * multiplier;
            worst = worst.max(-slack).max(-multiplier);
            if *multiplier > 0.0 {
                worst = worst.max(slack);
            }
            for k in 0..6 {
                gradient[6 * i + k] -= a[k] * multiplier;
            }
        }
    }
    worst.max(largest(gradient.iter().copied()) / scale)
}

/// `H (w − w0) = Aᵀ λ`, and every row, from matrices that are written down here.
#[test]
fn random_answers_are_optimal() {
    let mut rng = random(81);
    let one = largest((0..1000).map(|_| optimality(&random_problem::<1>(&mut rng))));
    let two = largest((0..1000).map(|_| optimality(&random_problem::<2>(&mut rng))));
    let four = largest((0..200).map(|_| optimality(&random_problem::<4>(&mut rng))));
    println!("1, 2, 4 feet: {one:.1e} {two:.1e} {four:.1e}");
    // N, N·m; gradients relative.
    assert!(one.max(two).max(four) < 1e-7);
}
