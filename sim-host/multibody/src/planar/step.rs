//! The equations of one step in a plane, at a trial of its end.
//!
//! # Notation
//! For each body, over the step: `φ` its turn, `c, s` cosine and sine of half of it, `d` the mean velocity of its
//! centre of mass, `J` its moment of inertia, `g` gravity, `f` the forces on it.
//! ```text
//! L  = 2/h J c s = J/h sin φ                                 (2.51) with v = s n̂ and I n̂ = J n̂
//! w⁻ = (m d − ½h m g − ½h Σ f,  L − ½h Σ ℓ⁻ × f)        impulse on the body at the step's beginning
//! w⁺ = (m d + ½h m g + ½h Σ f,  L + ½h Σ ℓ⁺ × f)        momentum at its end
//! r_j = H_j⁻ · Σ outboard w⁻ − π_j − ½h τ_j = 0          (1)
//! π_j ← H_j⁺ · Σ outboard w⁺ + ½h τ_j                    (2)
//! ```
//! These are the equations of space, which [`super::super::recursive`] has, seen along the normal: what is left
//! out is zero, or borne by joints.

use super::algebra::{Pair, Rotation, Turn, cross};
use super::node::{Kind, Node, Place};
use super::simulation::{Law, PlanarSimulation};
use nalgebra::Vector2;

/// Where a body is at the trial's end, and the impulse on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub turn: Turn,
    pub rotation: Rotation,
    /// Of the reference point.
    pub displacement: Vector2<f64>,
    pub to_center: Vector2<f64>,
    pub from_inboard: Vector2<f64>,
    pub axis: Vector2<f64>,
    /// `m d`, `L`
    pub momentum: Pair,
    /// `w⁻` about the reference point: the body's own, then that of all outboard.
    pub own: Pair,
    pub all: Pair,
}

impl End {
    /// Of a body that has not moved.
    pub const AT_REST: Self = {
        let zero = Vector2::new(0.0, 0.0);
        Self {
            turn: Turn::NONE,
            rotation: Rotation::NONE,
            displacement: zero,
            to_center: zero,
            from_inboard: zero,
            axis: zero,
            momentum: Pair::ZERO,
            own: Pair::ZERO,
            all: Pair::ZERO,
        }
    };
}

/// What all bodies have in common in a step: its length, one over it, and half of what gravity does in it to the
/// momentum of a kilogram.
struct Span {
    h: f64,
    per_step: f64,
    weight: Vector2<f64>,
}

/// A force and its moment about the reference point, along a joint's columns.
#[inline(always)]
pub(super) fn project(node: &Node, place: &Place, all: &Pair, along: &mut impl FnMut(usize, f64)) {
    let c = node.column;
    match node.kind {
        Kind::Fixed => {}
        Kind::Revolute => along(c, all.angular),
        Kind::Prismatic => along(c, place.axis.dot(&all.linear)),
        Kind::Floating => {
            along(c, all.linear.x);
            along(c + 1, all.linear.y);
            along(c + 2, all.angular);
        }
    }
}

impl PlanarSimulation {
    /// Positions of the points that can touch the floor, and the motors' impulses, where a step begins.
    pub(super) fn begin_step(&mut self, h: f64) {
        for (impulse, torque) in self.own_impulses.iter_mut().zip(&self.torques) {
            *impulse = 0.5 * h * torque;
        }
        if !self.touches.is_empty() {
            for (node, place) in self.nodes.iter().zip(&self.places) {
                for touch in &mut self.touches[node.touches.clone()] {
                    touch.begin = place.rotation.rotate(&touch.arm);
                }
            }
        }
    }

    /// Evaluates (1) at the increments; tells `‖r‖²` of [`crate::scale`].
    #[inline]
    pub(super) fn residuals(&mut self, h: f64) -> f64 {
        let span = Span { h, per_step: 1.0 / h, weight: self.gravity * (0.5 * h) };
        for k in 0..self.nodes.len() {
            self.ends[k] = self.end(k, &span);
        }
        self.find_laws(h);
        let mut sum = 0.0;
        for k in (0..self.nodes.len()).rev() {
            let (node, place, all) = (&self.nodes[k], &self.places[k], self.ends[k].all);
            let (momenta, own) = (&self.at.momenta, &self.own_impulses);
            let weights = &self.scales.weights;
            project(node, place, &all, &mut |c, along| {
                let relative = (along - momenta[c] - own[c]) * weights[c];
                sum += relative * relative;
            });
            if let Some(inboard) = node.inboard {
                self.ends[inboard].all.add_shifted(&all, &place.from_inboard);
            }
        }
        sum
    }

    /// Torques of springs, dampers and stops.
    fn find_laws(&mut self, h: f64) {
        let half = 0.5 * h;
        for Law { column, .. } in &self.laws {
            self.own_impulses[*column] = half * self.torques[*column];
            self.own_slopes[*column] = 0.0;
        }
        for (Law { node, column, law, sign }, angle) in self.laws.iter().zip(&self.at.angles) {
            let way = self.way(*node, *column) * sign;
            let (torque, slope) = law.over_step(*angle, way, h);
            let (rotor, rotor_slope) = law.rotor(way, h);
            self.own_impulses[*column] += sign * (half * torque - rotor);
            self.own_slopes[*column] += half * slope - rotor_slope;
        }
    }

    /// Rotors' momenta from what (1) takes from the joints' impulses to what (2) adds to them. The increments are still
    /// those of the step.
    pub(super) fn end_rotors(&mut self, h: f64) {
        for Law { node, column, law, .. } in &self.laws {
            if law.rotor_inertia != 0.0 {
                self.own_impulses[*column] += 2.0 * law.rotor(self.way(*node, *column), h).0;
            }
        }
    }

    /// What a joint moves by in the trial: rad, or m.
    pub(super) fn way(&self, node: usize, column: usize) -> f64 {
        let increment = self.increments[column];
        if self.nodes[node].kind == Kind::Prismatic { increment } else { 2.0 * increment.atan() }
    }

    /// Where a body is in the trial.
    #[inline(always)]
    fn end(&mut self, k: usize, span: &Span) -> End {
        let (node, place) = (&self.nodes[k], &self.places[k]);
        let by = &self.increments[node.column..];
        let (turn_i, rotation_i, moved_i) = match node.inboard {
            Some(i) => {
                let end = &self.ends[i];
                (end.turn, end.rotation, end.displacement)
            }
            None => (Turn::NONE, Rotation::NONE, Vector2::zeros()),
        };
        let (mut turn, mut rotation, mut axis) = (turn_i, rotation_i, place.axis);
        let mut displacement = match node.inboard {
            Some(_) => moved_i + rotation_i.displacement(&place.from_inboard),
            None => moved_i,
        };
        match node.kind {
            Kind::Fixed => {}
            Kind::Revolute => {
                turn = Turn::of_tangent(by[0]).and(&turn_i);
                rotation = turn.rotation();
            }
            Kind::Prismatic => {
                axis = rotation_i.rotate(&place.axis);
                displacement += axis * by[0];
            }
            Kind::Floating => {
                displacement = Vector2::new(by[0], by[1]);
                turn = Turn::of_tangent(by[2]);
                rotation = turn.rotation();
            }
        }
        let of_center = rotation.displacement(&place.to_center);
        let moved = displacement + of_center;
        let velocity = moved * span.per_step;
        let momentum = Pair {
            linear: velocity * node.mass,
            angular: node.moment * span.per_step * rotation.sine,
        };
        let mut linear = momentum.linear - span.weight * node.mass;
        let mut angular = momentum.angular;
        if let Some(ground) = self.system.ground() {
            let center = place.reference + place.to_center;
            let memories = &self.at.memories[node.touches.clone()];
            for (touch, memory) in self.touches[node.touches.clone()].iter_mut().zip(memories) {
                let way = rotation.displacement(&touch.begin);
                touch.meet(ground, memory, &center, (&moved, &way), span.h);
                let impulse = touch.at_begin(span.h);
                linear -= impulse.linear;
                angular -= impulse.angular;
            }
        }
        let own = Pair { linear, angular: angular + cross(&place.to_center, &linear) };
        End {
            turn,
            rotation,
            displacement,
            to_center: place.to_center + of_center,
            from_inboard: place.from_inboard + displacement - moved_i,
            axis,
            momentum,
            own,
            all: own,
        }
    }

    /// `w⁺` of a body alone, about its reference point where the step leads to.
    pub(super) fn end_momentum(&self, k: usize, h: f64) -> Pair {
        let (node, end) = (&self.nodes[k], &self.ends[k]);
        let Pair { mut linear, mut angular } = end.momentum;
        linear += self.gravity * (0.5 * h * node.mass);
        // Without a floor there is nothing to look through.
        let touches =
            if self.touches.is_empty() { &[] } else { &self.touches[node.touches.clone()] };
        for touch in touches {
            let impulse = touch.at_end(h);
            linear += impulse.linear;
            angular += impulse.angular;
        }
        Pair { linear, angular: angular + cross(&self.places[k].to_center, &linear) }
    }
}
