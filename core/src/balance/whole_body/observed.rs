//! What a measured state is by the model: the kinematics and masses of a tick, and the motion of the
//! whole that a planner reads from them.
//!
//! # Notation
//! Frame 1. `M_b`: the mass matrix's rows of the central body; `β` all velocities; `m` mass; `c` centre
//! of mass.
//! ```text
//! (p, L₁) = M_b β,     M_b = [m 1, −m ĉ, …; m ĉ, J, …]                              (1)
//! ċ = p/m,     L = L₁ − c × p                                                       (2)
//! ```
//! (1) is what `M = Σ Jᵀ I J` says of a body whose velocity all others add to theirs: momentum of the
//! whole, angular about frame 1's origin. Rotors have none in it.

use super::measured::{checked_state, first3, posture, screws};
use super::robot::Leg;
use super::{ObservedFoot, ObservedMotion, WholeBodyController, WholeBodyState};
use crate::Real;
use crate::balance::{CentralBody, Fault, Input};
use crate::dynamics::{
    BodyKinematics, JointPoses, Kinematics, forward_kinematics_in, joint_poses, mass_matrix,
};
use crate::spatial::{Quaternion, Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// A state with its kinematics and masses, from [`observe`]: read by a planner
/// ([`motion`](Self::motion)) and by the [tick](super::whole_body_motion_tick), computed once.
#[derive(Clone, Copy, Debug)]
pub struct ObservedBody<T, const N: usize, const NQ: usize, const NV: usize> {
    pub(super) state: WholeBodyState<T, NQ, NV>,
    pub(super) central: CentralBody<T>,
    /// At the world's origin, like all that follows.
    pub(super) poses: JointPoses<T, N, NQ>,
    /// Of the posture.
    pub(super) accelerations: [T; NV],
    /// With these accelerations, and a central body whose twist does not change.
    pub(super) kinematics: Kinematics<T, N>,
    /// By joint that moves a foot: twist at frame 1's origin per rate, frame 1's axes.
    pub(super) screws: [Twist<T>; NV],
    pub(super) masses: [[T; NV]; NV],
}

/// Kinematics and mass matrix at a measured state.
///
/// # Errors
/// A [`Fault`]: an input that is not finite, a quaternion that is none, or numbers so large that they
/// overflow.
///
/// # Cost
/// Kinematics and mass matrix of the tree: about half of a tick.
pub fn observe<T: Real, const N: usize, const NQ: usize, const NV: usize, const FEET: usize>(
    controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    state: &WholeBodyState<T, NQ, NV>,
) -> Result<ObservedBody<T, N, NQ, NV>, Fault> {
    let mut observed = ObservedBody::new();
    observed.observe(controller, state)?;
    Ok(observed)
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> ObservedBody<T, N, NQ, NV> {
    /// Of no robot yet: a place for [`observe`](Self::observe).
    pub fn new() -> Self {
        let zero = T::zero();
        Self {
            state: WholeBodyState { positions: [zero; NQ], velocities: [zero; NV] },
            central: CentralBody {
                rotation: Matrix3::identity(),
                orientation: Quaternion::identity(),
                velocity: Twist::zero(),
                gravity: Vector3::zeros(),
            },
            poses: JointPoses::home(),
            accelerations: [zero; NV],
            kinematics: [BodyKinematics::still(); N],
            screws: [Twist::zero(); NV],
            masses: [[zero; NV]; NV],
        }
    }

    /// [`observe`] in place, for those who keep one: copies would cost a sixth of it, and 3.5 KB of stack.
    ///
    /// # Errors
    /// As of [`observe`]; what is here is then of no state.
    pub fn observe<const FEET: usize>(
        &mut self,
        controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
        state: &WholeBodyState<T, NQ, NV>,
    ) -> Result<(), Fault> {
        let WholeBodyController { tree, robot, settings } = controller;
        self.central = checked_state(tree, state)?;
        self.state = *state;
        let mut positions = state.positions;
        positions.iter_mut().take(3).for_each(|x| *x = T::zero());
        self.poses =
            joint_poses(tree, &positions).map_err(|_| Fault::NotUnit(Input::Orientation))?;
        self.accelerations = posture(robot, settings, state);
        let Self { poses, accelerations, kinematics, central, .. } = self;
        forward_kinematics_in(tree, poses, &state.velocities, accelerations, kinematics);
        self.screws = screws(tree, robot, kinematics, &central.rotation);
        self.masses = mass_matrix(tree, poses);
        let is_finite = self.masses.as_flattened().iter().all(|x| x.is_finite());
        if is_finite { Ok(()) } else { Err(Fault::Overflow) }
    }

    /// The state that it was observed at.
    pub fn state(&self) -> &WholeBodyState<T, NQ, NV> {
        &self.state
    }

    /// Centre of mass and momentum of the whole, central body and feet.
    ///
    /// # Errors
    /// [`Fault::Overflow`] where a velocity is so large that a momentum is not finite.
    ///
    /// # Cost
    /// About `12 NV + 150` multiplications for each foot.
    pub fn motion<const FEET: usize>(
        &self,
        controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
    ) -> Result<ObservedMotion<T, FEET>, Fault> {
        let r = &self.central.rotation;
        let origin = first3(&self.state.positions);
        // (1)
        let mut momentum = [T::zero(); 6];
        for (to, row) in momentum.iter_mut().zip(&self.masses) {
            let all = row.iter().zip(&self.state.velocities);
            *to = all.fold(T::zero(), |sum, (mass, rate)| sum + *mass * *rate);
        }
        let momentum = Wrench::from_array(momentum);
        let mass = controller.robot.mass;
        let center = center_of_mass(&self.masses, mass);
        let angular = momentum.torque - center.cross(&momentum.force);
        let mut feet = [ObservedFoot {
            position: Vector3::zeros(),
            rotation: Matrix3::zeros(),
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            leg: Vector3::zeros(),
        }; FEET];
        for (to, leg) in feet.iter_mut().zip(&controller.robot.legs) {
            if let Some(leg) = leg {
                *to = self.foot(controller, leg, origin).ok_or(Fault::NotHeld)?;
            }
        }
        let motion = ObservedMotion {
            center_of_mass: origin + r * center,
            velocity: r * (momentum.force / mass),
            angular_momentum: r * angular,
            central_rotation: *r,
            angular_velocity: r * self.central.velocity.angular,
            feet,
        };
        let of_feet = motion.feet.iter().map(|foot| foot.velocity + foot.angular_velocity);
        let sum = of_feet.fold(motion.velocity + motion.angular_momentum, |sum, v| sum + v);
        if sum.iter().all(|x| x.is_finite()) { Ok(motion) } else { Err(Fault::Overflow) }
    }

    /// `None` for a foot of another tree.
    #[inline(always)]
    fn foot<const FEET: usize>(
        &self,
        controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
        leg: &Leg<T>,
        origin: Vector3<T>,
    ) -> Option<ObservedFoot<T>> {
        let body = self.kinematics.get(leg.foot.body)?;
        let (rotation, r) = (&body.pose.rotation, leg.foot.reference);
        let w = body.velocity.angular;
        let point = body.pose.position + rotation * r;
        let moments = leg.foot.limits.patch.moments();
        let is_point = moments == [false; 3];
        let ankle = self.joint_position(controller, leg.joints.first().copied()?)?;
        let hip =
            self.joint_position(controller, leg.joints.get(leg.count.checked_sub(1)?).copied()?)?;
        Some(ObservedFoot {
            position: origin + point,
            rotation: if is_point { Matrix3::identity() } else { rotation * leg.axes },
            velocity: rotation * (body.velocity.linear + w.cross(&r)),
            angular_velocity: rotation * w,
            leg: (if is_point { point } else { ankle }) - hip,
        })
    }

    /// Where a joint is, from frame 1's origin, world axes.
    #[inline(always)]
    fn joint_position<const FEET: usize>(
        &self,
        controller: &WholeBodyController<'_, T, N, NQ, NV, FEET>,
        velocity: usize,
    ) -> Option<Vector3<T>> {
        let joint = controller.robot.joints.get(velocity)?.as_ref()?;
        let node = controller.tree.nodes.get(joint.node)?;
        let pose = &self.kinematics.get(joint.node)?.pose;
        let center = match &node.body_rotation {
            None => node.center,
            Some(r) => r.tr_mul(&node.center),
        };
        Some(pose.position - pose.rotation * center)
    }
}

/// `c` of (1), from frame 1's origin, of the masses of a whole that weighs `mass`.
#[inline(always)]
pub(super) fn center_of_mass<T: Real, const NV: usize>(
    masses: &[[T; NV]; NV],
    mass: T,
) -> Vector3<T> {
    let entry =
        |i: usize, j: usize| masses.get(i).and_then(|row| row.get(j)).copied().unwrap_or(T::zero());
    Vector3::new(entry(5, 1), entry(3, 2), entry(4, 0)) / mass
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Default
    for ObservedBody<T, N, NQ, NV>
{
    fn default() -> Self {
        Self::new()
    }
}
