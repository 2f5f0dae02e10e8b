//! What a tick takes on the emulated target, as one JSON document: `budget TRACE`.
//!
//! `cargo xtask budget` runs it. `TRACE` is where QEMU writes down every instruction of some ticks.

use serde_json::{Value, json};
use std::error::Error;
use std::path::Path;
use surefoot::balance::Mode;
use surefoot_link::{Sensors, Stages, ToTarget};
use surefoot_sim::closed_loop;
use surefoot_sim::closed_loop::firmware::{
    Emulator, FirmwareController, LinkError, image_for, sensors, set_point, settings,
};
use surefoot_sim::scene::{Disturbance, Push, Scene, StateSource, load};

/// Of the robot of the text.
const JOINTS: usize = 12;
type Target = surefoot_sim::closed_loop::firmware::Target<JOINTS>;

/// Ticks that are traced, after the first, which also takes orders.
const TRACED: usize = 2;

fn main() -> Result<(), Box<dyn Error>> {
    let trace = std::env::args().nth(1).ok_or("budget TRACE")?;
    let scenes = ["experiment-1", "experiment-1-pushes"];
    let mut costs = Vec::new();
    let mut stack = 0;
    for name in scenes {
        eprintln!("  {name} with the controller on the target");
        let scene = load(name)?;
        let mut controller = FirmwareController::new(target(&scene, &[])?, &scene)?;
        let run = closed_loop::run(&scene, &mut controller, &mut |_| {});
        if let Some(failure) = run.failure {
            return Err(format!("{name} failed: {}", failure.place).into());
        }
        // The first tick takes the order to arm, too.
        costs.extend_from_slice(&controller.tick_costs()[1..]);
        stack = stack.max(controller.target().status()?.stack_bytes);
    }
    let limited = limited(&mut stack)?;
    let sensing = sensing()?;
    let walk = walk()?;
    let scene = load(scenes[0])?;
    let stages = profile(&scene)?;
    eprintln!("  every instruction of {TRACED} ticks");
    traced(&scene, &trace)?;
    let mut document = document(&costs, &limited, stack, &stages);
    document["sensing"] = sensing;
    document["walk"] = walk;
    println!("{document:#}");
    Ok(())
}

fn target(scene: &Scene, arguments: &[&str]) -> Result<Target, LinkError> {
    Target::connect(Emulator::start_with(&image_for(scene)?, &std::env::temp_dir(), arguments)?)
}

fn start(scene: &Scene) -> Sensors<JOINTS> {
    sensors(&scene.initial.state())
}

/// Both forms of workspace dynamics, stage by stage.
fn profile(scene: &Scene) -> Result<[Stages; 2], LinkError> {
    let mut target = target(scene, &[])?;
    let mut both = [Stages::default(); 2];
    for (stages, big_base) in both.iter_mut().zip([None, Some(1e3)]) {
        let mut settings = settings(scene);
        settings.big_base = big_base;
        target.order("configure", &ToTarget::Configure(settings))?;
        target.order("set point", &ToTarget::SetPoint(set_point(scene)))?;
        *stages = target.profile(&start(scene))?;
    }
    Ok(both)
}

fn traced(scene: &Scene, trace: &str) -> Result<(), Box<dyn Error>> {
    let arguments = ["-singlestep", "-d", "in_asm,exec,nochain", "-D", trace];
    let mut target = target(scene, &arguments)?;
    target.order("configure", &ToTarget::Configure(settings(scene)))?;
    target.order("set point", &ToTarget::SetPoint(set_point(scene)))?;
    target.order("arm", &ToTarget::Arm(scene.robot().id().expect("legs of six joints")))?;
    let mut sensors = start(scene);
    // At rest, so that the same measurement will do again.
    sensors.joint_rates = [0.0; JOINTS].into();
    for _ in 0..=TRACED {
        let torques = target.tick(&sensors)?;
        if torques.mode != Mode::Active {
            return Err("the traced tick is not active".into());
        }
    }
    Ok(())
}

/// Pushes of 0.1 s that it survives: impulse, N·s, and direction, from backwards over its right side to forwards.
const PUSHES: [(f64, f64); 5] =
    [(25.0, 0.0), (35.0, 45.0), (35.0, 90.0), (25.0, 135.0), (18.0, 180.0)];

/// Costs of ticks within limits of ground and motors: those in which none bound, and those in which some did.
fn limited(stack: &mut u32) -> Result<[Vec<u32>; 2], Box<dyn Error>> {
    let mut costs = [Vec::new(), Vec::new()];
    for (impulse, degrees) in PUSHES {
        eprintln!(
            "  stand, pushed by {impulse} N·s at {degrees}°, with the controller on the target"
        );
        let mut scene = load("stand")?;
        let (sine, cosine) = f64::to_radians(degrees).sin_cos();
        let force = impulse / 0.1;
        let force_n = [force * cosine, force * sine, 0.0];
        scene.pushes = vec![Push { at_s: 0.7, duration_s: 0.1, force_n }];
        let mut controller = FirmwareController::new(target(&scene, &[])?, &scene)?;
        let run = closed_loop::run(&scene, &mut controller, &mut |_| {});
        if let Some(failure) = run.failure {
            return Err(format!("{impulse} N·s at {degrees}°: {}", failure.place).into());
        }
        let ticks = controller.tick_costs().iter().zip(controller.limited_ticks());
        for (cost, is_limited) in ticks.skip(1) {
            costs[usize::from(*is_limited)].push(*cost);
        }
        *stack = (*stack).max(controller.target().status()?.stack_bytes);
    }
    Ok(costs)
}

/// Costs of a scene's ticks, the first left out.
struct Played {
    all: Vec<u32>,
    /// Of those in which no limit bound.
    free: Vec<u32>,
    /// Of the image, bytes.
    stack: u32,
}

/// Plays a scene on an image.
fn played(scene: &Scene, image: &Path) -> Result<Played, Box<dyn Error>> {
    let emulator = Emulator::start_with(image, &std::env::temp_dir(), &[])?;
    let mut controller = FirmwareController::<JOINTS>::new(Target::connect(emulator)?, scene)?;
    let run = closed_loop::run(scene, &mut controller, &mut |_| {});
    if let Some(failure) = run.failure {
        return Err(format!("{} failed: {}", scene.name, failure.place).into());
    }
    let all = controller.tick_costs()[1..].to_vec();
    let ticks = all.iter().zip(&controller.limited_ticks()[1..]);
    let free = ticks.filter(|(_, is_limited)| !**is_limited).map(|(cost, _)| *cost).collect();
    Ok(Played { all, free, stack: controller.target().status()?.stack_bytes })
}

fn mean(costs: &[u32]) -> f64 {
    costs.iter().map(|cost| f64::from(*cost)).sum::<f64>() / costs.len().max(1) as f64
}

/// What filter and observer take of a tick: `stand-loaded` without its load for 1 s, within limits of which none
/// binds, with and without each; and both together with the load.
fn sensing() -> Result<Value, Box<dyn Error>> {
    let loaded = load("stand-loaded")?;
    let image = image_for(&loaded)?;
    let scene = |state, disturbance| {
        let mut scene = Scene { duration_s: 1.0, ..loaded.clone() };
        scene.plant = load("stand")?.plant;
        scene.sensing.state = state;
        scene.controller.disturbance = disturbance;
        Ok::<_, Box<dyn Error>>(scene)
    };
    let free = |state, disturbance| {
        eprintln!("  stand, state {state:?}, disturbances {disturbance:?}, on the target");
        let Played { free, .. } = played(&scene(state, disturbance)?, &image)?;
        // From half a second on all have come to rest.
        Ok::<_, Box<dyn Error>>(mean(&free[free.len() / 2..]))
    };
    let plain = free(StateSource::Truth, Disturbance::Ignored)?;
    let filter = free(StateSource::Estimate, Disturbance::Ignored)? - plain;
    let observer = free(StateSource::Truth, Disturbance::Observed)? - plain;
    eprintln!("  stand-loaded with filter and observer on the target");
    let Played { all, stack, .. } = played(&Scene { duration_s: 4.0, ..loaded }, &image)?;
    Ok(json!({
        "filter": filter, "observer": observer, "tick": spread(&all), "stack_bytes": stack,
    }))
}

/// Ticks of a walk, by planner and whole-body controller.
fn walk() -> Result<Value, Box<dyn Error>> {
    let scene = load("walk")?;
    eprintln!("  walk with planner and controller on the target");
    let Played { all, stack, .. } = played(&scene, &image_for(&scene)?)?;
    Ok(json!({ "tick": spread(&all), "stack_bytes": stack }))
}

fn spread(costs: &[u32]) -> Value {
    let min = costs.iter().min().copied().unwrap_or(0);
    let max = costs.iter().max().copied().unwrap_or(0);
    let mean = costs.iter().map(|c| f64::from(*c)).sum::<f64>() / costs.len().max(1) as f64;
    json!({ "min": min, "mean": mean, "max": max })
}

fn document(costs: &[u32], limited: &[Vec<u32>; 2], stack: u32, stages: &[Stages; 2]) -> Value {
    let named = |stages: &Stages| {
        json!({
            "central_body": stages.central_body,
            "leg_kinematics": stages.leg_kinematics,
            "desired_acceleration": stages.desired_acceleration,
            "workspace_dynamics": stages.workspace_dynamics,
            "wrench_distribution": stages.wrench_distribution,
            "joint_torques": stages.joint_torques,
            "tick": stages.tick,
        })
    };
    json!({
        "ticks": costs.len(),
        "instructions": spread(costs),
        "limited_ticks": limited[0].len() + limited[1].len(),
        "limited_free": spread(&limited[0]),
        "limited_active": spread(&limited[1]),
        "per_stage": named(&stages[0]),
        "per_stage_big_base": named(&stages[1]),
        "stack_bytes": stack,
        "traced_ticks": TRACED,
    })
}
