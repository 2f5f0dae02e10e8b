//! Numbers kept within bounds.

use crate::Real;

/// The nearest number from `least` to `most`; NaN stays NaN. Unlike `clamp` it has no panic for bounds that
/// contradict each other: then it gives `least` or `most`.
pub(super) fn bounded<T: Real>(x: T, least: T, most: T) -> T {
    if x < least {
        least
    } else if x > most {
        most
    } else {
        x
    }
}
