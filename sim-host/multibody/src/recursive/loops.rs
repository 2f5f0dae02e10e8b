//! Constraints beside the tree, which close its loops: solved by the Schur complement of the tree.
//!
//! # Notation
//! `T(r)` the tree's solution `A δ = −r`; `G⁻, G⁺` the constraints' rows at the step's beginning and end,
//! `λ` their impulses:
//! ```text
//! A δ − G⁻ᵀ δλ = −r,  G⁺ δ = −g   ⇒   δ = T(r) + T(−G⁻ᵀ) δλ,  S δλ = −g − G⁺ T(r),  S = G⁺ T(−G⁻ᵀ)
//! ```
//! Cost: one solution of the tree for each constraint, and elimination of a small dense matrix.

use super::super::BodyState;
use super::super::closure::Closure;
use super::super::joint::JointConstraint;
use super::super::scale::beyond;
use super::super::system::{System, WORLD};
use super::closing_rows::{ClosingRow, Seen, closing_rows};
use super::elimination::Elimination;
use super::node::{Node, Place};
use super::stiffness::Pair;
use super::trial::Trial;
use nalgebra::Vector3;

/// All closures' constraints, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Loops {
    rows: Vec<Row>,
    /// Of the constraints' impulses `λ`, N·s or N·m·s.
    pub corrections: Vec<f64>,
    /// `T(−G⁻ᵀ)`: motions of all columns, by constraint.
    answers: Vec<f64>,
    schur: Vec<f64>,
    /// Pivots in their order, rows and columns; those that are none are left out.
    pivots: Vec<(usize, usize)>,
    columns: usize,
    /// Of all arms of the system, and its bodies' radii of gyration, m.
    length: f64,
    /// Nodes of the trees that each constraint's bodies belong to; none where there are few constraints.
    near: Vec<Vec<usize>>,
    /// Impulses of closing joints' motors at a step's beginning, by body.
    driven: Vec<(usize, Pair)>,
}

/// One constraint: its bodies, its derivative at the beginning and at the end, and its error there.
#[derive(Clone, Copy, Debug)]
struct Row {
    bodies: [Option<usize>; 2],
    begin: [Pair; 2],
    end: [Pair; 2],
    error: f64,
    /// What makes a length of the error: 1 of one that displacements change, or the system's length of an angle's, m.
    arm: f64,
    /// How far the bodies at the end are from the origin, m: their positions are rounded to this.
    away: f64,
}

/// Pivots that are no more than round-off beside the first: constraints that say what others say already.
const DEPENDENT: f64 = 1e-9;

impl Loops {
    pub fn new(system: &System, columns: usize) -> Self {
        let mut rows = Vec::new();
        for closure in system.closures() {
            let bodies = [Some(closure.outboard), closure.inboard];
            for _ in 0..closure.constraints() {
                rows.push(Row { bodies, ..Row::NONE });
            }
        }
        let n = rows.len();
        let near = if n > MANY && system.strikers().is_empty() {
            rows.iter().map(|row| near(system, row)).collect()
        } else {
            Vec::new()
        };
        Self {
            near,
            rows,
            corrections: vec![0.0; n],
            answers: vec![0.0; n * columns],
            schur: vec![0.0; n * n],
            pivots: Vec::with_capacity(n),
            columns,
            length: system.length(),
            driven: Vec::with_capacity(2 * system.closing_motors().len()),
        }
    }

    /// How many constraints.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Rows at the beginning of a step.
    pub fn begin(&mut self, closures: &[Closure], places: &[Place]) {
        let state = |k: usize| {
            let place = &places[k];
            (body_state(&place.center, place.orientation.to_array()), place.to_center)
        };
        let length = self.length;
        self.each(closures, state, |row, found, _| {
            row.begin = found.pairs;
            let moves = |pair: &Pair| pair.linear != Vector3::zeros();
            row.arm = if found.pairs.iter().any(moves) { 1.0 } else { length };
        });
    }

    /// Impulses of closing joints' motors at the beginning of a step.
    pub fn drive(&mut self, impulses: impl Iterator<Item = (usize, Pair)>) {
        self.driven.clear();
        self.driven.extend(impulses);
    }

    /// Rows and errors at a trial's end.
    pub fn end(&mut self, closures: &[Closure], places: &[Place], trial: &Trial) {
        let state = |k: usize| {
            let (place, end) = (&places[k], &trial.ends[k]);
            let of_center = end.to_center - place.to_center;
            let center = place.center + end.displacement + of_center;
            let q = end.turn.turned(place.orientation.to_array());
            (body_state(&center, q), end.to_center)
        };
        self.each(closures, state, |row, found, away| {
            row.end = found.pairs;
            row.error = found.error;
            row.away = away;
        });
    }

    /// Fills rows from the closures' derivatives at these states, with the arms from reference points to
    /// centres of mass.
    fn each(
        &mut self,
        closures: &[Closure],
        state: impl Fn(usize) -> Seen,
        fill: impl Fn(&mut Row, &ClosingRow, f64),
    ) {
        let mut next = 0;
        for closure in closures {
            let outboard = state(closure.outboard);
            let inboard = closure.inboard.map_or((WORLD, Vector3::zeros()), &state);
            let found = closing_rows(closure, &outboard, &inboard);
            let far = |x: &BodyState| x[..3].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let away = far(&outboard.0) + far(&inboard.0);
            for row in &found[..closure.constraints()] {
                fill(&mut self.rows[next], row, away);
                next += 1;
            }
        }
    }

    /// The bodies that constraints act on, each once for each constraint, with the impulse
    /// there at the beginning: `G⁻ᵀ λ`, and that of motors.
    pub fn impulses<'a>(
        &'a self,
        multipliers: &'a [f64],
    ) -> impl Iterator<Item = (usize, Pair)> + 'a {
        let held = self.rows.iter().zip(multipliers).flat_map(|(row, m)| {
            row.bodies.iter().zip(&row.begin).filter_map(move |(body, pair)| {
                let scaled = Pair { linear: pair.linear * *m, angular: pair.angular * *m };
                body.map(|k| (k, scaled))
            })
        });
        held.chain(self.driven.iter().copied())
    }

    /// Largest error of a constraint, beyond that of rounding, against what bodies move by in a step, m.
    pub fn largest_error(&self, way: f64) -> f64 {
        self.rows.iter().fold(0.0, |m, row| {
            let e = beyond(row.error.abs() * row.arm, self.length + row.away, way);
            if e > m || e.is_nan() { e } else { m }
        })
    }

    /// For velocities: rows of the end are those of the beginning, and errors zero.
    pub fn stand_still(&mut self) {
        for row in &mut self.rows {
            row.end = row.begin;
            row.error = 0.0;
        }
    }

    /// Eliminates `S`, with the tree eliminated.
    pub fn factor(&mut self, nodes: &[Node], tree: &mut Elimination) {
        let n = self.rows.len();
        for j in 0..n {
            let row = self.rows[j];
            let unit = |k: usize| {
                let [outboard, inboard] = row.bodies;
                let mut sum = Pair::ZERO;
                if outboard == Some(k) {
                    sum.subtract(&row.begin[0]);
                }
                if inboard == Some(k) {
                    sum.subtract(&row.begin[1]);
                }
                sum
            };
            let answer = &mut self.answers[j * self.columns..(j + 1) * self.columns];
            match self.near.get(j) {
                Some(near) => tree.solve_near(nodes, near, unit, answer),
                None => tree.solve(nodes, unit, |_| 0.0, answer),
            }
            for i in 0..n {
                self.schur[i * n + j] = self.rows[i].along(tree.motions());
            }
        }
        self.eliminate();
    }

    /// Gaussian elimination with complete pivoting, in place.
    fn eliminate(&mut self) {
        let n = self.rows.len();
        self.pivots.clear();
        let (mut row_is_used, mut column_is_used) = ([false; MOST], [false; MOST]);
        let mut first = 0.0;
        for _ in 0..n {
            let mut best = (0, 0, 0.0_f64);
            for i in (0..n).filter(|i| !row_is_used[*i]) {
                for j in (0..n).filter(|j| !column_is_used[*j]) {
                    let size = self.schur[i * n + j].abs() * self.rows[i].arm * self.rows[j].arm;
                    if size > best.2 {
                        best = (i, j, size);
                    }
                }
            }
            let (r, c, size) = best;
            if self.pivots.is_empty() {
                first = size;
            }
            if !(size > DEPENDENT * first) {
                break;
            }
            self.pivots.push((r, c));
            (row_is_used[r], column_is_used[c]) = (true, true);
            for i in (0..n).filter(|i| !row_is_used[*i]) {
                let factor = self.schur[i * n + c] / self.schur[r * n + c];
                self.schur[i * n + c] = factor;
                // Loops far from one another have nothing in common.
                if factor == 0.0 {
                    continue;
                }
                for j in (0..n).filter(|j| !column_is_used[*j]) {
                    self.schur[i * n + j] -= factor * self.schur[r * n + j];
                }
            }
        }
    }

    /// Corrects the tree's solution, the last that was found, so that constraints hold.
    pub fn correct(&mut self, tree: &Elimination, all: &mut [f64]) {
        let n = self.rows.len();
        // −g − G⁺ T(r), eliminated along with S; a constraint that others imply is left out.
        let mut right = std::mem::take(&mut self.corrections);
        for (x, row) in right.iter_mut().zip(&self.rows) {
            *x = -row.error - row.along(tree.motions());
        }
        let mut row_is_used = [false; MOST];
        for (r, c) in &self.pivots {
            let value = right[*r];
            row_is_used[*r] = true;
            for (i, x) in right.iter_mut().enumerate().filter(|(i, _)| !row_is_used[*i]) {
                *x -= self.schur[i * n + c] * value;
            }
        }
        let mut solution = [0.0; MOST];
        for (at, (r, c)) in self.pivots.iter().enumerate().rev() {
            let known: f64 = self.pivots[at + 1..]
                .iter()
                .map(|(_, column)| self.schur[r * n + column] * solution[*column])
                .sum();
            solution[*c] = (right[*r] - known) / self.schur[r * n + c];
        }
        right.copy_from_slice(&solution[..n]);
        for (answer, by) in self.answers.chunks(self.columns).zip(&right) {
            for (x, a) in all.iter_mut().zip(answer) {
                *x += a * by;
            }
        }
        self.corrections = right;
    }
}

/// All nodes of the trees that the bodies of a constraint belong to.
fn near(system: &System, row: &Row) -> Vec<usize> {
    let root = |link: usize| {
        let floats = |k: &usize| system.links()[*k].joint.constraint == JointConstraint::Floating;
        let inboard = |k: &usize| system.links()[*k].inboard.filter(|_| !floats(k));
        std::iter::successors(Some(link), inboard).last()
    };
    let roots = row.bodies.map(|body| body.and_then(root));
    let is_near = |k: &usize| root(*k).is_some_and(|of| roots.contains(&Some(of)));
    (0..system.links().len()).filter(is_near).collect()
}

/// Constraints from which on it pays to know which trees each of them can move.
const MANY: usize = 32;

/// Constraints of all loops, at most.
pub const MOST: usize = 96;

impl Row {
    const NONE: Self = Self {
        bodies: [None; 2],
        begin: [Pair::ZERO; 2],
        end: [Pair::ZERO; 2],
        error: 0.0,
        arm: 1.0,
        away: 0.0,
    };

    /// `G⁺` along a motion of all bodies.
    fn along(&self, motions: &[Pair]) -> f64 {
        let [outboard, inboard] = self.bodies;
        outboard.map_or(0.0, |k| self.end[0].dot(&motions[k]))
            + inboard.map_or(0.0, |k| self.end[1].dot(&motions[k]))
    }
}

fn body_state(center: &Vector3<f64>, q: [f64; 4]) -> BodyState {
    [center.x, center.y, center.z, q[0], q[1], q[2], q[3]]
}
