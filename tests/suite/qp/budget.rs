//! The budget of work, and what becomes of a program that it does not suffice for.

use super::{cold, distance, solved};
use crate::qp::random::random_program;
use surefoot::qp::{ActiveRows, DenseProgram, Program, Settings, Status};
use surefoot_tests::random_trees::random;

/// Whatever the budget, it is kept; what is reported as broken is broken by as much as reported.
#[test]
fn a_budget_is_kept() {
    let mut rng = random(71);
    let scan = <DenseProgram<f64, 6, 20> as Program<f64>>::COST.scan;
    for _ in 0..100 {
        let program = random_program::<6, 20>(&mut rng);
        let (whole, _) = cold(&program, 1e-3);
        for work in (0..=whole.work).step_by(17) {
            let settings = Settings { work, ..Settings::new(1e-3) };
            let mut active = ActiveRows::new();
            let hurried = solved(&program, &mut active, &settings).expect("finite");
            assert!(hurried.work <= work.max(scan), "{} of {work}", hurried.work);
            let enough = work >= whole.work;
            assert!(enough || hurried.status == Status::BudgetSpent || whole.changes == 0);
            let broken = program
                .normals
                .iter()
                .zip(&program.bounds)
                .map(|(a, b)| b - a.iter().zip(&hurried.x).map(|(a, x)| a * x).sum::<f64>());
            let broken = broken.fold(0.0, f64::max);
            let told = hurried.violation.map_or(0.0, |violation| violation.amount);
            assert!((told - broken).abs() < 1e-6, "{told} and {broken}");
        }
        let settings = Settings { work: whole.work, ..Settings::new(1e-3) };
        let exact = solved(&program, &mut ActiveRows::new(), &settings).expect("finite");
        assert!(exact.x == whole.x && exact.status == Status::Solved);
    }
}

/// A program that does not fit into one call is solved in several: the rows are carried over.
#[test]
fn calls_go_on_where_the_last_one_ended() {
    let mut rng = random(72);
    let mut calls = [0; 6];
    for _ in 0..2000 {
        let program = random_program::<6, 20>(&mut rng);
        let (whole, held) = cold(&program, 1e-3);
        // Enough to begin with the rows of the answer and to take in a few more.
        let mut again = held;
        let warm = solved(&program, &mut again, &Settings::new(1e-3)).expect("finite").work;
        let settings = Settings { work: 2 * warm, ..Settings::new(1e-3) };
        let mut active = ActiveRows::new();
        let (last, count) = (0..5)
            .map(|count| (solved(&program, &mut active, &settings).expect("finite"), count))
            .find(|(solution, _)| solution.status == Status::Solved)
            .expect("solved within five calls");
        assert!(distance(&last.x, &whole.x) < 1e-7);
        calls[count] += 1;
    }
    println!("calls that it took: {calls:?}");
    assert!(calls[1..].iter().sum::<i32>() > 100, "the budget was no limit");
}
