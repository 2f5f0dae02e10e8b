//! The same programs by Clarabel, an interior-point method.

use super::{cold, distance};
use crate::qp::random::random_program;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use surefoot::qp::DenseProgram;
use surefoot_tests::random_trees::random;

/// `None` where it gives up. Unknowns (x, s): `½ (x − x₀)ᵀ H (x − x₀) + ½ |s|²/δ`, `A x + s ≥ b`.
pub fn by_clarabel<const N: usize, const M: usize>(
    program: &DenseProgram<f64, N, M>,
    softness: f64,
) -> Option<[f64; N]> {
    let width = N + M;
    let mut hessian = vec![vec![0.0; width]; width];
    for i in 0..N {
        // The upper triangle.
        hessian[i][i..N].copy_from_slice(&program.hessian[i][i..]);
    }
    for j in N..width {
        hessian[j][j] = 1.0 / softness;
    }
    let mut linear = vec![0.0; width];
    for i in 0..N {
        linear[i] = -(0..N).map(|k| program.hessian[i][k] * program.minimum[k]).sum::<f64>();
    }
    let rows: Vec<Vec<f64>> = (0..M)
        .map(|j| {
            let slack = (0..M).map(|k| if j == k { -1.0 } else { 0.0 });
            program.normals[j].iter().map(|x| -x).chain(slack).collect()
        })
        .collect();
    let limits: Vec<f64> = program.bounds.iter().map(|b| -b).collect();
    let settings = DefaultSettings {
        verbose: false,
        tol_gap_abs: 1e-12,
        tol_gap_rel: 1e-12,
        tol_feas: 1e-12,
        ..DefaultSettings::default()
    };
    let mut solver = DefaultSolver::new(
        &csc(&hessian),
        &linear,
        &csc(&rows),
        &limits,
        &[NonnegativeConeT(M)],
        settings,
    )
    .expect("a valid program");
    solver.solve();
    let status = solver.solution.status;
    let is_solved = matches!(status, SolverStatus::Solved | SolverStatus::AlmostSolved);
    is_solved.then(|| std::array::from_fn(|i| solver.solution.x[i]))
}

fn csc(rows: &[Vec<f64>]) -> CscMatrix<f64> {
    let (height, width) = (rows.len(), rows[0].len());
    let (mut starts, mut places, mut values) = (vec![0], vec![], vec![]);
    for j in 0..width {
        for (i, row) in rows.iter().enumerate() {
            if row[j] != 0.0 {
                places.push(i);
                values.push(row[j]);
            }
        }
        starts.push(values.len());
    }
    CscMatrix::new(height, width, starts, places, values)
}

#[test]
fn clarabel_agrees() {
    let mut rng = random(61);
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        let program = random_program::<6, 20>(&mut rng);
        let (ours, _) = cold(&program, 1e-3);
        worst = worst.max(distance(&ours.x, &by_clarabel(&program, 1e-3).expect("solved")));
    }
    for _ in 0..20 {
        let program = random_program::<24, 60>(&mut rng);
        let (ours, _) = cold(&program, 1e-3);
        worst = worst.max(distance(&ours.x, &by_clarabel(&program, 1e-3).expect("solved")));
    }
    println!("largest difference {worst:e}");
    assert!(worst < 1e-7);
}
