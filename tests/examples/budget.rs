//! What a tick takes on the emulated target, as one JSON document: `budget TRACE`.
//!
//! `cargo xtask budget` runs it. `TRACE` is where QEMU writes down every instruction of some ticks.

use serde_json::{Value, json};
use surefoot::balance::Mode;
use surefoot_link::{Sensors, Stages, ToTarget};
use surefoot_sim::closed_loop;
use surefoot_sim::closed_loop::firmware::{
    Emulator, FirmwareController, LinkError, image_for, sensors, set_point, settings,
};
use surefoot_sim::scene::{Push, Scene, load};

/// Of the robot of the text.
const JOINTS: usize = 12;
type Target = surefoot_sim::closed_loop::firmware::Target<JOINTS>;

/// Ticks that are traced, after the first, which also takes orders.
const TRACED: usize = 2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
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
    let scene = load(scenes[0])?;
    let stages = profile(&scene)?;
    eprintln!("  every instruction of {TRACED} ticks");
    traced(&scene, &trace)?;
    println!("{:#}", document(&costs, &limited, stack, &stages));
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

fn traced(scene: &Scene, trace: &str) -> Result<(), Box<dyn std::error::Error>> {
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
fn limited(stack: &mut u32) -> Result<[Vec<u32>; 2], Box<dyn std::error::Error>> {
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
