//! What a mechanism looks like: as its scene describes it, or by its inertia and its joints.

use super::{Framing, Shown, ShownBody, ShownPoint, Solid};
use crate::mechanism::{JointKind, Layout, LayoutKind, MechanismSample};
use crate::robot::biped;
use crate::scene::{Mechanism, Outline};
use nalgebra::{Matrix3, Vector3};
use surefoot_multibody::{Closing, Joint, JointConstraint, System};

/// Thickness of rods that have none of their own, and of marks, in the size of what is shown.
const THIN: f64 = 0.018;
/// A box of a body's inertia is drawn as far as it does not hide its joints: so much longer than its longest arm.
const HIDES: f64 = 1.5;
/// Distance of the eye, in the radius of what is to be seen.
const DISTANCE: f64 = 4.2;
/// What goes along over a floor has so much more around it, to be seen moving on that.
const SURROUNDINGS: f64 = 1.6;

impl Shown {
    /// Of a mechanism, with its run's samples: these say how much room it takes.
    pub fn of_mechanism(
        mechanism: &Mechanism,
        layout: &Layout,
        samples: &[MechanismSample],
    ) -> Self {
        let room = Room::of(layout, samples);
        let thin = THIN * room.radius;
        let pivots = pivots(layout, thin);
        let bodies = layout.bodies.iter().zip(solids(mechanism, layout, thin)).enumerate();
        let robot = matches!(mechanism, Mechanism::Biped(_)).then(|| biped(Outline::A));
        let group = |k: usize| match &robot {
            Some(robot) => robot.leg_of(k).map_or(0, |leg| 1 + (leg % 2) as u8),
            None => (k % 3) as u8,
        };
        let largest = samples
            .iter()
            .flat_map(|sample| &sample.contact_forces)
            .map(|force| Vector3::from(*force).norm())
            .fold(0.0, f64::max);
        let named = robot.iter().flat_map(|_| [(1, "left leg"), (2, "right leg")]);
        Self {
            bodies: bodies
                .map(|(k, (name, solids))| ShownBody {
                    name: name.clone(),
                    group: group(k),
                    solids,
                })
                .collect(),
            points: layout
                .points
                .iter()
                .map(|point| ShownPoint { body: point.body, at: point.at })
                .collect(),
            pivots,
            block: None,
            goal: None,
            legend: named.map(|(group, name)| (group, name.to_owned())).collect(),
            force_length: if largest > 0.0 { rounded_down(room.radius / largest) } else { 0.0 },
            framing: room.framing(layout),
        }
    }
}

/// What a motion takes.
struct Room {
    /// Middle of all positions, m.
    middle: Vector3<f64>,
    /// Of what is to be seen at once, m.
    radius: f64,
    /// Of the lowest point, m.
    lowest: f64,
    /// Whether the eye goes along: the bodies hang from nothing, and leave where they were.
    follows: bool,
}

impl Room {
    fn of(layout: &Layout, samples: &[MechanismSample]) -> Self {
        let (mut low, mut high) =
            (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
        let held = is_held(layout);
        if held || samples.is_empty() {
            (low, high) = (Vector3::zeros(), Vector3::zeros());
        }
        // Of bodies from their mean, at any time.
        let mut spread: f64 = 0.0;
        // A hundred moments are enough for that.
        for sample in samples.iter().step_by((samples.len() / 100).max(1)) {
            let poses = layout.poses(sample);
            let count = poses.len().max(1) as f64;
            let mean = poses.iter().map(|pose| pose.position).sum::<Vector3<f64>>() / count;
            for pose in poses.iter().filter(|pose| pose.position.iter().all(|x| x.is_finite())) {
                (low, high) = (low.inf(&pose.position), high.sup(&pose.position));
                spread = spread.max((pose.position - mean).norm());
            }
        }
        let own = body_radius(layout);
        // It is seldom in its corners.
        let whole = 0.55 * (high - low).max() + own;
        let follows = !held && whole > 2.5 * (spread + own);
        let along = if layout.points.is_empty() { 1.0 } else { SURROUNDINGS };
        let radius = if follows { along * (spread + own) } else { whole };
        let radius = if radius.is_finite() && radius > 0.0 { radius } else { 1.0 };
        Self { middle: 0.5 * (low + high), radius, lowest: low.z - own, follows }
    }

    fn framing(&self, layout: &Layout) -> Framing {
        let has_floor = !layout.points.is_empty();
        let all = |v: f64| (!self.follows).then_some(v);
        let lowest = if has_floor { Some(0.0) } else { all(self.lowest) };
        Framing {
            target: [all(self.middle.x), all(self.middle.y), all(self.middle.z)],
            follows: None,
            distance: DISTANCE * self.radius,
            square: rounded_down(self.radius / 3.0),
            ground: lowest,
        }
    }
}

/// The next lower of 1, 2 and 5 times a power of ten.
fn rounded_down(x: f64) -> f64 {
    let power = 10.0_f64.powf(x.log10().floor());
    let first = [5.0, 2.0, 1.0].into_iter().find(|first| first * power <= x * (1.0 + 1e-9));
    first.unwrap_or(1.0) * power
}

/// Whether the world holds something.
fn is_held(layout: &Layout) -> bool {
    match &layout.kind {
        LayoutKind::Orientation | LayoutKind::Rods(_) => true,
        LayoutKind::Bodies(system) => {
            let of_world =
                system.links().iter().any(|l| l.inboard.is_none() && l.joint.constraints() > 0);
            of_world || system.closures().iter().any(|closure| closure.inboard.is_none())
        }
    }
}

/// How far a body reaches from its centre of mass, m: the longest of its arms, its contact points', and the radius of a
/// ball of its inertia.
fn body_radius(layout: &Layout) -> f64 {
    match &layout.kind {
        LayoutKind::Orientation => 0.8,
        LayoutKind::Rods(rods) => 0.1 * rods.lengths.iter().fold(0.0, |m: f64, l| m.max(*l)),
        LayoutKind::Bodies(system) => {
            let arms = (0..system.links().len()).map(|k| {
                let largest =
                    system.links()[k].body.inertia.iter().fold(0.0, |m: f64, i| m.max(*i));
                let ball = (2.5 * largest / system.links()[k].body.mass).sqrt();
                arms(system, k).iter().map(Vector3::norm).fold(ball, f64::max)
            });
            let points = layout.points.iter().map(|point| point.at.norm());
            arms.chain(points).fold(0.0, f64::max)
        }
    }
}

/// Where joints hold a body, from its centre of mass, in its frame.
fn arms(system: &System, body: usize) -> Vec<Vector3<f64>> {
    let mut arms = Vec::new();
    let has_point = |joint: &Joint| {
        !matches!(
            joint.constraint,
            JointConstraint::Floating | JointConstraint::Prismatic { .. } | JointConstraint::Fixed
        )
    };
    let links = system.links().iter().enumerate();
    let of_links = links.map(|(k, link)| (k, link.inboard, link.joint));
    let of_loops = system.closures().iter().filter_map(|closure| match &closure.closing {
        Closing::Joint(joint) => Some((closure.outboard, closure.inboard, *joint)),
        Closing::General(_) => None,
    });
    for (outboard, inboard, joint) in of_links.chain(of_loops) {
        // A body that is fixed to another is seen to be by a rod to its centre of mass.
        let fixed = joint.constraint == JointConstraint::Fixed;
        if outboard == body && has_point(&joint) {
            arms.push(joint.outboard.into());
        }
        if inboard == Some(body) && (has_point(&joint) || fixed) {
            arms.push(joint.inboard.into());
        }
    }
    arms
}

/// What each body looks like.
fn solids(mechanism: &Mechanism, layout: &Layout, thin: f64) -> Vec<Vec<Solid>> {
    match (mechanism, &layout.kind) {
        (Mechanism::RigidBody { inertia_kg_m2, .. }, _) => {
            // Its mass is of no account: the largest edge is 1 m long.
            vec![vec![inertia_box(1.0, inertia_kg_m2, 0.02).scaled_to(1.0)]]
        }
        (Mechanism::Biped(_), _) => {
            biped(Outline::A).shapes.iter().map(|shape| vec![shape.clone()]).collect()
        }
        (Mechanism::Chain { links, length_m, radius_m, .. }, _) => {
            let edge = 2.0 * radius_m;
            vec![vec![Solid::cuboid([edge, edge, *length_m])]; *links]
        }
        (_, LayoutKind::Rods(rods)) => {
            let ball = Solid::ball(2.5 * thin);
            let rod = |length: &f64| Solid::rod(Vector3::zeros(), Vector3::z() * *length, thin);
            rods.lengths.iter().map(|length| vec![rod(length), ball.clone()]).collect()
        }
        (_, LayoutKind::Bodies(system)) => {
            let points = |k: usize| layout.points.iter().filter(move |point| point.body == k);
            let points = |k: usize| points(k).map(|point| point.at).collect::<Vec<_>>();
            (0..system.links().len()).map(|k| of_body(system, k, &points(k), thin)).collect()
        }
        (_, LayoutKind::Orientation) => Vec::new(),
    }
}

/// The box of a body's inertia, and rods from its centre of mass to its joints, and to contact points outside of the box.
fn of_body(system: &System, k: usize, points: &[Vector3<f64>], thin: f64) -> Vec<Solid> {
    let body = &system.links()[k].body;
    let whole = inertia_box(body.mass, &body.inertia, thin);
    let arms = arms(system, k);
    let longest = arms.iter().map(Vector3::norm).fold(0.0, f64::max);
    let halves = Vector3::from(whole.extent()) * 0.5;
    let half = halves.max();
    let outside = |point: &&Vector3<f64>| (point.abs() - halves).max() > thin;
    let is_fit = arms.is_empty() || half <= HIDES * longest;
    let mut solids: Vec<Solid> = arms
        .iter()
        .chain(points.iter().filter(outside))
        .filter(|arm| arm.norm() > thin)
        .map(|arm| Solid::rod(Vector3::zeros(), *arm, thin))
        .collect();
    solids.push(if is_fit { whole } else { Solid::cuboid([3.0 * thin; 3]) });
    solids
}

/// The box of uniform density with these principal moments, its edges no shorter than `least`: a plate or a rod without
/// thickness has some for the eye.
fn inertia_box(mass: f64, inertia: &[f64; 3], least: f64) -> Solid {
    let total: f64 = inertia.iter().sum();
    Solid::cuboid(inertia.map(|i| (6.0 * (total - 2.0 * i) / mass).max(0.0).sqrt().max(least)))
}

/// What joints to the world are marked by.
fn pivots(layout: &Layout, thin: f64) -> Vec<Solid> {
    let mark = |at: Vector3<f64>| Solid::cuboid([3.0 * thin; 3]).moved(&Matrix3::identity(), at);
    match &layout.kind {
        LayoutKind::Orientation => Vec::new(),
        LayoutKind::Rods(_) => vec![mark(Vector3::zeros())],
        LayoutKind::Bodies(_) => {
            let of_world = layout.joints.iter().filter(|joint| joint.inboard.is_none());
            of_world
                .filter_map(|joint| match &joint.kind {
                    JointKind::Bodies(joint) => Some(mark(joint.inboard.into())),
                    JointKind::Rod => None,
                })
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_rounded_to_what_is_easily_read() {
        for (x, expected) in [(0.99, 0.5), (1.0, 1.0), (0.2, 0.2), (73.0, 50.0), (0.03, 0.02)] {
            assert!((rounded_down(x) / expected - 1.0).abs() < 1e-12, "{x}: {}", rounded_down(x));
        }
    }

    /// A plate has no thickness by its inertia, and some for the eye.
    #[test]
    fn a_plate_is_seen() {
        let [a, b, c] = inertia_box(1.0, &[1.0, 2.0, 3.0], 0.02).extent();
        assert!((a - 24.0_f64.sqrt()).abs() < 1e-12 && (b - 12.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(c, 0.02);
    }
}
