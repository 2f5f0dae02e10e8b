//! The residual of the equations of motion: what acts on a robot beside its motors and its model.
//!
//! # Notation
//! Ticks `k`, a period `Δ` apart; `q, v` coordinates and velocities, `τ` what the motors were sent from one
//! tick to the next; `ID` inverse dynamics (Alg. 3.2).
//! ```text
//! e_k = ID(q_{k−1}, v_{k−1}, (v_k − v_{k−1})/Δ) − S τ_{k−1}                      (1)
//! r ← r + K Δ (e_k − r)                                                          (2)
//! ```
//! The generalized-momentum observer (De Luca and Mattone, ICRA 2005) in difference form: momentum's rate is
//! `M v̇ + Ṁ v`, and (1) has it without the transposed Coriolis matrix. What is left is
//! `r = Σ J_iᵀ F_i`, of all wrenches on all bodies, held back by a pole at `K`.
//!
//! The six rows of a floating central body are turned to world axes before they are held back: a load pulls
//! along the world's vertical while the robot leans.
//!
//! # Accuracy
//! (1) is exact at rest. In motion its error is of the order of `Δ`, and a velocity's noise comes in as
//! `M δv/Δ`, of which (2) leaves about `√(K Δ/2)`.

use super::ObserverFault;
use crate::Real;
use crate::balance::WholeBodyState;
use crate::dynamics::{
    DynamicsFault, JointPoses, floating_inverse_dynamics, inverse_dynamics, joint_frames,
    joint_poses,
};
use crate::model::Tree;
use crate::spatial::{Pose, Wrench};

/// The last tick's state, and (2).
#[derive(Clone, Copy, Debug)]
pub struct Residual<T, const N: usize, const NQ: usize, const NV: usize> {
    /// `K Δ`
    gain: T,
    /// `1/Δ`
    per_second: T,
    before: Option<Before<T, N, NQ, NV>>,
    r: [T; NV],
    /// As of a reading.
    frames: [Pose<T>; N],
}

/// A state that was measured. Its central body is at the origin.
#[derive(Clone, Copy, Debug)]
struct Before<T, const N: usize, const NQ: usize, const NV: usize> {
    poses: JointPoses<T, N, NQ>,
    velocities: [T; NV],
}

/// `r` of a tick, and the poses that it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct ResidualReading<T, const N: usize, const NV: usize> {
    /// `r` by velocity, N and N·m; of the central body a wrench about its centre of mass, in world axes.
    pub r: [T; NV],
    /// World axes from those of each joint's frame, at the tick before; positions from the central body's centre
    /// of mass, m.
    pub(crate) frames: [Pose<T>; N],
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Residual<T, N, NQ, NV> {
    /// Documented starting value of `K`, 1/s.
    pub const RATE: f64 = 80.0;

    /// Of ticks `period` seconds apart, with a pole at `rate` (1/s).
    ///
    /// # Errors
    /// [`ObserverFault::Period`], [`ObserverFault::Rate`] for a pole faster than a tick.
    pub fn new(period: T, rate: T) -> Result<Self, ObserverFault> {
        if !(period > T::zero() && period.is_finite()) {
            return Err(ObserverFault::Period);
        }
        let gain = rate * period;
        if !(gain > T::zero() && gain <= T::one()) {
            return Err(ObserverFault::Rate);
        }
        let frames = [Pose::identity(); N];
        Ok(Self { gain, per_second: T::one() / period, before: None, r: [T::zero(); NV], frames })
    }

    /// (1) and (2) for the state at this tick and the torques (by velocity, N·m or N; those of the central
    /// body are not read) sent from the last one to this. `None` at the first tick.
    ///
    /// # Errors
    /// A [`DynamicsFault`] for coordinates or a result that are not finite; then the next tick is a first
    /// one, and `r` is as it was.
    ///
    /// # Cost
    /// One inverse dynamics with the joints' frames. No allocation, no panic.
    #[inline]
    pub fn update(
        &mut self,
        tree: &Tree<T, N, NQ, NV>,
        state: &WholeBodyState<T, NQ, NV>,
        torques: &[T; NV],
    ) -> Result<Option<ResidualReading<T, N, NV>>, DynamicsFault> {
        let is_read = self.advance(tree, state, torques)?;
        Ok(is_read.then_some(ResidualReading { r: self.r, frames: self.frames }))
    }

    /// The same in place: whether it was not the first tick.
    #[inline(always)]
    pub(super) fn advance(
        &mut self,
        tree: &Tree<T, N, NQ, NV>,
        state: &WholeBodyState<T, NQ, NV>,
        torques: &[T; NV],
    ) -> Result<bool, DynamicsFault> {
        let mut positions = state.positions;
        positions.iter_mut().take(3).for_each(|x| *x = T::zero());
        let poses = joint_poses(tree, &positions);
        let found = match (&self.before, &poses) {
            (Some(before), Ok(_)) => {
                let mut accelerations = state.velocities;
                for (x, old) in accelerations.iter_mut().zip(&before.velocities) {
                    *x = (*x - *old) * self.per_second;
                }
                let frames = &mut self.frames;
                difference(tree, before, &accelerations, torques, frames).map(Some)
            }
            _ => Ok(None),
        };
        self.before = None;
        let (poses, found) = (poses?, found?);
        self.before = Some(Before { poses, velocities: state.velocities });
        let Some(e) = found else { return Ok(false) };
        for (r, e) in self.r.iter_mut().zip(&e) {
            *r += (*e - *r) * self.gain;
        }
        Ok(true)
    }

    /// The frames of the last reading.
    #[inline(always)]
    pub(super) fn frames(&self) -> &[Pose<T>; N] {
        &self.frames
    }

    /// `r`, to be kept; see [`restore`](Self::restore).
    pub fn r(&self) -> &[T; NV] {
        &self.r
    }

    /// Goes on with an `r` that was kept, after a tick in `state`.
    pub fn restore(
        &mut self,
        tree: &Tree<T, N, NQ, NV>,
        state: &WholeBodyState<T, NQ, NV>,
        r: &[T; NV],
    ) {
        let mut positions = state.positions;
        positions.iter_mut().take(3).for_each(|x| *x = T::zero());
        let poses = joint_poses(tree, &positions).ok();
        self.before = poses.map(|poses| Before { poses, velocities: state.velocities });
        self.r = *r;
    }
}

/// (1), in world axes where the central body's are, and the joints' frames.
#[inline(always)]
fn difference<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    Before { poses, velocities }: &Before<T, N, NQ, NV>,
    accelerations: &[T; NV],
    torques: &[T; NV],
    frames: &mut [Pose<T>; N],
) -> Result<[T; NV], DynamicsFault> {
    let mut e = [T::zero(); NV];
    let found = floating_inverse_dynamics::<_, N, NQ, NV, true>(
        tree,
        poses,
        velocities,
        accelerations,
        frames,
        &mut e,
    );
    if found.is_none() {
        of_any(tree, poses, velocities, accelerations, frames, &mut e);
    }
    if let (Some(base), Some(central)) = (e.first_chunk_mut::<6>(), frames.first()) {
        let wrench = Wrench::from_array(*base);
        let (force, torque) = (central.rotation * wrench.force, central.rotation * wrench.torque);
        *base = Wrench { force, torque }.to_array();
    }
    for (e, torque) in e.iter_mut().zip(torques).skip(6) {
        *e -= *torque;
    }
    match e.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(DynamicsFault::ResultNotFinite { index }),
        None => Ok(e),
    }
}

/// Inverse dynamics and frames of trees with rotors, or with other joints than revolute ones.
#[cold]
#[inline(never)]
fn of_any<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
    frames: &mut [Pose<T>; N],
    torques: &mut [T; NV],
) {
    *torques = inverse_dynamics(tree, poses, velocities, accelerations, None);
    *frames = joint_frames(tree, poses);
}
