//! Which branch of solutions a step is on.

use super::StepFailure;
use crate::Scalar;
use crate::newton::Factors;

/// Refuses a root behind a fold.
///
/// For a short step the Jacobian's determinant is positive, as kinetic energy is: there it is a
/// positive multiple of `h^{2C} det(M) det(G M⁻¹ Gᵀ)`. Along the branch of roots that short steps lead
/// to it can change its sign only at a fold, so that behind the first fold it is negative.
pub(super) fn on_branch_of_short_steps<D: Scalar, const U: usize>(
    jacobian: &[[D; U]; U],
) -> Result<(), StepFailure> {
    let real = jacobian.map(|row| row.map(|x| x.re()));
    match Factors::new(real) {
        Ok(factors) if factors.determinant_is_positive() => Ok(()),
        _ => Err(StepFailure::WrongBranch),
    }
}
