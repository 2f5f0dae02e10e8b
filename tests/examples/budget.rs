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
use surefoot_sim::scene::{Scene, load};

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
    let scene = load(scenes[0])?;
    let stages = profile(&scene)?;
    eprintln!("  every instruction of {TRACED} ticks");
    traced(&scene, &trace)?;
    println!("{:#}", document(&costs, stack, &stages));
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
    sensors.joint_rates = [0.0; JOINTS];
    for _ in 0..=TRACED {
        let torques = target.tick(&sensors)?;
        if torques.mode != Mode::Active {
            return Err("the traced tick is not active".into());
        }
    }
    Ok(())
}

fn document(costs: &[u32], stack: u32, stages: &[Stages; 2]) -> Value {
    let min = costs.iter().min().copied().unwrap_or(0);
    let max = costs.iter().max().copied().unwrap_or(0);
    let mean = costs.iter().map(|c| f64::from(*c)).sum::<f64>() / costs.len().max(1) as f64;
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
        "instructions": { "min": min, "mean": mean, "max": max },
        "per_stage": named(&stages[0]),
        "per_stage_big_base": named(&stages[1]),
        "stack_bytes": stack,
        "traced_ticks": TRACED,
    })
}
