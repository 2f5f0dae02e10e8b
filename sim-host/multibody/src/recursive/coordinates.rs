//! Where joints are, and how they move over a step.

use super::super::{BodyState, Joint, JointConstraint};
use super::node::{Kind, Node, Place};
use super::turn::Turn;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use surefoot::spatial::Quaternion;

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

    /// The same in a step `ratio` times as long.
    pub fn scaled(&self, ratio: f64) -> Self {
        Self {
            tangents: self.tangents.map(|t| t * ratio),
            position: self.position * ratio,
            turn: Turn::of_vector(self.turn.v * ratio),
        }
    }
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

    /// An increment by column: tangents of half angles, ways, the vector part of a turn.
    #[inline]
    pub fn ways(&self, of: &Increment, ways: &mut [f64]) {
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute | Kind::Prismatic => ways[0] = of.tangents[0],
            Kind::Universal => ways.copy_from_slice(&of.tangents),
            Kind::Spherical => ways.copy_from_slice(of.turn.v.as_slice()),
            Kind::Floating => {
                ways[..3].copy_from_slice(of.position.as_slice());
                ways[3..].copy_from_slice(of.turn.v.as_slice());
            }
        }
    }

    /// The increment that these are of.
    #[inline]
    pub fn increment(&self, ways: &[f64; 6]) -> Increment {
        let mut all = Increment::NONE;
        let [a, b, c, d, e, f] = *ways;
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute | Kind::Prismatic => all.tangents[0] = a,
            Kind::Universal => all.tangents = [a, b],
            Kind::Spherical => all.turn = Turn::of_vector(Vector3::new(a, b, c)),
            Kind::Floating => {
                all.position = Vector3::new(a, b, c);
                all.turn = Turn::of_vector(Vector3::new(d, e, f));
            }
        }
        all
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

    /// Adds an increment, times a factor, to what there is by column.
    pub fn add_mean_rates(&self, by: &Increment, factor: f64, rates: &mut [f64]) {
        let angle = |tangent: f64| 2.0 * tangent.atan() * factor;
        let turned = by.turn.rotation_vector() * factor;
        match self.kind {
            Kind::Fixed => {}
            Kind::Revolute => rates[0] += angle(by.tangents[0]),
            Kind::Prismatic => rates[0] += by.tangents[0] * factor,
            Kind::Universal => {
                rates[0] += angle(by.tangents[0]);
                rates[1] += angle(by.tangents[1]);
            }
            Kind::Spherical => rates.iter_mut().zip(turned.iter()).for_each(|(r, t)| *r += t),
            Kind::Floating => {
                let moved = by.position * factor;
                let both = moved.iter().chain(turned.iter());
                rates.iter_mut().zip(both).for_each(|(r, x)| *r += x);
            }
        }
    }

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
}
