//! The speed loop: once a step, an integral of the error of the mean velocity over the last two steps goes
//! into the next (Raibert, chapter 2).

use super::WalkMemory;
use super::bounded::bounded;
use super::heading::Heading;
use crate::Real;
use nalgebra::Vector2;

/// A touch-down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchDown<T> {
    /// Seconds ago.
    pub age: T,
    /// Centre of mass in the world's plane, m.
    pub center: Vector2<T>,
    /// Commanded velocity, forward and left, m/s.
    pub velocity: Vector2<T>,
}

/// Takes a touch-down into the memory's correction: a `share` of the error, up to `most` (m/s).
pub(super) fn corrected<T: Real, const FEET: usize>(
    memory: &mut WalkMemory<T, FEET>,
    [share, most]: [T; 2],
    heading: Heading<T>,
    center: Vector2<T>,
) {
    let now = TouchDown { age: T::zero(), center, velocity: memory.commanded.velocity };
    let [earlier, last] = memory.touch_downs;
    if let Some(start) = earlier
        && start.age > T::zero()
    {
        let mean = heading.of_world(now.center - start.center) / start.age;
        let error = (start.velocity + now.velocity) * T::of(0.5) - mean;
        memory.correction = (memory.correction + error * share).map(|x| bounded(x, -most, most));
    }
    memory.touch_downs = [last, Some(now)];
}
