//! Whatever comes in: numbers, or a typed fault.

use super::super::feet_f32;
use super::{Play, task};
use nalgebra::Vector3;
use rand::RngExt;
use rand_pcg::Pcg64;
use surefoot::Real;
use surefoot::balance::{
    AngularTask, Fault, FootTask, Input, LinearTask, MotionTask, WholeBody, WholeBodyController,
    WholeBodyMemory, WholeBodySettings, WholeBodyState, observe, whole_body_motion_tick,
};
use surefoot_tests::legged_trees::{quadruped, seven};
use surefoot_tests::random_trees::random;

/// Numbers that no sensor and no planner gives.
const WILD: [f64; 9] =
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e30, 1e9, 1e-300, 0.0];

fn wild<T: Real>(rng: &mut Pcg64) -> T {
    T::of(WILD[rng.random_range(0..WILD.len())])
}

fn spoil<T: Real>(rng: &mut Pcg64, all: &mut [T]) {
    for _ in 0..rng.random_range(0..2) {
        let at = rng.random_range(0..all.len());
        all[at] = wild(rng);
    }
}

fn spoil_task<T: Real>(rng: &mut Pcg64, task: &mut MotionTask<T, 4>) {
    let at = rng.random_range(0..4);
    match rng.random_range(0..6) {
        0 => task.feet[at] = FootTask::Press { most_force: wild(rng) },
        1 => {
            let linear = Vector3::from_fn(|_, _| wild(rng));
            task.feet[at] = FootTask::Swing { linear, angular: Vector3::zeros() };
        }
        2 => {
            let turn = Vector3::new(T::zero(), wild(rng), T::zero());
            task.angular = AngularTask::CentralBody(turn);
        }
        3 => {
            let [x, y, vertical, per_length] = std::array::from_fn(|_| wild(rng));
            task.linear = LinearTask::CenterOfPressure { point: [x, y], vertical, per_length };
        }
        _ => {}
    }
}

/// Plays spoiled states and tasks; counts torques and faults.
fn play<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    controller: &WholeBodyController<'_, T, N, NQ, NV, 4>,
    state: &WholeBodyState<T, NQ, NV>,
    memory: &mut WholeBodyMemory<T>,
    answers: &mut [usize; 2],
) {
    let mut state = *state;
    spoil(rng, &mut state.positions);
    spoil(rng, &mut state.velocities);
    let pressing = std::array::from_fn(|_| rng.random_bool(0.6));
    let ticked = observe(controller, &state).and_then(|observed| {
        let motion = observed.motion(controller)?;
        let momentum = motion.angular_momentum.iter().chain(motion.velocity.iter());
        assert!(momentum.chain(motion.center_of_mass.iter()).all(|x| x.is_finite()));
        let mut task = task(rng, &motion, &pressing, 1.0);
        spoil_task(rng, &mut task);
        whole_body_motion_tick(controller, &observed, &task, memory)
    });
    match ticked {
        Ok(out) => {
            answers[0] += 1;
            assert!(out.torques.iter().all(|x| x.is_finite()));
            let most = controller.settings.limits.work;
            assert!(out.limits.work <= most, "{}", out.limits.work);
        }
        Err(fault) => {
            answers[1] += 1;
            assert!(!matches!(fault, Fault::SingularLeg { .. }));
        }
    }
}

#[test]
fn no_state_and_no_task_gives_a_torque_that_is_no_number() {
    let mut rng = random(97);
    let mut answers = [[0; 2]; 2];
    for _ in 0..60 {
        let at = Play::new(&mut rng, seven(&mut random(5)), 1.0);
        let single = WholeBodySettings {
            posture: at.robot.stance.map(|x| x as f32),
            ..WholeBodySettings::scaled(0.8, 9.81, 4)
        };
        let tree = at.robot.tree.to_f32();
        let model = WholeBody::new(&tree, &feet_f32(&at.robot.feet)).expect("a robot");
        let (mut memory, mut memory_f32) = (WholeBodyMemory::new(), WholeBodyMemory::new());
        let controller =
            WholeBodyController { tree: &at.robot.tree, robot: &at.model, settings: &at.settings };
        let controller_f32 = WholeBodyController { tree: &tree, robot: &model, settings: &single };
        let state_f32 = WholeBodyState {
            positions: at.state.positions.map(|x| x as f32),
            velocities: at.state.velocities.map(|x| x as f32),
        };
        for _ in 0..250 {
            play(&mut rng, &controller, &at.state, &mut memory, &mut answers[0]);
            play(&mut rng, &controller_f32, &state_f32, &mut memory_f32, &mut answers[1]);
        }
    }
    assert!(answers.as_flattened().iter().all(|count| *count > 3_000), "{answers:?}");
}

#[test]
fn what_is_wrong_with_a_task_is_named() {
    let mut rng = random(3);
    let at = Play::new(&mut rng, quadruped(&mut random(3)), 0.1);
    let tick = |change: &dyn Fn(&mut MotionTask<f64, 4>)| {
        let tree = &at.robot.tree;
        let controller = WholeBodyController { tree, robot: &at.model, settings: &at.settings };
        let observed = observe(&controller, &at.state).expect("a state");
        let mut task = at.task;
        change(&mut task);
        let mut memory = WholeBodyMemory::new();
        whole_body_motion_tick(&controller, &observed, &task, &mut memory).map(|_| ())
    };
    assert_eq!(tick(&|_| {}), Ok(()));
    let fault = Err(Fault::NotFinite(Input::Reference));
    let turns = |rate: f64| AngularTask::CentralBody(Vector3::x() * rate);
    assert_eq!(tick(&|task| task.angular = turns(f64::NAN)), fault);
    for (rate, inertia) in [(f64::NAN, 1.0), (1.0, 0.0), (1.0, -1.0), (1.0, f64::NAN)] {
        let momentum = AngularTask::Momentum { rate: Vector3::x() * rate, inertia };
        assert_eq!(tick(&|task| task.angular = momentum), fault);
    }
    assert_eq!(
        tick(&|task| task.linear = LinearTask::CenterOfMass([0.0, f64::INFINITY, 0.0].into())),
        fault
    );
    assert_eq!(tick(&|task| task.feet[1] = FootTask::Press { most_force: -1.0 }), fault);
    assert_eq!(tick(&|task| task.feet[1] = FootTask::Press { most_force: f64::NAN }), fault);
    let far =
        FootTask::Swing { linear: Vector3::new(f64::NAN, 0.0, 0.0), angular: Vector3::zeros() };
    assert_eq!(tick(&|task| task.feet[2] = far), fault);
}
