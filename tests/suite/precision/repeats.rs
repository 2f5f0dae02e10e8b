//! A second run comes to the same conclusions, on all problems. Times differ; all else is the same to the last bit.

use surefoot_host::precision::{Curve, Effort, PROBLEMS, problem, ranked, reference, sweep};

/// All curves of a problem, and whether what works was timed.
fn run(name: &str, effort: &Effort) -> Vec<Curve> {
    let problem = problem(name).expect("a problem");
    let exact = reference(&problem, effort.most_evaluations).expect("a reference");
    let mut curves: Vec<Curve> =
        problem.contenders.iter().map(|c| sweep(&problem, c, &exact, effort)).collect();
    for m in curves.iter_mut().flat_map(|curve| &mut curve.measurements) {
        assert_eq!(
            m.time.is_some(),
            effort.repeats > 0 && m.failure.is_none(),
            "what works is timed"
        );
        m.time = None;
    }
    curves
}

/// What is read off the charts: who is ahead at each accuracy, and all slopes.
fn conclusions(curves: &[Curve]) -> (Vec<Vec<String>>, Vec<Option<f64>>) {
    let methods = |accuracy: f64| -> Vec<String> {
        ranked(curves, accuracy).into_iter().map(|choice| choice.method).collect()
    };
    let slopes = curves.iter().map(|curve| curve.fit.map(|fit| fit.order)).collect();
    ([1e-1, 1e-2, 1e-4, 1e-6].map(methods).into(), slopes)
}

#[test]
fn a_second_run_changes_no_conclusion() {
    for name in PROBLEMS {
        // A closed loop's and the box's runs take most: what they evaluate are contacts.
        let most_evaluations = match name {
            "experiment-1" | "box-drop" => 2000,
            _ => 4000,
        };
        let effort = Effort { most_evaluations, repeats: 0, timed_s: 0.0 };
        let (first, second) = (run(name, &effort), run(name, &effort));
        assert_eq!(first, second, "{name}");
        let (rankings, slopes) = conclusions(&first);
        assert_eq!((&rankings, &slopes), (&conclusions(&second).0, &conclusions(&second).1));
        println!("{name}: {rankings:?}");
        assert!(!rankings[0].is_empty(), "{name}: nothing reaches a tenth");
    }
}

/// Times change nothing but times.
#[test]
fn what_is_timed_is_what_is_not() {
    let untimed = Effort { most_evaluations: 4000, repeats: 0, timed_s: 0.0 };
    let timed = Effort { repeats: 3, ..untimed };
    assert_eq!(run("chain", &untimed), run("chain", &timed));
}
