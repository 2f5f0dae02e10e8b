//! Foot wrenches within limits: against 50-digit answers, and in [`optimality`] against conditions written down anew.

mod optimality;

use serde_json::Value;
use surefoot::Real;
use surefoot::balance::{
    CentralBody, ContactLimit, ContactProgram, LeggedRobot, RobotState, central_body,
    leg_kinematics, wrench_distribution,
};
use surefoot::qp::{ActiveRows, Fault, Program, Settings, Status, solve};
use surefoot::spatial::{Twist, Wrench};
use surefoot_tests::contact_problems::{Problem, cases, later, random_problem};
use surefoot_tests::random_trees::random;
use surefoot_tests::vectors::array;

use super::workspace::{BIPED, random_state};

/// Rows that can be held at once in these tests.
const ROOM: usize = 40;
/// δ of the vectors.
const SOFTNESS: f64 = 1e-3;

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { most.max(x.abs()) })
}

fn difference(ours: &[f64], theirs: &[f64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    largest(ours.iter().zip(theirs).map(|(a, b)| a - b)) / largest(theirs.iter().copied())
}

fn wrenches(answer: &Value) -> Vec<f64> {
    answer["w"].as_array().unwrap().iter().flat_map(array::<6>).collect()
}

fn name(foot: usize, limit: ContactLimit) -> String {
    let limit = match limit {
        ContactLimit::Torque(joint) | ContactLimit::Range(joint) => format!("torque{joint}"),
        other => format!("{other:?}").to_lowercase(),
    };
    format!("foot {foot}: {limit}")
}

/// Errors of one case: w, the wrench made, multipliers; all relative.
fn errors<T: Real, const FEET: usize>(problem: &Problem<T, FEET>, case: &Value) -> [f64; 3] {
    let mut active = ActiveRows::<T, ROOM>::new();
    let settings = Settings::new(T::of(SOFTNESS));
    let solution = problem.solve(&mut active, &settings).expect("finite");
    assert_eq!(solution.status, Status::Solved, "{}", case["name"]);
    let expected = &case["stiff"];
    let desired = largest(array::<6>(&case["F_d"]));
    let achieved = problem.achieved(&solution.x);
    let wrench = array::<6>(&expected["wrench"]);
    let wrench = largest(achieved.iter().zip(wrench).map(|(a, b)| a - b)) / desired;

    let mut multipliers = [[0.0; 32]; FEET];
    for (row, multiplier) in active.iter() {
        multipliers[usize::from(row / 32)][usize::from(row % 32)] = multiplier.to_f64();
    }
    let mut scale = 1.0_f64;
    for row in expected["active"].as_array().unwrap() {
        let at = |key: &str| row[key].as_u64().unwrap() as usize;
        let multiplier = row["multiplier"].as_f64().unwrap();
        scale = scale.max(multiplier);
        multipliers[at("foot")][at("row")] -= multiplier;
    }
    reasons(problem, &solution.x, &active, case);
    [
        difference(&problem.in_sole_axes(&solution.x), &wrenches(expected)),
        wrench,
        largest(multipliers.into_iter().flatten()) / scale,
    ]
}

/// Where one relief exceeds the next by a tenth, its limit is the reason.
fn reasons<T: Real, const FEET: usize>(
    problem: &Problem<T, FEET>,
    wrenches: &[Wrench<T>; FEET],
    active: &ActiveRows<T, ROOM>,
    case: &Value,
) {
    let contacts = problem.contacts();
    let program = problem.program(&contacts);
    let reason = program.reason(wrenches, active);
    let theirs = case["stiff"]["relief"].as_object().unwrap();
    let Some(expected) = case["stiff"]["reason"].as_str() else {
        assert!(reason.is_none(), "{}: {reason:?}", case["name"]);
        return;
    };
    let reason = reason.expect("something binds");
    let relief = |name: &str| theirs[name].as_f64().unwrap();
    let next = theirs.keys().filter(|key| *key != expected).map(|key| relief(key));
    if relief(expected) > 1.1 * next.fold(0.0, f64::max) {
        assert_eq!(name(reason.foot, reason.limit), expected, "{}", case["name"]);
        let double = T::default_epsilon() < T::of(1e-10);
        let error = reason.relief.to_f64() / relief(expected) - 1.0;
        // Measured in f32: 2e-2 at a sole's corner with ε = 1e-3, 3e-3 elsewhere.
        assert!(error.abs() < if double { 1e-9 } else { 5e-2 }, "{}: {error:e}", case["name"]);
    }
}

fn vectors<const FEET: usize>() -> usize {
    let cases = cases::<FEET>();
    let (mut double, mut single, mut hard) = ([0.0_f64; 3], [0.0_f64; 3], 0.0_f64);
    for (problem, case) in &cases {
        let grow = |most: &mut [f64; 3], new: [f64; 3]| {
            *most = std::array::from_fn(|i| most[i].max(new[i]));
        };
        grow(&mut double, errors(problem, case));
        grow(&mut single, errors(&problem.to_f32(), case));
        if !case["hard"].is_null() {
            // Rows that give way by next to nothing.
            let mut active = ActiveRows::<f64, ROOM>::new();
            let settings = Settings { tolerance: 1e-7, ..Settings::new(1e-9) };
            let solution = problem.solve(&mut active, &settings).expect("finite");
            assert_eq!(solution.status, Status::Solved);
            let w = problem.in_sole_axes(&solution.x);
            hard = hard.max(difference(&w, &wrenches(&case["hard"])));
        }
    }
    println!("{FEET} feet, {} cases: f64 {double:?}, f32 {single:?}, hard {hard:.1e}", cases.len());
    // Measured: f64 1e-12, 6e-13, 6e-12; f32 1e-3, 4e-4; hard 2e-8.
    assert!(double[0] < 1e-11 && double[1] < 1e-11 && double[2] < 1e-10);
    assert!(single[0] < 2e-3 && single[1] < 1e-3);
    assert!(hard < 1e-6);
    cases.len()
}

#[test]
fn all_vectors() {
    assert_eq!(vectors::<1>() + vectors::<2>() + vectors::<3>() + vectors::<4>(), 45);
}

/// Nothing binds: the bits of Alg. 4.5, in both precisions.
fn printed_split<T: Real>(
    robot: &LeggedRobot<T, 2>,
    state: &RobotState<T, 2>,
    base: Problem<T, 2>,
) {
    let central: CentralBody<T> = central_body(robot, state).expect("a unit quaternion");
    let legs = leg_kinematics(robot, &central, state);
    let printed = wrench_distribution(base.desired, &legs).expect("feet nearby").in_central_axes;
    let mut problem = base;
    for (foot, leg) in problem.feet.iter_mut().zip(&legs) {
        foot.position = leg.foot.position;
        foot.rotation = leg.foot.rotation;
        let limits = &mut foot.limits;
        // So wide that nothing binds.
        limits.least_force = T::of(-1e6);
        limits.greatest_force = T::of(1e6);
        limits.torques = [T::of(1e6); 6];
        limits.friction = T::zero();
        limits.patch = surefoot::balance::ContactPatch::sole(
            [T::of(-1e3), T::of(1e3)],
            [T::of(-1e3), T::of(1e3)],
            T::zero(),
        );
        foot.carried = Wrench::from_array([0.0, 0.0, 1e7, 0.0, 0.0, 0.0].map(T::of));
        limits.greatest_force = T::of(1e8);
        limits.friction = T::one();
    }
    problem.weights.norm_length = T::one();
    let mut active = ActiveRows::<T, ROOM>::new();
    let solution = problem.solve(&mut active, &Settings::new(T::of(SOFTNESS))).expect("finite");
    assert!(solution.status == Status::Solved && active.is_empty() && solution.changes == 0);
    for (ours, theirs) in solution.x.iter().zip(&printed) {
        let bits = |w: &Wrench<T>| w.to_array().map(|x| x.to_f64().to_bits());
        assert_eq!(bits(ours), bits(theirs));
    }
}

#[test]
fn where_nothing_binds_it_is_the_printed_split_to_the_bit() {
    let single = BIPED.to_f32();
    let mut rng = random(82);
    for _ in 0..100 {
        let state: RobotState<f64, 2> = random_state(&mut rng);
        let problem = random_problem::<2>(&mut rng);
        printed_split(&BIPED, &state, problem);
        let rounded = RobotState {
            position: state.position.map(|x| x as f32),
            orientation: surefoot::spatial::Quaternion::from_array(
                state.orientation.to_array().map(|x| x as f32),
            ),
            velocity: Twist::from_array(state.velocity.to_array().map(|x| x as f32)),
            joint_angles: state.joint_angles.map(|leg| leg.map(|x| x as f32)),
            joint_rates: state.joint_rates.map(|leg| leg.map(|x| x as f32)),
        };
        printed_split(&single, &rounded, problem.to_f32());
    }
}

/// In f32: what is stated of accuracy, and that a start from other rows ends at the same answer.
#[test]
fn single_precision_and_warm_starts() {
    let mut rng = random(83);
    let (mut errors, mut warm_errors, mut changes) = (vec![], vec![], vec![]);
    for _ in 0..4000 {
        let mut exact = random_problem::<2>(&mut rng);
        exact.weights.regularization = 0.01;
        let single = exact.to_f32();
        let exact = single.to_f64();
        let mut active = ActiveRows::<f64, ROOM>::new();
        let expected = exact.solve(&mut active, &Settings::new(SOFTNESS)).expect("finite").x;
        let expected = exact.in_sole_axes(&expected);
        let settings = Settings::new(1e-3_f32);
        let mut active = ActiveRows::<f32, ROOM>::new();
        let cold = single.solve(&mut active, &settings).expect("finite");
        assert_eq!(cold.status, Status::Solved);
        errors.push(difference(&single.in_sole_axes(&cold.x), &expected));
        // Rows of the program some time before.
        let before = later(&exact, &mut rng, [60.0, 20.0]).to_f32();
        let mut carried = ActiveRows::<f32, ROOM>::new();
        before.solve(&mut carried, &settings).expect("finite");
        let warm = single.solve(&mut carried, &settings).expect("finite");
        assert_eq!(warm.status, Status::Solved);
        warm_errors.push(difference(&single.in_sole_axes(&warm.x), &expected));
        changes.push(f64::from(warm.changes));
    }
    let quantile = |values: &mut Vec<f64>, q: f64| {
        values.sort_by(f64::total_cmp);
        values[((values.len() - 1) as f64 * q) as usize]
    };
    for (what, values) in [("cold", &mut errors), ("warm", &mut warm_errors)] {
        let [half, most, all] = [0.5, 0.99, 1.0].map(|q| quantile(values, q));
        println!("{what}: median {half:.1e}, 99 % {most:.1e}, greatest {all:.1e}");
        assert!(half < 1e-4 && most < 1e-3 && all < 1e-2);
    }
    println!("changes of a warm start after 60 N, 20 N·m: 99 % {}", quantile(&mut changes, 0.99));
}

/// A foot that is not in contact is not there.
#[test]
fn a_foot_in_the_air() {
    let mut rng = random(84);
    for _ in 0..200 {
        let two = random_problem::<2>(&mut rng);
        let one = Problem {
            feet: [two.feet[1]],
            world: two.world,
            desired: two.desired,
            weights: two.weights,
        };
        let settings = Settings::new(SOFTNESS);
        let mut contacts = two.contacts();
        contacts[0] = None;
        let program = two.program(&contacts);
        let mut active = ActiveRows::<f64, ROOM>::new();
        // Rows of the time when it was in contact are passed over.
        two.solve(&mut active, &settings).expect("finite");
        let ours = solve(&program, &mut active, &settings).expect("finite");
        let alone = one.solve(&mut ActiveRows::<f64, ROOM>::new(), &settings).expect("finite");
        assert!(active.iter().all(|(row, _)| row >= 32));
        assert_eq!(ours.x[0], Wrench::zero());
        let ours = ours.x[1].to_array();
        assert!(difference(&ours, &alone.x[0].to_array()) < 1e-9);
    }
    let problem = random_problem::<2>(&mut rng);
    assert!(
        ContactProgram::new(
            &[None; 2] as &[Option<surefoot::balance::ContactFoot<'_, f64, 6>>; 2],
            &problem.weights,
            &problem.world,
            problem.desired
        )
        .is_none()
    );
}

/// Relief by its definition: by how much the objective falls where a limit is widened.
#[test]
fn relief_is_what_widening_a_limit_brings() {
    let objective = |problem: &Problem<f64, 2>| {
        let mut active = ActiveRows::<f64, ROOM>::new();
        let solution = problem.solve(&mut active, &Settings::new(SOFTNESS)).expect("finite");
        let contacts = problem.contacts();
        let program = problem.program(&contacts);
        let start = program.minimum();
        let made = program.achieved(&solution.x) - problem.desired;
        let error = [problem.world * made.force, problem.world * made.torque];
        let mut value = 0.0;
        for k in 0..3 {
            value += (problem.weights.task[k] * error[0][k]).powi(2);
            value += (problem.weights.task[3 + k] * error[1][k]).powi(2);
        }
        for (x, x0) in solution.x.iter().zip(&start) {
            let step = *x - *x0;
            let moment = step.torque / problem.weights.norm_length;
            let norm = step.force.norm_squared() + moment.norm_squared();
            value += problem.weights.regularization * norm;
        }
        value += SOFTNESS * active.iter().map(|(_, l)| l * l).sum::<f64>();
        let reliefs: Vec<_> = program.reliefs(&solution.x, &active).collect();
        (0.5 * value, reliefs)
    };
    let mut rng = random(85);
    let mut compared = 0;
    for _ in 0..100 {
        let problem = random_problem::<2>(&mut rng);
        let (_, reliefs) = objective(&problem);
        for reason in reliefs {
            let widened = |by: f64| {
                let mut wider = problem;
                let limits = &mut wider.feet[reason.foot].limits;
                match reason.limit {
                    ContactLimit::Torque(joint) => limits.torques[usize::from(joint)] *= 1.0 + by,
                    ContactLimit::Press => limits.greatest_force *= 1.0 + by,
                    ContactLimit::Lift => limits.least_force *= 1.0 - by,
                    // Friction is in slip and twist rows alike, a sole's size in tip and twist.
                    _ => return None,
                }
                Some(objective(&wider).0)
            };
            if let (Some(less), Some(more)) = (widened(-1e-4), widened(1e-4)) {
                let slope = (less - more) / 2e-4;
                let error = (slope - reason.relief).abs() / reason.relief.abs().max(1.0);
                assert!(error < 1e-2, "{reason:?} {slope}");
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared}");
}

/// Whatever number is not finite, there is no answer.
#[test]
fn numbers_that_are_not_finite() {
    let mut rng = random(86);
    let good = random_problem::<2>(&mut rng);
    let settings = Settings::new(SOFTNESS);
    assert!(good.solve(&mut ActiveRows::<f64, ROOM>::new(), &settings).is_ok());
    let spoil: [fn(&mut Problem<f64, 2>); 9] = [
        |p| p.desired.force.x = f64::NAN,
        |p| p.desired.torque.z = f64::INFINITY,
        |p| p.feet[0].position.y = f64::NAN,
        |p| p.feet[1].rotation.m22 = f64::NAN,
        |p| p.feet[0].carried.force.z = f64::NAN,
        |p| p.feet[1].joints[3].linear.x = f64::NAN,
        |p| p.feet[0].limits.torques[2] = f64::NAN,
        |p| p.feet[0].limits.friction = f64::NAN,
        |p| p.weights.norm_length = f64::NAN,
    ];
    for (place, spoil) in spoil.iter().enumerate() {
        let mut bad = good;
        spoil(&mut bad);
        let mut active = ActiveRows::<f64, ROOM>::new();
        let answer = bad.solve(&mut active, &settings);
        assert!(matches!(answer, Err(Fault::NotFinite | Fault::NotPositiveDefinite)), "{place}");
    }
}

/// The budget is kept, and a push that does not fit into one tick is solved within a few.
#[test]
fn a_push_within_a_budget() {
    const BUDGET: u32 = 7000;
    let mut rng = random(87);
    let mut ticks = [0; 8];
    for _ in 0..2000 {
        let mut problem = random_problem::<2>(&mut rng);
        problem.weights.regularization = 0.01;
        let settings = Settings { work: BUDGET, ..Settings::new(1e-3_f32) };
        let mut active = ActiveRows::<f32, 20>::new();
        let before = later(&problem, &mut rng, [60.0, 20.0]).to_f32();
        before.solve(&mut active, &settings).expect("finite");
        let problem = problem.to_f32();
        let count = (0..8).find(|_| {
            let solution = problem.solve(&mut active, &settings).expect("finite");
            assert!(solution.work <= BUDGET);
            solution.status == Status::Solved
        });
        ticks[count.unwrap_or(7)] += 1;
    }
    println!("ticks until solved after a push: {ticks:?}");
    assert!(ticks[7] < 20 && ticks[0] > 1200);
}
