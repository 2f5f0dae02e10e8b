//! The solver of quadratic programs, which knows no physics.

mod budget;
mod degenerate;
pub mod peer;
mod random;
mod textbook;

use surefoot::qp::{ActiveRows, DenseProgram, Fault, Settings, Solution, solve};

/// Rows that can be held at once in these tests.
const ROOM: usize = 64;

/// One compiled solver for all tests of a size.
#[inline(never)]
fn solved<const N: usize, const M: usize>(
    program: &DenseProgram<f64, N, M>,
    active: &mut ActiveRows<f64, ROOM>,
    settings: &Settings<f64>,
) -> Result<Solution<f64, [f64; N]>, Fault> {
    solve(program, active, settings)
}

fn cold<const N: usize, const M: usize>(
    program: &DenseProgram<f64, N, M>,
    softness: f64,
) -> (Solution<f64, [f64; N]>, ActiveRows<f64, ROOM>) {
    let mut active = ActiveRows::new();
    let solution = solved(program, &mut active, &Settings::new(softness)).expect("finite");
    (solution, active)
}

fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}
