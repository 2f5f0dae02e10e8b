//! What is out of bounds, and by how much.

use super::{Bounds, Estimator, EstimatorState, Innovation};
use crate::Real;

/// What can be out of bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Concern {
    /// `|b_f|`: an estimate that was started wrong, or a sensor that is not mounted as said.
    AccelerometerBias,
    /// `|b_w|`
    GyroscopeBias,
    /// Foot number is not where it has stood: it slips, or its switch lies. m
    FootPosition(usize),
    /// Foot number is turned against how it has stood. rad
    FootOrientation(usize),
    /// The switch of foot number and the plan disagree. s
    Switch(usize),
    /// No foot stands: position and velocity are the inertial sensor's alone. s
    Airborne,
    /// The covariance is not positive any more: measurements were left out. Start again.
    Covariance,
}

/// One thing that is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OutOfBounds<T> {
    /// What.
    pub concern: Concern,
    /// How much it is.
    pub size: T,
    /// How much it may be.
    pub limit: T,
}

/// What is out of bounds in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Health<T> {
    /// That which is farthest beyond its bound, as a ratio.
    pub worst: Option<OutOfBounds<T>>,
    /// How many things are.
    pub count: u8,
}

impl<T: Real> Health<T> {
    /// Whether nothing is.
    pub fn is_good(&self) -> bool {
        self.count == 0
    }

    #[inline(always)]
    fn look(&mut self, concern: Concern, size: T, limit: T) {
        // NaN is beyond every bound.
        if size <= limit {
            return;
        }
        self.count = self.count.saturating_add(1);
        let is_worse =
            self.worst.as_ref().is_none_or(|worst| size * worst.limit > worst.size * limit);
        if is_worse {
            self.worst = Some(OutOfBounds { concern, size, limit });
        }
    }
}

/// Of a state at the end of a tick.
#[inline(always)]
pub(super) fn health<T: Real, const FEET: usize>(
    settings: &Estimator<T, FEET>,
    state: &EstimatorState<T, FEET>,
    innovations: &[Option<Innovation<T>>; FEET],
    is_indefinite: bool,
) -> Health<T> {
    let Bounds { accelerometer_bias, gyroscope_bias, disagreement_s, airborne_s, .. } =
        settings.bounds;
    let Bounds { position_innovation, orientation_innovation, .. } = settings.bounds;
    let mut health = Health { worst: None, count: 0 };
    health.look(Concern::AccelerometerBias, state.accelerometer_bias.norm(), accelerometer_bias);
    health.look(Concern::GyroscopeBias, state.gyroscope_bias.norm(), gyroscope_bias);
    let seconds = |ticks: u16| T::of(f64::from(ticks)) * settings.period_s;
    health.look(Concern::Airborne, seconds(state.airborne), airborne_s);
    for (number, (foot, innovation)) in state.feet.iter().zip(innovations).enumerate() {
        health.look(Concern::Switch(number), seconds(foot.disagreement), disagreement_s);
        if let Some(innovation) = innovation {
            let size = innovation.position.amax();
            // One that made the foot anew counts even where the bound is wider than the gate.
            let limit = if innovation.is_reset {
                position_innovation.min(settings.gate)
            } else {
                position_innovation
            };
            health.look(Concern::FootPosition(number), size, limit);
            let size = innovation.orientation.norm();
            health.look(Concern::FootOrientation(number), size, orientation_innovation);
        }
    }
    if is_indefinite {
        health.look(Concern::Covariance, T::one(), T::zero());
    }
    health
}

impl core::fmt::Display for Concern {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::AccelerometerBias => f.write_str("the accelerometer's bias (m/s²)"),
            Self::GyroscopeBias => f.write_str("the gyroscope's bias (rad/s)"),
            Self::FootPosition(foot) => write!(f, "how far foot {foot} is from where it stood (m)"),
            Self::FootOrientation(foot) => {
                write!(f, "how far foot {foot} is turned from how it stood (rad)")
            }
            Self::Switch(foot) => {
                write!(f, "for how long the switch of foot {foot} and the plan disagree (s)")
            }
            Self::Airborne => f.write_str("for how long no foot stands (s)"),
            Self::Covariance => f.write_str("the covariance, which is not positive"),
        }
    }
}

impl<T: Real> core::fmt::Display for OutOfBounds<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { concern, size, limit } = self;
        write!(f, "{concern}: {:.3}, bound {:.3}", size.to_f64(), limit.to_f64())
    }
}
