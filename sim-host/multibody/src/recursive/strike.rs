//! Forces between a free body's points and the box around another body, over a trial of a step.
//!
//! # Notation
//! World axes; `s` the striker, `a` the body struck, `p⁻, p⁺` a point at the step's ends, `R_m` the
//! orientation of `a` half way.
//! ```text
//! a_i = Rᵀ (p − x_a) at either end,  F = R_m F_box(a⁻, a⁺)                                       (1)
//! ```
//! `F` acts on the striker and `−F` on the body struck, half at the step's beginning and half at its end, at
//! the same places `p⁻` and `p⁺`: momentum and moment of momentum are kept exactly.

use super::end::End;
use super::node::Place;
use super::stiffness::{Pair, Stiffness};
use super::turn::Turn;
use crate::contact::{BoxForce, BoxPoint};
use crate::{Striker, System};
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// A striker's points, in a trial.
#[derive(Clone, Debug)]
pub(super) struct Strike {
    pub link: usize,
    pub struck: usize,
    /// Its points, among those of all strikers.
    pub points: Range<usize>,
    /// In the striker.
    arms: Vec<Vector3<f64>>,
    /// `p⁻ − x_s`, and `p⁻` in the box, by point.
    begin: Vec<(Vector3<f64>, Vector3<f64>)>,
    /// `F` (N) and its slope with respect to `p⁺`, world axes, with the arms `p⁺ − x_s`.
    forces: Vec<(BoxForce, Vector3<f64>)>,
    radius: f64,
    /// Whether some point may feel something in this step; of the trial, whether some point does.
    is_near: bool,
    is_felt: bool,
}

impl Strike {
    /// Of all strikers of a system.
    pub fn all(system: &System) -> Vec<Self> {
        let mut next = 0;
        let of = |striker: &Striker| {
            let n = striker.points.len();
            let nothing = BoxForce {
                force: Vector3::zeros(),
                slope: Matrix3::zeros(),
                point: BoxPoint::default(),
            };
            let arms: Vec<Vector3<f64>> = striker.points.iter().map(|p| (*p).into()).collect();
            let start = next;
            next += n;
            Self {
                link: striker.link,
                struck: striker.struck,
                points: start..next,
                radius: arms.iter().fold(0.0, |r, arm| f64::max(r, arm.norm())),
                begin: vec![(Vector3::zeros(), Vector3::zeros()); n],
                forces: vec![(nothing, Vector3::zeros()); n],
                arms,
                is_near: false,
                is_felt: false,
            }
        };
        system.strikers().iter().map(of).collect()
    }

    /// Where a step begins. A striker that is farther away than it can come in one step costs no more
    /// than this.
    pub fn begin(&mut self, striker: &Striker, places: &[Place], speed: f64, h: f64) {
        let (of, on) = (&places[self.link], &places[self.struck]);
        let center = on.center + on.rotation * Vector3::from(striker.around.center);
        let reach = self.radius + striker.around.radius() + REACH * speed * h;
        self.is_near = (of.center - center).norm() < reach;
        self.is_felt = false;
        if !self.is_near {
            return;
        }
        for (begin, arm) in self.begin.iter_mut().zip(&self.arms) {
            let arm = of.rotation * arm;
            *begin = (arm, on.rotation.tr_mul(&(of.center + arm - on.center)));
        }
    }

    /// (1) at the ends of a trial, and the impulses at its beginning: they are added to both bodies'.
    pub fn evaluate(
        &mut self,
        striker: &Striker,
        memories: &[BoxPoint],
        places: &[Place],
        ends: &mut [End],
        h: f64,
    ) {
        if !self.is_near {
            return;
        }
        self.is_felt = false;
        let (of, on) = (&places[self.link], &places[self.struck]);
        let (end_of, end_on) = (&ends[self.link], &ends[self.struck]);
        let x_of = center_at(of, end_of);
        let x_on = center_at(on, end_on);
        let back = Turn { c: end_on.turn.c, v: -end_on.turn.v };
        let to_box = |arm: &Vector3<f64>| on.rotation.tr_mul(&back.rotate(&(x_of - x_on + arm)));
        let half_way = Turn::of_vector(end_on.turn.v * (0.5 / (0.5 + 0.5 * end_on.turn.c).sqrt()));
        let mut total = [Pair::ZERO; 2];
        for (k, (force, arm)) in self.forces.iter_mut().enumerate() {
            let (begin, a0) = &self.begin[k];
            *arm = begin + end_of.turn.displacement(begin);
            let memory = &memories[self.points.start + k];
            let found = memory.over_step(&striker.around, striker.switching, a0, &to_box(arm), h);
            *force = found;
            if found.force == Vector3::zeros() && found.slope == Matrix3::zeros() {
                continue;
            }
            self.is_felt = true;
            force.force = half_way.rotate(&(on.rotation * found.force));
            let columns = |turn: &Turn| {
                let column = |i: usize| turn.rotate(&on.rotation.column(i).into_owned());
                Matrix3::from_columns(&[column(0), column(1), column(2)])
            };
            force.slope = columns(&half_way) * found.slope * columns(&end_on.turn).transpose();
            let half = force.force * (0.5 * h);
            let about = [*begin, of.center + begin - on.center + on.to_center];
            for (sum, (arm, sign)) in total.iter_mut().zip(about.iter().zip([1.0, -1.0])) {
                sum.linear += half * sign;
                sum.angular += arm.cross(&half) * sign;
            }
        }
        if self.is_felt {
            for (body, impulse) in [self.link, self.struck].into_iter().zip(&total) {
                ends[body].own.subtract(impulse);
                ends[body].all = ends[body].own;
            }
        }
    }

    /// Adds the impulses at the step's end to the momenta of both bodies, about their reference points there.
    pub fn add_end_impulses(&self, places: &[Place], ends: &mut [End], h: f64) {
        if !self.is_felt {
            return;
        }
        let (of, on) = (&places[self.link], &places[self.struck]);
        let apart = of.center - on.center + on.to_center;
        for (force, arm) in &self.forces {
            let half = force.force * (0.5 * h);
            let moments = [arm.cross(&half), -(apart + arm).cross(&half)];
            let linear = [half, -half];
            for (i, body) in [self.link, self.struck].into_iter().enumerate() {
                ends[body].all.linear += linear[i];
                ends[body].all.angular += moments[i];
            }
        }
    }

    /// How the impulse on the striker answers to its own motion against the body struck; none where there is
    /// no contact.
    pub fn stiffness(&self, h: f64) -> Option<Stiffness> {
        self.is_felt.then(|| {
            let mut all = Stiffness::ZERO;
            for ((force, end), (begin, _)) in self.forces.iter().zip(&self.begin) {
                if force.slope != Matrix3::zeros() {
                    all.add_point(&(force.slope * (-0.5 * h)), begin, end);
                }
            }
            all
        })
    }

    /// What its points remember after the step, and the mean force on it, N.
    pub fn remember(&self, memories: &mut [BoxPoint]) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        for (k, memory) in memories[self.points.clone()].iter_mut().enumerate() {
            let force = if self.is_near { Some(&self.forces[k].0) } else { None };
            *memory = force.map_or_else(BoxPoint::default, |force| force.point);
            sum += force.map_or_else(Vector3::zeros, |force| force.force);
        }
        sum
    }

    /// Largest force of a point over a step, with what its springs' numbers are made of, as an impulse, N·s.
    pub fn felt(&self, h: f64) -> f64 {
        if !self.is_felt {
            return 0.0;
        }
        let each = self.forces.iter().zip(&self.begin).map(|((force, arm), (_, begin))| {
            let at = begin.abs().max() + arm.abs().max();
            force.force.abs().max() + force.slope.abs().max() * at
        });
        (0.5 * h * each.sum::<f64>()).abs()
    }

    /// Nothing is felt: for velocities, which belong to steps of no length.
    pub fn forget(&mut self) {
        self.is_felt = false;
    }

    /// Energy in the springs of the faces, J.
    pub fn spring_energy(&self, striker: &Striker, memories: &[BoxPoint], places: &[Place]) -> f64 {
        let (of, on) = (&places[self.link], &places[self.struck]);
        let each = memories[self.points.clone()].iter().zip(&self.arms).map(|(memory, arm)| {
            let p = of.center + of.rotation * arm - on.center;
            memory.spring_energy(&striker.around, &on.rotation.tr_mul(&p))
        });
        each.sum()
    }

    /// From the struck body's reference point to the striker's, at the step's beginning and at a trial's end.
    pub fn arms(&self, places: &[Place], ends: &[End]) -> [Vector3<f64>; 2] {
        let (of, on) = (&places[self.link], &places[self.struck]);
        let begin = of.center - on.center + on.to_center;
        [begin, begin + ends[self.link].displacement - ends[self.struck].displacement]
    }
}

/// How much faster than the fastest body so far, and both bodies, something may move in the next step.
const REACH: f64 = 8.0;

/// Centre of mass at a trial's end.
fn center_at(place: &Place, end: &End) -> Vector3<f64> {
    place.center + end.displacement + (end.to_center - place.to_center)
}
