//! Where the central body has to be for the robot to stand as one without a load would.
//!
//! # Notation
//! World axes, horizontal but for `r_z`. `f` mean of the feet's reference points, `r` central body's centre
//! of mass (`r_z` its height above f), `c` the model's centre of mass, `o = c − r`; `(W, M)` the wrench from
//! outside at r; `n` where the centre of mass of a robot without a load is to stand, from f.
//! ```text
//! p₀ = r + o + d,   d = ((r_z W_x + M_y + W_z o_x)/(m g − W_z), (r_z W_y − M_x + W_z o_y)/(m g − W_z))   (1)
//! p₀ − f = n   ⇒   r* = f + n − o − d,   |d| ≤ bound                             (2)
//! ```
//! `p₀` is the point on the ground about which weight and W have no moment: at rest the ground's forces act
//! there, whatever tilts, loads or misplaces the model (Stephens, IROS 2011; Xinjilefu, Feng and Atkeson,
//! Humanoids 2015). f and n are both seen through the same encoders and the same orientation, so that an
//! error of the latter cancels. (1) is held back by the pole of the wrench.

use super::{FootForce, ObserverFault};
use crate::Real;
use crate::spatial::Wrench;
use nalgebra::Vector3;

/// What (1) and (2) are told of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalancePointSettings<T> {
    /// `m g` of the model, N.
    pub weight: T,
    /// `n`, m.
    pub nominal: [T; 2],
    /// Greatest `|d|` in either direction, m.
    pub bound: T,
    /// Pole, 1/s.
    pub rate: T,
}

impl<T: Real> BalancePointSettings<T> {
    /// Documented starting values: d at most 0.08 of the height (m), a pole of 2 /s.
    ///
    /// # Errors
    /// [`ObserverFault::Robot`] where mass, gravity or height is not positive and finite.
    pub fn scaled(mass: T, gravity: T, height: T, nominal: [T; 2]) -> Result<Self, ObserverFault> {
        let weight = mass * gravity;
        let is_finite = nominal.iter().all(|x| x.is_finite()) && (weight * height).is_finite();
        if !(weight > T::zero() && height > T::zero() && is_finite) {
            return Err(ObserverFault::Robot);
        }
        Ok(Self { weight, nominal, bound: height * T::of(0.08), rate: T::of(2.0) })
    }
}

/// `r*`, held back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalancePoint<T> {
    /// `r* − f`, m; `None` before all feet have stood.
    pub from_feet: Option<[T; 2]>,
    /// `d` before its bound, m: how far the model's centre of mass is off.
    pub offset: [T; 2],
    /// `f − r`, m: the mean of the feet from the central body, as seen last.
    pub feet: Vector3<T>,
}

impl<T: Real> BalancePoint<T> {
    /// Before the first tick.
    pub fn new() -> Self {
        Self { from_feet: None, offset: [T::zero(); 2], feet: Vector3::zeros() }
    }

    /// Another tick after `period` seconds, for `o` and a wrench. Nothing changes while not all feet of the
    /// robot stand.
    #[inline(always)]
    pub fn update<const FEET: usize>(
        &mut self,
        settings: &BalancePointSettings<T>,
        o: Vector3<T>,
        wrench: &Wrench<T>,
        (feet, standing): (&[Option<FootForce<T>>; FEET], &[bool; FEET]),
        period: T,
    ) {
        let mut sum = Vector3::zeros();
        let mut count = T::zero();
        for (foot, stands) in feet.iter().zip(standing) {
            let Some(foot) = foot else { continue };
            if !stands {
                return;
            }
            sum += foot.position;
            count += T::one();
        }
        let carried = settings.weight - wrench.force.z;
        // Nothing stands that is lifted by more than nine tenths of its weight.
        if !(count > T::zero() && carried > settings.weight * T::of(0.1)) {
            return;
        }
        self.feet = sum / count;
        let height = -self.feet.z;
        let Wrench { force: w, torque: m } = wrench;
        self.offset = [
            (height * w.x + m.y + w.z * o.x) / carried,
            (height * w.y - m.x + w.z * o.y) / carried,
        ];
        let [dx, dy] = self.offset.map(|d| d.max(-settings.bound).min(settings.bound));
        let [nx, ny] = settings.nominal;
        let target = [nx - o.x - dx, ny - o.y - dy];
        let [x, y] = self.from_feet.unwrap_or(target);
        let gain = settings.rate * period;
        let [to_x, to_y] = target;
        self.from_feet = Some([x + (to_x - x) * gain, y + (to_y - y) * gain]);
    }

    /// (2): where the central body is to be, for where it is seen; `wanted` where nothing is known yet. Its
    /// height is the wanted one.
    #[inline(always)]
    pub fn reference(&self, seen: Vector3<T>, wanted: Vector3<T>) -> Vector3<T> {
        match self.from_feet {
            None => wanted,
            Some([x, y]) => {
                Vector3::new(seen.x + self.feet.x + x, seen.y + self.feet.y + y, wanted.z)
            }
        }
    }
}

impl<T: Real> Default for BalancePoint<T> {
    fn default() -> Self {
        Self::new()
    }
}
