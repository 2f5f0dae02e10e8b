//! The dual active set.
//!
//! # Notation
//! Beside that of [`Program`] and of the factors:
//! ```text
//! maximise  r · λ − ½ λᵀ (A H⁻¹ Aᵀ + δ 1) λ,   λ ≥ 0                         (3)
//! x = x₀ + H⁻¹ Aᵀ λ,   s = δ λ                                               (4)
//! ```
//! (3) is the dual of the program: strictly concave as δ > 0, bounded, with one solution, whatever
//! rows depend on each other or contradict each other. From any λ ≥ 0 the steps are those of Goldfarb
//! and Idnani (*Math. Programming* 27, 1983), which are here those of Lawson and Hanson (*Solving
//! Least Squares Problems*, 1974, ch. 23): towards λ*, the optimum of the rows that are held; where a
//! multiplier would turn negative, only until it is zero, and its row is let go; from λ* on with the
//! row that is broken most. Each step raises (3) and no set is held twice, so it ends.

use super::factors::{Factors, append_cost, optimum_cost, remove_cost};
use super::{ActiveRows, Program, RowSet, Search, Violation, Work};
use crate::Real;

/// What is required of an answer, and what it may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<T> {
    /// δ: how far a row gives way per unit of its multiplier.
    pub softness: T,
    /// By how much a row may be broken, beyond what it gives way, without being taken in.
    pub tolerance: T,
    /// A row that gives way by more than this contradicts the others.
    pub margin: T,
    /// Multiplications that may be spent. [`solve`] tells what they are.
    pub work: Work,
}

impl<T: Real> Settings<T> {
    /// With a tolerance of 0.02 (f32) or 1e-9 (f64), no margin, and no limit of work. The tolerance
    /// of f32 is for numbers of a thousand in rows: 300 roundings.
    pub fn new(softness: T) -> Self {
        let single = T::default_epsilon() > T::of(1e-10);
        Self {
            softness,
            tolerance: T::of(if single { 0.02 } else { 1e-9 }),
            margin: T::of(f64::from(f32::MAX)),
            work: Work::MAX,
        }
    }
}

/// How a solution ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The answer is the program's.
    Solved,
    /// It is the program's, and some row gives way by more than the margin: the rows contradict each
    /// other.
    Contradiction,
    /// The work is spent. The rows held so far are a better start than none for the next call; the
    /// answer is optimal for them, and `violation` is what is broken.
    BudgetSpent,
    /// More rows bind than there is room for; as before.
    TooManyRows,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A number of the program, or one that it leads to, is not finite.
    NotFinite,
    /// The Hessian has a pivot that is not positive.
    NotPositiveDefinite,
}

/// An answer. Multipliers are in the [`ActiveRows`].
#[derive(Clone, Copy, Debug)]
pub struct Solution<T, X> {
    /// `x`
    pub x: X,
    /// How it ended.
    pub status: Status,
    /// The row that is broken most, and by how much: for a solved program what gives way most.
    /// `None` where no row is broken by more than the tolerance.
    pub violation: Option<Violation<T>>,
    /// Rows taken in and let go, those of a warm start aside.
    pub changes: u32,
    /// Multiplications spent.
    pub work: Work,
}

/// Solves a program, beginning with the rows of `active`, and leaves there those of the answer.
///
/// Where no row is broken at `x₀`, that is the answer, to the bit, and nothing is factored.
///
/// # Errors
/// [`Fault`]. `active` is empty then.
///
/// # Cost
/// Counted in multiplications, of which every operation makes a number that depends only on its
/// size; an operation that does not fit into what is left of `settings.work` is not begun. With k
/// rows active, and the costs of the [`Program`] in capitals:
/// ```text
/// begin                 SCAN + FACTOR
/// take a row in         ROW + RESPONSE + (k + 1) PRODUCT + k (k + 5)/2 + 4
/// optimum of the rows   k (k + 3)/2
/// let the row i go      (k − i − 1) (k − i + 5) + k
/// point and its test    RESPONSE + k PRODUCT + SCAN
/// ```
/// So the work never exceeds the greater of `settings.work` and [`least_work`], which is what it
/// takes to begin and to report.
#[inline(always)]
pub fn solve<T: Real, P: Program<T>, const K: usize>(
    program: &P,
    active: &mut ActiveRows<T, K>,
    settings: &Settings<T>,
) -> Result<Solution<T, P::Point>, Fault> {
    let mut run =
        Run { program, settings, held: RowSet::default(), work: P::COST.scan, changes: 0 };
    let x0 = program.minimum();
    if !program.is_finite(&x0) {
        *active = ActiveRows::new();
        return Err(Fault::NotFinite);
    }
    match run.worst(&x0, settings.tolerance) {
        None => {
            *active = ActiveRows::new();
            Ok(run.solution(x0, Status::Solved, None))
        }
        Some(worst) if !run.affords(P::COST.factor + run.report_cost(0)) => {
            Ok(run.solution(x0, Status::BudgetSpent, Some(worst)))
        }
        Some(worst) => {
            let answer = run.from_broken(&x0, worst, active);
            if answer.is_err() {
                *active = ActiveRows::new();
            }
            answer
        }
    }
}

/// One call's state beside its rows.
struct Run<'a, T, P> {
    program: &'a P,
    settings: &'a Settings<T>,
    held: RowSet,
    work: Work,
    changes: u32,
}

impl<T: Real, P: Program<T>> Run<'_, T, P> {
    /// The row broken most of those that are not held.
    #[inline(always)]
    fn worst(&self, x: &P::Point, tolerance: T) -> Option<Violation<T>> {
        let mut search = Search::new(&self.held, tolerance);
        self.program.scan(x, &mut search);
        search.worst()
    }

    #[inline(always)]
    fn affords(&self, cost: Work) -> bool {
        self.work.saturating_add(cost) <= self.settings.work
    }

    /// Point and its test, with k rows.
    #[inline(always)]
    fn report_cost(&self, k: usize) -> Work {
        P::COST.response + k as Work * P::COST.product + P::COST.scan
    }

    /// From the row that is broken most at `x₀`, or the rows given.
    #[inline(always)]
    fn from_broken<const K: usize>(
        &mut self,
        x0: &P::Point,
        worst: Violation<T>,
        active: &mut ActiveRows<T, K>,
    ) -> Result<Solution<T, P::Point>, Fault> {
        let program = self.program;
        let factor = program.factor().ok_or(Fault::NotPositiveDefinite)?;
        self.work += P::COST.factor;
        let (filling, _) = program.row(worst.row).ok_or(Fault::NotFinite)?;
        let mut rows = Factors::<T, P::Normal, K>::new(filling);
        for (row, multiplier) in active.iter() {
            let fits =
                self.affords(self.append_cost(rows.len()) + self.report_cost(rows.len() + 1));
            if fits && multiplier >= T::zero() {
                self.append(&mut rows, &factor, x0, row, multiplier);
            }
        }
        if rows.len() == 0 {
            if !self.affords(self.append_cost(0) + self.report_cost(1)) {
                return Ok(self.solution(*x0, Status::BudgetSpent, Some(worst)));
            }
            self.append(&mut rows, &factor, x0, worst.row, T::zero());
            self.changes += 1;
        }
        let (status, x) = self.iterate(&factor, x0, &mut rows);
        let x = match x {
            Some(x) => x,
            None => self.point(&factor, x0, &rows),
        };
        if !program.is_finite(&x) {
            return Err(Fault::NotFinite);
        }
        rows.leave_in(active);
        // What gives way most, or what is broken.
        self.held = RowSet::default();
        let violation = if status == Status::Solved {
            let softness = self.settings.softness;
            let given = active
                .iter()
                .map(|(row, multiplier)| Violation { row, amount: softness * multiplier });
            given.fold(None, |most: Option<Violation<T>>, one| match most {
                Some(most) if most.amount >= one.amount => Some(most),
                _ => Some(one),
            })
        } else {
            self.worst(&x, self.settings.tolerance)
        };
        let contradicts = violation.is_some_and(|most| most.amount > self.settings.margin);
        let status = match status {
            Status::Solved if contradicts => Status::Contradiction,
            other => other,
        };
        Ok(self.solution(x, status, violation))
    }

    /// The steps, from rows with multipliers that are not negative. The point where it is known.
    #[inline(always)]
    fn iterate<const K: usize>(
        &mut self,
        factor: &P::Factor,
        x0: &P::Point,
        rows: &mut Factors<T, P::Normal, K>,
    ) -> (Status, Option<P::Point>) {
        loop {
            let k = rows.len();
            if !self.affords(optimum_cost(k) + self.report_cost(k)) {
                return (Status::BudgetSpent, None);
            }
            self.work += optimum_cost(k);
            let optimum = rows.optimum();
            if let Some((at, share)) = rows.first_to_leave(&optimum) {
                if !self.affords(remove_cost(k, at) + self.report_cost(k)) {
                    return (Status::BudgetSpent, None);
                }
                self.work += remove_cost(k, at);
                self.changes += 1;
                rows.go_towards(&optimum, share);
                self.held.remove(rows.rows[at.min(K - 1)]);
                rows.remove(at);
                continue;
            }
            rows.go_towards(&optimum, T::one());
            let x = self.point(factor, x0, rows);
            self.work += self.report_cost(k);
            let Some(worst) = self.worst(&x, self.settings.tolerance) else {
                return (Status::Solved, Some(x));
            };
            if k == K {
                return (Status::TooManyRows, Some(x));
            }
            if !self.affords(self.append_cost(k) + self.report_cost(k + 1)) {
                return (Status::BudgetSpent, Some(x));
            }
            self.append(rows, factor, x0, worst.row, T::zero());
            self.changes += 1;
        }
    }

    /// (4)
    #[inline(always)]
    fn point<const K: usize>(
        &self,
        factor: &P::Factor,
        x0: &P::Point,
        rows: &Factors<T, P::Normal, K>,
    ) -> P::Point {
        let mut gradient = self.program.zero();
        for (normal, multiplier) in rows.normals.iter().zip(&rows.multipliers).take(rows.len()) {
            self.program.accumulate(&mut gradient, normal, *multiplier);
        }
        self.program.moved(x0, &self.program.response(factor, &gradient))
    }

    #[inline(always)]
    fn append_cost(&self, k: usize) -> Work {
        P::COST.row + P::COST.response + (k as Work + 1) * P::COST.product + append_cost(k)
    }

    #[inline(always)]
    fn append<const K: usize>(
        &mut self,
        rows: &mut Factors<T, P::Normal, K>,
        factor: &P::Factor,
        x0: &P::Point,
        row: u8,
        multiplier: T,
    ) {
        let program = self.program;
        self.work += self.append_cost(rows.len());
        let Some((normal, bound)) = program.row(row) else { return };
        let mut gradient = program.zero();
        program.accumulate(&mut gradient, &normal, T::one());
        let response = program.response(factor, &gradient);
        let mut products = [T::zero(); K];
        for (product, other) in products.iter_mut().zip(&rows.normals).take(rows.len()) {
            *product = program.product(other, &response);
        }
        let softness = self.settings.softness;
        let own = program.product(&normal, &response) + softness;
        let residual = bound - program.product(&normal, x0);
        rows.append((row, normal, multiplier), products, own, residual, softness);
        self.held.insert(row);
    }

    #[inline(always)]
    fn solution(
        &self,
        x: P::Point,
        status: Status,
        violation: Option<Violation<T>>,
    ) -> Solution<T, P::Point> {
        Solution { x, status, violation, changes: self.changes, work: self.work }
    }
}
