//! All of it, tick by tick.

use super::external_wrench::unexplained;
use super::ground_forces::forces;
use super::{
    BalancePoint, BalancePointSettings, ExternalWrench, ExternalWrenchSettings, FootForce,
    ObserverFault, Residual,
};
use crate::Real;
use crate::balance::{WholeBody, WholeBodyState};
use crate::dynamics::DynamicsFault;
use crate::model::Tree;
use crate::spatial::{Pose, Wrench};
use nalgebra::{Matrix3, Vector3};

/// Constants of a robot's observer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisturbanceSettings<T> {
    /// Seconds between ticks.
    pub period: T,
    /// Pole of the residual, 1/s.
    pub residual_rate: T,
    /// Of the wrench from outside.
    pub wrench: ExternalWrenchSettings<T>,
    /// Of where the body is to be.
    pub balance: BalancePointSettings<T>,
    /// From the first tick to the first wrench, s: what touch-down shakes is not outside.
    pub settle: T,
}

impl<T: Real> DisturbanceSettings<T> {
    /// Documented starting values for a mass (kg) under gravity (m/s²), a central body at a height (m) above
    /// the feet, ticks a period (s) apart, and a centre of mass that is to stand at `nominal` (m, world axes)
    /// from the mean of the feet.
    ///
    /// # Errors
    /// [`ObserverFault::Robot`].
    pub fn scaled(
        mass: T,
        gravity: T,
        height: T,
        period: T,
        nominal: [T; 2],
    ) -> Result<Self, ObserverFault> {
        Ok(Self {
            period,
            residual_rate: T::of(80.0).min(T::one() / period),
            wrench: ExternalWrenchSettings::scaled(mass, gravity, height)?,
            balance: BalancePointSettings::scaled(mass, gravity, height, nominal)?,
            settle: T::of(0.3),
        })
    }
}

/// Residual, wrench and set point of one robot.
#[derive(Clone, Copy, Debug)]
pub struct DisturbanceObserver<T, const N: usize, const NQ: usize, const NV: usize> {
    settings: DisturbanceSettings<T>,
    /// The residual's filter.
    pub residual: Residual<T, N, NQ, NV>,
    /// The wrench's.
    pub wrench: ExternalWrench<T>,
    /// The set point's.
    pub balance: BalancePoint<T>,
    /// Seconds since the first tick, as far as they matter.
    pub since: T,
}

/// What is known after a tick.
#[derive(Clone, Copy, Debug)]
pub struct Disturbance<T, const FEET: usize> {
    /// The ground's wrench on each foot, world axes.
    pub feet: [Option<FootForce<T>>; FEET],
    /// Of the residual, what those of standing feet do not explain: on the central body about its centre of
    /// mass, world axes.
    pub unexplained: Wrench<T>,
    /// The same, held back: what the controller is told.
    pub wrench: Wrench<T>,
    /// Sum of the standing feet's forces in the axes of the central body, N: at rest and without a wrench it
    /// points up, whatever the orientation is taken to be.
    pub support: Vector3<T>,
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> DisturbanceObserver<T, N, NQ, NV> {
    /// Of a robot at its first tick.
    ///
    /// # Errors
    /// An [`ObserverFault`] for a number that cannot be.
    pub fn new(settings: DisturbanceSettings<T>) -> Result<Self, ObserverFault> {
        let residual = Residual::new(settings.period, settings.residual_rate)?;
        settings.wrench.check(settings.period)?;
        let balance = settings.balance.rate * settings.period;
        if !(balance >= T::zero() && balance <= T::one()) {
            return Err(ObserverFault::Rate);
        }
        if !(settings.settle >= T::zero() && settings.balance.bound >= T::zero()) {
            return Err(ObserverFault::Bound);
        }
        Ok(Self {
            settings,
            residual,
            wrench: ExternalWrench::new(),
            balance: BalancePoint::new(),
            since: T::zero(),
        })
    }

    /// Whether it has been long enough since the first tick for a wrench from outside to be read.
    pub fn has_settled(&self) -> bool {
        self.since >= self.settings.settle
    }

    /// After the state at this tick and the torques (by velocity, N·m or N) sent from the last one to this;
    /// `standing` says which feet the ground holds. `None` at the first tick.
    ///
    /// # Errors
    /// A [`DynamicsFault`] for numbers that are not finite; then all is as it was, and the next tick is taken
    /// for a first one.
    ///
    /// # Cost
    /// An inverse dynamics, the joints' frames, and about 200 multiplications a foot. No allocation, no panic.
    #[inline]
    pub fn update<const FEET: usize>(
        &mut self,
        tree: &Tree<T, N, NQ, NV>,
        robot: &WholeBody<T, FEET, NV>,
        state: &WholeBodyState<T, NQ, NV>,
        torques: &[T; NV],
        standing: &[bool; FEET],
    ) -> Result<Option<Disturbance<T, FEET>>, DynamicsFault> {
        if !self.residual.advance(tree, state, torques)? {
            return Ok(None);
        }
        let (r, frames) = (self.residual.r(), self.residual.frames());
        let feet = forces(tree, robot, r, frames);
        let base = match r.first_chunk::<6>() {
            Some(base) => Wrench::from_array(*base),
            None => Wrench::zero(),
        };
        let unexplained = unexplained(base, &feet, standing);
        let o = center_of_mass(tree, frames);
        let central = frames.first().map_or(Matrix3::identity(), |central| central.rotation);
        let Self { settings, wrench, balance, since, .. } = self;
        let period = settings.period;
        if *since < settings.settle {
            *since += period;
        } else {
            if standing.iter().any(|stands| *stands) {
                wrench.update(&settings.wrench, unexplained, period);
            }
            let feet = (&feet, standing);
            balance.update(&settings.balance, o, &wrench.wrench, feet, period);
        }
        let mut sum = Vector3::zeros();
        for (foot, stands) in feet.iter().zip(standing) {
            if let Some(foot) = foot.as_ref().filter(|_| *stands) {
                sum += foot.wrench.force;
            }
        }
        let support = central.tr_mul(&sum);
        Ok(Some(Disturbance { feet, unexplained, wrench: wrench.wrench, support }))
    }
}

/// `o`: the centre of mass of what hangs from the central body, from that body's.
#[inline(always)]
fn center_of_mass<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    frames: &[Pose<T>; N],
) -> Vector3<T> {
    let mut hangs = [false; N];
    let (mut moment, mut mass) = (Vector3::zeros(), T::zero());
    for (k, (node, frame)) in tree.nodes.iter().zip(frames).enumerate() {
        let is_part = match node.inboard {
            None => k == 0,
            Some(inboard) => hangs.get(inboard).copied().unwrap_or(false),
        };
        if let Some(hangs) = hangs.get_mut(k) {
            *hangs = is_part;
        }
        if is_part {
            moment += frame.position * node.inertia.mass;
            if node.is_eccentric {
                moment += frame.rotation * node.inertia.first_moment;
            }
            mass += node.inertia.mass;
        }
    }
    if mass > T::zero() { moment / mass } else { moment }
}
