//! The one nonlinear solver: Newton's method with a backtracking line search (Dennis and Schnabel
//! 1983, alg. A6.3.1). It gives a root to round-off or says why not, and never the last iterate.

mod linear;

pub use linear::{Factors, solve_linear};

use crate::Scalar;

/// Equations at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation<T, const U: usize, D = f64> {
    /// What should be zero.
    pub residual: [D; U],
    /// Its derivatives, by rows.
    pub jacobian: [[D; U]; U],
    /// What else is known there.
    pub known: T,
}

/// A root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root<T, const U: usize, D = f64> {
    /// Where it is.
    pub x: [D; U],
    /// Newton steps made.
    pub iterations: u32,
    /// Evaluations of the equations, those of rejected steps too.
    pub evaluations: u32,
    /// Largest residual there, in units of the scale.
    pub residual: f64,
    /// The equations there.
    pub at: Evaluation<T, U, D>,
}

/// Why there is no root.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NewtonFailure {
    /// The residual has a least value above zero nearby.
    #[error("no root nearby: the residual goes no lower than {residual:.1e}")]
    NoRootNearby {
        /// In units of the scale.
        residual: f64,
    },
    /// The Jacobian cannot be inverted.
    #[error("the Jacobian is singular (pivot {pivot})")]
    SingularJacobian {
        /// Number of the pivot.
        pivot: usize,
    },
    /// A number is not finite.
    #[error("a residual is not finite")]
    NotFinite,
    /// Too many steps.
    #[error("no root after {iterations} iterations (residual {residual:.1e})")]
    TooManyIterations {
        /// Steps made.
        iterations: u32,
        /// In units of the scale.
        residual: f64,
    },
}

/// Newton steps at most.
const MOST_ITERATIONS: u32 = 50;
/// Halvings of a step at most.
const MOST_HALVINGS: u32 = 12;
/// Residuals, in units of the scale, that count as a root once they fall no further.
const TOLERANCE: f64 = 1e-11;
/// Residuals that count as a root at once: round-off.
const ROUND_OFF: f64 = 1e-15;

/// Finds a root of `evaluate` near `x`. `scale` is the size of each residual's terms: what its
/// round-off is relative to.
///
/// In numbers that carry derivatives, those of the root come with it, exactly.
///
/// # Errors
/// A [`NewtonFailure`].
///
/// # Cost
/// One evaluation and one factorisation an iteration, and one more evaluation for each halving.
pub fn solve<D: Scalar, T, const U: usize>(
    mut x: [D; U],
    scale: &[f64; U],
    mut evaluate: impl FnMut(&[D; U]) -> Evaluation<T, U, D>,
) -> Result<Root<T, U, D>, NewtonFailure> {
    let mut at = evaluate(&x);
    let mut evaluations = 1;
    let mut error = size(&at.residual, scale);
    for iterations in 0..=MOST_ITERATIONS {
        if !error.is_finite() {
            return Err(NewtonFailure::NotFinite);
        }
        if error <= ROUND_OFF {
            let root = Root { x, iterations, evaluations, residual: error, at };
            return with_derivatives(root, evaluate);
        }
        if iterations == MOST_ITERATIONS {
            break;
        }
        let step = newton_step(&at)?;
        let mut share = 1.0;
        let mut halvings = 0;
        loop {
            let trial: [D; U] = std::array::from_fn(|i| x[i] - step[i] * share);
            let at_trial = evaluate(&trial);
            evaluations += 1;
            let trial_error = size(&at_trial.residual, scale);
            // Sufficient decrease; NaN is none.
            if trial_error <= (1.0 - 1e-4 * share) * error {
                (x, at, error) = (trial, at_trial, trial_error);
                break;
            }
            // Near a root round-off has the last word.
            if error <= TOLERANCE {
                let root = Root { x, iterations, evaluations, residual: error, at };
                return with_derivatives(root, evaluate);
            }
            if halvings == MOST_HALVINGS {
                return Err(NewtonFailure::NoRootNearby { residual: error });
            }
            share *= 0.5;
            halvings += 1;
        }
    }
    Err(NewtonFailure::TooManyIterations { iterations: MOST_ITERATIONS, residual: error })
}

/// Largest residual in units of the scale; NaN if there is one.
fn size<D: Scalar, const U: usize>(residual: &[D; U], scale: &[f64; U]) -> f64 {
    residual.iter().zip(scale).fold(0.0_f64, |m, (r, s)| {
        // `max` would lose a NaN.
        let r = (r.re() / s).abs();
        if r > m || r.is_nan() { r } else { m }
    })
}

fn newton_step<D: Scalar, T, const U: usize>(
    at: &Evaluation<T, U, D>,
) -> Result<[D; U], NewtonFailure> {
    solve_linear(at.jacobian, at.residual)
        .map_err(|pivot| NewtonFailure::SingularJacobian { pivot })
}

/// One Newton step more for each order of derivatives that the numbers carry makes these the root's;
/// the root itself stays.
fn with_derivatives<D: Scalar, T, const U: usize>(
    mut root: Root<T, U, D>,
    mut evaluate: impl FnMut(&[D; U]) -> Evaluation<T, U, D>,
) -> Result<Root<T, U, D>, NewtonFailure> {
    for _ in 0..D::NDERIV {
        let step = newton_step(&root.at)?;
        for (x, step) in root.x.iter_mut().zip(step) {
            *x -= step - step.re();
        }
        root.at = evaluate(&root.x);
        root.evaluations += 1;
    }
    Ok(root)
}

#[cfg(test)]
mod tests {
    use super::{Evaluation, NewtonFailure, solve};
    use crate::Scalar;
    use num_dual::Dual64;

    fn equation<D: Scalar>(residual: D, slope: D) -> Evaluation<(), 1, D> {
        Evaluation { residual: [residual], jacobian: [[slope]], known: () }
    }

    fn square_root<D: Scalar>(of: D) -> impl FnMut(&[D; 1]) -> Evaluation<(), 1, D> {
        move |x| equation(x[0] * x[0] - of, x[0] * 2.0)
    }

    #[test]
    fn a_root_is_found_to_round_off() {
        let root = solve([3.0], &[2.0], square_root(2.0)).expect("a root");
        assert!((root.x[0] - 2.0_f64.sqrt()).abs() < 1e-15);
        assert!(root.iterations <= 7);
    }

    /// From the root itself too, where no iteration would touch the derivative.
    #[test]
    fn derivatives_of_a_root_are_exact() {
        for start in [3.0, 2.0] {
            let of = Dual64::new(4.0, 1.0);
            let root = solve([Dual64::from_re(start)], &[2.0], square_root(of)).expect("a root");
            assert_eq!((root.x[0].re, root.x[0].eps), (2.0, 0.25));
        }
    }

    /// Plain Newton diverges on the arc tangent from here.
    #[test]
    fn the_line_search_reaches_roots_that_full_steps_miss() {
        let arc = |x: &[f64; 1]| equation(x[0].atan(), 1.0 / (1.0 + x[0] * x[0]));
        let root = solve([20.0], &[1.0], arc).expect("a root");
        assert!(root.x[0].abs() < 1e-14);
    }

    #[test]
    fn failures_have_their_reasons() {
        let none = solve([1.0], &[1.0], square_root(-1.0));
        assert!(matches!(
            none,
            Err(NewtonFailure::NoRootNearby { .. } | NewtonFailure::SingularJacobian { .. })
        ));
        let flat = solve([0.0], &[1.0], square_root(1.0));
        assert_eq!(flat.expect_err("flat"), NewtonFailure::SingularJacobian { pivot: 0 });
        let lost = solve([1.0], &[1.0], |_| equation(f64::NAN, 1.0));
        assert_eq!(lost.expect_err("lost"), NewtonFailure::NotFinite);
    }
}
