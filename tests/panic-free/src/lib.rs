//! What the images share: inputs that the optimiser cannot see through, and the panic handler whose
//! presence in a linked image is the finding.
//!
//! The images are linked for the target with link-time optimisation and without unreachable
//! sections. A panicking function, or the handler, that is still there is one which the code under
//! test can call. `cargo xtask test --only panic-free` builds the images and reads their symbols.

#![cfg_attr(target_os = "none", no_std)]

use core::hint::black_box;
use nalgebra::{Matrix3, Vector2, Vector3};
use surefoot::balance::{
    AngularTask, ContactLimits, ContactPatch, Controller, FootLimits, FootTask, Gains, Ground,
    LeggedRobot, LimitMemory, LinearTask, MotionTask, ObservedFoot, ObservedMotion, Reference,
    RobotState, Sole, Supervisor, WholeBody, WholeBodyController, WholeBodyFoot, WholeBodyMemory,
    WholeBodySettings, WholeBodyState, WorkspaceForm, WrenchLimits, limited_tick, observe, tick,
    whole_body_motion_tick, whole_body_tick,
};
use surefoot::disturbance::{
    DisturbanceObserver, DisturbanceSettings, ForceContact, ForceThresholds, friction_compensation,
    seen_friction,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot::walk::{Planner, Side, StandingRobot, Stature, WalkCommand, WalkMemory};

static ROBOT: LeggedRobot<f32, 2> = LeggedRobot::new(&biped::TREE).to_f32();

static TREE: biped::Biped<f32> = biped::TREE_F32;

/// A robot at rest on bent legs that is to stay there.
#[inline(always)]
fn crouching() -> (RobotState<f32, 2>, Reference<f32>) {
    let position = Vector3::new(0.0, 0.0, 1.035);
    let state = RobotState {
        position,
        orientation: Quaternion::identity(),
        velocity: Twist::zero(),
        joint_angles: [[0.0, 0.698, 0.0, -1.352, 0.0, 0.654]; 2],
        joint_rates: [[0.0; 6]; 2],
    };
    (black_box(state), black_box(Reference::at_rest(position, Quaternion::identity())))
}

/// One tick in single precision of a controller of whose robot, gains, form, limits, state and
/// reference the optimiser knows nothing but the types.
#[inline(always)]
pub fn opaque_tick() {
    let sole = Sole { x: [-0.2, 0.05], y: [-0.05, 0.05], z: -0.06 };
    let controller = Controller {
        robot: black_box(&ROBOT),
        gains: black_box(Gains::experiments()),
        form: black_box(WorkspaceForm::BigBase { factor: 1e3 }),
        singularity: black_box(0.01),
        foot_limits: black_box(FootLimits::new(0.0, Some(0.3), Some(sole)).ok()),
    };
    let (state, reference) = crouching();
    let _ = black_box(tick(&controller, &state, &reference));
}

/// Measures of a robot, and two ticks of a walk's plan, from anything.
#[inline(always)]
pub fn opaque_plan() {
    let foot = ObservedFoot {
        position: Vector3::new(0.0, 0.1, 0.0),
        rotation: Matrix3::identity(),
        velocity: Vector3::zeros(),
        angular_velocity: Vector3::zeros(),
        leg: Vector3::new(0.0, 0.0, -0.7),
    };
    let observed = black_box(ObservedMotion {
        center_of_mass: Vector3::new(0.0, 0.0, 0.8),
        velocity: Vector3::zeros(),
        angular_momentum: Vector3::zeros(),
        central_rotation: Matrix3::identity(),
        angular_velocity: Vector3::zeros(),
        feet: [foot; 4],
    });
    let robot = black_box(StandingRobot {
        mass: 70.0_f32,
        gravity: 9.81,
        leg_length: 0.9,
        forward: 0.0,
        sole: Vector2::new(0.1, 0.05),
        pressure_reach: Vector2::new(0.1, 0.05),
    });
    let sides = black_box([Some(Side::Left), Some(Side::Right), None, None]);
    let Ok(stature) = Stature::measured(&robot, &sides, &observed) else { return };
    let planner = black_box(Planner::new(stature));
    let mut memory = black_box(WalkMemory::standing(0.0));
    let command = black_box(WalkCommand::walk(Vector2::new(0.5, 0.0), 0.1));
    for _ in 0..2 {
        memory = black_box(memory);
        let forces = black_box([350.0; 4]);
        let task = planner.plan(&mut memory, &observed, &forces, &command, black_box(2e-3));
        let _ = black_box(task);
    }
}

/// The same within limits, under a supervisor, with a memory of anything.
#[inline(always)]
pub fn opaque_limited_tick() {
    let controller = Controller {
        gains: black_box(Gains::experiments()),
        form: black_box(WorkspaceForm::BigBase { factor: 1e3 }),
        singularity: black_box(0.01),
        ..Controller::new(black_box(&ROBOT))
    };
    let sole = black_box(Sole { x: [-0.2, 0.05], y: [-0.05, 0.05], z: -0.06 });
    let ground = black_box(Ground { least_force: 5.0, greatest_force: 2000.0, friction: 0.24 });
    let torques = black_box([[200.0; 6]; 2]);
    let Ok(limits) = WrenchLimits::new(&ROBOT, &[sole; 2], ground, &torques) else { return };
    let limits = black_box(limits);
    let (state, reference) = crouching();
    let contacts = black_box([true; 2]);
    let rows = black_box([(3_u8, 1.0_f32); 20]);
    let mut memory = black_box(LimitMemory::of(rows));
    let Ok(mut supervisor) = Supervisor::new(black_box(biped::LIMITS.to_f32()), 2e-3) else {
        return;
    };
    supervisor.arm();
    let mut report = None;
    let answer = supervisor.step_with(Some(&state), &reference, false, |now| {
        let answer = limited_tick(&controller, &limits, now, &reference, &contacts, &mut memory)?;
        report = Some(answer.limits);
        Ok(answer.command)
    });
    black_box((answer, report, memory));
}

/// A tick of the whole-body controller, of a robot and a memory of anything.
#[inline(always)]
pub fn opaque_whole_body_tick() {
    with_whole_body(|controller, state, memory| {
        let (_, wanted) = crouching();
        let contacts = black_box([true; 4]);
        let answer = whole_body_tick(controller, state, &wanted, &contacts, memory);
        let _ = black_box((answer, memory));
    });
}

/// The same of one whose feet press or swing, with the motion that it reports.
#[inline(always)]
pub fn opaque_motion_tick() {
    with_whole_body(|controller, state, memory| {
        let Ok(observed) = observe(controller, state) else { return };
        let motion = black_box(observed.motion(controller));
        let swing = FootTask::Swing { linear: Vector3::zeros(), angular: Vector3::zeros() };
        let press = FootTask::Press { most_force: 100.0 };
        let linear =
            LinearTask::CenterOfPressure { point: [0.0; 2], vertical: 0.0, per_length: 12.0 };
        let feet = [press, swing, press, swing];
        let task = black_box(MotionTask {
            linear,
            angular: AngularTask::CentralBody(Vector3::zeros()),
            feet,
        });
        let answer = whole_body_motion_tick(controller, &observed, &task, memory);
        let _ = black_box((motion, answer, memory));
    });
}

/// Plays with a controller, state and memory of anything.
#[inline(always)]
fn with_whole_body(
    play: impl FnOnce(
        &WholeBodyController<'_, f32, 13, 19, 18, 4>,
        &WholeBodyState<f32, 19, 18>,
        &mut WholeBodyMemory<f32>,
    ),
) {
    let patch = black_box(ContactPatch::sole([-0.2, 0.05], [-0.05, 0.05], -0.06));
    let limits = ContactLimits {
        least_force: 5.0,
        greatest_force: 2000.0,
        friction: 0.24,
        patch,
        torques: [],
    };
    let (reference, axes) = (Vector3::zeros(), Quaternion::identity());
    let foot = |body| Some(WholeBodyFoot { body, reference, axes, limits });
    let feet = black_box([foot(biped::FEET[0]), foot(biped::FEET[1]), None, None]);
    let tree = black_box(&TREE);
    let Ok(robot) = WholeBody::new(tree, &feet) else { return };
    let settings = black_box(WholeBodySettings::scaled(1.05, 9.81, 4));
    if settings.check().is_err() {
        return;
    }
    let controller =
        WholeBodyController { tree, robot: black_box(&robot), settings: black_box(&settings) };
    let state = black_box(WholeBodyState { positions: [0.1; 19], velocities: [0.1; 18] });
    let mut memory = black_box(WholeBodyMemory::of([(130_u8, 1.0_f32); 30]));
    play(&controller, &state, &mut memory);
}

/// An observer of disturbances, of a robot and a memory of anything, with a check of contacts and joints whose
/// friction is made up for.
#[inline(always)]
pub fn opaque_observer() {
    let patch = black_box(ContactPatch::sole([-0.2, 0.05], [-0.05, 0.05], -0.06));
    let limits = ContactLimits {
        least_force: 5.0,
        greatest_force: 2000.0,
        friction: 0.24,
        patch,
        torques: [],
    };
    let (reference, axes) = (Vector3::zeros(), Quaternion::identity());
    let foot = |body| Some(WholeBodyFoot { body, reference, axes, limits });
    let feet = black_box([foot(biped::FEET[0]), foot(biped::FEET[1]), None, None]);
    let tree = black_box(&TREE);
    let Ok(robot) = WholeBody::new(tree, &feet) else { return };
    let settings = DisturbanceSettings::scaled(black_box(75.0), 9.81, 1.0, 2e-3, [0.0; 2]);
    let Ok(settings) = settings else { return };
    let Ok(observer) = DisturbanceObserver::new(black_box(settings)) else { return };
    let mut observer = black_box(observer);
    let state = black_box(WholeBodyState { positions: [0.1; 19], velocities: [0.1; 18] });
    let standing = black_box([true; 4]);
    let thresholds = black_box(ForceThresholds::scaled(735.0));
    let mut contact = black_box(ForceContact::new());
    let mut torques = black_box([1.0; 18]);
    for torque in &mut torques {
        *torque += friction_compensation(2.0, 0.8, *torque, 0.1) + seen_friction(2.0, 0.8, *torque);
    }
    let seen = observer.update(tree, black_box(&robot), &state, &torques, &standing);
    if let Ok(Some(seen)) = &seen {
        contact.update(&thresholds, &seen.feet);
    }
    let (_, wanted) = crouching();
    let position = observer.balance.reference(wanted.position, wanted.position);
    let _ = black_box((seen, observer, contact, position));
}

/// Ends an image: there is nothing more to do, and nowhere to return to.
#[cfg(target_os = "none")]
pub fn halt() -> ! {
    loop {
        black_box(());
    }
}

/// On the host there is no image, only a program that says so.
#[cfg(not(target_os = "none"))]
pub fn halt() -> ! {
    println!("This program is an image for the target; `cargo xtask test` builds and reads it.");
    std::process::exit(0)
}

/// Linked only where something can panic. The name is what the check looks for; never inlined, so
/// that the name survives.
#[cfg(target_os = "none")]
#[inline(never)]
fn panic_reached() -> ! {
    halt()
}

#[cfg(target_os = "none")]
#[panic_handler]
fn on_panic(_: &core::panic::PanicInfo) -> ! {
    panic_reached()
}
