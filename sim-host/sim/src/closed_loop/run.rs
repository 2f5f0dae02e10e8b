//! One run of a scene.

use super::cause::{Cause, step_failure, with_hardware};
use super::controller::FAULT_ADVICE;
use super::errors::set_point_errors;
use super::events::Watch;
use super::memory::{memory, remember};
use super::plant::plant;
use super::{
    Commanded, ControlFailure, Controller, Costs, CutTorques, EstimateTally, Failure, Gait,
    LimitTally, Motors, Outcome, Sensors,
};
use crate::follow::Follow;
use crate::plant::{Observation, PerPoint, Plant, PlantState};
use crate::record::{Event, MotionIdentity, Sample, SavedMotion, SavedRun};
use crate::robot::{LEG, Robot};
use crate::scene::{Feet, Scene, TorquesFrom};
use nalgebra::Vector3;
use std::time::{Duration, Instant};
use surefoot::balance::StopReason;
use surefoot::estimate::EstimateFault;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::Progress;
use surefoot_multibody::SystemError;
use surefoot_multibody::contact::ContactState;

/// What a run gives.
#[derive(Clone, Debug)]
pub struct Run {
    /// How it ended.
    pub outcome: Outcome,
    /// Whether it was ended before its time, by whoever followed it.
    pub is_interrupted: bool,
    /// Why, if it failed.
    pub failure: Option<Failure>,
    /// What is known of that.
    pub cause: Option<Cause>,
    /// One sample a tick, and one at the end.
    pub samples: Vec<Sample>,
    /// What happened at the feet.
    pub events: Vec<Event>,
    /// Steps made.
    pub steps: u64,
    /// Largest violation of a constraint at any sample, m or rad.
    pub constraint_max: f64,
    /// Time spent computing.
    pub wall: Duration,
    /// What the solver of implicit steps has done, if the plant has one.
    pub progress: Option<Progress>,
    /// Where it stopped, if it can be taken up again.
    pub saved: Option<SavedRun>,
    /// What the controller's ticks have cost, where it ran on a target.
    pub costs: Option<Costs>,
    /// What limits of ground and motors have done, where the controller knows them.
    pub limits: Option<LimitTally>,
    /// How it walked, if it walked.
    pub gait: Option<Gait>,
    /// What the state estimator has said, where there is one.
    pub estimate: Option<EstimateTally>,
    /// What the motors could not give.
    pub cut_torques: CutTorques,
    /// That the controller's supervisor has stopped the robot.
    pub stop: Option<Stop>,
}

/// A stop by the supervisor. The run goes on: motors brake, until the robot lies or the time is over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// When, s.
    pub time_s: f64,
    /// Why.
    pub reason: StopReason,
}

/// A central body tilted this far (cosine of 60°) has fallen.
const FALLEN_UPRIGHT: f64 = 0.5;

/// Runs a scene to its end, until it fails, or until `follow`, which hears of the simulated time now and then, ends it.
pub fn run(scene: &Scene, controller: &mut dyn Controller, follow: &mut dyn Follow) -> Run {
    run_from(scene, controller, None, follow)
}

/// The same from where a run has stopped, if one is given: to the same bits as if it had gone on.
pub fn run_from(
    scene: &Scene,
    controller: &mut dyn Controller,
    from: Option<&SavedRun>,
    follow: &mut dyn Follow,
) -> Run {
    match plant(scene) {
        Ok(mut plant) => run_plant(scene, plant.as_mut(), controller, from, follow),
        Err(failure) => ended(Run::new(), Err(step_failure(0.0, failure))),
    }
}

/// The same with a plant of one's own, where its motion begins.
pub fn run_plant(
    scene: &Scene,
    plant: &mut dyn Plant,
    controller: &mut dyn Controller,
    from: Option<&SavedRun>,
    follow: &mut dyn Follow,
) -> Run {
    let started = Instant::now();
    let mut run = Run::new();
    let result = advance(scene, plant, controller, (from, follow), &mut run);
    // Whatever came of it later.
    let result = run.stop.map_or(result, |stop| Err(stopped(stop, &scene.robot())));
    run.progress = plant.progress().copied();
    run = ended(run, result);
    if let Some(failure) = &mut run.failure {
        let cause = Cause::of_record(&run.samples, &scene.robot());
        if failure.kind == "step" && cause != Cause::default() {
            failure.advice = cause.advice();
        }
        with_hardware(failure, scene);
        run.cause = Some(cause);
    }
    run.wall = started.elapsed();
    run.costs = controller.costs();
    run.limits = controller.limits();
    run.gait = controller.gait().map(|tally| Gait::of(&tally, &run, &scene.robot()));
    run
}

impl Run {
    /// Before it has begun.
    fn new() -> Self {
        Self {
            outcome: Outcome::Completed,
            is_interrupted: false,
            failure: None,
            cause: None,
            samples: Vec::new(),
            events: Vec::new(),
            steps: 0,
            constraint_max: 0.0,
            wall: Duration::ZERO,
            progress: None,
            saved: None,
            costs: None,
            limits: None,
            gait: None,
            estimate: None,
            cut_torques: CutTorques::default(),
            stop: None,
        }
    }
}

/// With the way that it ended.
fn ended(mut run: Run, result: Result<(), Failure>) -> Run {
    if let Err(failure) = result {
        run.outcome = match failure.kind {
            "stopped" => Outcome::Stopped,
            "fell" => Outcome::Fell,
            _ => Outcome::Failed,
        };
        run.failure = Some(failure);
    } else if run.is_interrupted {
        run.outcome = Outcome::Interrupted;
    } else if let Some(last) = run.samples.last() {
        let arrived = last.error_distance() < 1e-3 && last.error_angle() < 0.1_f64.to_radians();
        run.outcome = if arrived { Outcome::Balanced } else { Outcome::Completed };
    }
    run
}

fn advance(
    scene: &Scene,
    plant: &mut dyn Plant,
    controller: &mut dyn Controller,
    (from, follow): (Option<&SavedRun>, &mut dyn Follow),
    run: &mut Run,
) -> Result<(), Failure> {
    let step = scene.integrator.step_s;
    // The scene's check has made sure that this is a whole number, at least 1.
    let steps_per_tick = (1.0 / (scene.controller.rate_hz * step)).round() as u64;
    let ticks = (scene.duration_s * scene.controller.rate_hz).round().max(1.0) as u64;
    let robot = scene.robot();
    let joints = robot.joint_count();
    let mut watch = Watch::new(robot.clone());
    let (mut state, mut contacts) = (PlantState::home(joints), PerPoint::new());
    let mut feet = Vec::with_capacity(robot.leg_count());
    let mut touched = scene.controller.torques_from == TorquesFrom::Start;
    let mut sensors = Sensors::of_robot(
        &scene.sensing,
        steps_per_tick as f64 * step,
        &robot,
        (controller.filter_place(), !scene.walk.is_empty()),
    );
    let mut motors = Motors::new(&scene.acting, step, steps_per_tick as usize, joints);
    let (mut first, mut noted) = (0, 0);
    if let Some(saved) = from {
        if sensors.is_estimating() {
            return Err(not_resumed());
        }
        let SavedRun { torques_on, checkpoint, hardware, supervisor, motion, .. } = saved;
        if let Some(difference) = motion.difference(&MotionIdentity::of_robot(scene)) {
            return Err(other_motion(&difference));
        }
        let SavedMotion::Tree(checkpoint) = checkpoint else {
            return Err(step_failure(0.0, SystemError::OtherCheckpoint.into()));
        };
        plant.restore(checkpoint).map_err(|failure| step_failure(0.0, failure))?;
        let made = plant.progress().map_or(0, |progress| progress.steps);
        if !made.is_multiple_of(steps_per_tick) {
            return Err(not_at_a_tick(made as f64 * step));
        }
        touched |= torques_on;
        first = made / steps_per_tick;
        if !remember(scene, hardware.as_ref(), first, &mut sensors, &mut motors) {
            return Err(other_hardware(made as f64 * step));
        }
        // A run saved under another controller goes on as if this one were armed now.
        if let Some(memory) = supervisor {
            controller.remember(memory);
        }
        controller.resume_limits(&saved.limit_rows);
        if !controller.resume_observed(&saved.observer) {
            return Err(other_hardware(made as f64 * step));
        }
        if plant.read_contacts(&mut contacts) {
            watch.begin_with(&contacts);
        }
        watch.look_at_block(0.0, plant.is_struck(), &mut Vec::new());
    }
    for tick in first..=ticks {
        let time = (tick * steps_per_tick) as f64 * step;
        touched |= watch.touched();
        plant.read_state(&mut state).map_err(|failure| step_failure(time, failure))?;
        // A run that is taken up again begins with this tick.
        let is_interrupted = tick % 25 == 0 && tick < ticks && follow.reached(time).is_break();
        let is_last = tick == ticks || is_interrupted;
        let memory = is_last.then(|| memory(scene, &sensors, &motors)).flatten();
        let supervisor = is_last.then(|| controller.memory()).flatten();
        let observer = if is_last { controller.observed() } else { Vec::new() };
        // Before its first step a plant knows of no contact.
        if tick > 0 && plant.read_contacts(&mut contacts) {
            feet.clear();
            feet.extend(contacts.iter().map(|foot| foot.iter().any(|s| *s != ContactState::Free)));
            controller.touch(time, &feet);
        }
        let seen = plant.observe().map_err(|failure| step_failure(time, failure))?;
        if sensors.is_estimating() {
            let held = matches!(scene.feet, Feet::Welded {}).then_some(f64::INFINITY);
            let forces = seen.foot_forces.iter().map(|force| held.unwrap_or(*force));
            let switched = sensors.see_feet(forces, controller.planned());
            controller.press(time, &switched);
            if let Some(force) = controller.support() {
                sensors.see_feet_force(force.into());
            }
        } else {
            controller.press(time, &seen.foot_forces);
        }
        sensors.read(&state);
        if let Some((readings, start)) = sensors.readings() {
            controller.sense(readings, start);
        }
        if let Some(concern) = sensors.distrusted() {
            controller.stop(StopReason::Estimate(concern));
        }
        let command = command(sensors.seen(), controller, touched, time)?;
        if let Some(filtered) = controller.filtered() {
            sensors.note(&filtered);
        }
        run.estimate = sensors.tally().cloned();
        if let Some(fault) = sensors.fault() {
            return Err(estimator_failed(time, fault));
        }
        if run.stop.is_none() {
            run.stop = controller.stopped().map(|reason| Stop { time_s: time, reason });
        }
        motors.command(&command.torques, time);
        run.cut_torques = motors.cut();
        let sent = (&command.desired_wrench, motors.over_step(0));
        sample(seen, scene, &state, sent, time, run);
        if let Some(last) = run.samples.last_mut() {
            last.estimate = sensors.is_estimating().then(|| central(sensors.seen()));
            let tally = controller.limits().filter(|tally| tally.ticks > noted);
            last.note = tally.map(|tally| {
                noted = tally.ticks;
                tally.last
            });
        }
        fallen(&state, robot.fallen_height, time)?;
        if is_last {
            run.is_interrupted = is_interrupted;
            // What a walk and an estimator remember is not saved.
            let is_saved = scene.walk.is_empty() && !sensors.is_estimating();
            let checkpoint = plant.checkpoint().filter(|_| is_saved);
            run.saved = checkpoint.map(|checkpoint| SavedRun {
                scene: scene.name.clone(),
                motion: MotionIdentity::of_robot(scene),
                scalar: None,
                time_s: time,
                torques_on: touched,
                checkpoint: SavedMotion::Tree(checkpoint.clone()),
                hardware: memory,
                supervisor,
                limit_rows: controller.limit_rows(),
                observer,
            });
            break;
        }
        for number in 0..steps_per_tick as usize {
            let begun = (first * steps_per_tick + run.steps) as f64 * step;
            let end = (first * steps_per_tick + run.steps + 1) as f64 * step;
            plant
                .step(step, motors.over_step(number), scene.push(begun, end))
                .map_err(|failure| step_failure(time, failure))?;
            motors.advance(number);
            run.steps += 1;
            let made = (first * steps_per_tick + run.steps) as f64 * step;
            if plant.read_contacts(&mut contacts) {
                watch.look(made, &contacts, &mut run.events);
            }
            watch.look_at_block(made, plant.is_struck(), &mut run.events);
        }
    }
    Ok(())
}

/// The torques of this tick; zero before the first touch-down, if the scene says so.
fn command(
    measured: &PlantState,
    controller: &mut dyn Controller,
    active: bool,
    time: f64,
) -> Result<Commanded, Failure> {
    let failed = |failure: ControlFailure| Failure {
        kind: failure.kind(),
        time_s: time,
        place: failure.to_string(),
        advice: failure.advice().into(),
    };
    if !active {
        controller.wait(measured).map_err(failed)?;
        return Ok(Commanded { torques: vec![0.0; measured.joints()], desired_wrench: [0.0; 6] });
    }
    controller.tick(measured).map_err(failed)
}

fn sample(
    seen: Observation,
    scene: &Scene,
    state: &PlantState,
    (desired_wrench, torques): (&[f64; 6], &[f64]),
    time_s: f64,
    run: &mut Run,
) {
    let (position_error, orientation_error) = set_point_errors(state, &scene.set_point);
    run.constraint_max = run.constraint_max.max(seen.constraint);
    run.samples.push(Sample {
        time_s,
        positions: state.positions.clone(),
        velocities: state.velocities.clone(),
        torques: torques.to_vec(),
        desired_wrench: *desired_wrench,
        position_error,
        orientation_error,
        foot_forces: seen.foot_forces,
        contacts: seen.contacts,
        energy: [seen.kinetic_energy, seen.potential_energy],
        corner_forces: seen.corner_forces,
        block: seen.block,
        estimate: None,
        note: None,
    });
}

fn fallen(state: &PlantState, lowest: f64, time: f64) -> Result<(), Failure> {
    let p = &state.positions;
    let up = Quaternion::from_array([p[3], p[4], p[5], p[6]]).rotate(Vector3::z()).z;
    let what = if p[2] < lowest {
        format!("the central body is at {:.2} m, below {lowest} m", p[2])
    } else if up < FALLEN_UPRIGHT {
        format!("the central body is tilted by {:.0}°", up.acos().to_degrees())
    } else {
        return Ok(());
    };
    Err(Failure {
        kind: "fell",
        time_s: time,
        place: what,
        advice: "see the record: which foot slips, tips or leaves the floor first".into(),
    })
}

/// What a stop says of a run.
fn stopped(Stop { time_s, reason }: Stop, robot: &Robot) -> Failure {
    let advice = match reason {
        StopReason::Tick(_) => FAULT_ADVICE,
        StopReason::Saturated { .. } => {
            "a smaller disturbance, a set point nearer by, or stronger motors"
        }
        StopReason::Tilt | StopReason::Height | StopReason::FreeFall => {
            "see the record: which foot slips, tips or leaves the floor first"
        }
        StopReason::Estimate(_) => {
            "a start at rest and upright, sensors as they are said to be, feet that hold and switches that agree"
        }
        _ => "see the measurements before; the limits are those of the robot's description",
    };
    let mut place = format!("the supervisor stopped the robot: {reason}");
    if let (false, Some((row, joint))) = (robot.tree.is_six_jointed(), joint_of(reason))
        && let Some(name) = robot.joints.get(LEG * row + joint)
    {
        // Its supervisor has joints in rows of six, which are no legs.
        place = place.replace(&format!("leg {row}'s joint {joint}"), name);
    }
    Failure { kind: "stopped", time_s, place, advice: advice.into() }
}

/// The joint that a reason is about.
fn joint_of(reason: StopReason) -> Option<(usize, usize)> {
    match reason {
        StopReason::Encoder { leg, joint }
        | StopReason::Frozen { leg, joint }
        | StopReason::Jump { leg, joint }
        | StopReason::Saturated { leg, joint } => Some((leg, joint)),
        _ => None,
    }
}

fn other_motion(difference: &str) -> Failure {
    Failure {
        kind: "resume",
        time_s: 0.0,
        place: format!("the saved run is of another motion: {difference}"),
        advice: "the scene that the run was saved with".into(),
    }
}

/// Position, quaternion and body twist of the central body.
fn central(state: &PlantState) -> [f64; 13] {
    let numbers = state.positions[..7].iter().chain(&state.velocities[..6]);
    let mut all = [0.0; 13];
    all.iter_mut().zip(numbers).for_each(|(to, x)| *to = *x);
    all
}

fn estimator_failed(time_s: f64, fault: EstimateFault) -> Failure {
    Failure {
        kind: "estimator",
        time_s,
        place: format!("the state estimator: {fault}"),
        advice: "sensors whose errors are smaller, or a start at rest".into(),
    }
}

fn not_resumed() -> Failure {
    Failure {
        kind: "resume",
        time_s: 0.0,
        place: "a run with `sensing.state = \"estimate\"` cannot go on from a saved one".into(),
        advice: "the whole run from its start".into(),
    }
}

fn not_at_a_tick(time_s: f64) -> Failure {
    Failure {
        kind: "resume",
        time_s,
        place: "the saved run stopped between two ticks of this scene's controller".into(),
        advice: "the control rate that the run was saved with".into(),
    }
}

fn other_hardware(time_s: f64) -> Failure {
    Failure {
        kind: "resume",
        time_s,
        place: "the saved run had other sensors, another delay or another observer than this scene"
            .into(),
        advice: "the tables `sensing`, `acting` and `controller` that the run was saved with"
            .into(),
    }
}
