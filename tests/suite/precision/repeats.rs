//! A second run comes to the same conclusions. Times differ; all else is the same to the last bit.

use surefoot_sim::precision::{Curve, Effort, problem, ranked, reference, sweep};

fn run() -> Vec<Curve> {
    let effort = Effort { most_evaluations: 4000, repeats: 3, timed_s: 0.0 };
    let problem = problem("chain").expect("a problem");
    let exact = reference(&problem, effort.most_evaluations).expect("a reference");
    problem.contenders.iter().map(|c| sweep(&problem, c, &exact, &effort)).collect()
}

fn without_times(mut curves: Vec<Curve>) -> Vec<Curve> {
    for m in curves.iter_mut().flat_map(|curve| &mut curve.measurements) {
        assert!(m.time.is_some() || m.failure.is_some(), "what works is timed");
        m.time = None;
    }
    curves
}

#[test]
fn a_second_run_changes_no_conclusion() {
    let (first, second) = (without_times(run()), without_times(run()));
    assert_eq!(first, second);
    for accuracy in [1e-2, 1e-4, 1e-6] {
        let methods = |curves: &[Curve]| -> Vec<String> {
            ranked(curves, accuracy).into_iter().map(|choice| choice.method).collect()
        };
        assert!(!methods(&first).is_empty(), "nothing reaches {accuracy}");
        assert_eq!(methods(&first), methods(&second));
    }
}
