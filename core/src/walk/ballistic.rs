//! A body that nothing but gravity moves, and the push that sends it up.
//!
//! ```text
//! v² = 2 g h                        speed that rises by h                                       (1)
//! a  = (v² − ż²)/(2 s)              the constant acceleration that makes v of ż on the way s    (2)
//! t  = (ż + √(ż² + 2 g (z − z_l)))/g   until z_l is passed downwards                            (3)
//! ```

use crate::Real;

/// (1): speed at take-off, m/s, for a rise of `rise` (m).
pub fn take_off_speed<T: Real>(rise: T, gravity: T) -> T {
    (rise.max(T::zero()) * gravity * T::of(2.0)).sqrt()
}

/// (2): m/s², from the rate `rate` to the speed `to` (m/s) on the way `way` (m, positive).
pub(super) fn push<T: Real>(rate: T, to: T, way: T) -> T {
    (to * to - rate * rate.abs()) / (way * T::of(2.0))
}

/// (3): seconds until a body at `above` (m, may be negative: then zero is the least that is under the root) over its
/// landing height that rises at `rate` (m/s) comes down to it.
pub fn time_aloft<T: Real>(above: T, rate: T, gravity: T) -> T {
    let squared = rate * rate + gravity * above * T::of(2.0);
    (rate + squared.max(T::zero()).sqrt()) / gravity
}
