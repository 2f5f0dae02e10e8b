//! One step of any set of equations: Newton's method with a line search, and shorter steps where it fails.

use surefoot_mechanics::integrators::{Progress, StepError, StepFailure};
use surefoot_mechanics::newton::NewtonFailure;

/// Newton steps at most.
const MOST_ITERATIONS: u32 = 40;
/// Halvings of a Newton step at most.
const MOST_HALVINGS: u32 = 30;
/// Residuals, relative to their terms, that count as a root once they fall no further.
const TOLERANCE: f64 = 1e-10;
/// The same where they fall slowly by an old elimination: above it a new one is worth its cost.
const SLOW: f64 = 1e-12;
/// Residuals that count as a root at once.
pub(super) const ROUND_OFF: f64 = 2e-15;
/// While residuals fall by this in an iteration, the elimination is used again.
const FAST: f64 = 1e-2;
/// Cosine of half the angle by which a body may turn in a step: beyond a quarter turn (2.51) folds.
pub(super) const LEAST_TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Steps that may be made in shorter ones: so many, and one of so many.
const FREE_SPLITS: u64 = 10;
const STEPS_PER_SPLIT: u64 = 100;
/// A step that fails is made in 2, 4, … up to 2 to this power.
const MOST_SPLITS: u32 = 6;

/// The equations of a step, with a trial of its end.
pub(super) trait StepEquations {
    /// Time and statistics.
    fn progress(&self) -> &Progress;
    /// The same, to be told.
    fn progress_mut(&mut self) -> &mut Progress;
    /// Keeps where the motion is.
    fn save(&mut self);
    /// Goes back to what was kept.
    fn go_back(&mut self);
    /// Begins a step of `h`, with a first guess of its end.
    fn begin(&mut self, h: f64);
    /// Size of the residuals at the trial, relative to their terms.
    fn evaluate(&mut self, h: f64) -> f64;
    /// Finds Newton's correction at the trial, which becomes the base: with a new elimination or the last one.
    ///
    /// # Errors
    /// The link whose equations are singular.
    fn correct(&mut self, anew: bool, h: f64) -> Result<(), usize>;
    /// Takes as the trial the base with a share of the correction.
    fn take(&mut self, share: f64);
    /// Whether a body of the trial turns by more than a quarter turn, beyond which (2.51) folds.
    fn is_folded(&self) -> bool;
    /// Goes on to the trial's end.
    fn accept(&mut self, h: f64);
    /// A joint that cannot go on from there.
    fn locked(&self) -> Option<usize> {
        None
    }
    /// Whether steps that fail are made in shorter ones.
    fn may_split(&self) -> bool {
        true
    }
}

/// One step. Where its equations have no solution nearby it is made in 2, 4, … 64 shorter ones.
///
/// # Errors
/// A [`StepError`]; the motion is then where it was.
pub(super) fn make_step(equations: &mut impl StepEquations) -> Result<(), StepError> {
    equations.save();
    let h = equations.progress().h;
    let mut result = advance(equations, h);
    let mut splits = 0;
    while result.is_err() && equations.may_split() && splits < MOST_SPLITS {
        // What was evaluated in vain has been evaluated.
        let evaluations = equations.progress().evaluations;
        equations.go_back();
        equations.progress_mut().evaluations = evaluations;
        splits += 1;
        let parts = 1_u32 << splits;
        if (0..parts).try_for_each(|_| advance(equations, h / f64::from(parts))).is_ok() {
            equations.progress_mut().split_steps += 1;
            result = bear_splits(equations.progress());
            break;
        }
    }
    conclude(equations, result)
}

/// One step in stages, each this share of it, which are not made in shorter ones.
///
/// # Errors
/// A [`StepError`]; the motion is then where it was.
pub(super) fn make_stages(
    equations: &mut impl StepEquations,
    stages: &[f64],
) -> Result<(), StepError> {
    equations.save();
    let h = equations.progress().h;
    let made = stages.iter().try_for_each(|share| advance(equations, share * h));
    conclude(equations, made)
}

/// Counts the step, or goes back to where it began.
fn conclude(
    equations: &mut impl StepEquations,
    result: Result<(), StepError>,
) -> Result<(), StepError> {
    match result {
        Ok(()) => equations.progress_mut().advance(),
        Err(_) => equations.go_back(),
    }
    result
}

/// Shorter steps by the dozen turn the method into another one, whose energy grows.
fn bear_splits(progress: &Progress) -> Result<(), StepError> {
    let splits = progress.split_steps;
    if splits <= FREE_SPLITS + progress.steps / STEPS_PER_SPLIT {
        return Ok(());
    }
    Err(progress.error(StepFailure::TooManySplits { splits }))
}

/// Goes on by `h`.
fn advance(equations: &mut impl StepEquations, h: f64) -> Result<(), StepError> {
    equations.begin(h);
    let mut error = equations.evaluate(h);
    let mut evaluations = 1;
    let mut iterations = 0;
    let mut is_fresh = false;
    let result = 'newton: loop {
        if !error.is_finite() {
            break Err(NewtonFailure::NotFinite);
        }
        if error <= ROUND_OFF {
            break Ok(());
        }
        if iterations == MOST_ITERATIONS {
            break Err(NewtonFailure::TooManyIterations { iterations, residual: error });
        }
        let was_fresh = is_fresh;
        if let Err(pivot) = equations.correct(!is_fresh, h) {
            break Err(NewtonFailure::SingularJacobian { pivot });
        }
        let mut share = 1.0;
        for halvings in 0..=MOST_HALVINGS {
            equations.take(share);
            let tried = equations.evaluate(h);
            evaluations += 1;
            if tried <= (1.0 - 1e-4 * share) * error {
                is_fresh = tried < FAST * error;
                error = tried;
                iterations += 1;
                if error <= SLOW && !is_fresh {
                    // So close to a root only round-off makes it slow.
                    break 'newton Ok(());
                }
                continue 'newton;
            }
            if error <= TOLERANCE || was_fresh || halvings == MOST_HALVINGS {
                break;
            }
            share *= 0.5;
        }
        // Back to the best iterate.
        equations.take(0.0);
        equations.evaluate(h);
        evaluations += 1;
        if error <= TOLERANCE {
            // Round-off has the last word.
            break Ok(());
        }
        if !was_fresh {
            break Err(NewtonFailure::NoRootNearby { residual: error });
        }
        // An old elimination is no reason to give up.
        is_fresh = false;
    };
    equations.progress_mut().evaluated(evaluations);
    result.map_err(|failure| equations.progress().error(failure))?;
    if equations.is_folded() {
        return Err(equations.progress().error(StepFailure::WrongBranch));
    }
    equations.accept(h);
    if let Some(joint) = equations.locked() {
        return Err(equations.progress().error(StepFailure::GimbalLock { joint }));
    }
    equations.progress_mut().iterated(iterations, error);
    Ok(())
}
