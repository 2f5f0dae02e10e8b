//! Rows that depend on each other, contradict each other, or meet in too great a number.

use super::{ROOM, cold, distance, solved};
use surefoot::qp::{ActiveRows, DenseProgram, Settings, Status, solve};

/// A row given k times is one row that gives way a k-th.
#[test]
fn a_row_many_times() {
    let hessian = [[3.0, 1.0], [1.0, 2.0]];
    let minimum = [-1.0, -2.0];
    let once = DenseProgram { minimum, hessian, normals: [[1.0, 2.0]], bounds: [1.0] };
    let often = DenseProgram { minimum, hessian, normals: [[1.0, 2.0]; 7], bounds: [1.0; 7] };
    for softness in [1e-1, 1e-3, 1e-6] {
        let (one, _) = cold(&once, softness / 7.0);
        let (seven, active) = cold(&often, softness);
        assert!(distance(&one.x, &seven.x) < 1e-9);
        assert_eq!(active.len(), 7);
        let (least, most) = active
            .iter()
            .fold((f64::MAX, 0.0_f64), |(least, most), (_, x)| (least.min(x), most.max(x)));
        // Measured 2e-10 of the multiplier at 1e-6.
        assert!(most - least < 1e-9 * most, "{least} … {most}");
    }
}

/// `x ≥ 1` and `x ≤ −1`: both give way by 1, and the answer says so.
#[test]
fn a_contradiction_is_shared() {
    let program = DenseProgram {
        minimum: [0.0],
        hessian: [[2.0]],
        normals: [[1.0], [-1.0]],
        bounds: [1.0; 2],
    };
    let settings = Settings { margin: 0.1, ..Settings::new(1e-3) };
    let mut active = ActiveRows::new();
    let solution = solved(&program, &mut active, &settings).expect("finite");
    assert_eq!(solution.status, Status::Contradiction);
    assert!(solution.x[0].abs() < 1e-9);
    assert!((solution.violation.expect("broken").amount - 1.0).abs() < 1e-9);
    assert!(active.iter().all(|(_, multiplier)| (multiplier - 1000.0).abs() < 1e-6));
    let tolerant = Settings { margin: 1.1, ..settings };
    let solution = solved(&program, &mut active, &tolerant).expect("finite");
    assert_eq!(solution.status, Status::Solved);
}

/// 24 rows through one vertex of a cone, the minimum behind it: the vertex is the answer.
#[test]
fn many_rows_through_a_vertex() {
    let vertex = [1.0, 2.0, 3.0];
    let normals: [[f64; 3]; 24] = std::array::from_fn(|i| {
        let (y, x) = (i as f64 * std::f64::consts::TAU / 24.0).sin_cos();
        [x, y, 1.0]
    });
    let bounds = normals.map(|a| a[0] * vertex[0] + a[1] * vertex[1] + a[2] * vertex[2]);
    let hessian = [[2.0, 0.3, 0.0], [0.3, 1.0, 0.1], [0.0, 0.1, 1.5]];
    for shift in [[0.0, 0.0, -5.0], [0.1, -0.2, -5.0], [1.0, 1.0, -9.0]] {
        let minimum = std::array::from_fn(|i| vertex[i] + shift[i]);
        let (solution, _) = cold(&DenseProgram { minimum, hessian, normals, bounds }, 1e-9);
        assert_eq!(solution.status, Status::Solved);
        assert!(distance(&solution.x, &vertex) < 1e-7, "{:?}", solution.x);
    }
}

/// Linear programs on which the simplex method cycles (Beale 1955; Marshall and Suurballe 1969), with
/// `½ ε |x − x_opt|²` for the missing curvature: their optimum is then this program's, up to what rows
/// give way. All their vertices on the way are degenerate.
#[test]
fn programs_that_cycle() {
    // maximise c · x, A x ≤ b, x ≥ 0.
    let beale = (
        [0.75, -150.0, 0.02, -6.0],
        [[0.25, -60.0, -1.0 / 25.0, 9.0], [0.5, -90.0, -1.0 / 50.0, 3.0], [0.0, 0.0, 1.0, 0.0]],
        [0.0, 0.0, 1.0],
        [0.04, 0.0, 1.0, 0.0],
    );
    let marshall = (
        [10.0, -57.0, -9.0, -24.0],
        [[0.5, -5.5, -2.5, 9.0], [0.5, -1.5, -0.5, 1.0], [1.0, 0.0, 0.0, 0.0]],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0, 0.0],
    );
    for (gain, rows, limits, optimum) in [beale, marshall] {
        let epsilon = 1e-2;
        let hessian =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { epsilon } else { 0.0 }));
        let linear = std::array::from_fn(|i| -gain[i] - epsilon * optimum[i]);
        let normals: [[f64; 4]; 7] = std::array::from_fn(|i| {
            if i < 3 {
                rows[i].map(|x: f64| -x)
            } else {
                std::array::from_fn(|j| if i - 3 == j { 1.0 } else { 0.0 })
            }
        });
        let bounds = std::array::from_fn(|i| if i < 3 { -limits[i] } else { 0.0 });
        let program = DenseProgram::with_linear_term(hessian, linear, normals, bounds);
        let (solution, _) = cold(&program.expect("positive definite"), 1e-9);
        assert_eq!(solution.status, Status::Solved);
        println!("{} changes, {:?}", solution.changes, solution.x);
        assert!(distance(&solution.x, &optimum) < 1e-4 && solution.changes < 30);
    }
}

/// More rows bind than there is room for: told, with an answer that is optimal for those held.
#[test]
fn no_room() {
    let identity: [[f64; 5]; 5] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    let program =
        DenseProgram { minimum: [0.0; 5], hessian: identity, normals: identity, bounds: [1.0; 5] };
    let mut active = ActiveRows::<f64, 3>::new();
    let solution = solve(&program, &mut active, &Settings::new(1e-9)).expect("finite");
    assert_eq!((solution.status, active.len()), (Status::TooManyRows, 3));
    assert!((solution.violation.expect("broken").amount - 1.0).abs() < 1e-8);
    let mut active = ActiveRows::<f64, ROOM>::new();
    assert_eq!(solved(&program, &mut active, &Settings::new(1e-9)).unwrap().status, Status::Solved);
}
