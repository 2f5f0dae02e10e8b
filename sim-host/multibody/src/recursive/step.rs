//! The equations of one step, at a trial of its end.
//!
//! # Notation
//! World axes. For each body, over the step: `(c, v)` its turn as a unit quaternion, `d` the mean velocity
//! of its centre of mass, `I` its inertia at the beginning, `f` the forces on it.
//! ```text
//! p  = m d,   L = 2/h (c I v + v × I v)        momenta of (2.51) and of the midpoint rule, in world axes
//! w⁻ = (p + ½h m g ẑ − ½h Σ f,  L − ½h Σ ℓ⁻ × f)        impulse on the body at the step's beginning
//! w⁺ = (p − ½h m g ẑ + ½h Σ f,  L + ½h Σ ℓ⁺ × f)        momentum at its end
//! r_j = H_j⁻ · Σ outboard w⁻ + I_j θ_j/h − π_j − ½h τ_j = 0           (1)
//! π_j ← H_j⁺ · Σ outboard w⁺ + I_j θ_j/h + ½h τ_j                     (2)
//! ```
//! (1) is (5.11) multiplied by the joints' columns `H` at the step's beginning, which takes the constraint
//! forces away; that the constraints hold is in the coordinates. A body that turns freely keeps `L`. A joint with a
//! rotor of inertia `I` turns by `θ` over the step.
//!
//! Forces are taken at the points where they act, half at the step's beginning and half at its end, with
//! the arms of either: then their moment about any point is that of the mean position.

use super::end::End;
use super::loops::Loops;
use super::node::{Kind, Node, Place};
use super::stiffness::Pair;
use super::trial::{Law, Loads, Trial};
use super::turn::Turn;
use crate::System;
use crate::contact::{BoxPoint, ContactPoint};
use nalgebra::Vector3;

/// What stays the same over all trials of a step.
pub(super) struct Step<'a> {
    pub system: &'a System,
    pub nodes: &'a [Node],
    pub places: &'a [Place],
    pub angles: &'a dyn Fn(usize) -> f64,
    pub momenta: &'a [f64],
    pub memories: &'a [ContactPoint],
    pub strikes: &'a [BoxPoint],
    pub loads: &'a Loads,
    pub h: f64,
}

impl Trial {
    /// Positions of the contact sites and of strikers' points, where a step begins.
    pub fn begin(
        &mut self,
        system: &System,
        nodes: &[Node],
        places: &[Place],
        fastest: f64,
        h: f64,
    ) {
        for (node, place) in nodes.iter().zip(places) {
            for touch in &mut self.touches[node.sites.clone()] {
                touch.begin = place.rotation * touch.arm;
            }
        }
        // What a loop over no strikers would prepare is not computed either.
        if !self.strikes.is_empty() {
            for (strike, striker) in self.strikes.iter_mut().zip(system.strikers()) {
                strike.begin(striker, places, fastest, h);
            }
        }
    }

    /// Evaluates (1) at the increments, with the loops' multipliers, if there are loops.
    pub fn evaluate(&mut self, step: &Step, loops: Option<(&Loops, &[f64])>) {
        for k in 0..step.nodes.len() {
            self.end(step, k);
        }
        if !self.strikes.is_empty() {
            for (strike, striker) in self.strikes.iter_mut().zip(step.system.strikers()) {
                strike.evaluate(striker, step.strikes, step.places, &mut self.ends, step.h);
            }
        }
        for (body, impulse) in loops.into_iter().flat_map(|(loops, m)| loops.impulses(m)) {
            let end = &mut self.ends[body];
            end.own.subtract(&impulse);
            end.all = end.own;
        }
        self.own_forces(step);
        for k in (0..step.nodes.len()).rev() {
            let (node, place) = (&step.nodes[k], &step.places[k]);
            let all = self.ends[k].all;
            let first = node.columns.start;
            let mut along = |column: usize, impulse: f64| {
                let c = first + column;
                self.residuals[c] = impulse - step.momenta[c] - self.own_impulses[c];
            };
            project(node, place, &all, &mut along);
            if let Some(inboard) = node.inboard {
                self.ends[inboard].all.add_shifted(&all, &place.from_inboard);
            }
        }
    }

    /// Torques on the joints.
    fn own_forces(&mut self, step: &Step) {
        let half = 0.5 * step.h;
        for (impulse, torque) in self.own_impulses.iter_mut().zip(&step.loads.torques) {
            *impulse = half * torque;
        }
        for (column, torque) in &self.motor_torques {
            for i in 0..3 {
                self.own_impulses[column + i] = half * torque[i];
            }
        }
        if self.laws.is_empty() {
            return;
        }
        self.own_slopes.fill(0.0);
        for k in 0..self.laws.len() {
            let Law { node, column, law } = self.laws[k];
            let way = self.way(step.nodes, node);
            let (torque, slope) = law.over_step((step.angles)(node), way, step.h);
            let (rotor, rotor_slope) = law.rotor(way, step.h);
            self.own_impulses[column] += half * torque - rotor;
            self.own_slopes[column] += half * slope - rotor_slope;
        }
    }

    /// Rotors' momenta from what (1) takes from the joints' impulses to what (2) adds to them. The increments are still
    /// those of the step.
    pub fn end_rotors(&mut self, nodes: &[Node], h: f64) {
        for k in 0..self.laws.len() {
            let Law { node, column, law } = self.laws[k];
            if law.rotor_inertia != 0.0 {
                self.own_impulses[column] += 2.0 * law.rotor(self.way(nodes, node), h).0;
            }
        }
    }

    /// What a joint of one coordinate moves by: rad, or m.
    pub fn way(&self, nodes: &[Node], node: usize) -> f64 {
        let tangent = self.increments[node].tangents[0];
        if nodes[node].kind == Kind::Prismatic { tangent } else { 2.0 * tangent.atan() }
    }

    /// Where a body is at the trial's end, and the impulse on it alone.
    #[inline]
    fn end(&mut self, step: &Step, k: usize) {
        let (node, place, by) = (&step.nodes[k], &step.places[k], &self.increments[k]);
        let (turn_i, moved_i) = match node.inboard {
            Some(i) => (self.ends[i].turn, self.ends[i].displacement),
            None => (Turn::NONE, Vector3::zeros()),
        };
        let mut displacement = moved_i + turn_i.displacement(&place.from_inboard);
        let turn = match node.kind {
            Kind::Fixed => turn_i,
            Kind::Revolute => turn_i.after(&Turn::cayley(place.axes[0] * by.tangents[0])),
            Kind::Prismatic => {
                displacement += turn_i.rotate(&place.axes[0]) * by.tangents[0];
                turn_i
            }
            Kind::Universal => turn_i
                .after(&Turn::cayley(place.axes[0] * by.tangents[0]))
                .after(&Turn::cayley(place.axes[1] * by.tangents[1])),
            Kind::Spherical => turn_i.after(&by.turn),
            Kind::Floating => {
                displacement = by.position;
                by.turn
            }
        };
        let of_center = turn.displacement(&place.to_center);
        let h = step.h;
        let velocity = (displacement + of_center) / h;
        let inertia_turn = place.inertia * turn.v;
        let spin = (inertia_turn * turn.c + turn.v.cross(&inertia_turn)) * (2.0 / h);
        let load = &step.loads.wrenches[k];
        let mut linear = velocity * node.mass - load.linear * (0.5 * h);
        linear.z += 0.5 * h * node.mass * step.system.gravity();
        let mut angular = spin - load.angular * (0.5 * h);
        if let Some((floor, switching)) = step.system.ground() {
            let memories = &step.memories[node.sites.clone()];
            for (touch, memory) in self.touches[node.sites.clone()].iter_mut().zip(memories) {
                let way = turn.displacement(&touch.begin);
                touch.end = touch.begin + way;
                let p = place.center + touch.begin;
                let way = displacement + of_center + way;
                touch.force = match &touch.plane {
                    None => memory.over_step(floor, *switching, p, way, h),
                    Some(plane) => plane.over_step(memory, (floor, *switching), p, way, h),
                };
                let half = touch.force.force * (0.5 * h);
                linear -= half;
                angular -= touch.begin.cross(&half);
            }
        }
        let own = Pair { linear, angular: angular + place.to_center.cross(&linear) };
        let to_center = place.to_center + of_center;
        self.ends[k] =
            End { turn, displacement, to_center, velocity, inertia_turn, spin, own, all: own };
    }

    /// Momenta at the end, about the reference points there, for every body alone: `w⁺`. The arms are those
    /// of the places that the step leads to.
    pub fn end_momentum(&self, step: &Step, k: usize, to: &Place) -> Pair {
        let (node, end, half) = (&step.nodes[k], &self.ends[k], 0.5 * step.h);
        let load = &step.loads.wrenches[k];
        let mut linear = end.velocity * node.mass + load.linear * half;
        linear.z -= half * node.mass * step.system.gravity();
        let mut angular = end.spin + load.angular * half;
        for touch in &self.touches[node.sites.clone()] {
            let impulse = touch.force.force * half;
            linear += impulse;
            angular += touch.end.cross(&impulse);
        }
        Pair { linear, angular: angular + to.to_center.cross(&linear) }
    }
}

/// A force and its moment about the reference point, along a joint's columns.
#[inline]
pub(super) fn project(node: &Node, place: &Place, all: &Pair, along: &mut impl FnMut(usize, f64)) {
    match node.kind {
        Kind::Fixed => {}
        Kind::Revolute => along(0, place.axes[0].dot(&all.angular)),
        Kind::Prismatic => along(0, place.axes[0].dot(&all.linear)),
        Kind::Universal => {
            along(0, place.axes[0].dot(&all.angular));
            along(1, place.axes[1].dot(&all.angular));
        }
        Kind::Spherical => {
            for i in 0..3 {
                along(i, all.angular[i]);
            }
        }
        Kind::Floating => {
            for i in 0..3 {
                along(i, all.linear[i]);
                along(3 + i, all.angular[i]);
            }
        }
    }
}
