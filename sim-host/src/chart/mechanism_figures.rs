//! The figures of a mechanism's run: where it is, its joints, what it keeps, what it touches.

use super::marks::marks;
use super::{ChartError, Panel, Series, TimeSeries};
use surefoot_multibody::JointConstraint;
use surefoot_sim::mechanism::{
    JointKind, JointMotion, LayoutKind, MechanismSample, NamedJoint, Reaction,
};
use surefoot_sim::record::{Event, MechanismRecord, Record};

/// Curves that a legend has room for.
const MOST_CURVES: usize = 12;
/// Changes of what is kept are drawn in round-off's own size: this share of it is no more than that, J of 1 J.
const ROUND_OFF: f64 = 1e-15;

/// A figure of a mechanism's run.
#[derive(Clone, Copy, Debug)]
pub struct MechanismFigure {
    /// Name of its file, without the ending.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    panels: fn(&MechanismRecord<'_>) -> Vec<Panel>,
}

/// All figures; those of what a mechanism has not are left out.
pub const MECHANISM_FIGURES: [MechanismFigure; 8] = [
    MechanismFigure { name: "motion", title: "motion", panels: motion },
    MechanismFigure { name: "joint-angles", title: "joints", panels: joint_positions },
    MechanismFigure { name: "joint-rates", title: "joint rates", panels: joint_rates },
    MechanismFigure { name: "joint-torques", title: "joint torques", panels: joint_torques },
    MechanismFigure { name: "joint-forces", title: "what joints bear", panels: reactions },
    MechanismFigure { name: "energy", title: "energy", panels: energy },
    MechanismFigure { name: "conserved", title: "what is kept", panels: conserved },
    MechanismFigure { name: "ground-forces", title: "forces of the floor", panels: floor_forces },
];

impl MechanismFigure {
    /// Draws it as SVG, if there is something to draw; `of` names the run.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(
        &self,
        of: &str,
        record: &MechanismRecord<'_>,
        events: &[Event],
    ) -> Result<Option<String>, ChartError> {
        let panels = (self.panels)(record);
        if panels.is_empty() {
            return Ok(None);
        }
        let title = format!("{of}: {}", self.title);
        let times = record.times();
        TimeSeries { title, times: &times, panels, marks: &marks(events) }.svg().map(Some)
    }
}

fn panel(title: String, axis: &str, series: Vec<Series>) -> Option<Panel> {
    (!series.is_empty()).then(|| Panel { title, axis: axis.to_owned(), series })
}

fn curve(
    record: &MechanismRecord<'_>,
    name: &str,
    value: impl Fn(&MechanismSample) -> f64,
) -> Series {
    Series { name: name.to_owned(), values: record.samples().iter().map(value).collect() }
}

/// Where it is: the body that moves most, or is last in its row.
fn motion(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let layout = record.layout();
    let numbers = |first: usize, names: &[&str]| -> Vec<Series> {
        let numbered = names.iter().enumerate();
        numbered.map(|(i, name)| curve(record, name, |s| s.configuration[first + i])).collect()
    };
    let quaternion = |first: usize| numbers(first, &["scalar", "x", "y", "z"]);
    let panels = match &layout.kind {
        LayoutKind::Orientation => {
            vec![panel("Unit quaternion, world from body".to_owned(), "", quaternion(0))]
        }
        LayoutKind::Rods(rods) => {
            let last = rods.lengths.len() - 1;
            let title = format!("Position of {}", layout.bodies[last]);
            vec![panel(title, "m", numbers(3 * last, &["x", "y", "z"]))]
        }
        LayoutKind::Bodies(system) => {
            // What floats is the body that carries the others; of what hangs the last reaches farthest.
            let floats = system.links().first().is_some_and(|l| l.joint.constraints() == 0);
            let body = if floats { 0 } else { layout.bodies.len() - 1 };
            let name = &layout.bodies[body];
            vec![
                panel(
                    format!("Centre of mass of {name}"),
                    "m",
                    numbers(7 * body, &["x", "y", "z"]),
                ),
                panel(format!("Unit quaternion of {name}"), "", quaternion(7 * body + 3)),
            ]
        }
    };
    panels.into_iter().flatten().collect()
}

/// How joints' numbers are drawn.
#[derive(Clone, Copy, PartialEq)]
enum Scale {
    Degrees,
    Metres,
}

fn scale(joint: &NamedJoint) -> Scale {
    match &joint.kind {
        JointKind::Bodies(joint)
            if matches!(joint.constraint, JointConstraint::Prismatic { .. }) =>
        {
            Scale::Metres
        }
        _ => Scale::Degrees,
    }
}

/// Names of a joint's curves. A rod's azimuth leaps wherever it passes the vertical: it is left to the record.
fn names(joint: &NamedJoint) -> Vec<String> {
    let name = &joint.name;
    match &joint.kind {
        JointKind::Rod => vec![format!("{name} from down")],
        JointKind::Bodies(of) => match of.constraint {
            JointConstraint::Universal { .. } => {
                vec![format!("{name}, first"), format!("{name}, second")]
            }
            _ => vec![name.clone()],
        },
    }
}

/// A spherical joint is drawn by its angle from home, others by their coordinates.
fn position(motion: &JointMotion, k: usize) -> f64 {
    match motion.positions[..] {
        [s, x, y, z] => 2.0 * (x * x + y * y + z * z).sqrt().atan2(s.abs()),
        _ => motion.positions[k],
    }
}

/// A spherical joint is drawn by the size of its angular velocity.
fn rate(motion: &JointMotion, k: usize) -> f64 {
    match motion.rates[..] {
        [x, y, z] => (x * x + y * y + z * z).sqrt(),
        _ => motion.rates[k],
    }
}

/// Panels of angles and of displacements.
fn of_joints(
    record: &MechanismRecord<'_>,
    what: [(&str, &str, f64); 2],
    value: fn(&JointMotion, usize) -> f64,
) -> Vec<Panel> {
    let joints = &record.layout().joints;
    let panels = [Scale::Degrees, Scale::Metres].into_iter().zip(what).filter_map(
        |(of_scale, (title, unit, factor))| {
            let curves: Vec<(usize, usize, String)> = joints
                .iter()
                .enumerate()
                .filter(|(_, joint)| scale(joint) == of_scale)
                .flat_map(|(j, joint)| {
                    names(joint).into_iter().enumerate().map(move |(k, name)| (j, k, name))
                })
                .collect();
            let all = curves.len();
            let series = curves.into_iter().take(MOST_CURVES).map(|(j, k, name)| Series {
                name,
                values: record
                    .joint_motions()
                    .iter()
                    .map(|joints| factor * value(&joints[j], k))
                    .collect(),
            });
            panel(titled(title, all), unit, series.collect())
        },
    );
    panels.collect()
}

/// With what is left out.
fn titled(title: &str, all: usize) -> String {
    if all > MOST_CURVES {
        format!("{title}: the first {MOST_CURVES} of {all}")
    } else {
        title.to_owned()
    }
}

fn joint_positions(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let degrees = 1.0_f64.to_degrees();
    of_joints(
        record,
        [("Joint angles", "degrees", degrees), ("Joint displacements", "m", 1.0)],
        position,
    )
}

fn joint_rates(record: &MechanismRecord<'_>) -> Vec<Panel> {
    of_joints(
        record,
        [("Joint rates", "rad/s", 1.0), ("Joint rates along their axes", "m/s", 1.0)],
        rate,
    )
}

fn joint_torques(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let driven = record.layout().joints.iter().enumerate().filter(|(_, joint)| joint.is_driven());
    let all = driven.clone().count();
    let series = driven.take(MOST_CURVES).map(|(j, joint)| Series {
        name: joint.name.clone(),
        values: record.joint_motions().iter().map(|joints| joint.effort(&joints[j])).collect(),
    });
    let title = titled("Of motors, springs, dampers and stops", all);
    panel(title, "N·m or N", series.collect()).into_iter().collect()
}

fn reactions(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let joints = record.layout().joints.iter().enumerate();
    let all = record.layout().joints.len();
    let of = |value: fn(&Reaction) -> f64| -> Vec<Series> {
        if !record.layout().has_reactions() {
            return Vec::new();
        }
        // Where that is not known, as at the start, a curve goes on from what is known next.
        let known = |i: usize| record.reactions()[i..].iter().flatten().next();
        let curve = |(j, joint): (usize, &NamedJoint)| Series {
            name: joint.name.clone(),
            values: (0..record.samples().len())
                .map(|i| known(i).map_or(0.0, |all| value(&all[j])))
                .collect(),
        };
        joints.clone().take(MOST_CURVES).map(curve).collect()
    };
    let forces = panel(titled("Size of the force at each joint", all), "N", of(|r| r.force.norm()));
    let has_torques = !matches!(record.layout().kind, LayoutKind::Rods(_));
    let torques = has_torques.then(|| {
        let title = titled("Size of the torque at each joint, its motor's included", all);
        panel(title, "N·m", of(|r| r.torque.norm()))
    });
    forces.into_iter().chain(torques.flatten()).collect()
}

fn energy(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let first = record.samples().first().map_or(0.0, |sample| sample.energy);
    let parts = vec![
        curve(record, "kinetic", |s| s.kinetic),
        curve(record, "potential", |s| s.energy - s.kinetic),
        curve(record, "sum", |s| s.energy),
    ];
    let (factor, unit) = power_of_ten(record.samples().iter().map(|s| s.energy - first), "J");
    let change = vec![curve(record, "sum", |s| factor * (s.energy - first))];
    let both = [
        panel("Energy".to_owned(), "J", parts),
        panel("Energy, less that of the start".to_owned(), &unit, change),
    ];
    both.into_iter().flatten().collect()
}

fn conserved(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let first = record.samples().first();
    let momenta = first.map(|sample| sample.momentum.clone()).unwrap_or_default();
    let axes: &[&str] = if momenta.len() == 1 { &["z"] } else { &["x", "y", "z"] };
    let samples = record.samples().iter();
    let changes =
        samples.clone().flat_map(|s| s.momentum.iter().zip(&momenta).map(|(m, m0)| m - m0));
    let (factor, unit) = power_of_ten(changes, "N·m·s");
    let of_momentum = axes.iter().zip(&momenta).enumerate().map(|(i, (axis, start))| {
        curve(record, &format!("about {axis}"), move |s| factor * (s.momentum[i] - start))
    });
    let title = "Angular momentum, less that of the start".to_owned();
    let momentum = panel(title, &unit, of_momentum.collect());
    let (factor, unit) = power_of_ten(samples.map(|s| s.constraint), "");
    let largest = vec![curve(record, "largest", |s| factor * s.constraint)];
    let title = "Largest error of joints (m or rad) and unit quaternions".to_owned();
    [momentum, panel(title, &unit, largest)].into_iter().flatten().collect()
}

/// A factor that brings the largest of these to between 1 and 1000, and the unit with it: axes have room for few digits.
fn power_of_ten(values: impl Iterator<Item = f64>, unit: &str) -> (f64, String) {
    let largest = values.filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest <= ROUND_OFF * 1e-3 || (1e-2..1e4).contains(&largest) {
        return (1.0, unit.to_owned());
    }
    let power = 3 * (largest.log10() / 3.0).floor() as i32;
    (10.0_f64.powi(-power), format!("1e{power} {unit}").trim_end().to_owned())
}

fn floor_forces(record: &MechanismRecord<'_>) -> Vec<Panel> {
    let points = record.layout().points.iter().enumerate();
    let all = record.layout().points.len();
    let of = |value: fn(&[f64; 3]) -> f64| -> Vec<Series> {
        let named = points.clone().take(MOST_CURVES);
        named
            .map(|(k, point)| {
                let name = point.column.replace('_', " ");
                curve(record, &name, move |s| s.contact_forces.get(k).map_or(0.0, value))
            })
            .collect()
    };
    let both = [
        panel(titled("Vertical force of the floor on each point", all), "N", of(|f| f[2])),
        panel(
            titled("Horizontal force of the floor on each point", all),
            "N",
            of(|f| f64::hypot(f[0], f[1])),
        ),
    ];
    both.into_iter().flatten().collect()
}
