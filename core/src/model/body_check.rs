//! Which mass and inertia a body can have.

use super::LinkFault;

/// Relative rounding of moments of inertia in printed data and robot files.
const PRINTED: f64 = 1e-9;

/// Relative rounding of arithmetic that moves an inertia by a link's length and back, with a margin:
/// 45 units in the last place.
const ARITHMETIC: f64 = 1e-14;

/// Refuses what no body can have. A body without mass and inertia is allowed inside a branch.
///
/// `length` (m) is the link's size: what is small beside m · length² cannot be told from round-off.
/// No margin is absolute, so that a robot may be of any size.
pub(super) const fn check_body(
    mass: f64,
    inertia: [f64; 6],
    length_squared: f64,
) -> Result<(), LinkFault> {
    if !(mass >= 0.0 && mass.is_finite()) {
        return Err(LinkFault::Mass);
    }
    let [xx, yy, zz, yz, zx, xy] = inertia;
    let sum = xx + yy + zz;
    if !(sum.is_finite() && yz.is_finite() && zx.is_finite() && xy.is_finite()) {
        return Err(LinkFault::Inertia);
    }
    if mass == 0.0 {
        let is_zero = xx == 0.0 && yy == 0.0 && zz == 0.0 && yz == 0.0 && zx == 0.0 && xy == 0.0;
        return if is_zero { Ok(()) } else { Err(LinkFault::InertiaWithoutMass) };
    }
    // The second moments of the mass, ½ tr(I) 1 − I, form a positive semi-definite matrix
    // (equivalently, principal inertias obey the triangle inequality): its minors are not negative.
    let (a, b, c) = (0.5 * sum - xx, 0.5 * sum - yy, 0.5 * sum - zz);
    let slack = PRINTED * sum.abs() + ARITHMETIC * mass * length_squared;
    if !(a >= -slack && b >= -slack && c >= -slack) {
        return Err(LinkFault::Moments);
    }
    let scale = sum.abs() + slack;
    let determinant = a * (b * c - yz * yz) - xy * (xy * c + yz * zx) - zx * (xy * yz + b * zx);
    if !(a * b - xy * xy >= -slack * scale
        && b * c - yz * yz >= -slack * scale
        && c * a - zx * zx >= -slack * scale
        && determinant >= -slack * scale * scale)
    {
        return Err(LinkFault::Products);
    }
    Ok(())
}
