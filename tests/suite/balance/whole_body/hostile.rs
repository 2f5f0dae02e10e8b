//! Whatever comes in: numbers, or a typed fault.

use super::{feet_f32, reference, state};
use rand::RngExt;
use rand_pcg::Pcg64;
use surefoot::Real;
use surefoot::balance::{
    ContactPatch, Fault, Input, WholeBody, WholeBodyController, WholeBodyFoot, WholeBodyMemory,
    WholeBodyRobotFault, WholeBodySettings, WholeBodyState, whole_body_tick,
};
use surefoot::model::{Link, Tree};
use surefoot_tests::legged_trees::{five, quadruped, seven};
use surefoot_tests::random_trees::random;

/// Numbers that no sensor gives.
const WILD: [f64; 9] =
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e30, 1e9, 1e-300, 0.0];

fn spoil<T: Real>(rng: &mut Pcg64, all: &mut [T]) {
    for _ in 0..rng.random_range(0..3) {
        let at = rng.random_range(0..all.len());
        all[at] = T::of(WILD[rng.random_range(0..WILD.len())]);
    }
}

#[test]
fn no_state_gives_a_torque_that_is_no_number() {
    let mut rng = random(99);
    let mut answers = [0; 2];
    for _ in 0..200 {
        let robot = seven(&mut rng);
        let settings =
            WholeBodySettings { posture: robot.stance, ..WholeBodySettings::scaled(0.8, 9.81, 4) };
        let single = WholeBodySettings {
            posture: robot.stance.map(|x| x as f32),
            ..WholeBodySettings::scaled(0.8, 9.81, 4)
        };
        let tree = robot.tree.to_f32();
        let model = WholeBody::new(&robot.tree, &robot.feet).expect("a robot");
        let model_f32 = WholeBody::new(&tree, &feet_f32(&robot.feet)).expect("a robot");
        let (mut memory, mut memory_f32) = (WholeBodyMemory::new(), WholeBodyMemory::new());
        for _ in 0..500 {
            let mut state = state(&mut rng, &robot, 1.0);
            let mut state_f32 = WholeBodyState {
                positions: state.positions.map(|x| x as f32),
                velocities: state.velocities.map(|x| x as f32),
            };
            spoil(&mut rng, &mut state.positions);
            spoil(&mut rng, &mut state.velocities);
            spoil(&mut rng, &mut state_f32.positions);
            spoil(&mut rng, &mut state_f32.velocities);
            let contacts = std::array::from_fn(|_| rng.random_bool(0.8));
            let controller =
                WholeBodyController { tree: &robot.tree, robot: &model, settings: &settings };
            let wanted = reference(&mut rng, 1.0);
            match whole_body_tick(&controller, &state, &wanted, &contacts, &mut memory) {
                Ok(out) => {
                    answers[0] += 1;
                    assert!(out.torques.iter().all(|x| x.is_finite()));
                    assert!(out.limits.work <= settings.limits.work, "{}", out.limits.work);
                }
                Err(_) => answers[1] += 1,
            }
            let controller =
                WholeBodyController { tree: &tree, robot: &model_f32, settings: &single };
            let wanted = reference(&mut rng, 1.0);
            match whole_body_tick(&controller, &state_f32, &wanted, &contacts, &mut memory_f32) {
                Ok(out) => assert!(out.torques.iter().all(|x| x.is_finite())),
                Err(fault) => assert!(!matches!(fault, Fault::SingularLeg { .. })),
            }
        }
    }
    assert!(answers.iter().all(|count| *count > 10_000), "{answers:?}");
}

#[test]
fn what_is_wrong_is_named() {
    let mut rng = random(3);
    let robot = quadruped(&mut rng);
    let settings = WholeBodySettings::scaled(0.4, 9.81, 4);
    let play = |state: &WholeBodyState<f64, 19, 18>| {
        super::command(&robot.tree, &robot.feet, &settings, state, &reference(&mut random(1), 0.1))
            .map(|_| ())
    };
    let good = state(&mut rng, &robot, 0.1);
    assert_eq!(play(&good), Ok(()));
    let spoiled = |at: usize, x: f64| {
        let mut bad = good;
        bad.positions[at] = x;
        play(&bad)
    };
    assert_eq!(spoiled(1, f64::NAN), Err(Fault::NotFinite(Input::Position)));
    assert_eq!(spoiled(4, 3.0), Err(Fault::NotUnit(Input::Orientation)));
    assert_eq!(spoiled(9, f64::INFINITY), Err(Fault::NotFinite(Input::Coordinate(9))));
    let mut bad = good;
    bad.velocities[17] = f64::NAN;
    assert_eq!(play(&bad), Err(Fault::NotFinite(Input::Rate(17))));
}

type Feet = [Option<WholeBodyFoot<f64>>; 4];

#[test]
fn what_is_no_legged_robot_is_refused() {
    let mut rng = random(4);
    let robot = five(&mut rng);
    let made = |change: &dyn Fn(&mut Feet)| {
        let mut feet = robot.feet;
        change(&mut feet);
        WholeBody::new(&robot.tree, &feet).map(|_| ()).expect_err("refused")
    };
    assert_eq!(made(&|feet| *feet = [None; 4]), WholeBodyRobotFault::NoFoot);
    let sole = ContactPatch::sole([-0.1, 0.1], [-0.1, 0.1], 0.0);
    let short = WholeBodyRobotFault::ShortLeg { foot: 1, joints: 5, directions: 6 };
    let with_sole = |feet: &mut Feet| {
        if let Some(foot) = feet[1].as_mut() {
            foot.limits.patch = sole;
        }
    };
    assert_eq!(made(&with_sole), short);
    let none = WholeBodyRobotFault::Body { foot: 0, body: 40 };
    assert_eq!(made(&|feet| feet[0].as_mut().expect("a foot").body = 40), none);
    let nan = WholeBodyRobotFault::Foot { foot: 0 };
    assert_eq!(made(&|feet| feet[0].as_mut().expect("a foot").reference.x = f64::NAN), nan);
    let fixed: Tree<f64, 2, 2, 2> = Tree::new([
        Link::revolute(0, [0.0, 0.0, 1.0], [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]),
        Link::revolute(1, [0.0, 0.0, 1.0], [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]),
    ]);
    let fault = WholeBody::new(&fixed, &robot.feet).map(|_| ()).expect_err("it does not float");
    assert_eq!(fault, WholeBodyRobotFault::CentralBody);
}
