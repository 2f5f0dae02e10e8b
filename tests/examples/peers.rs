//! `peers FOLDER`: our side of `cargo xtask peers`. Writes each motion as a MuJoCo model with its start, and
//! prints what ours takes: one JSON document.

use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;
use surefoot_host::precision::{MujocoModel, mujoco_model};
use surefoot_multibody::Simulation;
use surefoot_tests::motions::{MotionStart, biped_in_flight, biped_on_feet, hanging_chain};

fn main() {
    let folder = std::env::args().nth(1).expect("a folder");
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder).expect("a folder that can be made");
    let mut steps = Vec::new();
    for start in [
        biped_in_flight(),
        biped_on_feet(),
        hanging_chain(25, 0.1, 0.05),
        hanging_chain(100, 0.1, 0.05),
        hanging_chain(200, 0.1, 0.05),
    ] {
        let mut simulation = start.simulation(1e-3);
        write_model(folder, &start, &mut simulation);
        let settle = if start.name == "biped-feet" { 1000 } else { 0 };
        for _ in 0..settle {
            simulation.step().expect("a step");
        }
        let measured = 400_000 / start.states.len();
        let begun = Instant::now();
        for _ in 0..measured {
            simulation.step().expect("a step");
        }
        let us = begun.elapsed().as_secs_f64() * 1e6 / measured as f64;
        eprintln!("  {}: {us:.2} µs a step", start.name);
        steps.push(json!({
            "model": start.name,
            "us_per_step": us,
            "newton": simulation.progress().mean_iterations(),
        }));
    }
    let chain = hanging_chain(10, 0.5, 0.3);
    write_model(folder, &chain, &mut chain.simulation(1e-3));
    let energy: Vec<Value> =
        [1e-3, 2e-3, 5e-3, 1e-2].map(|h| long_run(&chain, h)).into_iter().collect();
    println!("{}", json!({ "steps": steps, "energy": energy }));
}

/// 1e5 steps: the largest error of energy over its scale, and computing time a simulated second.
fn long_run(start: &MotionStart, h: f64) -> Value {
    let mut simulation = start.simulation(h);
    let energy = |simulation: &mut Simulation| {
        let (kinetic, potential) = simulation.energies().expect("regular");
        kinetic + potential
    };
    let first = energy(&mut simulation);
    let (mut worst, mut computing) = (0.0_f64, 0.0);
    for _ in 0..1000 {
        let begun = Instant::now();
        for _ in 0..100 {
            simulation.step().expect("a step");
        }
        computing += begun.elapsed().as_secs_f64();
        worst = worst.max((energy(&mut simulation) - first).abs());
    }
    eprintln!("  {} at {h} s over 1e5 steps: {worst:.1e} J", start.name);
    json!({
        "model": start.name,
        "step_s": h,
        "energy_error_j": worst,
        "computing_s_per_s": computing / simulation.progress().time_s,
        "split_steps": simulation.progress().split_steps,
    })
}

/// A MuJoCo model and its start: `NAME.xml`, `NAME.json`.
fn write_model(folder: &Path, start: &MotionStart, simulation: &mut Simulation) {
    let MujocoModel { xml, qpos, qvel } = mujoco_model(simulation).expect("hinges and free bodies");
    std::fs::write(folder.join(format!("{}.xml", start.name)), xml).expect("written");
    let state = json!({ "qpos": qpos, "qvel": qvel }).to_string();
    std::fs::write(folder.join(format!("{}.json", start.name)), state).expect("written");
}
