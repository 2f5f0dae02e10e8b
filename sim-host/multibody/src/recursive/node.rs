//! A joint with its outboard body, as the recursions read it.

use super::super::JointConstraint;
use super::super::system::{Link, System};
use super::coordinates::Coordinates;
use super::stiffness::Pair;
use super::turn::Turn;
use nalgebra::{Matrix3, Vector3};
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

    /// Axes in the body that each is fixed to.
    pub fn axes_in_body(&self) -> &[Vector3<f64>; 2] {
        &self.axes
    }

    /// The columns' axes at a step's end, from the turns of the inboard and the outboard body.
    #[inline]
    pub fn axes_at_end(&self, place: &Place, inboard: &Turn, outboard: &Turn) -> [Vector3<f64>; 3] {
        let mut axes = place.axes;
        match self.kind {
            Kind::Fixed | Kind::Floating => {}
            Kind::Revolute | Kind::Prismatic => axes[0] = inboard.rotate(&axes[0]),
            Kind::Universal => {
                axes[0] = inboard.rotate(&axes[0]);
                axes[1] = outboard.rotate(&axes[1]);
            }
            Kind::Spherical => axes = axes.map(|axis| inboard.rotate(&axis)),
        }
        axes
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
