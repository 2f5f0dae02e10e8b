//! Other engines, where they are installed.

use super::play::{Played, Trace, error, kept};
use super::problems::Benchmark;
use super::references::Reference;
use super::row::Peer;
use serde::Deserialize;
use serde_json::json;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;
use surefoot_sim::scene::{Mechanism, MechanismScene};

const SCRIPT: &str = include_str!("peers.py");

/// Where Python with MuJoCo may be, below the folder that the program is started in.
const PLACES: [&str; 2] = ["target/robots/python/bin/python", "target/peers/python/bin/python"];

#[derive(Deserialize)]
struct Answer {
    version: String,
    wall_s: f64,
    traces: Vec<Trace>,
}

/// All that can be asked.
pub(super) fn all(
    of: &Benchmark,
    scene: &MechanismScene,
    known: &Reference,
) -> BTreeMap<&'static str, Peer> {
    let peer = match mujoco(of, scene, known) {
        Ok(peer) => peer,
        Err(note) => Peer { error: None, step_s: None, wall_s: None, note },
    };
    BTreeMap::from([("mujoco", peer)])
}

fn python() -> Option<PathBuf> {
    PLACES.iter().map(PathBuf::from).find(|path| path.exists())
}

/// The same scene at the same step, by MuJoCo's Runge–Kutta method of fourth order.
fn mujoco(of: &Benchmark, scene: &MechanismScene, known: &Reference) -> Result<Peer, String> {
    let Mechanism::Multibody(bodies) = &scene.mechanism else { return Err("no bodies".into()) };
    let python = python().ok_or("no Python with MuJoCo below target")?;
    let (step_s, steps) = kept(scene.integrator.step_s, &known.times).ok_or("no reference")?;
    let asked = json!({ "scene": bodies, "step_s": step_s, "steps": steps });
    let started = Command::new(python)
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = started.map_err(|error| error.to_string())?;
    if let Some(mut stdin) = child.stdin.take() {
        stdin.write_all(asked.to_string().as_bytes()).map_err(|error| error.to_string())?;
    }
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(said.lines().last().unwrap_or("it failed").to_owned());
    }
    let answer: Answer =
        serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())?;
    let played = Played {
        error: None,
        failure: None,
        step_s,
        wall: Duration::from_secs_f64(answer.wall_s.max(0.0)),
        traces: answer.traces,
        bodies: bodies.bodies.iter().map(|body| body.name.clone()).collect(),
    };
    Ok(Peer {
        error: error(scene, of.measure, &known.times, &played),
        step_s: Some(step_s),
        wall_s: Some(answer.wall_s),
        note: format!("MuJoCo {}, RK4", answer.version),
    })
}
