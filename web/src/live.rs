//! A closed loop that goes on for as long as somebody looks.

use crate::frame::{Frame, Still};
use crate::request::Request;
use nalgebra::Vector3;
use surefoot::spatial::Wrench;
use surefoot_multibody::contact::ContactState;
use surefoot_sim::closed_loop::{
    Commanded, Controller, Motors, Scalar, Sensors, controller, plant,
};
use surefoot_sim::plant::{PerPoint, Plant, PlantState};
use surefoot_sim::robot::SharedRobot;
use surefoot_sim::scene::{Scene, TorquesFrom};

/// How long a push lasts, s.
const PUSH_S: f64 = 0.1;

/// A robot in its scene, as the command `run` has it: plant, sensors, motors, and the supervised controller in the
/// target's precision.
pub struct Live {
    pub(crate) scene: Scene,
    pub(crate) robot: SharedRobot,
    pub(crate) plant: Box<dyn Plant>,
    pub(crate) controller: Box<dyn Controller>,
    pub(crate) state: PlantState,
    pub(crate) command: Commanded,
    pub(crate) failure: Option<String>,
    sensors: Sensors,
    motors: Motors,
    contacts: PerPoint<ContactState>,
    steps_per_tick: u64,
    steps: u64,
    has_touched: bool,
    push: Option<Push>,
}

/// A force on the central body until a step.
struct Push {
    force_n: [f64; 3],
    until_step: u64,
}

impl Live {
    /// A scene at its beginning.
    ///
    /// # Errors
    /// Why there is no such scene, or no such start.
    pub fn start(request: &Request) -> Result<Self, String> {
        let scene = request.scene()?;
        let (robot, step) = (scene.robot(), scene.integrator.step_s);
        let joints = robot.joint_count();
        let steps_per_tick = (1.0 / (scene.controller.rate_hz * step)).round() as u64;
        let mut plant = plant(&scene).map_err(|failure| failure.to_string())?;
        let state = plant.state().map_err(|failure| failure.to_string())?;
        let controller = controller(&scene, Scalar::F32);
        let tick_s = steps_per_tick as f64 * step;
        let place = (controller.filter_place(), !scene.walk.is_empty());
        Ok(Self {
            sensors: Sensors::of_robot(&scene.sensing, tick_s, &robot, place),
            controller,
            motors: Motors::new(&scene.acting, step, steps_per_tick as usize, joints),
            command: Commanded { torques: vec![0.0; joints], desired_wrench: [0.0; 6] },
            contacts: PerPoint::new(),
            has_touched: scene.controller.torques_from == TorquesFrom::Start,
            failure: None,
            push: None,
            steps: 0,
            plant,
            state,
            robot,
            steps_per_tick,
            scene,
        })
    }

    /// Simulated time, s.
    pub fn time_s(&self) -> f64 {
        self.steps as f64 * self.scene.integrator.step_s
    }

    /// Pushes the central body for 0.1 s from now on: N·s along the world's axes.
    pub fn push(&mut self, impulse: [f64; 3]) {
        let steps = (PUSH_S / self.scene.integrator.step_s).round().max(1.0) as u64;
        let force_n = impulse.map(|component| component / PUSH_S);
        if force_n.iter().all(|force| force.is_finite()) {
            self.push = Some(Push { force_n, until_step: self.steps + steps });
        }
    }

    /// What pushes now, N.
    pub(crate) fn pushing(&self) -> Option<[f64; 3]> {
        self.push.as_ref().filter(|push| self.steps < push.until_step).map(|push| push.force_n)
    }

    /// Goes on by whole ticks, for so long or a little less; not after a failure.
    pub fn advance(&mut self, seconds: f64) {
        let tick_s = self.steps_per_tick as f64 * self.scene.integrator.step_s;
        // A frame of a hundredth of a tick less is none less.
        let ticks = (seconds / tick_s + 0.01).floor() as u64;
        for _ in 0..ticks {
            if self.failure.is_none()
                && let Err(failure) = self.tick()
            {
                self.failure = Some(failure);
            }
        }
    }

    /// One tick, and the steps until the next.
    fn tick(&mut self) -> Result<(), String> {
        let time_s = self.time_s();
        if self.steps > 0 && self.plant.read_contacts(&mut self.contacts) {
            let down = |foot: &Vec<ContactState>| foot.iter().any(|s| *s != ContactState::Free);
            let feet: Vec<bool> = self.contacts.iter().map(down).collect();
            self.has_touched |= feet.contains(&true);
            self.controller.touch(time_s, &feet);
        }
        let seen = self.plant.observe().map_err(|failure| failure.to_string())?;
        if self.sensors.is_estimating() {
            let (forces, planned) = (seen.foot_forces.iter().copied(), self.controller.planned());
            let switched = self.sensors.see_feet(forces, planned);
            self.controller.press(time_s, &switched);
            if let Some(force) = self.controller.support() {
                self.sensors.see_feet_force(force.into());
            }
        } else {
            self.controller.press(time_s, &seen.foot_forces);
        }
        self.sensors.read(&self.state);
        if let Some((readings, start)) = self.sensors.readings() {
            self.controller.sense(readings, start);
        }
        if self.has_touched {
            let command = self.controller.tick(self.sensors.seen());
            self.command = command.map_err(|failure| failure.to_string())?;
        }
        if let Some(fault) = self.sensors.fault() {
            return Err(fault.to_string());
        }
        self.motors.command(&self.command.torques, time_s);
        for number in 0..self.steps_per_tick as usize {
            let force = self.pushing().map(Vector3::from);
            let load = force.map(|force| Wrench { force, torque: Vector3::zeros() });
            self.plant
                .step(self.scene.integrator.step_s, self.motors.over_step(number), load)
                .map_err(|failure| failure.to_string())?;
            self.motors.advance(number);
            self.steps += 1;
        }
        self.plant.read_state(&mut self.state).map_err(|failure| failure.to_string())?;
        if self.state.positions[2] < self.robot.fallen_height {
            return Err("the robot has fallen".to_owned());
        }
        Ok(())
    }

    /// What stands still.
    pub fn still(&self) -> Still {
        Still::of(self)
    }

    /// What moves, as it is now.
    ///
    /// # Errors
    /// Where the state is no configuration any more.
    pub fn frame(&mut self) -> Result<Frame, String> {
        Frame::of(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use surefoot_sim::closed_loop::run;

    fn live(json: &str) -> Live {
        Live::start(&Request::read(json.as_bytes()).expect("JSON")).expect("a scene")
    }

    /// The page shows what `run` runs: equal bits after a second, of a robot that stands and of one that walks.
    #[test]
    fn the_page_has_the_bits_of_the_command() {
        for name in ["stand", "walk", "experiment-2"] {
            let mut live = live(&format!(r#"{{"scene": "{name}"}}"#));
            for _ in 0..60 {
                live.advance(1.0 / 60.0);
            }
            live.advance(1.0 - live.time_s());
            let mut scene = live.scene.clone();
            scene.duration_s = live.time_s();
            let run = run(&scene, controller(&scene, Scalar::F32).as_mut(), &mut |_| {});
            let last = run.samples.last().expect("a sample");
            assert_eq!(last.time_s, live.time_s(), "{name}");
            assert_eq!(last.positions, live.state.positions, "{name}");
            assert_eq!(last.velocities, live.state.velocities, "{name}");
        }
    }

    /// 20 N·s to the side are survived, 200 are not; the page is told.
    #[test]
    fn a_push_moves_it_and_a_large_one_fells_it() {
        for (impulse, falls) in [(20.0, false), (200.0, true)] {
            let mut live = live(r#"{"scene": "stand"}"#);
            live.advance(0.1);
            live.push([0.0, impulse, 0.0]);
            let frame = live.frame().expect("a configuration");
            assert_eq!(frame.push, Some([0.0, 10.0 * impulse, 0.0]));
            for _ in 0..30 {
                live.advance(0.1);
            }
            let frame = live.frame().expect("a configuration");
            assert_eq!(frame.stopped.is_some() || frame.failure.is_some(), falls, "{impulse}");
        }
    }
}
