//! Random foot-wrench programs in f32, cold, on the next tick and after a push: `contact_wrenches
//! [COUNT] [SEED]`. Prints failures (there must be none), errors against f64, work and changes; then
//! climbs from the dearest programs to dearer ones.

use rand::RngExt;
use rand_pcg::Pcg64;
use std::process::ExitCode;
use surefoot::balance::ContactWeights;
use surefoot::qp::{ActiveRows, Settings, Status};
use surefoot_tests::contact_problems::{Problem, later, random_problem};
use surefoot_tests::random_trees::random;

/// Rows that there is room for.
const ROOM: usize = 24;
/// A budget for one tick, in multiplications.
const BUDGET: u32 = 7000;

/// Values, and how they are spread.
#[derive(Default)]
struct Spread(Vec<f64>);

impl Spread {
    fn print(&mut self, what: &str) {
        self.0.sort_by(f64::total_cmp);
        let Some(last) = self.0.len().checked_sub(1) else { return };
        let [half, most, nearly, all] =
            [0.5, 0.99, 0.9999, 1.0].map(|q| self.0[(last as f64 * q) as usize]);
        let mean = self.0.iter().sum::<f64>() / self.0.len() as f64;
        println!(
            "{what:<28} mean {mean:<9.3e} median {half:<9.3e} 99 % {most:<9.3e} 99.99 % {nearly:<9.3e} max {all:.3e}"
        );
    }
}

#[derive(Default)]
struct Figures {
    failures: u64,
    no_room: u64,
    over_budget: u64,
    work: [Spread; 3],
    changes: [Spread; 3],
    error: Spread,
    ticks: Spread,
    left_broken: Spread,
    loosened: u64,
}

fn one<const FEET: usize>(figures: &mut Figures, rng: &mut Pcg64, with_error: bool) {
    let mut first = random_problem::<FEET>(rng);
    first.weights.regularization = ContactWeights::<f64>::standing().regularization;
    let next = later(&first, rng, [3.0, 1.0]);
    let push = later(&first, rng, [60.0, 20.0]);
    let settings = Settings::new(1e-3_f32);
    let mut cold = ActiveRows::<f32, ROOM>::new();
    for (kind, problem) in [first, next, push].iter().enumerate() {
        let mut active = cold;
        let single = problem.to_f32();
        match single.solve(&mut active, &settings) {
            Ok(solution) if solution.status == Status::Solved => {
                figures.work[kind].0.push(f64::from(solution.work));
                figures.changes[kind].0.push(f64::from(solution.changes));
                figures.loosened += u64::from(solution.tolerance > settings.tolerance);
                if with_error && kind == 0 {
                    figures.error.0.push(error(&single, &solution.x));
                }
            }
            Ok(solution) if solution.status == Status::TooManyRows => figures.no_room += 1,
            _ => figures.failures += 1,
        }
        if kind == 0 {
            cold = active;
        }
    }
    // After the push with a budget: tick by tick.
    let hurried = Settings { work: BUDGET, ..settings };
    let single = push.to_f32();
    let mut active = cold;
    for tick in 1..=20 {
        let Ok(solution) = single.solve(&mut active, &hurried) else {
            figures.failures += 1;
            break;
        };
        figures.over_budget += u64::from(solution.work > BUDGET);
        if tick == 1 && solution.status == Status::BudgetSpent {
            let broken = solution.violation.map_or(0.0, |violation| violation.amount);
            figures.left_broken.0.push(f64::from(broken));
        }
        if solution.status != Status::BudgetSpent || tick == 20 {
            figures.ticks.0.push(f64::from(tick));
            break;
        }
    }
}

/// Of the wrenches, relative to the greatest of them, against the same numbers in f64.
fn error<const FEET: usize>(
    problem: &Problem<f32, FEET>,
    ours: &[surefoot::spatial::Wrench<f32>; FEET],
) -> f64 {
    let exact = problem.to_f64();
    let mut active = ActiveRows::<f64, ROOM>::new();
    let Ok(solution) = exact.solve(&mut active, &Settings::new(1e-3)) else { return f64::NAN };
    let (theirs, ours) = (exact.in_sole_axes(&solution.x), problem.in_sole_axes(ours));
    let scale = theirs.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    ours.iter().zip(&theirs).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / scale
}

/// Keeps what makes a cold start dearer: the most work that a climb found.
fn climb<const FEET: usize>(rng: &mut Pcg64, steps: u32) -> (u32, u32) {
    let cost = |problem: &Problem<f64, FEET>| {
        let mut active = ActiveRows::<f32, ROOM>::new();
        let solution = problem.to_f32().solve(&mut active, &Settings::new(1e-3));
        solution.map_or((0, 0), |solution| (solution.work, solution.changes))
    };
    let mut best = random_problem::<FEET>(rng);
    let mut most = cost(&best);
    for step in 0..steps {
        let size = 200.0 * 0.5_f64.powi((step % 8) as i32);
        let mut next = later(&best, rng, [size, 0.3 * size]);
        if step % 3 == 0 {
            let other = random_problem::<FEET>(rng);
            let foot = rng.random_range(0..FEET);
            next.feet[foot].limits = other.feet[foot].limits;
            next.feet[foot].sole = other.feet[foot].sole;
            next.feet[foot].height = other.feet[foot].height;
        }
        let cost = cost(&next);
        if cost > most {
            (best, most) = (next, cost);
        }
    }
    most
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).map(|x| x.parse::<u64>());
    let count = arguments.next().and_then(Result::ok).unwrap_or(100_000);
    let seed = arguments.next().and_then(Result::ok).unwrap_or(1);
    let mut rng = random(seed);
    let mut figures = Figures::default();
    for i in 0..count {
        match i % 10 {
            0 => one::<1>(&mut figures, &mut rng, i % 100 == 0),
            _ => one::<2>(&mut figures, &mut rng, i % 20 == 1),
        }
    }
    println!(
        "{count} programs, seed {seed}, of one foot and (9 of 10) two; each also 3 N and 60 N later"
    );
    println!(
        "failures {}, more than {ROOM} rows {}, over the budget {}, tolerance raised {}",
        figures.failures, figures.no_room, figures.over_budget, figures.loosened
    );
    let kinds = ["cold", "warm, 3 N, 1 N·m later", "warm, 60 N, 20 N·m later"];
    for (kind, work) in kinds.iter().zip(&mut figures.work) {
        work.print(&format!("work {kind}"));
    }
    for (kind, changes) in kinds.iter().zip(&mut figures.changes) {
        changes.print(&format!("changes {kind}"));
    }
    figures.error.print("error of w in f32");
    figures.ticks.print(&format!("ticks of {BUDGET} after 60 N"));
    figures.left_broken.print("left broken in the first, N");
    let climbs = (count / 10_000).clamp(5, 40) as u32;
    let most = (0..climbs).map(|_| climb::<2>(&mut rng, 4000)).max().unwrap_or_default();
    println!(
        "dearest cold start in {climbs} climbs of 4000 steps: work {}, changes {}",
        most.0, most.1
    );
    if figures.failures + figures.over_budget == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
