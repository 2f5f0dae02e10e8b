//! The biped walks by what inertial sensor, encoders and switches tell it, not knowing floor, load and friction.

use surefoot::balance::StopReason;
use surefoot::estimate::Concern;
use surefoot::spatial::Wrench;
use surefoot_multibody::contact::ContactState;
use surefoot_sim::closed_loop::{self, Run, Scalar, controller, plant};
use surefoot_sim::plant::{Observation, PerPoint, Plant, PlantState, StepFailure};
use surefoot_sim::record::{WorstErrors, center_of_pressure};
use surefoot_sim::scene::{Scene, load};

fn scene(seconds: f64) -> Scene {
    let mut scene = load("walk-estimated").expect("built in");
    scene.duration_s = seconds;
    scene
}

fn play(scene: &Scene) -> Run {
    scene.check().expect("a valid scene");
    closed_loop::run(scene, controller(scene, Scalar::F32).as_mut(), &mut |_| {})
}

/// 8 s with the standard biases, and what is recorded of it. Measured: 0.485 m/s, 61 mm off after 3.4 m, most of it
/// heading.
#[test]
fn it_walks_by_its_own_sensors() {
    let scene = scene(8.0);
    let run = play(&scene);
    assert_eq!(run.failure, None);
    let (gait, errors) = (run.gait.expect("a walk"), WorstErrors::of(&run.samples).expect("one"));
    println!("{gait:?} {errors:?}");
    assert!((gait.speed_m_s - 0.5).abs() < 0.05 && gait.falls == 0);
    assert!(errors.worst.position_error_m < 0.13, "{errors:?}");
    assert!(errors.worst.tilt_error_rad < 1.6_f64.to_radians(), "{errors:?}");
    // Half way from one foot to the other and back the pressure stays under the feet, the capture point near them.
    let robot = scene.robot();
    for sample in run.samples.iter().skip(1) {
        let note = sample.note.as_ref().expect("a tick within limits");
        let [x, y] = note.capture_point.expect("a walk");
        let [px, py] = [sample.positions[0], sample.positions[1]];
        assert!((x - px).hypot(y - py) < 0.6, "{} s", sample.time_s);
        if let Some(pressure) = center_of_pressure(&robot, sample) {
            assert!((pressure.x - px).hypot(pressure.y - py) < 0.6, "{} s", sample.time_s);
        }
        assert!(note.work.is_some_and(|work| work > 0));
    }
}

/// Dry friction of 2 N·m in every joint, of which it makes up for 95 %; with 80 % it falls after 6 s, even by the true state.
#[test]
fn it_walks_with_friction_that_it_knows() {
    let mut scene = scene(5.0);
    scene.plant.every_joint.get_or_insert_default().friction_nm = Some(2.0);
    (scene.controller.friction_share, scene.controller.friction_nm) = (0.95, Some(2.0));
    let run = play(&scene);
    println!("{:?}", run.gait);
    assert_eq!(run.failure, None);
    assert!((run.gait.expect("a walk").speed_m_s - 0.5).abs() < 0.1);
}

/// A plant whose first foot's switch is closed for ever.
struct Stuck(Box<dyn Plant>);

impl Plant for Stuck {
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        self.0.read_state(state)
    }

    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        self.0.step(step_s, torques, load)
    }

    fn read_contacts(&self, contacts: &mut PerPoint<ContactState>) -> bool {
        self.0.read_contacts(contacts)
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let mut seen = self.0.observe()?;
        seen.foot_forces[0] = 1e3;
        Ok(seen)
    }

    fn step_limit(&self) -> Option<f64> {
        self.0.step_limit()
    }

    fn unknowns(&self) -> usize {
        self.0.unknowns()
    }
}

/// It is stopped before it falls: by the switch's disagreement with the plan, or, here, by the doubt that the estimate's
/// jump raises.
#[test]
fn a_switch_that_lies_stops_the_walk() {
    let scene = scene(4.0);
    let mut plant = Stuck(plant(&scene).expect("a plant"));
    let mut controller = controller(&scene, Scalar::F32);
    let run = closed_loop::run_plant(&scene, &mut plant, controller.as_mut(), None, &mut |_| {});
    let stop = run.stop.expect("a stop");
    println!("{} s: {}", stop.time_s, stop.reason);
    assert!(matches!(stop.reason, StopReason::Doubtful | StopReason::Estimate(Concern::Switch(0))));
}
