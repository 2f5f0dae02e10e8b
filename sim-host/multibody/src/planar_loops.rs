//! Loops in which everything moves in one plane: a hinge that closes one keeps two points together in the plane, where
//! it would say five things of which three are always true.

use super::body::BodyState;
use super::closure::{Closing, Closure, ConstraintFunction};
use super::joint::{Joint, JointConstraint, across, rotated};
use super::system::System;
use nalgebra::Vector3;
use num_dual::Dual64;
use std::sync::Arc;

/// Two axes of the plane, in the inboard body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct InPlane {
    pub axes: [[f64; 3]; 2],
}

/// Sine of the angle by which axes may be off.
const PARALLEL: f64 = 1e-12;

/// By closure, the plane that its loop moves in, if it does.
pub(super) fn planar_loops(system: &System, states: &[BodyState]) -> Vec<Option<InPlane>> {
    let in_plane = |closure: &Closure| {
        let Closing::Joint(Joint { constraint: JointConstraint::Revolute { axis }, home, .. }) =
            &closure.closing
        else {
            return None;
        };
        let normal = Vector3::from(in_world(states, Some(closure.outboard), axis));
        let joined = loop_links(system, closure);
        let moves_in_it = |link: &usize| {
            let link_of = &system.links()[*link];
            let along = |v: [f64; 3]| Vector3::from(v).cross(&normal).norm();
            match &link_of.joint.constraint {
                JointConstraint::Fixed => true,
                JointConstraint::Revolute { axis } => {
                    along(in_world(states, Some(*link), axis)) <= PARALLEL
                }
                JointConstraint::Prismatic { axis } => {
                    let along = in_world(states, link_of.inboard, axis);
                    Vector3::from(along).dot(&normal).abs() <= PARALLEL
                }
                _ => false,
            }
        };
        let axes = across(&rotated(home, axis));
        joined.iter().all(moves_in_it).then_some(InPlane { axes })
    };
    system.closures().iter().map(in_plane).collect()
}

fn in_world(states: &[BodyState], link: Option<usize>, axis: &[f64; 3]) -> [f64; 3] {
    link.map_or(*axis, |link| {
        let [_, _, _, q @ ..] = states[link];
        rotated(&q, axis)
    })
}

/// Links whose joints are in the loop: those on the way from one of its bodies to the world, and not from the other.
fn loop_links(system: &System, closure: &Closure) -> Vec<usize> {
    let way = |link: Option<usize>| -> Vec<usize> {
        std::iter::successors(link, |link| system.links()[*link].inboard).collect()
    };
    let (a, b) = (way(Some(closure.outboard)), way(closure.inboard));
    let only = |one: &[usize], other: &[usize]| -> Vec<usize> {
        one.iter().copied().filter(|link| !other.contains(link)).collect()
    };
    [only(&a, &b), only(&b, &a)].concat()
}

/// The same system whose planar loops have two equations each, and bear no force across their plane.
pub fn with_planar_loops(system: System, states: &[BodyState]) -> System {
    let planes = planar_loops(&system, states);
    let closures = system.closures().iter().zip(planes).map(|(closure, plane)| {
        let (Closing::Joint(joint), Some(InPlane { axes })) = (&closure.closing, plane) else {
            return closure.clone();
        };
        let together = TogetherInPlane { joint: *joint, axes };
        Closure { closing: Closing::General(Arc::new(together)), ..closure.clone() }
    });
    let closures = closures.collect();
    system.with_closures(closures)
}

/// A joint's points, together along two axes.
#[derive(Debug)]
struct TogetherInPlane {
    joint: Joint,
    axes: [[f64; 3]; 2],
}

impl ConstraintFunction for TogetherInPlane {
    fn constraints(&self) -> usize {
        2
    }

    fn evaluate(&self, outboard: &[Dual64; 7], inboard: &[Dual64; 7]) -> [Dual64; 6] {
        let q = |x: &[Dual64; 7]| [x[3], x[4], x[5], x[6]];
        let (q_o, q_i) = (q(outboard), q(inboard));
        let (at_o, at_i) =
            (rotated(&q_o, &self.joint.outboard), rotated(&q_i, &self.joint.inboard));
        let mut all = [Dual64::from(0.0); 6];
        for (to, axis) in all.iter_mut().zip(&self.axes) {
            let axis = rotated(&q_i, axis);
            for k in 0..3 {
                *to += axis[k] * (outboard[k] + at_o[k] - inboard[k] - at_i[k]);
            }
        }
        all
    }
}
