//! `peers FOLDER`: our side of `cargo xtask peers`. Writes each motion as a MuJoCo model with its start, and
//! prints what ours takes: one JSON document.

use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;
use surefoot::spatial::Quaternion;
use surefoot_sim::contact::Floor;
use surefoot_sim::multibody::{Joint, JointConstraint, Link, Simulation, System};
use surefoot_tests::motions::{
    HOLDING, MotionStart, biped_in_flight, biped_on_feet, hanging_chain,
};

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
    let mut xml =
        format!("<mujoco><option gravity=\"0 0 {}\"/>\n<worldbody>\n", -start.system.gravity());
    if let Some((Floor { dynamic_friction, .. }, _)) = start.system.ground() {
        let _ = writeln!(
            xml,
            "<geom type=\"plane\" size=\"0 0 1\" friction=\"{dynamic_friction} 0 0\" condim=\"3\"/>"
        );
    }
    bodies(&mut xml, &start.system, None);
    xml.push_str("</worldbody></mujoco>\n");
    std::fs::write(folder.join(format!("{}.xml", start.name)), xml).expect("written");
    let (mut qpos, mut qvel) = (Vec::new(), Vec::new());
    let rates = simulation.column_rates().expect("rates").to_vec();
    let mut column = 0;
    for (k, link) in start.system.links().iter().enumerate() {
        if link.joint.constraint == JointConstraint::Floating {
            let x = start.states[k];
            qpos.extend(x);
            let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
            qvel.extend(&rates[column..column + 3]);
            // Theirs are in the body's axes.
            let omega = nalgebra::Vector3::from_row_slice(&rates[column + 3..column + 6]);
            qvel.extend(q.conjugate().rotate(omega).iter());
            column += 6;
        } else {
            qpos.push(simulation.angle(k));
            qvel.push(rates[column]);
            column += 1;
        }
    }
    let state = json!({ "qpos": qpos, "qvel": qvel }).to_string();
    std::fs::write(folder.join(format!("{}.json", start.name)), state).expect("written");
}

/// The bodies that hang from one, with all that hang from them.
fn bodies(xml: &mut String, system: &System, inboard: Option<usize>) {
    let three = |v: [f64; 3]| format!("{:?} {:?} {:?}", v[0], v[1], v[2]);
    for (k, link) in system.links().iter().enumerate() {
        let Link { inboard: hangs_from, joint, body } = link;
        if *hangs_from != inboard {
            continue;
        }
        let Joint { outboard, inboard: point, home, constraint } = joint;
        let arm = Quaternion::from_array(*home).rotate((*outboard).into());
        let at: [f64; 3] = std::array::from_fn(|i| point[i] - arm[i]);
        let [s, a, b, c] = home;
        let _ = writeln!(xml, "<body pos=\"{}\" quat=\"{s:?} {a:?} {b:?} {c:?}\">", three(at));
        match constraint {
            JointConstraint::Floating => xml.push_str("<freejoint/>"),
            JointConstraint::Revolute { axis } => {
                let law = system.laws().iter().find(|(link, _)| *link == k);
                let spring = law.map_or(String::new(), |(_, law)| {
                    let degrees = law.rest.to_degrees();
                    let (stiffness, damping) = (HOLDING.stiffness, HOLDING.damping);
                    format!(
                        " stiffness=\"{stiffness}\" damping=\"{damping}\" springref=\"{degrees:?}\""
                    )
                });
                let _ = writeln!(
                    xml,
                    "<joint type=\"hinge\" pos=\"{}\" axis=\"{}\"{spring}/>",
                    three(*outboard),
                    three(*axis)
                );
            }
            other => unreachable!("no motion here has {other:?}"),
        }
        let _ = writeln!(
            xml,
            "<inertial pos=\"0 0 0\" mass=\"{:?}\" diaginertia=\"{}\"/>",
            body.mass,
            three(body.inertia)
        );
        for site in system.sites().iter().filter(|site| site.link == k) {
            let _ = writeln!(
                xml,
                "<geom type=\"sphere\" size=\"0.001\" mass=\"0\" contype=\"0\" conaffinity=\"1\" condim=\"3\" pos=\"{}\"/>",
                three(site.position)
            );
        }
        bodies(xml, system, Some(k));
        xml.push_str("</body>\n");
    }
}
