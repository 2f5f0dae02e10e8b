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
//! and Idnani (*Math. Programming* 27, 1983), which here are those of Lawson and Hanson (*Solving
//! Least Squares Problems*, 1974, ch. 23): towards λ*, the optimum of the rows that are held; where a
//! multiplier would turn negative, only until it is zero, and its row is let go; from λ* on with the
//! row that is broken most. Each step raises (3) and no set is held twice, so it ends. Round-off can
//! make a set return: a row that comes for the third time doubles the tolerance, so it ends still.

use super::factors::{Factors, append_cost, optimum_cost, remove_cost};
use super::{
    ActiveRows, Fault, Program, RowSet, Search, Settings, Solution, Status, Violation, Work,
};
use crate::Real;

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
/// rows held, and the costs of the [`Program`] in capitals:
/// ```text
/// begin                 SCAN, and FACTOR where a row is broken
/// take a row in         ROW + RESPONSE + (k + 1) PRODUCT + k (k + 5)/2 + 4
/// optimum of the rows   k (k + 3)/2
/// let the row i go      (k − i − 1) (k − i + 5) + k
/// point and its test    RESPONSE + k PRODUCT + SCAN
/// ```
/// So the work never exceeds `settings.work` (but for the first SCAN, which is always made). No
/// allocation, no panic.
#[inline(always)]
pub fn solve<T: Real, P: Program<T>, const K: usize>(
    program: &P,
    active: &mut ActiveRows<T, K>,
    settings: &Settings<T>,
) -> Result<Solution<T, P::Point>, Fault> {
    let mut run = Run {
        program,
        settings,
        held: RowSet::default(),
        tolerance: settings.tolerance,
        changes: 0,
        work: P::COST.scan,
    };
    let start = core::mem::take(active);
    let x0 = program.minimum();
    if !program.is_finite(&x0) {
        return Err(Fault::NotFinite);
    }
    let Some(worst) = run.worst(&x0) else {
        return Ok(run.solution(x0, Status::Solved, None));
    };
    if !run.affords(P::COST.factor + run.report_cost(0)) {
        *active = start;
        return Ok(run.solution(x0, Status::BudgetSpent, Some(worst)));
    }
    let factor = program.factor().ok_or(Fault::NotPositiveDefinite)?;
    run.work += P::COST.factor;
    let (filling, _) = program.row(worst.row).ok_or(Fault::NoSuchRow { row: worst.row })?;
    let mut rows = Factors::new(filling);
    for (row, multiplier) in start.iter() {
        // A row that is gone, or has no valid multiplier, is left out.
        if multiplier >= T::zero() && !run.held.contains(row) && run.affords_row(rows.len()) {
            run.append(&mut rows, &factor, &x0, row, multiplier);
        }
    }
    if rows.is_empty() {
        if !run.affords_row(0) {
            return Ok(run.solution(x0, Status::BudgetSpent, Some(worst)));
        }
        run.append(&mut rows, &factor, &x0, worst.row, T::zero());
        run.changes += 1;
    }
    let (status, optimum) = run.iterate(&mut rows, &factor, &x0)?;
    let (x, broken) = optimum.unwrap_or_else(|| run.interrupted(&rows, &factor, &x0));
    if !program.is_finite(&x) {
        return Err(Fault::NotFinite);
    }
    rows.leave_in(active);
    // At an optimum the rows that are held are broken by what they give way.
    let most = active.iter().fold(broken, |most, (row, multiplier)| {
        let amount = settings.softness * multiplier;
        match most {
            Some(most) if most.amount >= amount => Some(most),
            _ => Some(Violation { row, amount }),
        }
    });
    let most = most.filter(|most| most.amount > settings.tolerance);
    let contradicts = most.is_some_and(|most| most.amount > settings.margin);
    let status = match status {
        Status::Solved if contradicts => Status::Contradiction,
        other => other,
    };
    Ok(run.solution(x, status, most))
}

/// A point, and the row that is broken most there of those not held.
type Tested<T, X> = (X, Option<Violation<T>>);

/// How the steps ended, with the point where they ended at an optimum of the rows held.
type Ended<T, X> = Result<(Status, Option<Tested<T, X>>), Fault>;

/// A call's state beside the rows.
struct Run<'a, T, P> {
    program: &'a P,
    settings: &'a Settings<T>,
    held: RowSet,
    tolerance: T,
    changes: u32,
    work: Work,
}

impl<T: Real, P: Program<T>> Run<'_, T, P> {
    /// The steps, from rows with multipliers that are not negative.
    #[inline(always)]
    fn iterate<const K: usize>(
        &mut self,
        rows: &mut Factors<T, P::Normal, K>,
        factor: &P::Factor,
        x0: &P::Point,
    ) -> Ended<T, P::Point> {
        let (mut left, mut left_twice) = (RowSet::default(), RowSet::default());
        loop {
            let k = rows.len();
            if !self.affords(optimum_cost(k) + self.report_cost(k)) {
                return Ok((Status::BudgetSpent, None));
            }
            self.work += optimum_cost(k);
            let optimum = rows.optimum();
            if let Some((at, row, share)) = rows.first_to_leave(&optimum) {
                if !self.affords(remove_cost(k, at) + self.report_cost(k)) {
                    return Ok((Status::BudgetSpent, None));
                }
                self.work += remove_cost(k, at);
                self.changes += 1;
                rows.go_towards(&optimum, share);
                rows.remove(at);
                self.held.remove(row);
                if left.contains(row) {
                    left_twice.insert(row);
                }
                left.insert(row);
                continue;
            }
            rows.go_towards(&optimum, T::one());
            let x = self.point(rows, factor, x0);
            self.work += self.report_cost(k);
            let Some(worst) = self.worst(&x) else {
                return Ok((Status::Solved, Some((x, None))));
            };
            if k == K {
                return Ok((Status::TooManyRows, Some((x, Some(worst)))));
            }
            if !self.affords_row(k) {
                return Ok((Status::BudgetSpent, Some((x, Some(worst)))));
            }
            if left_twice.contains(worst.row) {
                self.tolerance *= T::of(2.0);
            }
            if !self.append(rows, factor, x0, worst.row, T::zero()) {
                return Err(Fault::NoSuchRow { row: worst.row });
            }
            self.changes += 1;
        }
    }

    /// Between two optima: the point, and what is broken there, held or not.
    #[inline(always)]
    fn interrupted<const K: usize>(
        &mut self,
        rows: &Factors<T, P::Normal, K>,
        factor: &P::Factor,
        x0: &P::Point,
    ) -> Tested<T, P::Point> {
        self.work += self.report_cost(rows.len());
        self.held = RowSet::default();
        let x = self.point(rows, factor, x0);
        (x, self.worst(&x))
    }

    /// (4)
    #[inline(always)]
    fn point<const K: usize>(
        &self,
        rows: &Factors<T, P::Normal, K>,
        factor: &P::Factor,
        x0: &P::Point,
    ) -> P::Point {
        let mut gradient = self.program.zero();
        for (normal, multiplier) in rows.iter() {
            self.program.accumulate(&mut gradient, normal, multiplier);
        }
        self.program.moved(x0, &self.program.response(factor, &gradient))
    }

    /// The row broken most of those that are not held.
    #[inline(always)]
    fn worst(&self, x: &P::Point) -> Option<Violation<T>> {
        let mut search = Search::new(&self.held, self.tolerance);
        self.program.scan(x, &mut search);
        search.worst()
    }

    /// Takes a row in; false where there is no such row.
    #[inline(always)]
    fn append<const K: usize>(
        &mut self,
        rows: &mut Factors<T, P::Normal, K>,
        factor: &P::Factor,
        x0: &P::Point,
        row: u8,
        multiplier: T,
    ) -> bool {
        let program = self.program;
        let Some((normal, bound)) = program.row(row) else { return false };
        self.work += self.append_cost(rows.len());
        let response = program.row_response(factor, &normal);
        let softness = self.settings.softness;
        let own = program.product(&normal, &response) + softness;
        let residual = bound - program.product(&normal, x0);
        let product = |other: &_| program.product(other, &response);
        rows.append((row, normal, multiplier), product, own, residual, softness);
        self.held.insert(row);
        true
    }

    #[inline(always)]
    fn append_cost(&self, k: usize) -> Work {
        P::COST.row + P::COST.response + (k as Work + 1) * P::COST.product + append_cost(k)
    }

    /// Point and its test.
    #[inline(always)]
    fn report_cost(&self, k: usize) -> Work {
        P::COST.response + k as Work * P::COST.product + P::COST.scan
    }

    #[inline(always)]
    fn affords(&self, cost: Work) -> bool {
        self.work.saturating_add(cost) <= self.settings.work
    }

    /// Whether one more row can be taken in, and the point still be reported.
    #[inline(always)]
    fn affords_row(&self, k: usize) -> bool {
        self.affords(self.append_cost(k) + self.report_cost(k + 1))
    }

    #[inline(always)]
    fn solution(
        &self,
        x: P::Point,
        status: Status,
        violation: Option<Violation<T>>,
    ) -> Solution<T, P::Point> {
        let Self { tolerance, changes, work, .. } = *self;
        Solution { x, status, violation, tolerance, changes, work }
    }
}
