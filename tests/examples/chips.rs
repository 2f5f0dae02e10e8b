//! Whether the firmware has the host's bits on each chip that it has an image for, and what a tick takes there, as
//! one JSON document. `cargo xtask budget` runs it.

use serde_json::{Map, Value, json};
use surefoot::balance::StopReason;
use surefoot_sim::closed_loop::firmware::{
    Emulator, FirmwareController, Machine, Target, image_for,
};
use surefoot_sim::closed_loop::{
    self, Commanded, ControlFailure, Controller, LimitTally, Outcome, Scalar,
};
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::{Push, Scene, load};

/// Of the robot of the text.
const JOINTS: usize = 12;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scenes = [load("experiment-1")?, pushed()?];
    let mut targets = Map::new();
    for machine in [Machine::REFERENCE].iter().chain(&Machine::OTHERS) {
        eprintln!("  {} with the host's controller beside it", machine.core());
        let mut played = Vec::new();
        for scene in &scenes {
            played.push(play(machine, scene)?);
        }
        let [plain, limited] = &played[..] else { return Err("two scenes".into()) };
        targets.insert(
            machine.image().to_owned(),
            json!({
                "core": machine.core(),
                "ticks": plain.costs.len() + limited.costs.len(),
                "instructions": spread(&plain.costs),
                "limited_instructions": spread(&limited.costs),
                "stack_bytes": plain.stack_bytes.max(limited.stack_bytes),
                "bits_equal": plain.bits_equal && limited.bits_equal,
            }),
        );
    }
    println!("{:#}", Value::Object(targets));
    Ok(())
}

/// Stands, and is pushed forwards so that limits of ground and motors bind.
fn pushed() -> Result<Scene, Box<dyn std::error::Error>> {
    let mut scene = load("stand")?;
    scene.pushes = vec![Push { at_s: 0.7, duration_s: 0.1, force_n: [250.0, 0.0, 0.0] }];
    Ok(scene)
}

/// The target in the loop, and the host's controller beside it on the same measurements.
struct Twins {
    target: FirmwareController<JOINTS>,
    host: Box<dyn Controller>,
    bits_equal: bool,
}

impl Controller for Twins {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let answer = self.target.tick(state)?;
        let host = self.host.tick(state)?;
        let bits = |torques: &[f64]| torques.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        self.bits_equal &= bits(&host.torques[..]) == bits(&answer.torques[..])
            && host.desired_wrench == answer.desired_wrench
            && self.host.stopped() == self.target.stopped();
        Ok(answer)
    }

    fn stopped(&self) -> Option<StopReason> {
        self.target.stopped()
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        self.target.touch(time_s, feet);
        self.host.touch(time_s, feet);
    }
}

struct Played {
    /// Of each tick but the first, which also takes the order to arm.
    costs: Vec<u32>,
    stack_bytes: u32,
    bits_equal: bool,
}

fn play(machine: &Machine, scene: &Scene) -> Result<Played, Box<dyn std::error::Error>> {
    let image = image_for(scene)?.with_file_name(format!("{}.elf", machine.image()));
    let emulator = Emulator::start_on(machine, &image, &std::env::temp_dir(), &[])?;
    let target = FirmwareController::new(Target::<JOINTS>::connect(emulator)?, scene)?;
    let host = closed_loop::controller(scene, Scalar::F32);
    let mut twins = Twins { target, host, bits_equal: true };
    let run = closed_loop::run(scene, &mut twins, &mut |_| {});
    if run.outcome != Outcome::Balanced {
        return Err(format!("{}: {:?} {:?}", machine.core(), run.outcome, run.failure).into());
    }
    let [host, target] =
        [twins.host.limits(), twins.target.limits()].map(|limits| limits.map(LimitTally::over_all));
    let limits = (host, target);
    Ok(Played {
        costs: twins.target.tick_costs().get(1..).unwrap_or_default().to_vec(),
        stack_bytes: twins.target.target().status()?.stack_bytes,
        bits_equal: twins.bits_equal && limits.0 == limits.1,
    })
}

fn spread(costs: &[u32]) -> Value {
    let min = costs.iter().min().copied().unwrap_or(0);
    let max = costs.iter().max().copied().unwrap_or(0);
    let mean = costs.iter().map(|c| f64::from(*c)).sum::<f64>() / costs.len().max(1) as f64;
    json!({ "min": min, "mean": mean, "max": max })
}
