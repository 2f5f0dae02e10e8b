//! What a plan can be made of.

use super::{Planner, WalkFault, WalkInput};
use crate::Real;
use crate::balance::ObservedMotion;

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    /// Whether every number that is read is finite.
    pub(super) fn check(
        &self,
        observed: &ObservedMotion<T, FEET>,
        forces: &[T; FEET],
        dt: T,
    ) -> Result<(), WalkFault> {
        if !(dt > T::zero() && dt.is_finite()) {
            return Err(WalkFault::Period);
        }
        let whole = observed.center_of_mass + observed.velocity + observed.angular_momentum;
        if !whole.sum().is_finite() {
            return Err(WalkFault::NotFinite(WalkInput::CenterOfMass));
        }
        if !(observed.central_rotation.sum() + observed.angular_velocity.sum()).is_finite() {
            return Err(WalkFault::NotFinite(WalkInput::CentralBody));
        }
        let feet = self.stature.feet.iter().zip(&observed.feet).zip(forces).enumerate();
        for (number, ((_, foot), force)) in feet.filter(|(_, ((foot, _), _))| foot.is_some()) {
            let vectors = foot.position + foot.velocity + foot.angular_velocity + foot.leg;
            if !(vectors.sum() + foot.rotation.sum()).is_finite() {
                return Err(WalkFault::NotFinite(WalkInput::Foot(number)));
            }
            if !force.is_finite() {
                return Err(WalkFault::NotFinite(WalkInput::Force(number)));
            }
        }
        Ok(())
    }
}
