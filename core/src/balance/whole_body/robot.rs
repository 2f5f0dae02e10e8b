//! Which joints of a tree are legs.

use super::WholeBodyRobotFault;
use crate::Real;
use crate::balance::ContactLimits;
use crate::model::{JointKind, Node, Tree};
use crate::spatial::Quaternion;
use nalgebra::{Matrix3, Vector3};

/// Joints of a leg at most; what is inboard of them tracks a posture.
pub const MOST_LEG_JOINTS: usize = 7;
/// Joints of a robot at most: the number of a torque's row is one byte, of which feet take 128.
pub const MOST_JOINTS: usize = 64;

/// Feet of a robot at most.
pub const WHOLE_BODY_FEET: usize = 4;

/// A foot as a person describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeBodyFoot<T> {
    /// Index of its body in the tree.
    pub body: usize,
    /// Reference point in the body's frame, m. For an edge the middle of it, for a point the point.
    pub reference: Vector3<T>,
    /// Body frame from sole axes (x along the sole, z out of the ground), a unit quaternion. A point's
    /// normal is the world's vertical, whatever is said here, and so is an edge's as far as it can be.
    pub axes: Quaternion<T>,
    /// What the ground can give it: its patch about the reference point, friction, normal force.
    pub limits: ContactLimits<T, 0>,
}

impl<T: Real> WholeBodyFoot<T> {
    /// The same in another precision.
    pub fn rounded<U: Real>(&self) -> WholeBodyFoot<U> {
        let round = |x: T| U::of(x.to_f64());
        let limits = &self.limits;
        WholeBodyFoot {
            body: self.body,
            reference: self.reference.map(round),
            axes: Quaternion::from_array(self.axes.to_array().map(round)),
            limits: ContactLimits {
                least_force: round(limits.least_force),
                greatest_force: round(limits.greatest_force),
                friction: round(limits.friction),
                patch: limits.patch.rounded(),
                torques: [],
            },
        }
    }
}

/// A foot with its leg.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg<T> {
    pub foot: WholeBodyFoot<T>,
    /// Body frame from sole axes.
    pub axes: Matrix3<T>,
    /// Velocities of the leg's joints, foot to hip.
    pub joints: [usize; MOST_LEG_JOINTS],
    /// How many.
    pub count: usize,
    /// Greatest distance from the first joint to the reference point, m.
    pub reach: T,
}

/// A joint that the controller moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyJoint {
    /// Index of its coordinate.
    pub coordinate: usize,
    /// Index of its node.
    pub node: usize,
    /// Bit i: foot i is outboard of it.
    pub feet: u8,
    /// Bit i: some joint of foot i's leg moves what it moves, so that their masses are coupled.
    pub coupled: u8,
}

/// A floating central body (body 0) with legs and other limbs on revolute and prismatic joints; from a
/// tree and its feet. Bodies that do not hang from the central one take no part.
///
/// A foot's leg is the chain of joints inboard of it up to the central body, or to a body from which
/// another foot hangs too (a waist's); seven joints at most. All other joints track a posture.
#[derive(Clone, Copy, Debug)]
pub struct WholeBody<T, const FEET: usize, const NV: usize> {
    pub(crate) legs: [Option<Leg<T>>; FEET],
    /// By velocity; `None` for the central body's and for those of other trees.
    pub(crate) joints: [Option<BodyJoint>; NV],
    pub(crate) mass: T,
}

impl<T: Real, const FEET: usize, const NV: usize> WholeBody<T, FEET, NV> {
    /// Finds the legs. `None` in `feet` is no foot, for a robot with fewer than `FEET`.
    ///
    /// # Errors
    /// A [`WholeBodyRobotFault`] for the first thing that is not as above, or for a leg that has fewer
    /// joints than its contact has directions: three for a point, five for an edge, six for a sole.
    pub fn new<const N: usize, const NQ: usize>(
        tree: &Tree<T, N, NQ, NV>,
        feet: &[Option<WholeBodyFoot<T>>; FEET],
    ) -> Result<Self, WholeBodyRobotFault> {
        const {
            assert!(FEET >= 1 && FEET <= WHOLE_BODY_FEET, "one to four feet");
            assert!(NV <= 6 + MOST_JOINTS, "at most 64 joints");
        }
        if !matches!(tree.joint(0), Some(JointKind::Floating)) {
            return Err(WholeBodyRobotFault::CentralBody);
        }
        if feet.iter().all(Option::is_none) {
            return Err(WholeBodyRobotFault::NoFoot);
        }
        let joints = joints(tree)?;
        let mut robot = Self { legs: [None; FEET], joints, mass: T::zero() };
        for (body, node) in tree.nodes.iter().enumerate() {
            if hangs(tree, body) {
                robot.mass += node.inertia.mass;
            }
        }
        for (number, foot) in feet.iter().enumerate() {
            if let Some(foot) = foot {
                robot.mark(tree, number, foot)?;
            }
        }
        for number in 0..FEET {
            let Some(Some(foot)) = feet.get(number) else { continue };
            let leg = robot.find_leg(tree, number, foot)?;
            robot.couple(tree, number, &leg);
            if let Some(place) = robot.legs.get_mut(number) {
                *place = Some(leg);
            }
        }
        Ok(robot)
    }

    /// Joints of the leg of a foot; `None` where there is no such foot.
    pub fn leg_joints(&self, foot: usize) -> Option<usize> {
        self.legs.get(foot)?.as_ref().map(|leg| leg.count)
    }

    /// Velocities of the joints of a foot's leg, foot to hip.
    pub fn leg(&self, foot: usize) -> impl Iterator<Item = usize> + '_ {
        let leg = self.legs.get(foot).and_then(Option::as_ref);
        leg.into_iter().flat_map(|leg| leg.joints.iter().copied().take(leg.count))
    }

    /// Of all that hangs from the central body, kg.
    pub fn mass(&self) -> T {
        self.mass
    }

    /// Says of the joints inboard of a foot that they move it.
    fn mark<const N: usize, const NQ: usize>(
        &mut self,
        tree: &Tree<T, N, NQ, NV>,
        number: usize,
        foot: &WholeBodyFoot<T>,
    ) -> Result<(), WholeBodyRobotFault> {
        if foot.body >= N || !hangs(tree, foot.body) {
            return Err(WholeBodyRobotFault::Body { foot: number, body: foot.body });
        }
        for joint in self.joints.iter_mut().flatten() {
            if is_inboard(tree, joint.node, foot.body) {
                joint.feet |= 1_u8.checked_shl(number as u32).unwrap_or(0);
            }
        }
        Ok(())
    }

    /// Says of the joints inboard or outboard of a leg's that they are coupled to it.
    fn couple<const N: usize, const NQ: usize>(
        &mut self,
        tree: &Tree<T, N, NQ, NV>,
        number: usize,
        leg: &Leg<T>,
    ) {
        let own = 1_u8.checked_shl(number as u32).unwrap_or(0);
        // What is outboard of some joint of a chain is outboard of that nearest to the hip.
        let hip = leg.count.checked_sub(1).and_then(|last| leg.joints.get(last)).copied();
        let hip = hip.and_then(|hip| self.joints.get(hip)?.as_ref()).map(|joint| joint.node);
        for joint in self.joints.iter_mut().flatten() {
            let is_outboard = hip.is_some_and(|hip| is_inboard(tree, hip, joint.node));
            if joint.feet & own != 0 || is_outboard {
                joint.coupled |= own;
            }
        }
    }

    fn find_leg<const N: usize, const NQ: usize>(
        &self,
        tree: &Tree<T, N, NQ, NV>,
        number: usize,
        foot: &WholeBodyFoot<T>,
    ) -> Result<Leg<T>, WholeBodyRobotFault> {
        let fault = WholeBodyRobotFault::Foot { foot: number };
        let q = foot.axes;
        let is_unit = (q.norm_squared() - T::one()).abs() < T::of(2e-3);
        let axes = q.normalized().filter(|_| is_unit).ok_or(fault)?.to_matrix();
        let own = 1_u8.checked_shl(number as u32).unwrap_or(0);
        let mut leg =
            Leg { foot: *foot, axes, joints: [0; MOST_LEG_JOINTS], count: 0, reach: T::zero() };
        let limits = &foot.limits;
        let is_magnitude = |x: T| x >= T::zero() && x.is_finite();
        if !(is_magnitude(limits.least_force)
            && limits.greatest_force >= limits.least_force
            && is_magnitude(limits.friction)
            && foot.reference.iter().all(|x| x.is_finite()))
        {
            return Err(fault);
        }
        let mut at = foot.body;
        let mut arm = match tree.nodes.get(at) {
            Some(node) => (node.center + in_joint_axes(node, foot.reference)).norm(),
            None => return Err(fault),
        };
        // Numbers decrease on the way inboard.
        while let Some((node, inboard)) =
            tree.nodes.get(at).and_then(|node| Some((node, node.inboard?)))
        {
            if node.kind.degrees_of_freedom() == 1 {
                let joint = self.joints.get(node.velocity_start).and_then(Option::as_ref);
                let is_own = joint.is_some_and(|joint| joint.feet == own);
                let Some(place) = leg.joints.get_mut(leg.count).filter(|_| is_own) else { break };
                *place = node.velocity_start;
                leg.count += 1;
                leg.reach += arm;
                arm = T::zero();
            }
            arm += node.offset.norm();
            at = inboard;
        }
        let directions = 3 + limits.patch.moments().iter().filter(|free| **free).count();
        if leg.count < directions {
            let joints = leg.count;
            return Err(WholeBodyRobotFault::ShortLeg { foot: number, joints, directions });
        }
        if !(leg.reach > T::zero() && leg.reach.is_finite()) {
            return Err(fault);
        }
        Ok(leg)
    }
}

/// A vector of the body frame in the joint frame's axes.
fn in_joint_axes<T: Real>(node: &Node<T>, v: Vector3<T>) -> Vector3<T> {
    match &node.body_rotation {
        None => v,
        Some(r) => r * v,
    }
}

/// Joints of what hangs from the central body.
fn joints<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
) -> Result<[Option<BodyJoint>; NV], WholeBodyRobotFault> {
    let mut joints = [None; NV];
    for (body, node) in tree.nodes.iter().enumerate().skip(1) {
        if !hangs(tree, body) {
            continue;
        }
        match node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(_) | JointKind::Prismatic(_) => {
                if let Some(place) = joints.get_mut(node.velocity_start) {
                    *place = Some(BodyJoint {
                        coordinate: node.position_start,
                        node: body,
                        feet: 0,
                        coupled: 0,
                    });
                }
            }
            _ => return Err(WholeBodyRobotFault::Joint { body }),
        }
    }
    Ok(joints)
}

/// Whether a body is the central one or hangs from it.
fn hangs<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    body: usize,
) -> bool {
    is_inboard(tree, 0, body)
}

/// Whether the body `at` hangs from the body `inboard`, or is it.
fn is_inboard<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    inboard: usize,
    at: usize,
) -> bool {
    let mut at = at;
    while at > inboard {
        match tree.inboard(at) {
            Some(next) => at = next,
            None => return false,
        }
    }
    at == inboard
}
