//! What the filter remembers from tick to tick.

use super::covariance::{Covariance, FOOT_ORIENTATION, FOOT_POSITION, Present};
use super::{EstimateFault, Estimator, FootKind, Readings, StartPose};
use crate::Real;
use crate::spatial::Quaternion;
use nalgebra::Vector3;

/// A foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootState<T> {
    /// `p_i`, world, m. As it stood last, of a foot that does not stand.
    pub position: Vector3<T>,
    /// World from sole, unit quaternion.
    pub orientation: Quaternion<T>,
    /// Ticks for which it has stood; 0 if it does not.
    pub age: u16,
    /// Whether its position is among the errors: it has been measured since it stands.
    pub is_known: bool,
    /// Ticks for which its switch and the plan have disagreed.
    pub disagreement: u16,
}

/// The state: 2.4 kB in f32 with two feet, 4.9 kB with four.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimatorState<T, const FEET: usize> {
    /// `r`: the inertial sensor's point, world, m.
    pub position: Vector3<T>,
    /// `v`: its velocity, world axes, m/s.
    pub velocity: Vector3<T>,
    /// World from central body, unit quaternion.
    pub orientation: Quaternion<T>,
    /// `b_f`, body axes, m/s².
    pub accelerometer_bias: Vector3<T>,
    /// `b_w`, body axes, rad/s.
    pub gyroscope_bias: Vector3<T>,
    /// By number.
    pub feet: [FootState<T>; FEET],
    /// Specific force, drawn from sample to sample while (9) is fed, body axes, m/s².
    pub(super) smooth_force: Vector3<T>,
    /// Ticks since the start, modulo 2³²: whose turn it is.
    pub(super) tick: u32,
    /// Ticks in which no foot has stood.
    pub(super) airborne: u16,
    pub(super) covariance: Covariance<T, FEET>,
}

impl<T: Real, const FEET: usize> EstimatorState<T, FEET> {
    /// A robot at rest: tilt from the accelerometer, biases zero. The step of the same tick, with the same readings,
    /// comes after it.
    ///
    /// # Errors
    /// [`EstimateFault::NotAtRest`], or an input or setting that cannot be.
    pub fn start(
        settings: &Estimator<T, FEET>,
        readings: &Readings<T, FEET>,
        pose: &StartPose<T>,
    ) -> Result<Self, EstimateFault> {
        super::start::start(settings, readings, pose)
    }

    /// Standard deviations of position (m), velocity (m/s), tilt and heading (rad, body axes), and biases of
    /// accelerometer (m/s²) and gyroscope (rad/s), as the filter takes them to be.
    pub fn deviations(&self) -> [Vector3<T>; 5] {
        self.covariance.variances().map(|v| v.map(|x| x.max(T::zero()).sqrt()))
    }

    /// Rows of `P` for tests of symmetry and sign: entry `(i, j)` of the errors that there are now, in the order
    /// `δr δv δθ δb_f δb_w`, then `δp_i δφ_i` by foot; `None` beyond them. Slow.
    pub fn covariance_entry(
        &self,
        settings: &Estimator<T, FEET>,
        row: usize,
        column: usize,
    ) -> Option<T> {
        let present = self.present(settings);
        let feet = present.iter().enumerate().flat_map(|(foot, parts)| {
            parts.iter().enumerate().filter(|(_, is)| **is).map(move |(part, _)| (foot, part))
        });
        let foot_of = |error: usize| feet.clone().nth(error - super::covariance::BODY);
        let (j, k) = (row / 3, column / 3);
        let of_column = if k < super::covariance::BODY {
            let p = &self.covariance;
            match k {
                0 => p.column::<0>(),
                1 => p.column::<1>(),
                2 => p.column::<2>(),
                3 => p.column::<3>(),
                _ => p.column::<4>(),
            }
        } else {
            let (foot, part) = foot_of(k)?;
            self.covariance.foot_column(foot, part)
        };
        let block = match of_column.body.get(j) {
            Some(block) => block,
            None => {
                let (foot, part) = foot_of(j)?;
                of_column.feet.get(foot)?.get(part)?
            }
        };
        block.get((row % 3, column % 3)).copied()
    }

    /// Errors of feet that there are.
    #[inline(always)]
    pub(super) fn present(&self, settings: &Estimator<T, FEET>) -> Present<FEET> {
        let mut present = [[false; 2]; FEET];
        for ((parts, foot), kind) in present.iter_mut().zip(&self.feet).zip(&settings.feet) {
            parts[FOOT_POSITION] = foot.is_known;
            parts[FOOT_ORIENTATION] = foot.is_known && *kind == Some(FootKind::Sole);
        }
        present
    }

    /// Whether all that is put out is finite.
    #[inline(always)]
    pub(super) fn is_finite(&self) -> bool {
        let vectors =
            [&self.position, &self.velocity, &self.accelerometer_bias, &self.gyroscope_bias];
        vectors.into_iter().all(|v| v.iter().all(|x| x.is_finite()))
            && self.orientation.norm_squared().is_finite()
    }
}
