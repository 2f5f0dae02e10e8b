//! A mechanism's parts by name, and what a sample says of each.

use super::joint_motion::{BodyMotion, JointMotion, carried_on, joint_motion};
use super::named_joint::{JointKind, NamedJoint};
use super::run::MechanismSample;
use super::start::{StartFailure, start_bodies};
use crate::robot::biped;
use crate::scene::{Mechanism, Outline};
use nalgebra::Vector3;
use surefoot::spatial::{Pose, Quaternion};
use surefoot_multibody::{JointConstraint, System};

/// A mechanism's parts by name.
#[derive(Clone, Debug)]
pub struct Layout {
    /// Bodies in the order of their states, for people.
    pub bodies: Vec<String>,
    /// The same as columns of a record have them.
    pub body_columns: Vec<String>,
    /// Joints: those of the tree, then those that close loops.
    pub joints: Vec<NamedJoint>,
    /// Points that can touch the floor, in the order of their states.
    pub points: Vec<NamedPoint>,
    /// What coordinates a state has.
    pub kind: LayoutKind,
}

/// What coordinates a state has.
#[derive(Clone, Debug)]
pub enum LayoutKind {
    /// The unit quaternion of one body.
    Orientation,
    /// Positions of point masses, each on a rod below the one before.
    Rods(Rods),
    /// Position and unit quaternion of each body.
    Bodies(Box<System>),
}

/// Point masses on rods.
#[derive(Clone, Debug)]
pub struct Rods {
    /// m
    pub lengths: Vec<f64>,
    /// kg
    pub masses: Vec<f64>,
    /// m/s²
    pub gravity: f64,
}

/// A point that can touch the floor.
#[derive(Clone, Debug)]
pub struct NamedPoint {
    /// Name in columns of a record.
    pub column: String,
    /// Its body.
    pub body: usize,
    /// In the body's frame, m.
    pub at: Vector3<f64>,
}

impl Layout {
    /// Of a mechanism that can be started.
    ///
    /// # Errors
    /// As for [`start_bodies`].
    pub fn of(mechanism: &Mechanism) -> Result<Self, StartFailure> {
        Ok(match mechanism {
            Mechanism::RigidBody { .. } => Self {
                bodies: vec!["body".to_owned()],
                body_columns: vec!["body".to_owned()],
                joints: Vec::new(),
                points: Vec::new(),
                kind: LayoutKind::Orientation,
            },
            Mechanism::Pendulum { gravity_m_s2, links } => Self::of_rods(Rods {
                lengths: links.iter().map(|link| link.length_m).collect(),
                masses: links.iter().map(|link| link.mass_kg).collect(),
                gravity: *gravity_m_s2,
            }),
            Mechanism::Multibody(all) => {
                let names = all.bodies.iter().map(|body| body.name.clone()).collect();
                Self::of_system(mechanism, names, |name| format!("{name}, joint"))?
            }
            Mechanism::Chain { links, .. } => {
                let names = (1..=*links).map(|k| format!("rod {k}")).collect();
                Self::of_system(mechanism, names, |name| name.replace("rod", "joint"))?
            }
            Mechanism::Biped(_) => {
                let robot = biped(Outline::A);
                let mut layout =
                    Self::of_system(mechanism, robot.bodies.clone(), |name| name.to_owned())?;
                let named = robot.joints.iter().zip(&robot.columns);
                for (joint, (name, column)) in layout.joints.iter_mut().zip(named) {
                    (joint.name, joint.column) = (name.clone(), column.clone());
                }
                layout
            }
        })
    }

    fn of_rods(rods: Rods) -> Self {
        let numbered =
            |what: &str| (1..=rods.lengths.len()).map(|k| format!("{what} {k}")).collect();
        let bodies: Vec<String> = numbered("mass");
        let joints: Vec<String> = numbered("rod");
        let columns = columns(&joints);
        let joint = |(k, (name, column)): (usize, (String, String))| NamedJoint {
            name,
            column,
            outboard: k,
            inboard: k.checked_sub(1),
            kind: JointKind::Rod,
            torque: 0.0,
            law: None,
        };
        Self {
            body_columns: self::columns(&bodies),
            bodies,
            joints: joints.into_iter().zip(columns).enumerate().map(joint).collect(),
            points: Vec::new(),
            kind: LayoutKind::Rods(rods),
        }
    }

    fn of_system(
        mechanism: &Mechanism,
        bodies: Vec<String>,
        joint_of: impl Fn(&str) -> String,
    ) -> Result<Self, StartFailure> {
        // A step of any length: only what it is made of is looked at.
        let system = start_bodies(mechanism, 1e-3)?.system().clone();
        let torques = mechanism.torques();
        let mut joints = Vec::new();
        for (k, (link, body)) in system.links().iter().zip(&bodies).enumerate() {
            let is_none =
                matches!(link.joint.constraint, JointConstraint::Floating | JointConstraint::Fixed);
            if is_none {
                continue;
            }
            let law = system.laws().iter().find(|(of, _)| *of == k).map(|(_, law)| *law);
            joints.push(NamedJoint {
                name: joint_of(body),
                column: String::new(),
                outboard: k,
                inboard: link.inboard,
                kind: JointKind::Bodies(link.joint),
                torque: torques.get(k).copied().unwrap_or_default(),
                law,
            });
        }
        for (k, closure) in system.closures().iter().enumerate() {
            let surefoot_multibody::Closing::Joint(joint) = &closure.closing else { continue };
            if joint.constraint == JointConstraint::Fixed {
                continue;
            }
            joints.push(NamedJoint {
                name: format!("loop {}", k + 1),
                column: String::new(),
                outboard: closure.outboard,
                inboard: closure.inboard,
                kind: JointKind::Bodies(*joint),
                torque: 0.0,
                law: None,
            });
        }
        let names: Vec<String> = joints.iter().map(|joint| joint.name.clone()).collect();
        for (joint, column) in joints.iter_mut().zip(columns(&names)) {
            joint.column = column;
        }
        let sites = system.sites().iter().enumerate();
        Ok(Self {
            body_columns: columns(&bodies),
            bodies,
            joints,
            points: sites
                .map(|(k, site)| NamedPoint {
                    column: format!("point_{}", k + 1),
                    body: site.link,
                    at: site.position.into(),
                })
                .collect(),
            kind: LayoutKind::Bodies(Box::new(system)),
        })
    }

    /// Where all bodies are. A point mass has the direction of its rod, whose other end is above it along its z axis.
    pub fn poses(&self, sample: &MechanismSample) -> Vec<Pose<f64>> {
        let x = &sample.configuration;
        match &self.kind {
            LayoutKind::Orientation => vec![pose([0.0; 3], [x[0], x[1], x[2], x[3]])],
            LayoutKind::Bodies(_) => {
                let bodies = x.as_chunks::<7>().0.iter();
                bodies.map(|[x, y, z, q @ ..]| pose([*x, *y, *z], *q)).collect()
            }
            LayoutKind::Rods(_) => {
                let masses = x.as_chunks::<3>().0;
                let above = std::iter::once(&[0.0; 3]).chain(masses);
                masses.iter().zip(above).map(|(mass, above)| along_rod(mass, above)).collect()
            }
        }
    }

    /// Velocities of all bodies: of the centre of mass (m/s, world frame) and the angular velocity (rad/s, body axes),
    /// as far as they have either.
    pub fn velocities(&self, sample: &MechanismSample) -> Vec<f64> {
        let (x, v) = (&sample.configuration, &sample.velocity);
        match &self.kind {
            LayoutKind::Orientation => {
                let state = [0.0, 0.0, 0.0, x[0], x[1], x[2], x[3]];
                let rate = [0.0, 0.0, 0.0, v[0], v[1], v[2], v[3]];
                BodyMotion::of(&state, &rate).omega_in_body().as_slice().to_vec()
            }
            LayoutKind::Rods(_) => v.clone(),
            LayoutKind::Bodies(_) => motions(sample)
                .flat_map(|body| [body.velocity, body.omega_in_body()])
                .flat_map(|v| [v.x, v.y, v.z])
                .collect(),
        }
    }

    /// Where all joints are, and how they move, at all samples. Angles are counted on from the first one's, which is
    /// within half a turn of the joint's zero.
    pub fn joints_over(&self, samples: &[MechanismSample]) -> Vec<Vec<JointMotion>> {
        let mut all: Vec<Vec<JointMotion>> = Vec::with_capacity(samples.len());
        for (i, sample) in samples.iter().enumerate() {
            let mut now = self.joints_at(sample);
            if let Some(before) = i.checked_sub(1) {
                let dt = sample.time_s - samples[before].time_s;
                for ((named, now), before) in self.joints.iter().zip(&mut now).zip(&all[before]) {
                    if named.counts_turns() {
                        go_on(now, before, dt);
                    }
                }
            }
            all.push(now);
        }
        all
    }

    fn joints_at(&self, sample: &MechanismSample) -> Vec<JointMotion> {
        let bodies: Vec<BodyMotion> = match &self.kind {
            LayoutKind::Bodies(_) => motions(sample).collect(),
            _ => Vec::new(),
        };
        let of = |named: &NamedJoint| match &named.kind {
            JointKind::Rod => rod_motion(named.outboard, sample),
            JointKind::Bodies(joint) => {
                let on = named.inboard.map_or(&BodyMotion::WORLD, |inboard| &bodies[inboard]);
                joint_motion(joint, on, &bodies[named.outboard])
            }
        };
        self.joints.iter().map(of).collect()
    }
}

fn motions(sample: &MechanismSample) -> impl Iterator<Item = BodyMotion> + '_ {
    let (states, rates) = (sample.configuration.as_chunks().0, sample.velocity.as_chunks().0);
    states.iter().zip(rates).map(|(x, v)| BodyMotion::of(x, v))
}

fn go_on(now: &mut JointMotion, before: &JointMotion, dt: f64) {
    let JointMotion { positions, rates } = now;
    let earlier = before.positions.iter().zip(&before.rates);
    for ((angle, rate), (was, rate_was)) in positions.iter_mut().zip(rates).zip(earlier) {
        *angle = carried_on(*angle, (*was, *rate_was), *rate, dt);
    }
}

/// A rod's angles: from straight down, and about the vertical, which have no meaning of their own straight down.
fn rod_motion(k: usize, sample: &MechanismSample) -> JointMotion {
    let of = |all: &[f64]| {
        let at = |k: usize| Vector3::from_row_slice(&all[3 * k..3 * k + 3]);
        k.checked_sub(1).map_or(at(k), |above| at(k) - at(above))
    };
    let (d, v) = (of(&sample.configuration), of(&sample.velocity));
    let (across, length_2) = (f64::hypot(d.x, d.y), d.norm_squared());
    let outwards = if across > 0.0 { (d.x * v.x + d.y * v.y) / across } else { 0.0 };
    let around = if across > 0.0 { (d.x * v.y - d.y * v.x) / (across * across) } else { 0.0 };
    JointMotion {
        positions: vec![across.atan2(-d.z), d.y.atan2(d.x)],
        rates: vec![(across * v.z - d.z * outwards) / length_2, around],
    }
}

fn pose(at: [f64; 3], q: [f64; 4]) -> Pose<f64> {
    let q = Quaternion::from_array(q);
    let rotation = q.normalized().unwrap_or(q).to_matrix();
    Pose { rotation, position: at.into() }
}

fn along_rod(mass: &[f64; 3], above: &[f64; 3]) -> Pose<f64> {
    let (mass, above) = (Vector3::from(*mass), Vector3::from(*above));
    let rotation = nalgebra::Rotation3::rotation_between(&Vector3::z(), &(above - mass))
        .unwrap_or_else(|| {
            nalgebra::Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        });
    Pose { rotation: *rotation.matrix(), position: mass }
}

/// Names as columns have them: small letters, digits and underscores, each once.
fn columns(names: &[String]) -> Vec<String> {
    let mut all: Vec<String> = Vec::with_capacity(names.len());
    let mut taken = std::collections::HashSet::new();
    for name in names {
        let letter = |c: char| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        let plain: String = name.chars().map(letter).collect();
        let parts: Vec<&str> = plain.split('_').filter(|part| !part.is_empty()).collect();
        let plain = if parts.is_empty() { "part".to_owned() } else { parts.join("_") };
        let mut column = plain.clone();
        let mut number = 2;
        while !taken.insert(column.clone()) {
            column = format!("{plain}_{number}");
            number += 1;
        }
        all.push(column);
    }
    all
}
