//! The passes of `forward_dynamics.rs` along limbs of revolute joints.

use super::DynamicsFault;
use super::forward_dynamics::Input;
use super::joint_motion::own_one;
use super::lanes::{Lanes, V, cross, dot, for_each_lane, plus, vector};
use super::limb_inertia::{Articulated, Hinge, LimbInertia, Projection, across_turn, projection};
use super::limbs::{Nodes, at, axis, home, joint, lane, outboard};
use crate::Real;
use crate::model::{Axis, InertiaShape};
use crate::spatial::{ArticulatedInertia, SymmetricMatrix3, Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// `P` and `z` of a single body.
pub(super) type BodyBias<T> = (ArticulatedInertia<T>, Wrench<T>);

/// What the passes leave for each other at a joint.
#[derive(Clone, Copy)]
pub(super) struct LimbState<T> {
    pub omega: V<T>,
    /// Acceleration of the frame's origin from the inboard angular velocity, in this frame.
    linear: V<T>,
    /// `U`; after the last pass the acceleration, linear and angular.
    image: [V<T>; 2],
    /// `D⁻¹`
    inverse: T,
    /// `u`
    excess: T,
}

impl<T: Real> LimbState<T> {
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = T::zero();
        let none = [zero; 3];
        Self { omega: none, linear: none, image: [none; 2], inverse: zero, excess: zero }
    }

    /// Keeps the acceleration for what hangs from this body.
    #[inline(always)]
    pub fn keep(&mut self, acceleration: Twist<T>) {
        self.image = [acceleration.linear.into(), acceleration.angular.into()];
    }

    /// What was kept.
    #[inline(always)]
    pub fn acceleration(&self) -> Twist<T> {
        let [linear, angular] = self.image;
        Twist { linear: linear.into(), angular: angular.into() }
    }
}

/// Outboard along a limb: angular velocities and what they do to accelerations.
#[inline(always)]
pub(super) fn first_pass<L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<L::Scalar, N, NQ, NV>,
    states: &mut [LimbState<L::Scalar>; N],
    start: L::Each<usize>,
    count: usize,
) -> Option<()> {
    let (nodes, _) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, start)?;
    let zero = [nalgebra::zero(); 3];
    let from = L::each(nodes, |node| {
        Some(node.inboard.and_then(|i| states.get(i)).map_or(zero, |state| state.omega))
    })?;
    let mut omega = [0, 1, 2].map(|i| L::gather(from, |omega| omega[i % 3]));
    for i in 0..count {
        let here = joint::<L>(start, i);
        let (nodes, turn) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, here)?;
        let beta = L::gather(nodes, |node| own_one(node, input.velocities));
        let (next, linear) = match axis(L::first(nodes)) {
            Axis::X => turn_out::<L, 0>(nodes, turn, &omega, beta),
            Axis::Y => turn_out::<L, 1>(nodes, turn, &omega, beta),
            Axis::Z => turn_out::<L, 2>(nodes, turn, &omega, beta),
        };
        omega = next;
        for_each_lane!(L, here, |i, k| {
            if let Some(state) = states.get_mut(k) {
                (state.omega, state.linear) = (lane(&omega, i), lane(&linear, i));
            }
        });
    }
    Some(())
}

/// `ω` and the linear part of `c` behind a turn about axis `I`.
#[inline(always)]
fn turn_out<L: Lanes, const I: usize>(
    nodes: Nodes<L>,
    turn: (L, L),
    omega: &V<L>,
    beta: L,
) -> (V<L>, V<L>) {
    let first = L::first(nodes);
    let linear = if first.is_offset && first.inboard.is_some() {
        let offset = vector::<L, _>(nodes, |node| node.offset);
        outboard::<L, I>(nodes, turn, &cross(omega, &cross(omega, &offset)))
    } else {
        [L::splat(nalgebra::zero()); 3]
    };
    let mut next = outboard::<L, I>(nodes, turn, omega);
    next[I] = next[I] + beta;
    (next, linear)
}

/// Inboard along a limb: articulated inertias and biases, into those of the body that it hangs from.
#[inline(always)]
pub(super) fn inboard_pass<L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<L::Scalar, N, NQ, NV>,
    states: &mut [LimbState<L::Scalar>; N],
    bodies: &mut [BodyBias<L::Scalar>; N],
    start: L::Each<usize>,
    count: usize,
) -> Result<(), DynamicsFault> {
    let none = DynamicsFault::SingularInertia { joint: N };
    // Changed in place: to copy what was just written number by number would wait for it.
    let mut body = Articulated::<L>::zero();
    for i in (0..count).rev() {
        let here = joint::<L>(start, i);
        let (nodes, turn) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, here).ok_or(none)?;
        let state = L::each(here, |k| states.get(k)).ok_or(none)?;
        let omega = [0, 1, 2].map(|i| L::gather(state, |state| state.omega[i % 3]));
        let linear_product = [0, 1, 2].map(|i| L::gather(state, |state| state.linear[i % 3]));
        let first = L::first(nodes);
        if first.is_branch {
            // What hangs from here is there already.
            body = gathered::<L>(L::each(here, |k| bodies.get(k)).ok_or(none)?);
        } else {
            add_own::<L, N, NQ, NV>(input, here, nodes, &omega, &mut body);
        }
        let beta = L::gather(nodes, |node| own_one(node, input.velocities));
        let torque = L::gather(nodes, |node| own_one(node, input.torques));
        let mut hinge = Hinge {
            turn,
            offset: first.is_offset.then(|| vector::<L, _>(nodes, |node| node.offset)),
            home: home::<L>(nodes),
            rotor: input.tree.has_rotors.then(|| L::gather(nodes, |node| node.rotor_inertia)),
            torque,
            product: [beta; 2],
            linear_product,
        };
        let has_inboard = first.inboard.is_some();
        let (projection, d) = match axis(first) {
            Axis::X => turn_in::<L, 0>(&mut body, &mut hinge, &omega, has_inboard),
            Axis::Y => turn_in::<L, 1>(&mut body, &mut hinge, &omega, has_inboard),
            Axis::Z => turn_in::<L, 2>(&mut body, &mut hinge, &omega, has_inboard),
        };
        let mut fault = Ok(());
        for_each_lane!(L, here, |i, k| {
            if !(d.lane(i) > nalgebra::zero()) {
                fault = Err(DynamicsFault::SingularInertia { joint: k });
            }
            if let Some(state) = states.get_mut(k) {
                state.image = projection.image.map(|v| lane(&v, i));
                state.inverse = projection.inverse.lane(i);
                state.excess = projection.excess.lane(i);
            }
        });
        fault?;
    }
    let (nodes, _) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, start).ok_or(none)?;
    for_each_lane!(L, nodes, |i, node| {
        if let Some(inboard) = node.inboard.and_then(|inboard| bodies.get_mut(inboard)) {
            let (p, z) = scattered(&body, i);
            *inboard = (inboard.0 + p, inboard.1 + z);
        }
    });
    Ok(())
}

#[inline(always)]
fn turn_in<L: Lanes, const I: usize>(
    body: &mut Articulated<L>,
    hinge: &mut Hinge<L>,
    omega: &V<L>,
    has_inboard: bool,
) -> (Projection<L>, L) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let [beta, _] = hinge.product;
    hinge.product = [omega[k] * beta, -(omega[j] * beta)];
    let (projection, d) = projection::<L, I>(body, hinge.torque, hinge.rotor);
    // Nothing is passed on from the first joint of a fixed base.
    if has_inboard {
        across_turn::<L, I>(body, hinge, &projection);
    }
    (projection, d)
}

/// Adds a link's inertia and wrench to those of what hangs from it.
#[inline(always)]
fn add_own<L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<L::Scalar, N, NQ, NV>,
    here: L::Each<usize>,
    nodes: Nodes<L>,
    omega: &V<L>,
    Articulated { inertia, bias }: &mut Articulated<L>,
) {
    let first = L::first(nodes);
    let diagonal = vector::<L, _>(nodes, |node| node.inertia.rotational.diagonal);
    let mass = L::gather(nodes, |node| node.inertia.mass);
    inertia.linear[0] = inertia.linear[0].map(|x| mass + x);
    inertia.angular[0] = plus(&diagonal, &inertia.angular[0]);
    let [x, y, z] = *omega;
    let mut momentum = [diagonal[0] * x, diagonal[1] * y, diagonal[2] * z];
    if first.shape == InertiaShape::Full {
        let o = vector::<L, _>(nodes, |node| node.inertia.rotational.off_diagonal);
        momentum = [
            diagonal[0] * x + o[2] * y + o[1] * z,
            o[2] * x + diagonal[1] * y + o[0] * z,
            o[1] * x + o[0] * y + diagonal[2] * z,
        ];
        inertia.angular[1] = plus(&o, &inertia.angular[1]);
    }
    if first.shape != InertiaShape::Isotropic {
        bias[1] = plus(&cross(omega, &momentum), &bias[1]);
    }
    if first.is_eccentric {
        let h = vector::<L, _>(nodes, |node| node.inertia.first_moment);
        bias[0] = plus(&cross(omega, &cross(omega, &h)), &bias[0]);
        // −ĥ, by columns.
        let c = &mut inertia.coupling;
        for x in 0..3 {
            let (y, z) = ((x + 1) % 3, (x + 2) % 3);
            c[x][y] = c[x][y] - h[z];
            c[x][z] = c[x][z] + h[y];
        }
    }
    if let Some(external) = input.external {
        let applied = L::each(here, |k| {
            let (node, applied) = (input.tree.nodes.get(k)?, external.get(k)?);
            Some(super::inverse_dynamics::at_joint(node, applied))
        });
        if let Some(applied) = applied {
            let (force, torque) = (
                vector::<L, _>(applied, |wrench| wrench.force),
                vector::<L, _>(applied, |wrench| wrench.torque),
            );
            for i in 0..3 {
                bias[0][i] = bias[0][i] - force[i];
                bias[1][i] = bias[1][i] - torque[i];
            }
        }
    }
}

/// Lanes of what is kept for single bodies.
#[inline(always)]
fn gathered<L: Lanes>(from: L::Each<&BodyBias<L::Scalar>>) -> Articulated<L> {
    Articulated {
        inertia: LimbInertia {
            linear: [
                vector::<L, _>(from, |(p, _)| p.linear.diagonal),
                vector::<L, _>(from, |(p, _)| p.linear.off_diagonal),
            ],
            coupling: [0, 1, 2].map(|j| {
                [0, 1, 2].map(|i| L::gather(from, |(p, _)| p.coupling.data.0[j % 3][i % 3]))
            }),
            angular: [
                vector::<L, _>(from, |(p, _)| p.angular.diagonal),
                vector::<L, _>(from, |(p, _)| p.angular.off_diagonal),
            ],
        },
        bias: [vector::<L, _>(from, |(_, z)| z.force), vector::<L, _>(from, |(_, z)| z.torque)],
    }
}

/// Lane `i` of what is passed to a single body.
#[inline(always)]
fn scattered<L: Lanes>(of: &Articulated<L>, i: usize) -> BodyBias<L::Scalar> {
    let vector = |v: &V<L>| Vector3::from(lane(v, i));
    let symmetric = |block: &[V<L>; 2]| SymmetricMatrix3 {
        diagonal: vector(&block[0]),
        off_diagonal: vector(&block[1]),
    };
    let [x, y, z] = of.inertia.coupling.each_ref().map(vector);
    let inertia = ArticulatedInertia {
        linear: symmetric(&of.inertia.linear),
        coupling: Matrix3::from_columns(&[x, y, z]),
        angular: symmetric(&of.inertia.angular),
    };
    (inertia, Wrench { force: vector(&of.bias[0]), torque: vector(&of.bias[1]) })
}

/// Outboard along a limb: accelerations.
#[inline(always)]
pub(super) fn last_pass<L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<L::Scalar, N, NQ, NV>,
    states: &mut [LimbState<L::Scalar>; N],
    result: &mut [L::Scalar; NV],
    start: L::Each<usize>,
    count: usize,
) -> Option<()> {
    let (nodes, _) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, start)?;
    let base = [(-input.tree.gravity).into(), [nalgebra::zero(); 3]];
    let from = L::each(nodes, |node| {
        Some(node.inboard.and_then(|i| states.get(i)).map_or(base, |state| state.image))
    })?;
    let component = |part: usize| [0, 1, 2].map(|i| L::gather(from, |a| a[part % 2][i % 3]));
    let mut acceleration = [component(0), component(1)];
    for i in 0..count {
        let here = joint::<L>(start, i);
        let (nodes, turn) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, here)?;
        let state = L::each(here, |k| states.get(k))?;
        let beta = L::gather(nodes, |node| own_one(node, input.velocities));
        let (next, beta_dot) = match axis(L::first(nodes)) {
            Axis::X => turn_last::<L, 0>(nodes, turn, state, &acceleration, beta),
            Axis::Y => turn_last::<L, 1>(nodes, turn, state, &acceleration, beta),
            Axis::Z => turn_last::<L, 2>(nodes, turn, state, &acceleration, beta),
        };
        acceleration = next;
        for_each_lane!(L, nodes, |i, node| {
            if let Some(entry) = result.get_mut(node.velocity_start) {
                *entry = beta_dot.lane(i);
            }
        });
    }
    for_each_lane!(L, joint::<L>(start, count.saturating_sub(1)), |i, k| {
        if let Some(state) = states.get_mut(k) {
            state.image = acceleration.map(|v| lane(&v, i));
        }
    });
    Some(())
}

/// (3.59) across a turn about axis `I`.
#[inline(always)]
fn turn_last<L: Lanes, const I: usize>(
    nodes: Nodes<L>,
    turn: (L, L),
    state: L::Each<&LimbState<L::Scalar>>,
    [from_linear, from_angular]: &[V<L>; 2],
    beta: L,
) -> ([V<L>; 2], L) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let first = L::first(nodes);
    let part = |f: fn(&LimbState<L::Scalar>) -> V<L::Scalar>| {
        [0, 1, 2].map(|i| L::gather(state, |state| f(state)[i % 3]))
    };
    let mut linear = *from_linear;
    if first.is_offset && first.inboard.is_some() {
        let offset = vector::<L, _>(nodes, |node| node.offset);
        linear = plus(&linear, &cross(from_angular, &offset));
        linear = outboard::<L, I>(nodes, turn, &linear);
        linear = plus(&linear, &part(|state| state.linear));
    } else {
        linear = outboard::<L, I>(nodes, turn, &linear);
    }
    let mut angular = outboard::<L, I>(nodes, turn, from_angular);
    let omega = part(|state| state.omega);
    angular[j] = angular[j] + omega[k] * beta;
    angular[k] = angular[k] - omega[j] * beta;
    let (inverse, excess) =
        (L::gather(state, |state| state.inverse), L::gather(state, |state| state.excess));
    let power =
        dot(&linear, &part(|state| state.image[0])) + dot(&angular, &part(|state| state.image[1]));
    let beta_dot = inverse * (excess - power);
    angular[I] = angular[I] + beta_dot;
    ([linear, angular], beta_dot)
}
