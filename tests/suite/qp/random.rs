//! Random programs, by their optimality conditions.

use super::{ROOM, cold, distance, solved};
use rand::RngExt;
use rand_pcg::Pcg64;
use surefoot::qp::{ActiveRows, DenseProgram, Settings, Status};
use surefoot_tests::random_trees::{random, symmetric};

/// A Hessian of condition up to 10⁴ and rows of which some repeat, add up, or contradict others.
pub fn random_program<const N: usize, const M: usize>(rng: &mut Pcg64) -> DenseProgram<f64, N, M> {
    let root: [[f64; N]; N] = std::array::from_fn(|_| symmetric(rng));
    let floor = 10_f64.powf(rng.random_range(-2.0..0.0));
    let hessian = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            (0..N).map(|k| root[k][i] * root[k][j]).sum::<f64>() + if i == j { floor } else { 0.0 }
        })
    });
    let mut normals: [[f64; N]; M] = std::array::from_fn(|_| symmetric(rng));
    let mut bounds: [f64; M] = symmetric(rng);
    for i in 2..M {
        match rng.random_range(0..10) {
            0 => (normals[i], bounds[i]) = (normals[i - 1], bounds[i - 1]),
            1 => {
                normals[i] = std::array::from_fn(|k| normals[i - 1][k] + normals[i - 2][k]);
                bounds[i] = bounds[i - 1] + bounds[i - 2];
            }
            2 => {
                normals[i] = normals[i - 1].map(|x| -x);
                bounds[i] = 0.2 - bounds[i - 1];
            }
            _ => {}
        }
    }
    DenseProgram { minimum: symmetric(rng).map(|x: f64| 3.0 * x), hessian, normals, bounds }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Largest violation of: H (x − x₀) = Aᵀ λ; a x + δ λ ≥ b, with equality where λ > 0; λ ≥ 0.
pub fn residual<const N: usize, const M: usize>(
    program: &DenseProgram<f64, N, M>,
    x: &[f64; N],
    active: &ActiveRows<f64, ROOM>,
    softness: f64,
) -> f64 {
    let mut multipliers = [0.0; M];
    for (row, multiplier) in active.iter() {
        multipliers[usize::from(row)] = multiplier;
    }
    let step: [f64; N] = std::array::from_fn(|i| x[i] - program.minimum[i]);
    let mut worst = 0.0_f64;
    for i in 0..N {
        let pull: f64 = (0..M).map(|j| program.normals[j][i] * multipliers[j]).sum();
        worst = worst.max((dot(&program.hessian[i], &step) - pull).abs());
    }
    for j in 0..M {
        let slack = dot(&program.normals[j], x) + softness * multipliers[j] - program.bounds[j];
        worst = worst.max(-slack).max(-multipliers[j]);
        if multipliers[j] > 0.0 {
            worst = worst.max(slack);
        }
    }
    worst
}

fn check<const N: usize, const M: usize>(seed: u64, count: u32) {
    let mut rng = random(seed);
    let (mut worst, mut changes, mut differ) = (0.0_f64, 0, 0.0_f64);
    for _ in 0..count {
        let program = random_program::<N, M>(&mut rng);
        let (solution, mut active) = cold(&program, 1e-3);
        assert_eq!(solution.status, Status::Solved);
        worst = worst.max(residual(&program, &solution.x, &active, 1e-3));
        changes = changes.max(solution.changes);
        // From the rows of a neighbour, whatever they are, the same answer.
        let next = DenseProgram {
            minimum: std::array::from_fn(|i| program.minimum[i] + rng.random_range(-0.3..0.3)),
            ..program
        };
        let warm = solved(&next, &mut active, &Settings::new(1e-3)).expect("finite");
        differ = differ.max(distance(&warm.x, &cold(&next, 1e-3).0.x));
    }
    println!(
        "{N} unknowns, {M} rows: residual {worst:e}, warm − cold {differ:e}, {changes} changes"
    );
    // Measured 4e-8 (stationarity; multipliers are up to 10³, and S up to 10⁶ δ) and 3e-8.
    assert!(worst < 3e-7 && differ < 3e-7);
}

#[test]
fn optimality_of_random_programs() {
    check::<6, 20>(51, 4000);
    check::<24, 60>(52, 400);
}
