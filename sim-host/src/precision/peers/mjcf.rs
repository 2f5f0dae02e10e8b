//! A system of bodies and joints as a MuJoCo model, with its start.

use nalgebra::Vector3;
use serde::Serialize;
use std::fmt::Write;
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::Floor;
use surefoot_multibody::{Joint, JointConstraint, Link, Simulation, System};

/// A model and its start. Bodies are called `b` with their number in the system; their frames are principal ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MujocoModel {
    /// MJCF.
    pub xml: String,
    /// Positions: of a floating body place and quaternion, scalar first; of others the joint's coordinate.
    pub qpos: Vec<f64>,
    /// Velocities: of a floating body that of its centre of mass, world axes, and its angular velocity, its own axes.
    pub qvel: Vec<f64>,
}

/// Why there is no model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoModel {
    /// A joint of a kind that is not written.
    #[error("joint {link} is neither a hinge nor free")]
    Joint {
        /// Its link.
        link: usize,
    },
    /// A loop, a stop, something to strike.
    #[error("closed loops, stops and thrown bodies are not written")]
    Unwritten,
    /// Its velocities are not known.
    #[error("the start's inertia is singular")]
    Singular,
}

/// The model of a motion, and where it is now.
///
/// # Errors
/// A [`NoModel`].
pub fn mujoco_model(simulation: &mut Simulation) -> Result<MujocoModel, NoModel> {
    let system = simulation.system().clone();
    let has_stops = system.laws().iter().any(|(_, law)| law.stops.is_some());
    if has_stops || !system.closures().is_empty() || !system.strikers().is_empty() {
        return Err(NoModel::Unwritten);
    }
    let mut xml =
        format!("<mujoco><option gravity=\"0 0 {:?}\"/>\n<worldbody>\n", -system.gravity());
    // Writing to a string cannot fail.
    if let Some((Floor { dynamic_friction, .. }, _)) = system.ground() {
        let _ = writeln!(
            xml,
            "<geom type=\"plane\" size=\"0 0 1\" friction=\"{dynamic_friction} 0 0\" condim=\"3\"/>"
        );
    }
    bodies(&mut xml, &system, None)?;
    xml.push_str("</worldbody></mujoco>\n");
    let (mut qpos, mut qvel) = (Vec::new(), Vec::new());
    let rates = simulation.column_rates().map_err(|_| NoModel::Singular)?.to_vec();
    let mut column = 0;
    for (k, link) in system.links().iter().enumerate() {
        if link.joint.constraint == JointConstraint::Floating {
            let x = simulation.state(k);
            qpos.extend(x);
            let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
            qvel.extend(&rates[column..column + 3]);
            let omega = Vector3::from_row_slice(&rates[column + 3..column + 6]);
            qvel.extend(q.conjugate().rotate(omega).iter());
            column += 6;
        } else {
            qpos.push(simulation.angle(k));
            qvel.push(rates[column]);
            column += 1;
        }
    }
    Ok(MujocoModel { xml, qpos, qvel })
}

/// The bodies that hang from one, with all that hang from them.
fn bodies(xml: &mut String, system: &System, inboard: Option<usize>) -> Result<(), NoModel> {
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
        let pos = three(at);
        let _ =
            writeln!(xml, "<body name=\"b{k}\" pos=\"{pos}\" quat=\"{s:?} {a:?} {b:?} {c:?}\">");
        match constraint {
            JointConstraint::Floating => xml.push_str("<freejoint/>"),
            JointConstraint::Revolute { axis } => {
                let law = system.laws().iter().find(|(link, _)| *link == k);
                let spring = law.map_or(String::new(), |(_, law)| {
                    let (stiffness, damping) = (law.stiffness, law.damping);
                    let (rotor, friction) = (law.rotor_inertia, law.friction);
                    let degrees = law.rest.to_degrees();
                    format!(
                        " stiffness=\"{stiffness:?}\" damping=\"{damping:?}\" springref=\"{degrees:?}\" armature=\"{rotor:?}\" frictionloss=\"{friction:?}\""
                    )
                });
                let (pos, axis) = (three(*outboard), three(*axis));
                let _ =
                    writeln!(xml, "<joint type=\"hinge\" pos=\"{pos}\" axis=\"{axis}\"{spring}/>");
            }
            _ => return Err(NoModel::Joint { link: k }),
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
        bodies(xml, system, Some(k))?;
        xml.push_str("</body>\n");
    }
    Ok(())
}
