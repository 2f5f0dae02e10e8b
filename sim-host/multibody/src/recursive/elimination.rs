//! Newton's equations of a step, in time linear in its joints: one elimination from the leaves to the root,
//! and any number of solutions with it.
//!
//! It is Algorithm 5.1 with constraints and multipliers out of the way: `M̂` of (5.22) is a 6 × 6 matrix, and
//! of a joint there is left what moves. The stiffness of a part of the tree, and the impulse on it, are
//! taken at its joint, freed of the joint's columns one by one, and handed inboard.

use super::bond::Bond;
use super::end::End;
use super::node::{Kind, Node, Place};
use super::stiffness::{Column, Pair, Stiffness, skew_times, times_skew};
use super::trial::{Touch, Trial};
use super::turn::{Turn, skew};
use nalgebra::{Matrix3, Vector3};

/// The eliminated equations.
#[derive(Clone, Debug)]
pub(super) struct Elimination {
    columns: Vec<Column>,
    /// Axes and arms that they belong to: beginning and end, by node.
    geometry: Vec<Geometry>,
    /// Of a node with all outboard.
    stiffness: Vec<Stiffness>,
    impulses: Vec<Pair>,
    motions: Vec<Pair>,
    /// By column: what is left of its equation when its turn comes.
    left: Vec<f64>,
    /// Free bodies that touch others now, by striker: these are the last nodes.
    bonds: Vec<Option<Bond>>,
}

/// Axes and arms at a step's beginning and at a trial's end.
#[derive(Clone, Copy, Debug)]
struct Geometry {
    axes: [[Vector3<f64>; 3]; 2],
    from_inboard: [Vector3<f64>; 2],
}

impl Elimination {
    pub fn new(nodes: usize, columns: usize, strikers: usize) -> Self {
        let nothing = [Vector3::zeros(); 3];
        Self {
            columns: vec![Column::NONE; columns],
            geometry: vec![
                Geometry { axes: [nothing; 2], from_inboard: [Vector3::zeros(); 2] };
                nodes
            ],
            stiffness: vec![Stiffness::ZERO; nodes],
            impulses: vec![Pair::ZERO; nodes],
            motions: vec![Pair::ZERO; nodes],
            left: vec![0.0; columns],
            bonds: vec![None; strikers],
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
        trial: &Trial,
        h: f64,
    ) -> Result<(), usize> {
        for (k, part) in self.stiffness.iter_mut().enumerate() {
            *part = own_stiffness(&nodes[k], &places[k], &trial.ends[k], &trial.touches, h);
        }
        for (number, strike) in trial.strikes.iter().enumerate() {
            let k = strike.link;
            self.bonds[number] = None;
            match strike.stiffness(h) {
                None => self.factor_node(k, nodes, places, trial)?,
                Some(contact) => {
                    let part = &self.stiffness[k];
                    let arms = strike.arms(places, &trial.ends);
                    let (bond, passed) = Bond::new(strike.struck, arms, part, &contact).ok_or(k)?;
                    self.stiffness[bond.to].add_shifted(&passed, &arms[0], &arms[1]);
                    self.bonds[number] = Some(bond);
                }
            }
        }
        for k in (0..nodes.len() - trial.strikes.len()).rev() {
            self.factor_node(k, nodes, places, trial)?;
        }
        Ok(())
    }

    #[inline(always)]
    fn factor_node(
        &mut self,
        k: usize,
        nodes: &[Node],
        places: &[Place],
        trial: &Trial,
    ) -> Result<(), usize> {
        let (node, place, end) = (&nodes[k], &places[k], &trial.ends[k]);
        let (turn_i, moved_i) = match node.inboard {
            Some(i) => (trial.ends[i].turn, trial.ends[i].displacement),
            None => (Turn::NONE, Vector3::zeros()),
        };
        let geometry = Geometry {
            axes: [place.axes, node.axes_at_end(place, &turn_i, &end.turn)],
            from_inboard: [place.from_inboard, place.from_inboard + end.displacement - moved_i],
        };
        self.geometry[k] = geometry;
        let part = &mut self.stiffness[k];
        let first = node.columns.start;
        let slopes = &trial.own_slopes[node.columns.clone()];
        let mut keep = |c: usize, column: Option<Column>| match column {
            Some(column) => {
                self.columns[first + c] = column;
                Ok(())
            }
            None => Err(k),
        };
        let [begin, end] = &geometry.axes;
        match node.kind {
            Kind::Fixed => {}
            Kind::Revolute => {
                keep(0, part.eliminate_turn(&begin[0], &end[0], -slopes[0]))?;
            }
            Kind::Prismatic => {
                keep(0, part.eliminate_shift(&begin[0], &end[0], -slopes[0]))?;
            }
            Kind::Universal => {
                keep(0, part.eliminate_turn(&begin[0], &end[0], 0.0))?;
                keep(1, part.eliminate_turn(&begin[1], &end[1], 0.0))?;
            }
            Kind::Spherical => {
                for i in 0..3 {
                    keep(i, part.eliminate_ball_turn(i, &end[i]))?;
                }
            }
            Kind::Floating => {
                for i in 0..6 {
                    keep(i, part.eliminate_free(i))?;
                }
            }
        }
        if let Some(inboard) = node.inboard {
            let part = *part;
            let [begin, end] = &geometry.from_inboard;
            self.stiffness[inboard].add_shifted(&part, begin, end);
        }
        Ok(())
    }

    /// Solves for the motions of all columns that take away these impulses: `impulse` on a body about its
    /// reference point, and `own` of a column.
    pub fn solve(
        &mut self,
        nodes: &[Node],
        impulse: impl Fn(usize) -> Pair,
        own: impl Fn(usize) -> f64,
        corrections: &mut [f64],
    ) {
        for (k, z) in self.impulses.iter_mut().enumerate() {
            *z = impulse(k);
        }
        let tree = nodes.len() - self.bonds.len();
        for k in tree..nodes.len() {
            let Some(bond) = &self.bonds[k - tree] else {
                self.collect(k, nodes, &own);
                continue;
            };
            let mut z = self.impulses[k];
            let first = nodes[k].columns.start;
            z.subtract(&Pair::of_columns(|c| own(first + c)));
            self.impulses[bond.to].add_shifted(&bond.passed(&z), &bond.arms[0]);
            self.impulses[k] = z;
        }
        for k in (0..tree).rev() {
            self.collect(k, nodes, &own);
        }
        for k in 0..tree {
            self.distribute(k, nodes, corrections);
        }
        for k in tree..nodes.len() {
            let Some(bond) = &self.bonds[k - tree] else {
                self.distribute(k, nodes, corrections);
                continue;
            };
            let motion = bond.motion(&self.impulses[k], &self.motions[bond.to]);
            let own = &mut corrections[nodes[k].columns.clone()];
            own.copy_from_slice(motion.vector().as_slice());
            self.motions[k] = motion;
        }
    }

    /// The same of impulses on a few nodes, with all others of their trees: `near`, ascending. Nothing else moves.
    pub fn solve_near(
        &mut self,
        nodes: &[Node],
        near: &[usize],
        impulse: impl Fn(usize) -> Pair,
        corrections: &mut [f64],
    ) {
        self.motions.fill(Pair::ZERO);
        corrections.fill(0.0);
        for k in near {
            self.impulses[*k] = impulse(*k);
        }
        for k in near.iter().rev() {
            self.collect(*k, nodes, &|_| 0.0);
        }
        for k in near {
            self.distribute(*k, nodes, corrections);
        }
    }

    /// Takes the impulse on a node, with what is outboard, to its columns, and hands the rest inboard.
    #[inline(always)]
    fn collect(&mut self, k: usize, nodes: &[Node], own: &impl Fn(usize) -> f64) {
        let node = &nodes[k];
        let mut z = self.impulses[k];
        let Geometry { axes: [axes, _], from_inboard: [arm, _] } = &self.geometry[k];
        let first = node.columns.start;
        let columns = &self.columns[node.columns.clone()];
        let all_left = &mut self.left[node.columns.clone()];
        let mut take = |i: usize, along: f64, z: &mut Pair| {
            let (left, column) = (along - own(first + i), &columns[i]);
            all_left[i] = left;
            let share = left * column.inverse;
            z.linear -= column.impulse.linear * share;
            z.angular -= column.impulse.angular * share;
        };
        match node.kind {
            Kind::Fixed => {}
            Kind::Revolute => take(0, axes[0].dot(&z.angular), &mut z),
            Kind::Prismatic => take(0, axes[0].dot(&z.linear), &mut z),
            Kind::Universal => {
                take(0, axes[0].dot(&z.angular), &mut z);
                take(1, axes[1].dot(&z.angular), &mut z);
            }
            Kind::Spherical => (0..3).for_each(|i| take(i, z.angular[i], &mut z)),
            Kind::Floating => {
                (0..3).for_each(|i| take(i, z.linear[i], &mut z));
                (0..3).for_each(|i| take(3 + i, z.angular[i], &mut z));
            }
        }
        if let Some(inboard) = node.inboard {
            self.impulses[inboard].add_shifted(&z, arm);
        }
    }

    /// Takes the motion of what is inboard, with that of a node's columns, outboard.
    #[inline(always)]
    fn distribute(&mut self, k: usize, nodes: &[Node], corrections: &mut [f64]) {
        let node = &nodes[k];
        let Geometry { axes: [_, axes], from_inboard: [_, arm] } = &self.geometry[k];
        let mut motion = match node.inboard {
            None => Pair::ZERO,
            Some(i) => {
                let Pair { linear, angular } = self.motions[i];
                Pair { linear: linear + angular.cross(arm), angular }
            }
        };
        let columns = &self.columns[node.columns.clone()];
        let left = &self.left[node.columns.clone()];
        let corrections = &mut corrections[node.columns.clone()];
        let mut give = |i: usize, motion: &Pair| {
            let column = &columns[i];
            let by = -(left[i] + column.answer.dot(motion)) * column.inverse;
            corrections[i] = by;
            by
        };
        match node.kind {
            Kind::Fixed => {}
            Kind::Revolute => motion.angular += axes[0] * give(0, &motion),
            Kind::Prismatic => motion.linear += axes[0] * give(0, &motion),
            Kind::Universal => {
                motion.angular += axes[1] * give(1, &motion);
                motion.angular += axes[0] * give(0, &motion);
            }
            Kind::Spherical => {
                (0..3).rev().for_each(|i| motion.angular += axes[i] * give(i, &motion));
            }
            Kind::Floating => {
                (0..3).rev().for_each(|i| motion.angular[i] += give(3 + i, &motion));
                (0..3).rev().for_each(|i| motion.linear[i] += give(i, &motion));
            }
        }
        self.motions[k] = motion;
    }

    /// Motions of the reference points in the last solution.
    pub fn motions(&self) -> &[Pair] {
        &self.motions
    }
}

/// A body's own stiffness, and that of the floor under it.
#[inline(always)]
fn own_stiffness(node: &Node, place: &Place, end: &End, touches: &[Touch], h: f64) -> Stiffness {
    // With the end turned by δφ more: δ(c, v) = ½ (−v·δφ, N δφ), N = c 1 − v̂, so that
    // ∂L/∂φ = 1/h [(c I − (I v)^ + v̂ I) N − (I v) vᵀ].
    let (c, v, iv) = (end.turn.c, &end.turn.v, &end.inertia_turn);
    let left = place.inertia * c - skew(iv) + skew_times(v, &place.inertia);
    let turning = (left * c - times_skew(&left, v) - iv * v.transpose()) / h;
    let mut part = Stiffness::of_body(node.mass / h, &turning, &place.to_center, &end.to_center);
    for touch in &touches[node.sites.clone()] {
        if touch.force.slope != Matrix3::zeros() {
            let k = touch.force.slope * (-0.5 * h);
            part.add_point(&k, &(place.to_center + touch.begin), &(end.to_center + touch.end));
        }
    }
    part
}
