//! What a robot has otherwise than its controller's model: masses, places of joints, what is in joints.
//!
//! # Notation
//! A link's frame is along the principal axes of its body, at its centre of mass. `frames[k]`: body `k`'s frame of the
//! model in that of its link.

use crate::robot::{Robot, Start};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{
    Body, BodyState, Frame, Joint, JointConstraint, JointLaw, Link, System, SystemError,
};

/// A body that is not what the model says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyDifference {
    /// Which one.
    pub body: usize,
    /// Times the model's mass, with all of its inertia.
    pub mass_factor: f64,
    /// Times what that makes of the inertia about the centre of mass.
    pub inertia_factor: f64,
    /// Of the centre of mass, in the body's axes, m.
    pub center_shift: Vector3<f64>,
    /// A small ball that is fixed to it: kg, and from the model's centre of mass in the body's axes, m.
    pub added: Option<(f64, Vector3<f64>)>,
}

/// A joint that is not what the model says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointDifference {
    /// Which one, in the order of torques.
    pub joint: usize,
    /// Of its place in the inboard body, in that one's axes, m: a longer or shorter link.
    pub shift: Vector3<f64>,
    /// In place of the model's, kg·m²; of the robot's description, N·m·s/rad; and N·m.
    pub rotor_inertia: Option<f64>,
    /// N·m·s/rad
    pub damping: Option<f64>,
    /// N·m
    pub friction: Option<f64>,
}

/// All of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Differences {
    /// One a body at most.
    pub bodies: Vec<BodyDifference>,
    /// One a joint at most.
    pub joints: Vec<JointDifference>,
}

/// Radius of an added ball, m.
const BALL: f64 = 0.03;

impl Differences {
    /// Whether the robot is the model.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Makes them of a start. The robot is then raised or lowered so that its lowest point is where it was.
    ///
    /// # Errors
    /// A [`SystemError`] for what no body or joint can be.
    pub(super) fn make(&self, robot: &Robot, start: Start) -> Result<Start, SystemError> {
        let Start { system, mut frames, mut states, mut rates } = start;
        let mut links = system.links().to_vec();
        let before = lowest(robot, &frames, &states);
        for joint in self.joints.iter().filter(|joint| joint.shift != Vector3::zeros()) {
            let link = 1 + joint.joint;
            let Some(inboard) = links[link].inboard else { continue };
            let shift = frames[inboard].orientation.rotate(joint.shift);
            let at: [f64; 3] = (Vector3::from(links[link].joint.inboard) + shift).into();
            links[link].joint.inboard = at;
            let (way, speed) = apart(&shift, &states[inboard], &rates[inboard]);
            for k in outboard(&links, link) {
                add(&mut states[k], &way);
                add(&mut rates[k], &speed);
            }
        }
        for body in &self.bodies {
            let k = body.body;
            let shift = frames[k].orientation.rotate(body.center_shift);
            let all = body.mass_factor;
            links[k].body.mass *= all;
            links[k].body.inertia =
                links[k].body.inertia.map(|inertia| inertia * all * body.inertia_factor);
            let back = |point: [f64; 3]| (Vector3::from(point) - shift).into();
            if links[k].joint.constraint != JointConstraint::Floating {
                links[k].joint.outboard = back(links[k].joint.outboard);
            }
            for link in links.iter_mut().filter(|link| link.inboard == Some(k)) {
                link.joint.inboard = back(link.joint.inboard);
            }
            frames[k].position -= shift;
            let (way, speed) = apart(&shift, &states[k], &rates[k]);
            add(&mut states[k], &way);
            add(&mut rates[k], &speed);
        }
        let laws = self.laws(robot, &system);
        let mut made = System::new(links, system.gravity())?;
        for (link, law) in laws {
            made = made.with_law(link, law)?;
        }
        for body in &self.bodies {
            let Some((mass, at)) = body.added else { continue };
            let (k, seat) = (body.body, frames[body.body].point(at));
            let joint = Joint {
                outboard: [0.0; 3],
                inboard: seat.into(),
                home: [1.0, 0.0, 0.0, 0.0],
                constraint: JointConstraint::Fixed,
            };
            let ball = Body { mass, inertia: [0.4 * mass * BALL * BALL; 3] };
            made = made.with_link(Link { inboard: Some(k), joint, body: ball })?;
            let (way, speed) = apart(&seat, &states[k], &rates[k]);
            let (mut state, mut rate) = (states[k], rates[k]);
            add(&mut state, &way);
            add(&mut rate, &speed);
            states.push(state);
            rates.push(rate);
        }
        let raise = Vector3::new(0.0, 0.0, before - lowest(robot, &frames, &states));
        if raise.z.is_finite() {
            states.iter_mut().for_each(|state| add(state, &raise));
        }
        Ok(Start { system: made, frames, states, rates })
    }

    /// What is in the joints: the model's rotors, the description's damping and friction, and what differs.
    fn laws(&self, robot: &Robot, model: &System) -> Vec<(usize, JointLaw)> {
        let of_model = |link: usize| model.laws().iter().filter(move |(k, _)| *k == link);
        let each = robot.passive.iter().enumerate().map(|(joint, passive)| {
            let rotor = of_model(1 + joint).map(|(_, law)| law.rotor_inertia).sum();
            let other = self.joints.iter().find(|other| other.joint == joint);
            let other = other.copied().unwrap_or_default();
            let law = JointLaw {
                rotor_inertia: other.rotor_inertia.unwrap_or(rotor),
                damping: other.damping.unwrap_or(passive.damping),
                friction: other.friction.unwrap_or(passive.friction),
                ..JointLaw::NONE
            };
            (1 + joint, law)
        });
        each.filter(|(_, law)| *law != JointLaw::NONE).collect()
    }
}

/// The height of the lowest point of the feet.
fn lowest(robot: &Robot, frames: &[Frame], states: &[BodyState]) -> f64 {
    let of_foot = robot.feet.iter().flat_map(|foot| {
        let (x, frame) = (&states[foot.body], &frames[foot.body]);
        let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        foot.points.iter().map(move |point| x[2] + q.rotate(frame.point(point.at)).z)
    });
    of_foot.fold(f64::INFINITY, f64::min)
}

/// From a link's centre of mass to a point in its frame, and how fast that changes; world axes.
fn apart(point: &Vector3<f64>, x: &BodyState, v: &BodyState) -> (Vector3<f64>, Vector3<f64>) {
    let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
    let q_dot = Quaternion::from_array([v[3], v[4], v[5], v[6]]);
    // ω = 2 q̇ ⋆ q̄
    let omega = q_dot.product(q.conjugate()).v * 2.0;
    let way = q.rotate(*point);
    (way, omega.cross(&way))
}

fn add(state: &mut BodyState, way: &Vector3<f64>) {
    for (x, by) in state.iter_mut().zip(way.iter()) {
        *x += by;
    }
}

/// A link, and all that hang from it.
fn outboard(links: &[Link], first: usize) -> Vec<usize> {
    let mut all = vec![first];
    for (k, link) in links.iter().enumerate().skip(first + 1) {
        if link.inboard.is_some_and(|inboard| all.contains(&inboard)) {
            all.push(k);
        }
    }
    all
}
