//! A joint with its outboard body, as the recursions read it.

use super::super::system::{Link, System};
use super::super::{BodyState, Joint, JointConstraint};
use super::stiffness::Pair;
use super::turn::Turn;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};
use std::ops::Range;
use surefoot::spatial::Quaternion;

/// How a joint moves: its columns, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Fixed,
    /// About axis 0, fixed to both bodies.
    Revolute,
    /// Along axis 0, fixed to the inboard body.
    Prismatic,
    /// About axis 0, fixed to the inboard body, then about axis 1, fixed to the outboard body.
    Universal,
    /// About three axes of the inboard body, which at a step's beginning are the world's.
    Spherical,
    /// Along and about the world's axes.
    Floating,
}

impl Kind {
    pub fn columns(self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute | Self::Prismatic => 1,
            Self::Universal => 2,
            Self::Spherical => 3,
            Self::Floating => 6,
        }
    }
}

/// Constants of a joint and its outboard body. Its reference point is the joint's point of the outboard
/// body; a floating body's is its centre of mass.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub kind: Kind,
    /// None for the world: then nothing inboard moves.
    pub inboard: Option<usize>,
    /// Columns, of all joints in one row.
    pub columns: Range<usize>,
    /// Contact sites, likewise.
    pub sites: Range<usize>,
    pub mass: f64,
    pub inertia: Vector3<f64>,
    /// The joint's point in the outboard and in the inboard body.
    outboard_point: Vector3<f64>,
    inboard_point: Vector3<f64>,
    home: Quaternion<f64>,
    /// Axes in the body that they are fixed to.
    axes: [Vector3<f64>; 2],
}

/// Where a joint is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Coordinates {
    /// Of a revolute or universal joint, rad; of a prismatic one, m.
    pub angles: [f64; 2],
    /// Of a floating body's centre of mass, m.
    pub position: [f64; 3],
    /// Of a floating body, world from body; of a ball, inboard from outboard.
    pub orientation: [f64; 4],
}

/// A joint's motion over a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Increment {
    /// Tangents of half the angles; of a prismatic joint the way, m.
    pub tangents: [f64; 2],
    /// Of a floating body, m.
    pub position: Vector3<f64>,
    /// Of a floating body or a ball, in world axes at the beginning.
    pub turn: Turn,
}

impl Increment {
    pub const NONE: Self =
        Self { tangents: [0.0; 2], position: Vector3::new(0.0, 0.0, 0.0), turn: Turn::NONE };

    /// A guess of the next one, in a step `ratio` times as long: that it changes as it did from the one before.
    pub fn beyond(&self, before: &Self, ratio: f64) -> Self {
        let now = self.scaled(ratio);
        let further = ratio * ratio;
        let beyond = |now: f64, last: f64, before: f64| now + further * (last - before);
        Self {
            tangents: std::array::from_fn(|i| {
                beyond(now.tangents[i], self.tangents[i], before.tangents[i])
            }),
            position: now.position + (self.position - before.position) * further,
            turn: Turn::of_vector(now.turn.v + (self.turn.v - before.turn.v) * further),
        }
    }

    /// The same in a step `ratio` times as long.
    pub fn scaled(&self, ratio: f64) -> Self {
        Self {
            tangents: self.tangents.map(|t| t * ratio),
            position: self.position * ratio,
            turn: Turn::of_vector(self.turn.v * ratio),
        }
    }
}

/// Where a body is at a step's beginning, in world axes.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub orientation: Quaternion<f64>,
    pub rotation: Matrix3<f64>,
    /// Centre of mass.
    pub center: Vector3<f64>,
    /// From the reference point to the centre of mass.
    pub to_center: Vector3<f64>,
    /// From the inboard body's reference point to this one's.
    pub from_inboard: Vector3<f64>,
    pub axes: [Vector3<f64>; 3],
    /// About the centre of mass.
    pub inertia: Matrix3<f64>,
}

impl Place {
    /// Of the world.
    pub fn world() -> Self {
        Self {
            orientation: Quaternion::identity(),
            rotation: Matrix3::identity(),
            center: Vector3::zeros(),
            to_center: Vector3::zeros(),
            from_inboard: Vector3::zeros(),
            axes: [Vector3::x(), Vector3::y(), Vector3::z()],
            inertia: Matrix3::identity(),
        }
    }
}

/// All nodes of a system, and how many columns they have.
pub(super) fn nodes(system: &System) -> (Vec<Node>, usize) {
    let (mut columns, mut sites) = (0, 0);
    let nodes = system.links().iter().enumerate().map(|(k, link)| {
        let Link { inboard, joint, body } = link;
        let (kind, axes) = match joint.constraint {
            JointConstraint::Fixed => (Kind::Fixed, [[0.0; 3]; 2]),
            JointConstraint::Revolute { axis } => (Kind::Revolute, [axis, [0.0; 3]]),
            JointConstraint::Prismatic { axis } => (Kind::Prismatic, [axis, [0.0; 3]]),
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                (Kind::Universal, [inboard_axis, outboard_axis])
            }
            JointConstraint::Spherical => (Kind::Spherical, [[0.0; 3]; 2]),
            JointConstraint::Floating => (Kind::Floating, [[0.0; 3]; 2]),
        };
        let is_floating = kind == Kind::Floating;
        let touching = system.sites().iter().filter(|site| site.link == k).count();
        let point = |point: [f64; 3]| if is_floating { Vector3::zeros() } else { point.into() };
        let node = Node {
            kind,
            inboard: if is_floating { None } else { *inboard },
            columns: columns..columns + kind.columns(),
            sites: sites..sites + touching,
            mass: body.mass,
            inertia: body.inertia.into(),
            outboard_point: point(joint.outboard),
            inboard_point: point(joint.inboard),
            home: Quaternion::from_array(joint.home),
            axes: axes.map(Vector3::from),
        };
        columns += kind.columns();
        sites += touching;
        node
    });
    let nodes = nodes.collect();
    (nodes, columns)
}

impl Node {
    /// Coordinates that put the body where a state says, as far as the joint lets it.
    pub fn coordinates(joint: &Joint, state: &BodyState, inboard: &BodyState) -> Coordinates {
        let q = |x: &BodyState| Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let (q_o, q_i, home) = (q(state), q(inboard), Quaternion::from_array(joint.home));
        let relative = q_i.conjugate().product(q_o);
        let mut all = Coordinates {
            angles: [0.0; 2],
            position: [state[0], state[1], state[2]],
            orientation: relative.to_array(),
        };
        let angle = |turned: Quaternion<f64>, axis: [f64; 3]| {
            let [s, x, y, z] = turned.to_array();
            let along = axis[0] * x + axis[1] * y + axis[2] * z;
            // One of the two quaternions of this orientation turns by less than half a turn.
            2.0 * f64::atan2(along * 1.0_f64.copysign(s), s.abs())
        };
        match joint.constraint {
            JointConstraint::Fixed | JointConstraint::Spherical => {}
            JointConstraint::Floating => all.orientation = q_o.to_array(),
            JointConstraint::Revolute { axis } => {
                all.angles[0] = angle(home.conjugate().product(relative), axis);
            }
            JointConstraint::Prismatic { axis } => {
                let at = |x: &BodyState, q: Quaternion<f64>, arm: [f64; 3]| {
                    Vector3::new(x[0], x[1], x[2]) + q.rotate(arm.into())
                };
                let apart = at(state, q_o, joint.outboard) - at(inboard, q_i, joint.inboard);
                all.angles[0] = apart.dot(&q_i.rotate(axis.into()));
            }
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                let about = Vector3::from(inboard_axis);
                let from = home.rotate(outboard_axis.into());
                let to = relative.rotate(outboard_axis.into());
                let first = f64::atan2(about.dot(&from.cross(&to)), from.dot(&to));
                let turned = Quaternion::from_axis_angle(about, first).product(home);
                all.angles = [first, angle(turned.conjugate().product(relative), outboard_axis)];
            }
        }
        all
    }

    /// Where the body is. Angles are taken as they are, so that no error of rounding adds up.
    pub fn place(&self, at: &Coordinates, inboard: &Place) -> Place {
        let turned = |axis: &Vector3<f64>, angle: f64| Quaternion::from_axis_angle(*axis, angle);
        let q_i = inboard.orientation;
        let given = Quaternion::from_array(at.orientation);
        let orientation = match self.kind {
            Kind::Fixed | Kind::Prismatic => q_i.product(self.home),
            Kind::Revolute => q_i.product(self.home).product(turned(&self.axes[0], at.angles[0])),
            Kind::Universal => q_i
                .product(turned(&self.axes[0], at.angles[0]))
                .product(self.home)
                .product(turned(&self.axes[1], at.angles[1])),
            Kind::Spherical => q_i.product(given),
            Kind::Floating => given,
        };
        let rotation = orientation.to_matrix();
        let mut axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        match self.kind {
            Kind::Revolute => axes[0] = rotation * self.axes[0],
            Kind::Prismatic => axes[0] = inboard.rotation * self.axes[0],
            Kind::Universal => {
                axes[0] = inboard.rotation * self.axes[0];
                axes[1] = rotation * self.axes[1];
            }
            Kind::Fixed | Kind::Spherical | Kind::Floating => {}
        }
        let to_center = -(rotation * self.outboard_point);
        let (center, from_inboard) = if self.kind == Kind::Floating {
            (Vector3::from(at.position), Vector3::from(at.position))
        } else {
            let mut arm = inboard.rotation * self.inboard_point;
            if self.kind == Kind::Prismatic {
                arm += axes[0] * at.angles[0];
            }
            (inboard.center + arm + to_center, inboard.to_center + arm)
        };
        let inertia = rotation * Matrix3::from_diagonal(&self.inertia) * rotation.transpose();
        Place { orientation, rotation, center, to_center, from_inboard, axes, inertia }
    }

    /// Where the joint is after a step.
    pub fn moved(&self, from: &Coordinates, by: &Increment, inboard: &Place) -> Coordinates {
        let mut to = *from;
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute | Kind::Universal => {
                for (angle, tangent) in to.angles.iter_mut().zip(by.tangents) {
                    *angle += 2.0 * tangent.atan();
                }
            }
            Kind::Prismatic => to.angles[0] += by.tangents[0],
            Kind::Spherical => {
                // From world axes to those of the inboard body.
                let turn = Turn { c: by.turn.c, v: inboard.rotation.tr_mul(&by.turn.v) };
                to.orientation = turn.turned(from.orientation);
            }
            Kind::Floating => {
                for (x, way) in to.position.iter_mut().zip(by.position.iter()) {
                    *x += way;
                }
                to.orientation = by.turn.turned(from.orientation);
            }
        }
        to
    }
}

impl Node {
    /// An increment with a share of a correction of its end.
    #[inline]
    pub fn corrected(&self, base: &Increment, by: &[f64], share: f64) -> Increment {
        let mut to = *base;
        // d tan(θ/2) = ½ (1 + tan²(θ/2)) dθ
        let tangent = |t: f64, by: f64| t + 0.5 * share * (1.0 + t * t) * by;
        let turned = |by: &[f64]| {
            Turn::cayley(Vector3::new(by[0], by[1], by[2]) * (0.5 * share)).after(&base.turn)
        };
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute => to.tangents[0] = tangent(base.tangents[0], by[0]),
            Kind::Prismatic => to.tangents[0] += share * by[0],
            Kind::Universal => {
                to.tangents[0] = tangent(base.tangents[0], by[0]);
                to.tangents[1] = tangent(base.tangents[1], by[1]);
            }
            Kind::Spherical => to.turn = turned(by),
            Kind::Floating => {
                to.position += Vector3::new(by[0], by[1], by[2]) * share;
                to.turn = turned(&by[3..]);
            }
        }
        to
    }

    /// Adds the joint's own motion at these rates to its inboard body's.
    pub fn add_rates(&self, place: &Place, rates: &[f64], motion: &mut Pair) {
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute => motion.angular += place.axes[0] * rates[0],
            Kind::Prismatic => motion.linear += place.axes[0] * rates[0],
            Kind::Universal => {
                motion.angular += place.axes[0] * rates[0] + place.axes[1] * rates[1];
            }
            Kind::Spherical => motion.angular += Vector3::new(rates[0], rates[1], rates[2]),
            Kind::Floating => {
                motion.linear += Vector3::new(rates[0], rates[1], rates[2]);
                motion.angular += Vector3::new(rates[3], rates[4], rates[5]);
            }
        }
    }
}
