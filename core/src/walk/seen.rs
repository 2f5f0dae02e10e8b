//! What is observed, by sides and in the heading frame.

use super::heading::Heading;
use super::{Side, Stature, SteppingFoot, capture_point};
use crate::Real;
use crate::balance::{ObservedFoot, ObservedMotion};
use nalgebra::Vector2;

/// One tick's view.
pub(super) struct Seen<'a, T, const FEET: usize> {
    pub stature: &'a Stature<T, FEET>,
    pub observed: &'a ObservedMotion<T, FEET>,
    pub heading: Heading<T>,
    /// `ξ`, world.
    pub xi: Vector2<T>,
}

impl<'a, T: Real, const FEET: usize> Seen<'a, T, FEET> {
    pub fn new(
        stature: &'a Stature<T, FEET>,
        observed: &'a ObservedMotion<T, FEET>,
        psi: T,
        omega: T,
    ) -> Self {
        let feet = stature.feet.iter().zip(&observed.feet).filter(|(foot, _)| foot.is_some());
        let lowest = feet.fold(None, |lowest: Option<T>, (_, foot)| {
            Some(lowest.map_or(foot.position.z, |z| z.min(foot.position.z)))
        });
        let height = observed.center_of_mass.z - lowest.unwrap_or(T::zero());
        Self {
            stature,
            observed,
            heading: Heading::new(psi + stature.robot.forward),
            xi: capture_point(observed, stature.robot.mass, height, omega),
        }
    }

    /// Feet that step, with their numbers.
    pub fn feet(&self) -> impl Iterator<Item = (usize, &SteppingFoot<T>, &ObservedFoot<T>)> {
        let feet = self.stature.feet.iter().zip(&self.observed.feet).enumerate();
        feet.filter_map(|(number, (foot, seen))| Some((number, foot.as_ref()?, seen)))
    }

    /// Those of a side.
    pub fn of_side(&self, side: Side) -> impl Iterator<Item = &ObservedFoot<T>> {
        self.feet().filter(move |(_, foot, _)| foot.side == side).map(|(_, _, seen)| seen)
    }

    /// Mean point of a side's feet, world.
    pub fn point(&self, side: Side) -> Vector2<T> {
        mean::<T, _>(self.of_side(side).map(|foot| foot.position.xy()), Vector2::zeros())
    }

    /// Mean height of the ground below a side's feet.
    pub fn ground(&self, side: Side) -> T {
        mean::<T, _>(self.of_side(side).map(|foot| foot.position.z), T::zero())
    }

    /// Mean point of all feet, world.
    pub fn center(&self) -> Vector2<T> {
        mean::<T, _>(self.feet().map(|(_, _, foot)| foot.position.xy()), Vector2::zeros())
    }

    /// Mean height of all feet.
    pub fn floor(&self) -> T {
        mean::<T, _>(self.feet().map(|(_, _, foot)| foot.position.z), T::zero())
    }

    /// `e`: capture point from a side's point, heading frame.
    pub fn offset(&self, side: Side) -> Vector2<T> {
        self.heading.of_world(self.xi - self.point(side))
    }
}

fn mean<T: Real, V: core::ops::Add<Output = V> + core::ops::Div<T, Output = V>>(
    values: impl Iterator<Item = V>,
    zero: V,
) -> V {
    let (sum, count) = values.fold((zero, 0_u32), |(sum, n), value| (sum + value, n + 1));
    sum / T::of(f64::from(count.max(1)))
}
