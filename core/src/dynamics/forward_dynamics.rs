//! Algorithm 3.3: joint accelerations for given torques, by articulated-body inertias.
//!
//! # Notation
//! In joint frames, with classical accelerations less gravity `a'` (see the module's page):
//! - `P, z` articulated inertia and bias: `F = P a' + z` (3.36)
//! - `U = P H`, `D = Hᵀ U + I` with the joint's rotor inertia `I`, `u = τ − Hᵀ z`, `c` velocity
//!   products
//!
//! ```text
//! D β̇ = u − Uᵀ (A a'_{k.i} + c)                                            (3.59)
//! P_{k.i} += Aᵀ (P − U D⁻¹ Uᵀ) A                                           (3.51)
//! z_{k.i} += Aᵀ (z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u)                           (3.52)
//! ```
//! The text's `Lᵀ P L` equals `Aᵀ (P − U D⁻¹ Uᵀ) A` by (3.57) and costs twice as much.

use super::floating_root;
use super::forward_limbs::{LimbState, first_pass, inboard_pass, last_pass};
use super::inverse_dynamics::{VelocityTerms, at_joint, carried, velocity_terms};
use super::joint_block::JointBlock;
use super::joint_motion::{JointMotion, own, own_one};
use super::joint_poses::relative;
use super::lanes::{Lanes, along_limb};
use super::reversed::reversed;
use super::{DynamicsFault, JointPoses};
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{ArticulatedInertia, AxisTurn, Quaternion, Twist, Wrench};
use nalgebra::Vector3;

/// What the inboard pass leaves for the outboard pass at a joint with one degree of freedom.
#[derive(Clone, Copy)]
pub(crate) struct Hinge<T> {
    /// `U`
    image: Wrench<T>,
    /// `D⁻¹`
    inverse: T,
    /// `u`
    excess: T,
}

/// Joint accelerations `β̇` under torques `torques`, gravity and `external` wrenches (each at its
/// body's centre of mass, in its body frame). A floating joint's six are the component derivatives of
/// its body twist, its torques a wrench on the body.
///
/// # Errors
/// [`DynamicsFault::SingularInertia`] where a joint has nothing to move,
/// [`DynamicsFault::ResultNotFinite`] where an input was not finite.
///
/// # Cost
/// O(N), about 250 multiplications and one division per revolute joint.
#[inline]
pub fn forward_dynamics<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> Result<[T; NV], DynamicsFault> {
    if tree.has_reversed {
        return along_axes(tree, joint_poses, velocities, torques, external);
    }
    recursion(tree, joint_poses, velocities, torques, external)
}

/// The same for trees with reversed joints. Apart, so that others do not pay for them.
#[cold]
#[inline(never)]
fn along_axes<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> Result<[T; NV], DynamicsFault> {
    let (velocities, torques) = (reversed(tree, velocities), reversed(tree, torques));
    let along = recursion(tree, joint_poses, &velocities, &torques, external)?;
    Ok(reversed(tree, &along))
}

/// What every pass reads.
pub(super) struct Input<'a, T, const N: usize, const NQ: usize, const NV: usize> {
    pub tree: &'a Tree<T, N, NQ, NV>,
    pub joint_poses: &'a JointPoses<T, N, NQ>,
    pub velocities: &'a [T; NV],
    pub torques: &'a [T; NV],
    pub external: Option<&'a [Wrench<T>; N]>,
}

#[inline(never)]
fn recursion<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> Result<[T; NV], DynamicsFault> {
    let input = Input { tree, joint_poses, velocities, torques, external };
    let mut states = [LimbState::zero(); N];
    // Of bodies that others than the next of their limb hang from: `P` and `z`.
    let mut bodies = [(ArticulatedInertia::zero(), Wrench::zero()); N];

    for (k, node) in tree.nodes.iter().enumerate() {
        if node.limb > 0 {
            along_limb!(T, k, node, first_pass(&input, &mut states));
        } else if node.hinge().is_none() {
            let omega = match input.floating(node) {
                Some((_, omega)) => omega,
                None => input.terms(k, node, &states).omega,
            };
            if let Some(state) = states.get_mut(k) {
                state.omega = omega.into();
            }
        }
    }
    for (k, (node, state)) in tree.nodes.iter().zip(&states).enumerate() {
        if (node.is_branch || node.hinge().is_none())
            && let Some(body) = bodies.get_mut(k)
        {
            *body = (node.inertia.into(), input.own_wrench(k, node, state.omega.into()));
        }
    }

    for (k, node) in tree.nodes.iter().enumerate().rev() {
        if node.limb > 0 {
            along_limb!(T, k, node, inboard_pass(&input, &mut states, &mut bodies))?;
        } else if let (Some(i), false) = (node.inboard, matches!(node.kind, JointKind::Revolute(_)))
        {
            let (p, z) = input.across_joint(k, node, &states, &bodies)?;
            if let Some(body) = bodies.get_mut(i) {
                *body = (body.0 + p, body.1 + z);
            }
        }
    }

    let mut result = [T::zero(); NV];
    for (k, node) in tree.nodes.iter().enumerate() {
        if node.limb > 0 {
            along_limb!(T, k, node, last_pass(&input, &mut states, &mut result));
        } else if node.hinge().is_none() {
            let acceleration = if let JointKind::Floating = node.kind {
                input
                    .accelerate_floating(k, node, &bodies, &mut result)
                    .ok_or(DynamicsFault::SingularInertia { joint: k })?
            } else {
                input.accelerate(k, node, &states, &bodies, &mut result)?
            };
            if let Some(state) = states.get_mut(k) {
                state.keep(acceleration);
            }
        }
    }
    match result.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(DynamicsFault::ResultNotFinite { index }),
        None => Ok(result),
    }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Input<'_, T, N, NQ, NV> {
    /// `ω` and `c` of a joint that is not revolute.
    #[inline(always)]
    fn terms(&self, k: usize, node: &Node<T>, states: &[LimbState<T>; N]) -> VelocityTerms<T> {
        let omega = node.inboard.and_then(|i| states.get(i)).map(|state| state.omega.into());
        let positions = &self.joint_poses.positions;
        let pose = relative(node, self.turn(k), positions);
        velocity_terms(node, &pose, omega.unwrap_or(Vector3::zeros()), positions, self.velocities)
    }

    /// `v` and `ω` of a floating joint.
    #[inline(always)]
    fn floating(&self, node: &Node<T>) -> Option<(Vector3<T>, Vector3<T>)> {
        let JointKind::Floating = node.kind else { return None };
        let [a, b, c, d, e, f] = *self.velocities.get(node.velocity_start..)?.first_chunk()?;
        Some((Vector3::new(a, b, c), Vector3::new(d, e, f)))
    }

    /// The same as [`Self::accelerate`] for a floating joint, whose map is the identity.
    #[inline(always)]
    fn accelerate_floating(
        &self,
        k: usize,
        node: &Node<T>,
        bodies: &[(ArticulatedInertia<T>, Wrench<T>); N],
        result: &mut [T; NV],
    ) -> Option<Twist<T>> {
        let (v, omega) = self.floating(node)?;
        let quaternion =
            self.joint_poses.positions.get(node.position_start + 3..)?.first_chunk()?;
        let rotation = Quaternion::from_array(*quaternion).to_matrix();
        let (p, z) = bodies.get(k)?;
        let torque = *self.torques.get(node.velocity_start..)?.first_chunk()?;
        let acceleration = floating_root::acceleration(p, &(Wrench::from_array(torque) - *z))?;
        // Less what the frame has without the joint: gravity's, and ω × v of the components' change.
        let linear = acceleration.linear + rotation.tr_mul(&self.tree.gravity) - omega.cross(&v);
        *result.get_mut(node.velocity_start..)?.first_chunk_mut()? =
            Twist { linear, angular: acceleration.angular }.to_array();
        Some(acceleration)
    }

    #[inline(always)]
    fn turn(&self, k: usize) -> AxisTurn<T> {
        let none = AxisTurn { cosine: T::one(), sine: T::zero() };
        self.joint_poses.turns.get(k).copied().unwrap_or(none)
    }

    /// `(ω × (ω × h), ω × Jω)`, what a body asks for when its frame's origin does not accelerate, less
    /// what acts on it.
    #[inline(always)]
    pub fn own_wrench(&self, k: usize, node: &Node<T>, omega: Vector3<T>) -> Wrench<T> {
        let force = if node.is_eccentric {
            omega.cross(&omega.cross(&node.inertia.first_moment))
        } else {
            Vector3::zeros()
        };
        let own = Wrench { force, torque: node.gyroscopic_torque(omega) };
        self.external
            .and_then(|all| all.get(k))
            .map_or(own, |applied| own - at_joint(node, applied))
    }

    /// What a joint that is not revolute passes inboard.
    #[inline(never)]
    fn across_joint(
        &self,
        k: usize,
        node: &Node<T>,
        states: &[LimbState<T>; N],
        bodies: &[(ArticulatedInertia<T>, Wrench<T>); N],
    ) -> Result<(ArticulatedInertia<T>, Wrench<T>), DynamicsFault> {
        let singular = DynamicsFault::SingularInertia { joint: k };
        let Some((p, z)) = bodies.get(k) else { return Err(singular) };
        let terms = self.terms(k, node, states);
        let (projected, bias) = match &node.kind {
            JointKind::Fixed => (*p, *z + p.product(terms.product)),
            JointKind::Prismatic(axis) => {
                let hinge = self.slide(node, *axis, p, z).ok_or(singular)?;
                project_hinge(p, z, &hinge, terms.product)
            }
            _ => project_block(node, self.joint_poses, self.velocities, self.torques, p, z, terms)
                .ok_or(singular)?,
        };
        let pose = relative(node, self.turn(k), &self.joint_poses.positions);
        let turned = projected.rotated_inboard(&pose.rotation);
        let carried_inertia =
            if pose.is_translated { turned.shifted(pose.translation) } else { turned };
        Ok((carried_inertia, carried(&pose, &bias)))
    }

    /// `U`, `D⁻¹` and `u` of a slide.
    #[inline(always)]
    fn slide(
        &self,
        node: &Node<T>,
        axis: Axis,
        p: &ArticulatedInertia<T>,
        z: &Wrench<T>,
    ) -> Option<Hinge<T>> {
        let (image, d, force) = match axis {
            Axis::X => slide_column::<T, 0>(p, z),
            Axis::Y => slide_column::<T, 1>(p, z),
            Axis::Z => slide_column::<T, 2>(p, z),
        };
        hinge(image, d + node.rotor_inertia, own_one(node, self.torques) - force)
    }

    /// The acceleration behind a joint that is not revolute, and its own into the result.
    #[inline(never)]
    fn accelerate(
        &self,
        k: usize,
        node: &Node<T>,
        states: &[LimbState<T>; N],
        bodies: &[(ArticulatedInertia<T>, Wrench<T>); N],
        result: &mut [T; NV],
    ) -> Result<Twist<T>, DynamicsFault> {
        let singular = DynamicsFault::SingularInertia { joint: k };
        let Some((p, z)) = bodies.get(k) else { return Err(singular) };
        let pose = relative(node, self.turn(k), &self.joint_poses.positions);
        let arrived = match node.inboard.and_then(|i| states.get(i)) {
            None => Twist {
                linear: pose.rotation.outboard(-self.tree.gravity),
                angular: Vector3::zeros(),
            },
            Some(inboard) => {
                let inboard = inboard.acceleration();
                let linear = if pose.is_translated {
                    inboard.linear + inboard.angular.cross(&pose.translation)
                } else {
                    inboard.linear
                };
                Twist {
                    linear: pose.rotation.outboard(linear),
                    angular: pose.rotation.outboard(inboard.angular),
                }
            }
        };
        let mut acceleration = arrived + self.terms(k, node, states).product;
        match &node.kind {
            JointKind::Fixed | JointKind::Revolute(_) => {}
            JointKind::Prismatic(axis) => {
                let hinge = self.slide(node, *axis, p, z).ok_or(singular)?;
                let beta_dot = hinge_acceleration(&hinge, acceleration);
                match axis {
                    Axis::X => acceleration.linear.x += beta_dot,
                    Axis::Y => acceleration.linear.y += beta_dot,
                    Axis::Z => acceleration.linear.z += beta_dot,
                }
                if let Some(entry) = result.get_mut(node.velocity_start) {
                    *entry = beta_dot;
                }
            }
            _ => {
                let motion = JointMotion::new(
                    node,
                    &self.joint_poses.positions,
                    &own(node, self.velocities),
                );
                let block = JointBlock::new(p, &motion).ok_or(singular)?;
                let wrench = p.product(acceleration) + *z;
                let mut beta_dot = own(node, self.torques);
                for (b, h) in beta_dot.iter_mut().zip(&motion.map) {
                    *b -= h.power(wrench);
                }
                block.solve(&mut beta_dot);
                acceleration = acceleration + motion.relative(&beta_dot);
                let all = result.iter_mut().skip(node.velocity_start);
                for (to, from) in all.zip(beta_dot).take(motion.degrees_of_freedom) {
                    *to = from;
                }
            }
        }
        Ok(acceleration)
    }
}

/// The inboard step across a revolute joint, before it is carried to the inboard frame: `P − U D⁻¹ Uᵀ`,
/// `z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u`, and what the outboard pass needs. `None` where `D` is not
/// positive.
#[inline(always)]
pub(crate) fn project_turn<T: Real>(
    axis: Axis,
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
    product: Twist<T>,
    torque: T,
    rotor_inertia: Option<T>,
) -> Option<(ArticulatedInertia<T>, Wrench<T>, Hinge<T>)> {
    let (image, d, moment) = match axis {
        Axis::X => turn_column::<T, 0>(p, z),
        Axis::Y => turn_column::<T, 1>(p, z),
        Axis::Z => turn_column::<T, 2>(p, z),
    };
    let d = rotor_inertia.map_or(d, |rotor| d + rotor);
    let hinge = hinge(image, d, torque - moment)?;
    let (projected, bias) = project_hinge(p, z, &hinge, product);
    Some((projected, bias, hinge))
}

/// `U`, `D` and `Hᵀz` of a turn about axis `I`.
#[inline(always)]
fn turn_column<T: Real, const I: usize>(
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
) -> (Wrench<T>, T, T) {
    let image = p.angular_column::<I>();
    (image, image.torque[I], z.torque[I])
}

/// `U`, `D` and `Hᵀz` of a slide along axis `I`.
#[inline(always)]
fn slide_column<T: Real, const I: usize>(
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
) -> (Wrench<T>, T, T) {
    let image = p.linear_column::<I>();
    (image, image.force[I], z.force[I])
}

#[inline(always)]
fn hinge<T: Real>(image: Wrench<T>, d: T, excess: T) -> Option<Hinge<T>> {
    if d > T::zero() { Some(Hinge { image, inverse: T::one() / d, excess }) } else { None }
}

/// `P − U D⁻¹ Uᵀ` and `z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u`.
#[inline(always)]
fn project_hinge<T: Real>(
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
    hinge: &Hinge<T>,
    product: Twist<T>,
) -> (ArticulatedInertia<T>, Wrench<T>) {
    let projected = p.minus_outer(hinge.image, hinge.inverse);
    let bias = *z + projected.product(product) + hinge.image * (hinge.inverse * hinge.excess);
    (projected, bias)
}

/// (3.59) for one degree of freedom.
#[inline(always)]
fn hinge_acceleration<T: Real>(hinge: &Hinge<T>, arrived: Twist<T>) -> T {
    hinge.inverse * (hinge.excess - arrived.power(hinge.image))
}

/// The same projection for a joint with several degrees of freedom.
#[inline(never)]
fn project_block<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    node: &Node<T>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
    terms: VelocityTerms<T>,
) -> Option<(ArticulatedInertia<T>, Wrench<T>)> {
    let motion = JointMotion::new(node, &joint_poses.positions, &own(node, velocities));
    let block = JointBlock::new(p, &motion)?;
    // With D = L E Lᵀ, the columns of W = U L⁻ᵀ give U D⁻¹ Uᵀ = Σ w wᵀ / e.
    let mut excess = own(node, torques);
    for (u, h) in excess.iter_mut().zip(&motion.map) {
        *u -= h.power(*z);
    }
    let mut w = block.images;
    let mut projected = *p;
    let mut force = Wrench::zero();
    for i in 0..motion.degrees_of_freedom.min(6) {
        for j in 0..i {
            let l = block.lower[i][j];
            w[i] -= w[j] * l;
            excess[i] -= l * excess[j];
        }
        projected = projected.minus_outer(w[i], block.inverse[i]);
        force += w[i] * (block.inverse[i] * excess[i]);
    }
    let bias = *z + projected.product(terms.product) + force;
    Some((projected, bias))
}
