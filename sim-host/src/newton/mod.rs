//! The one nonlinear solver: Newton's method with a backtracking line search (Dennis and Schnabel
//! 1983, alg. A6.3.1). It gives a root to round-off or says why not, and never the last iterate.

mod linear;

pub use linear::{Factors, solve_linear};

/// Residual and Jacobian (by rows) at a point.
pub type Evaluation<const U: usize> = ([f64; U], [[f64; U]; U]);

/// A root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root<const U: usize> {
    /// Where it is.
    pub x: [f64; U],
    /// Newton steps made.
    pub iterations: u32,
    /// Largest residual there, in units of the scale.
    pub residual: f64,
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
/// # Errors
/// A [`NewtonFailure`].
///
/// # Cost
/// One evaluation and one factorisation an iteration, and one more evaluation for each halving.
pub fn solve<const U: usize>(
    mut x: [f64; U],
    scale: &[f64; U],
    mut evaluate: impl FnMut(&[f64; U]) -> Evaluation<U>,
) -> Result<Root<U>, NewtonFailure> {
    let size = |residual: &[f64; U]| {
        residual.iter().zip(scale).fold(0.0_f64, |m, (r, s)| {
            // `max` would lose a NaN.
            let r = (r / s).abs();
            if r > m || r.is_nan() { r } else { m }
        })
    };
    let (mut residual, mut jacobian) = evaluate(&x);
    let mut error = size(&residual);
    for iterations in 0..=MOST_ITERATIONS {
        if !error.is_finite() {
            return Err(NewtonFailure::NotFinite);
        }
        if error <= ROUND_OFF {
            return Ok(Root { x, iterations, residual: error });
        }
        if iterations == MOST_ITERATIONS {
            return Err(NewtonFailure::TooManyIterations { iterations, residual: error });
        }
        let step = solve_linear(jacobian, residual)
            .map_err(|pivot| NewtonFailure::SingularJacobian { pivot })?;
        let mut share = 1.0;
        let mut halvings = 0;
        loop {
            let trial: [f64; U] = std::array::from_fn(|i| x[i] - share * step[i]);
            let (trial_residual, trial_jacobian) = evaluate(&trial);
            let trial_error = size(&trial_residual);
            // Sufficient decrease; NaN is none.
            if trial_error <= (1.0 - 1e-4 * share) * error {
                (x, residual, jacobian, error) =
                    (trial, trial_residual, trial_jacobian, trial_error);
                break;
            }
            // Near a root round-off has the last word.
            if error <= TOLERANCE {
                return Ok(Root { x, iterations, residual: error });
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

#[cfg(test)]
mod tests {
    use super::{NewtonFailure, solve};

    fn square_root(of: f64) -> impl FnMut(&[f64; 1]) -> ([f64; 1], [[f64; 1]; 1]) {
        move |x| ([x[0] * x[0] - of], [[2.0 * x[0]]])
    }

    #[test]
    fn a_root_is_found_to_round_off() {
        let root = solve([3.0], &[2.0], square_root(2.0)).expect("a root");
        assert!((root.x[0] - 2.0_f64.sqrt()).abs() < 1e-15);
        assert!(root.iterations <= 7);
    }

    /// Plain Newton diverges on the arc tangent from here.
    #[test]
    fn the_line_search_reaches_roots_that_full_steps_miss() {
        let arc = |x: &[f64; 1]| ([x[0].atan()], [[1.0 / (1.0 + x[0] * x[0])]]);
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
        assert_eq!(
            solve([0.0], &[1.0], square_root(1.0)),
            Err(NewtonFailure::SingularJacobian { pivot: 0 })
        );
        assert_eq!(solve([1.0], &[1.0], |_| ([f64::NAN], [[1.0]])), Err(NewtonFailure::NotFinite));
    }
}
