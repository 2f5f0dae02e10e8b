//! The target's computation on the host, with its supervisor, under sensors and motors as robots have them:
//! counted encoders and noise are no faults to it.

use surefoot::balance::{
    Controller, Gains, LeggedRobot, Mode, Reference, RobotState, SafetyLimits, Supervisor,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, SymmetricMatrix3};
use surefoot_sim::closed_loop::firmware::{set_point, settings};
use surefoot_sim::closed_loop::{self, Commanded, ControlFailure, measured};
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::{Scene, Sensing, load};

static ROBOT: LeggedRobot<f32, 2> = LeggedRobot::<f64, 2>::new(&biped::TREE).to_f32();

/// What runs on the target, in the target's precision.
struct Supervised {
    controller: Controller<'static, f32, 2>,
    reference: Reference<f32>,
    supervisor: Supervisor<f32, 2>,
}

impl Supervised {
    fn new(scene: &Scene) -> Self {
        let (settings, pose) = (settings(scene), set_point(scene));
        let [position, velocity, orientation, angular_velocity] =
            settings.gains.map(|[x, y, z]| SymmetricMatrix3::diagonal(x, y, z));
        let mut controller = Controller::new(&ROBOT);
        controller.gains = Gains { position, velocity, orientation, angular_velocity };
        let orientation = Quaternion::from_array(pose.orientation);
        let mut supervisor = Supervisor::new(SafetyLimits::biped(), settings.period);
        supervisor.arm();
        Self {
            controller,
            reference: Reference::at_rest(pose.position.into(), orientation),
            supervisor,
        }
    }
}

impl closed_loop::Controller for Supervised {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let state: RobotState<f32, 2> = measured(state);
        let answer = self.supervisor.step(&self.controller, Some(&state), &self.reference, false);
        if self.supervisor.mode() != Mode::Active
            && let Some(reason) = self.supervisor.reason()
        {
            return Err(ControlFailure::Stopped(reason));
        }
        let wrench = answer.command.expect("a tick's answer").desired_wrench;
        let [left, right] = answer.joint_torques;
        Ok(Commanded {
            torques: std::array::from_fn(|i| f64::from(if i < 6 { left[i] } else { right[i - 6] })),
            desired_wrench: wrench.to_array().map(f64::from),
        })
    }
}

#[test]
fn the_supervisor_takes_counts_and_noise_for_what_they_are() {
    for bits in [12, 14, 16] {
        let mut scene = load("experiment-1").expect("built in");
        scene.sensing = Sensing {
            encoder_counts: 1 << bits,
            gyroscope_noise: 1e-4,
            accelerometer_noise: 1e-3,
            ..Sensing::default()
        };
        scene.acting.delay_s = 1e-3;
        let run = closed_loop::run(&scene, &mut Supervised::new(&scene), &mut |_| {});
        assert_eq!(run.failure, None, "{bits} bits");
        let last = run.samples.last().expect("samples");
        let degrees = last.error_angle().to_degrees();
        println!("{bits} bits: {:.3} mm, {degrees:.4}°", 1e3 * last.error_distance());
        assert!(last.error_distance() < 3e-3 && degrees < 0.3);
    }
}

/// Encoders that are too coarse to tell rates from noise make the loop fail, and it says of what.
#[test]
fn far_too_coarse_encoders_end_in_a_failure_with_its_reason() {
    let mut scene = load("experiment-1").expect("built in");
    scene.sensing.encoder_counts = 64;
    let run = closed_loop::run(&scene, &mut Supervised::new(&scene), &mut |_| {});
    let failure = run.failure.expect("rates in steps of 50 rad/s are none");
    println!("{failure:?}");
    assert!(["target-stopped", "fell", "step"].contains(&failure.kind), "{failure:?}");
    assert!(failure.advice.contains("better sensors"));
}
