//! A joint with its outboard body, as the recursions in a plane read it.

use super::super::body::BodyState;
use super::super::joint::JointConstraint;
use super::super::system::System;
use super::algebra::{Rotation, Turn};
use super::plane::{Body, Plane};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// How a joint moves: its columns, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Fixed,
    Revolute,
    /// Along an axis of the inboard body.
    Prismatic,
    /// Along both axes of the plane, and a turn.
    Floating,
}

impl Kind {
    pub fn columns(self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute | Self::Prismatic => 1,
            Self::Floating => 3,
        }
    }
}

/// Constants of a joint and its outboard body, in the plane's axes, as they are at the start of the motion: there
/// all turns are zero. The reference point is the joint's point of the outboard body; a floating body's is its
/// centre of mass.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub kind: Kind,
    pub inboard: Option<usize>,
    /// Its first column.
    pub column: usize,
    /// Touches, of all bodies in one row.
    pub touches: Range<usize>,
    pub mass: f64,
    /// About the plane's normal, through the centre of mass.
    pub moment: f64,
    /// From the inboard body's reference point, or the world's origin, to this one's.
    pub lever: Vector2<f64>,
    /// From the reference point to the centre of mass.
    pub arm: Vector2<f64>,
    /// Of a prismatic joint.
    pub axis: Vector2<f64>,
    /// Whether a revolute joint's angle counts about the plane's normal, 1, or against it, −1; of others 1.
    pub sense: f64,
}

/// How far a joint is from where it was at the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Coordinates {
    /// Of a revolute joint, or of a floating body against the world.
    pub turn: Turn,
    /// Of a prismatic joint the first number; of a floating body from where it was.
    pub way: Vector2<f64>,
}

impl Coordinates {
    pub const START: Self = Self { turn: Turn::NONE, way: Vector2::new(0.0, 0.0) };
}

/// Where a body is at a step's beginning, in the plane's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Since the start.
    pub turn: Turn,
    pub rotation: Rotation,
    pub reference: Vector2<f64>,
    pub to_center: Vector2<f64>,
    /// From the inboard body's reference point to this one's.
    pub from_inboard: Vector2<f64>,
    pub axis: Vector2<f64>,
}

impl Place {
    /// Of the world.
    pub const WORLD: Self = {
        let zero = Vector2::new(0.0, 0.0);
        Self {
            turn: Turn::NONE,
            rotation: Rotation::NONE,
            reference: zero,
            to_center: zero,
            from_inboard: zero,
            axis: zero,
        }
    };
}

impl Node {
    /// Where the body is.
    #[inline]
    pub fn place(&self, at: &Coordinates, inboard: &Place) -> Place {
        let mut place = Place {
            from_inboard: inboard.rotation.rotate(&self.lever),
            axis: self.axis,
            ..*inboard
        };
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute => {
                place.turn = at.turn.and(&inboard.turn);
                place.rotation = place.turn.rotation();
            }
            Kind::Prismatic => {
                place.axis = inboard.rotation.rotate(&self.axis);
                place.from_inboard += place.axis * at.way.x;
            }
            Kind::Floating => {
                place.turn = at.turn;
                place.rotation = at.turn.rotation();
                place.from_inboard += at.way;
            }
        }
        place.reference = inboard.reference + place.from_inboard;
        place.to_center = place.rotation.rotate(&self.arm);
        place
    }
}

/// All nodes of a system in its plane, and how many columns they have. `touches` tells the points of each link.
pub(super) fn nodes(
    system: &System,
    plane: &Plane,
    states: &[BodyState],
    touches: impl Fn(usize) -> Range<usize>,
) -> (Vec<Node>, usize) {
    let bodies: Vec<Body> = states.iter().map(|x| Body::of(x, &[0.0; 7])).collect();
    let mut columns = 0;
    let mut references: Vec<Vector3<f64>> = Vec::with_capacity(bodies.len());
    let nodes = system.links().iter().zip(&bodies).enumerate().map(|(k, (link, body))| {
        let q = body.orientation;
        let joint = &link.joint;
        let mut sense = 1.0;
        let (kind, axis) = match joint.constraint {
            JointConstraint::Revolute { axis } => {
                sense = q.rotate(axis.into()).dot(&plane.normal).signum();
                (Kind::Revolute, Vector2::zeros())
            }
            JointConstraint::Prismatic { axis } => {
                let axis = Vector3::from(axis);
                let world = link.inboard.map_or(axis, |i| bodies[i].orientation.rotate(axis));
                (Kind::Prismatic, plane.seen(&world))
            }
            JointConstraint::Floating => (Kind::Floating, Vector2::zeros()),
            // The plane has been checked: others do not move.
            _ => (Kind::Fixed, Vector2::zeros()),
        };
        let is_floating = kind == Kind::Floating;
        let arm = if is_floating { Vector3::zeros() } else { -q.rotate(joint.outboard.into()) };
        let inboard = if is_floating { None } else { link.inboard };
        let reference = body.center - arm;
        let from = inboard.map_or(Vector3::zeros(), |i| references[i]);
        references.push(reference);
        let normal = q.conjugate().rotate(plane.normal);
        let node = Node {
            kind,
            inboard,
            column: columns,
            touches: touches(k),
            mass: link.body.mass,
            moment: normal.dot(&Vector3::from(link.body.inertia).component_mul(&normal)),
            lever: plane.seen(&(reference - from)),
            arm: plane.seen(&arm),
            axis,
            sense,
        };
        columns += kind.columns();
        node
    });
    let nodes = nodes.collect();
    (nodes, columns)
}
