//! Host and target compute the same bits.

use crate::bench::target;
use surefoot::balance::{Controller, LeggedRobot, Reference, RobotState, SafetyLimits, Supervisor};
use surefoot::model::robots::biped;
use surefoot::spatial::Quaternion;
use surefoot_link::Torques;
use surefoot_sim::closed_loop::firmware::{FirmwareController, set_point, settings};
use surefoot_sim::closed_loop::{self, Commanded, ControlFailure, measured};
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::load;

static ROBOT: LeggedRobot<f32, 2> = LeggedRobot::<f64, 2>::new(&biped::TREE).to_f32();

/// The target in the loop, and the host's controller beside it on the same measurements.
struct Twins {
    target: FirmwareController,
    controller: Controller<'static, f32, 2>,
    reference: Reference<f32>,
    supervisor: Supervisor<f32, 2>,
    compared: usize,
}

impl closed_loop::Controller for Twins {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let answer = self.target.tick(state)?;
        let state: RobotState<f32, 2> = measured(state);
        let host = self.supervisor.step(&self.controller, Some(&state), &self.reference, false);
        for (host, target) in host.joint_torques.iter().flatten().zip(answer.torques) {
            assert_eq!(host.to_bits(), (target as f32).to_bits(), "tick {}", self.compared / 12);
            self.compared += 1;
        }
        let wrench = host.command.expect("a tick's answer").desired_wrench.to_array();
        assert_eq!(wrench.map(f64::from), answer.desired_wrench);
        Ok(answer)
    }
}

/// Torques and desired wrenches are equal, bit for bit, at every tick; and the costs are bounded.
fn plays_equally(name: &str) {
    let scene = load(name).expect("built in");
    let target = FirmwareController::new(target(), &scene).expect("obeyed");
    let pose = set_point(&scene);
    let mut controller = Controller::new(&ROBOT);
    controller.gains = gains(&settings(&scene).gains);
    let mut twins = Twins {
        target,
        controller,
        reference: Reference::at_rest(
            pose.position.into(),
            Quaternion::from_array(pose.orientation),
        ),
        supervisor: Supervisor::new(SafetyLimits::biped(), settings(&scene).period),
        compared: 0,
    };
    twins.supervisor.arm();
    let run = closed_loop::run(&scene, &mut twins, &mut |_| {});
    assert_eq!(run.failure, None);
    assert_eq!(run.outcome, closed_loop::Outcome::Balanced);
    let ticks = (scene.duration_s * scene.controller.rate_hz) as usize + 1;
    assert_eq!(twins.compared, 12 * ticks);

    // The first tick also takes the order to arm, and has no measurement before.
    let costs = &twins.target.tick_costs()[1..];
    let (least, most) = (costs.iter().min().expect("ticks"), costs.iter().max().expect("ticks"));
    let mean = costs.iter().map(|c| f64::from(*c)).sum::<f64>() / costs.len() as f64;
    println!("{name}: {least} to {most} instructions a tick, {mean:.1} on average");
    assert!(f64::from(*most) <= 1.02 * mean, "{most} is above 1.02 · {mean}");
    assert!(*most <= 40_000);
    let status = twins.target.target().status().expect("an answer");
    println!("{name}: stack {} bytes", status.stack_bytes);
    assert!(status.stack_bytes <= 8192);
    assert_eq!((status.overruns, status.telemetry_dropped, status.received.lost), (0, 0, 0));
}

fn gains(diagonals: &[[f32; 3]; 4]) -> surefoot::balance::Gains<f32> {
    let [position, velocity, orientation, angular_velocity] =
        diagonals.map(|[x, y, z]| surefoot::spatial::SymmetricMatrix3::diagonal(x, y, z));
    surefoot::balance::Gains { position, velocity, orientation, angular_velocity }
}

#[test]
fn experiment_1_is_the_same_to_the_last_bit() {
    plays_equally("experiment-1");
}

#[test]
fn experiment_2_is_the_same_to_the_last_bit() {
    plays_equally("experiment-2");
}

#[test]
fn twenty_seconds_of_pushes_are_the_same_to_the_last_bit() {
    plays_equally("experiment-1-pushes");
}

/// The emulator's instruction clock repeats.
#[test]
fn a_second_run_costs_the_same() {
    let run = || -> Vec<Torques> {
        let mut bench = crate::bench::Bench::new(target());
        (0..200).map(|_| bench.tick(|_| {})).collect()
    };
    assert_eq!(run(), run());
}
