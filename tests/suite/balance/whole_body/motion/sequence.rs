//! From tick to tick: caps hold, feet change what they do, and what was in force before does not matter.

use super::{Play, vector};
use nalgebra::Vector3;
use surefoot::balance::{
    FootTask, LinearTask, WholeBodyController, WholeBodyMemory, WholeBodySettings, observe,
    whole_body_motion_tick,
};
use surefoot::qp::{Settings, Status, Work};
use surefoot_tests::legged_trees::seven;
use surefoot_tests::random_trees::random;

#[test]
fn a_warm_start_from_other_feet_comes_to_the_same_torques() {
    let mut rng = random(21);
    let (mut most, mut bound, mut changes) = (0.0_f64, 0, [0, 0]);
    for _ in 0..10 {
        let robot = seven(&mut rng);
        let mut memory = WholeBodyMemory::new();
        for round in 0..40 {
            // The same state and task for two ticks with other feet in between.
            let mut at = Play::new(&mut rng, robot.clone(), 0.3);
            at.task.feet = std::array::from_fn(|foot| match (foot + round) % 3 {
                0 => FootTask::Press { most_force: 300.0 },
                1 => FootTask::Press { most_force: f64::INFINITY },
                _ => FootTask::Swing { linear: vector(&mut rng, 5.0), angular: Vector3::zeros() },
            });
            at.task.linear = LinearTask::CenterOfMass(vector(&mut rng, 4.0));
            let limits = Settings { work: Work::MAX, ..at.settings.limits };
            let settings = WholeBodySettings { limits, ..at.settings };
            let cold = at.command(&settings);
            let controller =
                WholeBodyController { tree: &robot.tree, robot: &at.model, settings: &settings };
            let observed = observe(&controller, &at.state).expect("a state");
            let warm = whole_body_motion_tick(&controller, &observed, &at.task, &mut memory);
            let warm = warm.expect("torques");
            assert_eq!((cold.limits.status, warm.limits.status), (Status::Solved, Status::Solved));
            bound += usize::from(cold.limits.is_limited());
            changes[0] += cold.limits.changes;
            changes[1] += warm.limits.changes;
            let scale = cold.torques.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (a, b) in cold.torques.iter().zip(warm.torques) {
                most = most.max((a - b).abs() / scale);
            }
            for (w, task) in warm.foot_wrenches.iter().zip(&at.task.feet) {
                if matches!(task, FootTask::Swing { .. }) {
                    assert_eq!(w.force.norm() + w.torque.norm(), 0.0);
                }
            }
        }
    }
    // Measured: 2.3e-14 of the greatest torque; 390 of 400 limited, with 2194 changes cold and 2883 from rows
    // of another state and other feet.
    assert!(most < 1e-12 && bound > 300, "{most} {bound} {changes:?}");
}

#[test]
fn a_cap_unloads_a_foot() {
    let mut rng = random(22);
    let mut most = 0.0_f64;
    for _ in 0..40 {
        let robot = seven(&mut rng);
        let mut at = Play::new(&mut rng, robot, 0.02);
        at.task.linear = LinearTask::CenterOfMass(Vector3::zeros());
        for cap in [200.0, 100.0, 40.0, 0.0] {
            at.task.feet = [f64::INFINITY, cap, f64::INFINITY, f64::INFINITY]
                .map(|most_force| FootTask::Press { most_force });
            let out = at.command(&at.settings);
            // The second foot's normal force. A cap below twice the least force of 4.6 N is that.
            let foot = at.motion.feet[1].rotation.column(2).into_owned();
            let force = (at.motion.central_rotation * out.foot_wrenches[1].force).dot(&foot);
            most = most.max(force - f64::max(cap, 9.2));
            assert!(force > 4.0, "{force}");
        }
    }
    // Measured: 0.018 N, a thousandth of what it costs.
    assert!(most < 0.05, "{most}");
}
