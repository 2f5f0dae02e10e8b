//! Newton's equations of a step in a plane, in time linear in its joints: Algorithm 5.1 as
//! [`super::super::recursive`] has it, with 3 × 3 matrices.

use super::algebra::{Column, Pair, Stiffness, cross, quarter};
use super::node::{Kind, Node, Place};
use super::step::End;
use super::touch::Touch;
use nalgebra::Vector2;

/// The eliminated equations.
#[derive(Clone, Debug)]
pub(super) struct Elimination {
    columns: Vec<Column>,
    /// By node: of a prismatic joint's axis, and of the arm from the inboard body, the end.
    axes: Vec<Vector2<f64>>,
    arms: Vec<Vector2<f64>>,
    /// Of a node with all outboard.
    stiffness: Vec<Stiffness>,
    impulses: Vec<Pair>,
    motions: Vec<Pair>,
    /// By column: what is left of its equation when its turn comes.
    left: Vec<f64>,
}

const UNITS: [Vector2<f64>; 2] = [Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)];

impl Elimination {
    pub fn new(nodes: usize, columns: usize) -> Self {
        Self {
            columns: vec![Column::NONE; columns],
            axes: vec![Vector2::zeros(); nodes],
            arms: vec![Vector2::zeros(); nodes],
            stiffness: vec![Stiffness::ZERO; nodes],
            impulses: vec![Pair::ZERO; nodes],
            motions: vec![Pair::ZERO; nodes],
            left: vec![0.0; columns],
        }
    }

    /// Eliminates at a trial that has been evaluated, for steps of `h`.
    ///
    /// # Errors
    /// The node whose joint's equations are singular.
    pub fn factor(
        &mut self,
        nodes: &[Node],
        places: &[Place],
        ends: &[End],
        touches: &[Touch],
        own_slopes: &[f64],
        h: f64,
    ) -> Result<(), usize> {
        let per_step = 1.0 / h;
        self.stiffness.fill(Stiffness::ZERO);
        for k in (0..nodes.len()).rev() {
            let (node, place, end) = (&nodes[k], &places[k], &ends[k]);
            let part = &mut self.stiffness[k];
            // ∂L/∂φ = J/h cos φ
            let turning = node.moment * per_step * (1.0 - end.rotation.versine);
            part.add_body(node.mass * per_step, turning, &place.to_center, &end.to_center);
            if !touches.is_empty() {
                for touch in &touches[node.touches.clone()] {
                    touch.add_to(part, &place.to_center, &end.to_center, h);
                }
            }
            let c = node.column;
            match node.kind {
                Kind::Fixed => {}
                Kind::Revolute => {
                    self.columns[c] = part.eliminate_turn(-own_slopes[c]).ok_or(k)?;
                }
                Kind::Prismatic => {
                    let column = part.eliminate_shift(&place.axis, &end.axis, -own_slopes[c]);
                    self.columns[c] = column.ok_or(k)?;
                    self.axes[k] = end.axis;
                }
                Kind::Floating => {
                    for (i, unit) in UNITS.iter().enumerate() {
                        self.columns[c + i] = part.eliminate_shift(unit, unit, 0.0).ok_or(k)?;
                    }
                    self.columns[c + 2] = part.eliminate_turn(0.0).ok_or(k)?;
                }
            }
            if let Some(inboard) = node.inboard {
                let part = *part;
                self.arms[k] = end.from_inboard;
                self.stiffness[inboard].add_shifted(&part, &place.from_inboard, &end.from_inboard);
            }
        }
        Ok(())
    }

    /// Solves for the motions of all columns that take away these impulses: `impulse` on a body about its
    /// reference point, and `own` of a column.
    pub fn solve(
        &mut self,
        nodes: &[Node],
        places: &[Place],
        impulse: impl Fn(usize) -> Pair,
        own: impl Fn(usize) -> f64,
        corrections: &mut [f64],
    ) {
        self.impulses.fill(Pair::ZERO);
        for (k, node) in nodes.iter().enumerate().rev() {
            let mut z = impulse(k);
            z.linear += self.impulses[k].linear;
            z.angular += self.impulses[k].angular;
            for i in 0..node.kind.columns() {
                let c = node.column + i;
                let along = match (node.kind, i) {
                    (Kind::Prismatic, _) => places[k].axis.dot(&z.linear),
                    (Kind::Floating, 0..2) => z.linear[i],
                    _ => z.angular,
                };
                let left = along - own(c);
                self.left[c] = left;
                let column = &self.columns[c];
                let share = left * column.inverse;
                z.linear -= column.impulse.linear * share;
                z.angular -= column.impulse.angular * share;
            }
            if let Some(inboard) = node.inboard {
                let arm = &places[k].from_inboard;
                self.impulses[inboard].linear += z.linear;
                self.impulses[inboard].angular += z.angular + cross(arm, &z.linear);
            }
        }
        for (k, node) in nodes.iter().enumerate() {
            let mut motion = match node.inboard {
                None => Pair::ZERO,
                Some(i) => {
                    let Pair { linear, angular } = self.motions[i];
                    Pair { linear: linear + quarter(&self.arms[k]) * angular, angular }
                }
            };
            for i in (0..node.kind.columns()).rev() {
                let c = node.column + i;
                let column = &self.columns[c];
                let answer = column.answer.linear.dot(&motion.linear)
                    + column.answer.angular * motion.angular;
                let by = -(self.left[c] + answer) * column.inverse;
                corrections[c] = by;
                match (node.kind, i) {
                    (Kind::Prismatic, _) => motion.linear += self.axes[k] * by,
                    (Kind::Floating, 0..2) => motion.linear[i] += by,
                    _ => motion.angular += by,
                }
            }
            self.motions[k] = motion;
        }
    }
}
