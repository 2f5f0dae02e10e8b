//! What comes out of a tick.

use super::WholeBodyLimit;
use super::program::limit_of;
use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{BindingRows, Command, LimitSet, RobotState};
use crate::qp::{ActiveRows, Solution, Status, Work};
use crate::spatial::{Quaternion, Twist, Wrench};
use nalgebra::Vector3;

/// Limits that may bind at once.
pub(super) const ROWS: usize = 24;

/// The measured state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeBodyState<T, const NQ: usize, const NV: usize> {
    /// Of the tree: position of the central body's centre of mass (m), its unit quaternion (world from
    /// body, scalar first), then joints in the tree's order (rad, m).
    pub positions: [T; NQ],
    /// Of the tree: body twist of the central body (m/s, rad/s), then rates of joints.
    pub velocities: [T; NV],
}

impl<T: Real, const NQ: usize, const NV: usize> WholeBodyState<T, NQ, NV> {
    /// Of a state with joints in rows of six, in the tree's order. Joints that there are not are at zero.
    pub fn of_rows<const ROWS: usize>(state: &RobotState<T, ROWS>) -> Self {
        let RobotState { position, orientation, velocity, joint_angles, joint_rates } = state;
        let pose = position.iter().copied().chain(orientation.to_array());
        let angles = joint_angles.as_flattened().iter().copied();
        let rates = joint_rates.as_flattened().iter().copied();
        let (mut positions, mut velocities) = ([T::zero(); NQ], [T::zero(); NV]);
        positions.iter_mut().zip(pose.chain(angles)).for_each(|(to, x)| *to = x);
        let twist = velocity.to_array().into_iter();
        velocities.iter_mut().zip(twist.chain(rates)).for_each(|(to, x)| *to = x);
        Self { positions, velocities }
    }
}

/// What one tick of the whole body leaves for the next.
pub type WholeBodyMemory<T> = BindingRows<T, ROWS>;

/// Torques, and what they come from.
#[derive(Clone, Copy, Debug)]
pub struct WholeBodyCommand<T, const FEET: usize, const NV: usize> {
    /// By velocity, N·m or N; zero for the central body and for bodies that do not hang from it.
    pub torques: [T; NV],
    /// What the ground gives each foot about its reference point, in the central body's frame.
    pub foot_wrenches: [Wrench<T>; FEET],
    /// The sum of these that the reference asks for, about the central body's centre of mass, in its
    /// frame. With it the body would accelerate as wanted.
    pub desired_wrench: Wrench<T>,
    /// Accelerations by velocity that the torques and wrenches make; of the central body the component
    /// derivative of its twist.
    pub accelerations: [T; NV],
    /// `e_p`, world frame, m.
    pub position_error: Vector3<T>,
    /// `q_e`, world frame, scalar part not negative.
    pub orientation_error: Quaternion<T>,
    /// What binds, and what is given up.
    pub limits: WholeBodyReport<T, FEET>,
}

impl<T: Real, const FEET: usize, const NV: usize> WholeBodyCommand<T, FEET, NV> {
    /// As a supervisor takes it, with joints in rows of six in the tree's order. Foot wrenches are left out: feet
    /// are not of rows.
    pub fn in_rows<const ROWS: usize>(&self) -> Command<T, ROWS> {
        let mut joint_torques = [[T::zero(); LEG]; ROWS];
        let torques = self.torques.iter().skip(6);
        joint_torques.as_flattened_mut().iter_mut().zip(torques).for_each(|(to, t)| *to = *t);
        Command {
            joint_torques,
            desired_wrench: self.desired_wrench,
            foot_wrenches: [Wrench::zero(); ROWS],
            position_error: self.position_error,
            orientation_error: self.orientation_error,
        }
    }
}

/// What binds in a tick, by how much, and what is given up for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeBodyReport<T, const FEET: usize> {
    /// How the distribution ended; solved where nothing binds.
    pub status: Status,
    /// The limits of each foot that bind.
    pub feet: [LimitSet; FEET],
    /// Bit k: the torque of the joint with velocity 6 + k binds.
    pub torques: u64,
    /// The same of its range.
    pub ranges: u64,
    /// The limit that costs most, and by how much the objective would fall per 100 % by which it is
    /// widened; `None` where nothing binds.
    pub worst: Option<(WholeBodyLimit, T)>,
    /// The limit that the wrenches break most, and by how much (N, N·m), in what is solved by giving way
    /// or because the work was spent; `None` where none is by more than the tolerance. Torques are cut in
    /// any case.
    pub broken: Option<(WholeBodyLimit, T)>,
    /// Desired wrench less the one that is made, in the central body's frame (N, N·m).
    pub given_up: Wrench<T>,
    /// Feet whose leg is near a singular posture: the acceleration that the leg cannot keep from the
    /// foot, in sole axes (m/s², rad/s²), zero for other feet.
    pub singular: [Option<Twist<T>>; FEET],
    /// Limits taken in and let go.
    pub changes: u32,
    /// Multiplications spent on the distribution.
    pub work: Work,
}

impl<T: Real, const FEET: usize> WholeBodyReport<T, FEET> {
    /// Of a tick in which nothing binds.
    pub(super) fn free() -> Self {
        Self {
            status: Status::Solved,
            feet: [LimitSet::default(); FEET],
            torques: 0,
            ranges: 0,
            worst: None,
            broken: None,
            given_up: Wrench::zero(),
            singular: [None; FEET],
            changes: 0,
            work: 0,
        }
    }

    /// Whether some limit binds.
    pub fn is_limited(&self) -> bool {
        self.worst.is_some() || self.status != Status::Solved
    }

    /// What a solution tells: the limits of the rows that it ends with, and of these the `worst`.
    #[inline(always)]
    pub(super) fn fill<X, const K: usize>(
        &mut self,
        solution: &Solution<T, X>,
        active: &ActiveRows<T, K>,
        worst: Option<(WholeBodyLimit, T)>,
        joint: impl Fn(usize, usize) -> usize,
    ) {
        self.status = solution.status;
        self.worst = worst;
        self.changes = solution.changes;
        self.work = solution.work;
        for (row, _) in active.iter() {
            self.insert(limit_of(row, &joint));
        }
        self.broken =
            solution.violation.map(|broken| (limit_of(broken.row, &joint), broken.amount));
    }

    fn insert(&mut self, limit: WholeBodyLimit) {
        match limit {
            WholeBodyLimit::Foot { foot, limit } => {
                if let Some(set) = self.feet.get_mut(foot) {
                    set.insert(limit);
                }
            }
            WholeBodyLimit::Torque { velocity } => {
                let bit = velocity.checked_sub(6).and_then(|k| 1_u64.checked_shl(k as u32));
                self.torques |= bit.unwrap_or(0);
            }
            WholeBodyLimit::Range { velocity } => {
                let bit = velocity.checked_sub(6).and_then(|k| 1_u64.checked_shl(k as u32));
                self.ranges |= bit.unwrap_or(0);
            }
        }
    }
}
