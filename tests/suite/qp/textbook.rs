//! Programs whose answers are printed elsewhere, or known in closed form.

use super::{cold, distance, solved};
use surefoot::qp::{ActiveRows, DenseProgram, Fault, Settings, Status};
use surefoot_tests::random_trees::{random, symmetric};

/// Rows give way by this little, so that hard answers are met to 1e-8.
const HARD: f64 = 1e-10;

/// The example of R's package `quadprog`, which is Goldfarb and Idnani's method by B. Turlach.
#[test]
fn the_example_of_quadprog() {
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let normals = [[-4.0, -3.0, 0.0], [2.0, 1.0, 0.0], [0.0, -2.0, 1.0]];
    let program =
        DenseProgram::with_linear_term(identity, [0.0, -5.0, 0.0], normals, [-8.0, 2.0, 0.0]);
    let (solution, active) = cold(&program.expect("positive definite"), HARD);
    let printed = [0.476_190_476_190_5, 1.047_619_047_619_0, 2.095_238_095_238_1];
    assert!(distance(&solution.x, &printed) < 1e-9);
    let mut multipliers: Vec<_> = active.iter().collect();
    multipliers.sort_by_key(|(row, _)| *row);
    let [(1, second), (2, third)] = multipliers[..] else { panic!("{multipliers:?}") };
    assert!((second - 0.238_095_238_1).abs() < 1e-9 && (third - 2.095_238_095_2).abs() < 1e-9);
}

/// Hock and Schittkowski, *Test Examples for Nonlinear Programming Codes*, problem 35 (Beale).
#[test]
fn hock_schittkowski_35() {
    let hessian = [[4.0, 2.0, 2.0], [2.0, 4.0, 0.0], [2.0, 0.0, 2.0]];
    let normals = [[-1.0, -1.0, -2.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let bounds = [-3.0, 0.0, 0.0, 0.0];
    let program = DenseProgram::with_linear_term(hessian, [-8.0, -6.0, -4.0], normals, bounds);
    let (solution, _) = cold(&program.expect("positive definite"), HARD);
    assert!(distance(&solution.x, &[4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0]) < 1e-9);
}

/// The same book, problem 76.
#[test]
fn hock_schittkowski_76() {
    let hessian =
        [[2.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 2.0, 1.0], [0.0, 0.0, 1.0, 1.0]];
    let normals = [
        [-1.0, -2.0, -1.0, -1.0],
        [-3.0, -1.0, -2.0, 1.0],
        [0.0, 1.0, 4.0, 0.0],
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let bounds = [-5.0, -4.0, 1.5, 0.0, 0.0, 0.0, 0.0];
    let program = DenseProgram::with_linear_term(hessian, [-1.0, -3.0, 1.0, -1.0], normals, bounds);
    let (solution, _) = cold(&program.expect("positive definite"), HARD);
    assert!(distance(&solution.x, &[3.0 / 11.0, 23.0 / 11.0, 0.0, 6.0 / 11.0]) < 1e-9);
}

/// A box, axis by axis: `λ = max(0, b − x₀) / (1/h + δ)`.
#[test]
fn a_box_in_closed_form() {
    let mut rng = random(41);
    for softness in [1e-3, 0.1, 10.0] {
        for _ in 0..200 {
            let minimum: [f64; 6] = symmetric(&mut rng);
            let stiffness = symmetric::<6>(&mut rng).map(|x: f64| 10_f64.powf(2.0 * x));
            let bounds: [f64; 6] = symmetric(&mut rng);
            let diagonal = |d: [f64; 6]| -> [[f64; 6]; 6] {
                std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
            };
            let program = DenseProgram {
                minimum,
                hessian: diagonal(stiffness),
                normals: diagonal([1.0; 6]),
                bounds,
            };
            let (solution, _) = cold(&program, softness);
            let expected = std::array::from_fn(|i| {
                let multiplier =
                    (bounds[i] - minimum[i]).max(0.0) / (1.0 / stiffness[i] + softness);
                minimum[i] + multiplier / stiffness[i]
            });
            // Measured 7e-16.
            assert!(distance(&solution.x, &expected) < 5e-15);
        }
    }
}

/// Where nothing binds the answer is the minimum itself.
#[test]
fn nothing_binds() {
    let program = DenseProgram {
        minimum: [0.1 + 0.2, -0.3],
        hessian: [[2.0, 0.5], [0.5, 1.0]],
        normals: [[1.0, 0.0], [0.0, 1.0]],
        bounds: [-1.0, -1.0],
    };
    let mut active = ActiveRows::new();
    let solution = solved(&program, &mut active, &Settings::new(1e-3)).expect("finite");
    assert_eq!(solution.x.map(f64::to_bits), program.minimum.map(f64::to_bits));
    assert!(solution.status == Status::Solved && solution.changes == 0 && active.is_empty());
    // Not even a Hessian that is not one is looked at.
    let unread = DenseProgram { hessian: [[-1.0; 2]; 2], ..program };
    assert!(solved(&unread, &mut active, &Settings::new(1e-3)).is_ok());
    let read = DenseProgram { bounds: [1.0, 0.0], ..unread };
    let fault = solved(&read, &mut active, &Settings::new(1e-3)).err();
    assert_eq!(fault, Some(Fault::NotPositiveDefinite));
}

/// Any number of a program that is not finite is a fault, and never an answer.
#[test]
fn numbers_that_are_not_finite() {
    let program = DenseProgram {
        minimum: [0.0, 0.0],
        hessian: [[2.0, 0.5], [0.5, 1.0]],
        normals: [[1.0, 0.5], [0.3, 1.0]],
        bounds: [1.0, 2.0],
    };
    for bad in [f64::NAN, f64::INFINITY] {
        for place in 0..9 {
            let mut broken = program;
            match place {
                0..2 => broken.minimum[place] = bad,
                2 => broken.hessian[0][0] = bad,
                3 => broken.hessian[1][0] = bad,
                4 => broken.hessian[1][1] = bad,
                5..7 => broken.normals[place - 5][1] = bad,
                _ => broken.bounds[place - 7] = bad,
            }
            let mut active = ActiveRows::new();
            let answer = solved(&broken, &mut active, &Settings::new(1e-3));
            assert!(answer.is_err() && active.is_empty(), "{bad} at {place}: {answer:?}");
        }
    }
}
