//! Wrenches of several columns of a mass matrix, side by side: carried inboard together, they need
//! each joint's turn once, wait for each other's results less, and fill a processor's wide registers.

use super::joint_poses::JointPose;
use crate::Real;
use crate::spatial::{AxisTurn, Rotation, Wrench};
use nalgebra::Vector3;

/// How many columns go together. A processor without wide registers would only carry zeros for the
/// columns that have not begun yet.
pub(super) const WIDTH: usize =
    if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) { 4 } else { 1 };

/// `WIDTH` wrenches in one frame; those not set are zero.
#[derive(Clone, Copy)]
pub(super) struct Columns<T> {
    force: [[T; WIDTH]; 3],
    torque: [[T; WIDTH]; 3],
}

impl<T: Real> Columns<T> {
    #[inline(always)]
    pub fn zero() -> Self {
        Self { force: [[T::zero(); WIDTH]; 3], torque: [[T::zero(); WIDTH]; 3] }
    }

    /// Column `i` becomes `wrench`.
    #[inline(always)]
    pub fn set(&mut self, i: usize, wrench: Wrench<T>) {
        let rows = self.force.iter_mut().chain(&mut self.torque);
        for (row, value) in rows.zip(wrench.to_array()) {
            // A single entry written to memory would have to arrive there before the row is read.
            for (m, entry) in row.iter_mut().enumerate() {
                *entry = if m == i { value } else { *entry };
            }
        }
    }

    /// The wrench of column `i`.
    #[inline(always)]
    pub fn column(&self, i: usize) -> Wrench<T> {
        let of = |rows: &[[T; WIDTH]; 3]| {
            let [x, y, z] = rows.each_ref().map(|row| row.get(i).copied().unwrap_or(T::zero()));
            Vector3::new(x, y, z)
        };
        Wrench { force: of(&self.force), torque: of(&self.torque) }
    }

    /// Component `I` of all torques.
    #[inline(always)]
    pub fn torques<const I: usize>(&self) -> &[T; WIDTH] {
        &self.torque[I]
    }

    /// The six components of all wrenches, force first.
    #[inline(always)]
    pub fn rows(&self) -> impl Iterator<Item = &[T; WIDTH]> {
        self.force.iter().chain(&self.torque)
    }

    /// In the inboard frame of any joint.
    #[inline(never)]
    pub fn carry(&mut self, pose: &JointPose<T>) {
        match &pose.rotation {
            Rotation::Identity => {}
            Rotation::X(turn) => self.turn::<0>(turn),
            Rotation::Y(turn) => self.turn::<1>(turn),
            Rotation::Z(turn) => self.turn::<2>(turn),
            Rotation::General(r) => {
                for vectors in [&mut self.force, &mut self.torque] {
                    let old = *vectors;
                    for (i, row) in vectors.iter_mut().enumerate() {
                        for (m, to) in row.iter_mut().enumerate() {
                            let [x, y, z] = [old[0][m], old[1][m], old[2][m]];
                            *to = r[(i, 0)] * x + r[(i, 1)] * y + r[(i, 2)] * z;
                        }
                    }
                }
            }
        }
        if pose.is_translated {
            self.shift(pose.translation);
        }
    }

    /// In axes that a turn about axis `I` leads to.
    #[inline(always)]
    pub fn turn<const I: usize>(&mut self, turn: &AxisTurn<T>) {
        let (j, k) = ((I + 1) % 3, (I + 2) % 3);
        let (c, s) = (turn.cosine, turn.sine);
        for vectors in [&mut self.force, &mut self.torque] {
            let old = *vectors;
            for m in 0..WIDTH {
                vectors[j][m] = c * old[j][m] - s * old[k][m];
                vectors[k][m] = s * old[j][m] + c * old[k][m];
            }
        }
    }

    /// Torques about a point from which the frame's origin lies at `arm`.
    #[inline(always)]
    pub fn shift(&mut self, arm: Vector3<T>) {
        let f = &self.force;
        for m in 0..WIDTH {
            self.torque[0][m] += arm.y * f[2][m] - arm.z * f[1][m];
            self.torque[1][m] += arm.z * f[0][m] - arm.x * f[2][m];
            self.torque[2][m] += arm.x * f[1][m] - arm.y * f[0][m];
        }
    }
}
