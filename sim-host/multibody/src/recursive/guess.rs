//! Where Newton's method begins a step: the increments of those before, carried on.
//!
//! # Notation
//! `x_n` the increments of step n by column, `∇` backward differences. Carried on as a polynomial of degree p they
//! give `x_n + ∇x_n + … + ∇ᵖx_n`, of which `x_{n+1}` is `∇ᵖ⁺¹x_{n+1}` away. So the degree is chosen for which the last
//! of these was least, as multistep methods choose their order: the highest where a motion is smooth, the lowest
//! where something has touched.

use super::coordinates::Increment;
use super::node::Node;
use serde::{Deserialize, Serialize};

/// Backward differences that are kept: `∇⁰` to `∇³`.
const KEPT: usize = 4;

/// What is known of the increments' course.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Guess {
    /// `∇ᵖ x_n`, by column.
    differences: [Vec<f64>; KEPT],
    /// `p`
    degree: usize,
}

impl Guess {
    /// Of no motion.
    pub fn new(columns: usize) -> Self {
        Self { differences: [(); KEPT].map(|()| vec![0.0; columns]), degree: 1 }
    }

    /// Of steps that are all like this one.
    pub fn start(&mut self, nodes: &[Node], increments: &[Increment]) {
        let [first, others @ ..] = &mut self.differences;
        for (node, increment) in nodes.iter().zip(increments) {
            node.ways(increment, &mut first[node.columns.clone()]);
        }
        others.iter_mut().for_each(|all| all.fill(0.0));
    }

    /// For steps `ratio` times as long: as a straight line.
    pub fn scale(&mut self, ratio: f64) {
        let factors = [ratio, ratio * ratio, 0.0, 0.0];
        for (all, factor) in self.differences.iter_mut().zip(factors) {
            all.iter_mut().for_each(|x| *x *= factor);
        }
    }

    /// The last increments, by column, as long as the next ones.
    pub fn last(&self) -> &[f64] {
        &self.differences[0]
    }

    /// The next increments.
    pub fn make(&self, nodes: &[Node], increments: &mut [Increment]) {
        let [d0, d1, d2, d3] = &self.differences;
        let [second, third] = [2, 3].map(|p| f64::from(u8::from(self.degree >= p)));
        for (node, increment) in nodes.iter().zip(increments) {
            let mut ways = [0.0; 6];
            for (way, c) in ways.iter_mut().zip(node.columns.clone()) {
                *way = d0[c] + d1[c] + second * d2[c] + third * d3[c];
            }
            *increment = node.increment(&ways);
        }
    }

    /// Takes up the increments of a step that is solved.
    pub fn learn(&mut self, nodes: &[Node], increments: &[Increment]) {
        let [d0, d1, d2, d3] = &mut self.differences;
        let mut missed = [0.0; KEPT - 1];
        for (node, increment) in nodes.iter().zip(increments) {
            let mut ways = [0.0; 6];
            node.ways(increment, &mut ways[..node.columns.len()]);
            for (way, c) in ways.iter().zip(node.columns.clone()) {
                let n1 = way - d0[c];
                let n2 = n1 - d1[c];
                let n3 = n2 - d2[c];
                let n4 = n3 - d3[c];
                (d0[c], d1[c], d2[c], d3[c]) = (*way, n1, n2, n3);
                for (sum, x) in missed.iter_mut().zip([n2, n3, n4]) {
                    *sum += x * x;
                }
            }
        }
        let [first, second, third] = missed;
        self.degree = if third < second && third < first {
            3
        } else if second < first {
            2
        } else {
            1
        };
    }

    /// Takes another one's place without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        for (to, from) in self.differences.iter_mut().zip(&other.differences) {
            to.copy_from_slice(from);
        }
        self.degree = other.degree;
    }

    /// How many columns it has, by degree.
    pub fn sizes(&self) -> [usize; KEPT] {
        self.differences.each_ref().map(Vec::len)
    }
}

#[cfg(test)]
mod tests {
    use super::super::node::nodes;
    use super::*;
    use crate::{Body, Joint, JointConstraint, Link, System};
    use nalgebra::Vector3;

    fn free_body() -> Vec<Node> {
        let joint = Joint {
            outboard: [0.0; 3],
            inboard: [0.0; 3],
            home: [1.0, 0.0, 0.0, 0.0],
            constraint: JointConstraint::Floating,
        };
        let body = Body { mass: 1.0, inertia: [1.0; 3] };
        let system = System::new(vec![Link { inboard: None, joint, body }], 0.0);
        nodes(&system.expect("a system")).0
    }

    fn way(x: f64) -> Vec<Increment> {
        vec![Increment { position: Vector3::new(x, -x, 0.5 * x), ..Increment::NONE }]
    }

    /// Cubic courses are carried on exactly; for two steps after a jump, a straight line is drawn.
    #[test]
    fn smooth_courses_are_carried_on_and_jumps_are_not() {
        let nodes = free_body();
        let course = |n: i32| {
            let t = 0.1 * f64::from(n);
            1.0 + 2.0 * t - 0.7 * t * t + 0.3 * t * t * t
        };
        let mut guess = Guess::new(6);
        guess.start(&nodes, &way(course(0)));
        let mut next = way(0.0);
        for n in 1..8 {
            guess.learn(&nodes, &way(course(n)));
        }
        guess.make(&nodes, &mut next);
        assert_eq!(guess.degree, 3);
        assert!((next[0].position - way(course(8))[0].position).norm() < 1e-13);
        for n in 8..10 {
            guess.learn(&nodes, &way(5.0 + course(n)));
        }
        guess.make(&nodes, &mut next);
        let line = 5.0 + 2.0 * course(9) - course(8);
        assert_eq!(guess.degree, 1);
        assert!((next[0].position - way(line)[0].position).norm() < 1e-12);
        // In steps half as long, the same line.
        guess.scale(0.5);
        guess.make(&nodes, &mut next);
        let shorter = 0.5 * (5.0 + course(9)) + 0.25 * (course(9) - course(8));
        assert!((next[0].position - way(shorter)[0].position).norm() < 1e-12);
    }
}
