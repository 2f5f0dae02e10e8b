//! The rows of a foot: what the ground and the motors cannot exceed.
//!
//! # Notation
//! Sole axes. `(f, n) = w + c`: wrench of the ground about the reference point. Patch: half-lengths
//! `hx, hy`, centre `(xc, yc, z)`; `μ' = μ/√2`, the pyramid inside the cone. Moments about its centre:
//! ```text
//! Mx = nx + z fy − yc fz,   My = ny − z fx + xc fz,   Mz = nz − xc fy + yc fx      (1)
//! ```
//!
//! | row | limit | slack `a · (w + c) − b` |
//! |---|---|---|
//! | 0, 1 | lift, press | `fz − least`, `greatest − fz` |
//! | 2 … 5 | slip | `μ' fz ∓ fx`, `μ' fz ∓ fy` |
//! | 6 … 9 | tip | `hx fz ± My`, `hy fz ∓ Mx` |
//! | 10 … 13 | twist + | `μ'(hx+hy) fz − Mz − s (hy fx + μ' Mx) − t (hx fy + μ' My)` |
//! | 14 … 17 | twist − | `μ'(hx+hy) fz + Mz − s (hy fx − μ' Mx) − t (hx fy − μ' My)` |
//! | 18 … | torque | `limit − τ_k`, then `limit + τ_k` (of a tick whose feet may swing: ranges of the leg's joints) |
//!
//! with `(s, t) = (+,+), (+,−), (−,+), (−,−)`. Rows 2 to 17 are exactly the wrenches of four forces at
//! the patch's corners, each in its pyramid (Caron, Pham, Nakamura, ICRA 2015). An edge has only the
//! tip rows along it and twist rows with one sign of the other; a point has none of either.
//!
//! Torques depend on `w` alone, as the links' weight and inertia are in the desired wrench:
//! `τ_k = −(J_k · w)`, with `J_k` the foot's twist per rate of joint k (Alg. 4.6).

use super::{ContactFoot, ContactLimits};
use crate::Real;
use crate::qp::Search;
use crate::spatial::Wrench;
use core::f64::consts::FRAC_1_SQRT_2;

/// Contact rows, before those of torques.
pub(in crate::balance) const CONTACT_ROWS: u8 = 18;
/// Numbers of rows from one foot to the next: 18 and twice at most 7 joints.
pub(super) const STRIDE: u8 = 32;

/// A limit of one foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactLimit {
    /// Least normal force.
    Lift,
    /// Greatest normal force.
    Press,
    /// Friction against sliding.
    Slip,
    /// Centre of pressure at the edge.
    Tip,
    /// Friction against turning about the normal.
    Twist,
    /// Torque of a joint, counted from the hip.
    Torque(u8),
    /// Range of a joint, numbered as its torque: how fast it may still turn towards the end.
    Range(u8),
}

impl ContactLimit {
    /// Of a row of a foot whose leg has this many joints.
    pub(in crate::balance) fn of_row(row: u8, joints: u8) -> Self {
        match row % STRIDE {
            0 => Self::Lift,
            1 => Self::Press,
            2..6 => Self::Slip,
            6..10 => Self::Tip,
            10..CONTACT_ROWS => Self::Twist,
            row => {
                let joint = row - CONTACT_ROWS;
                Self::Torque(if joint < joints { joint } else { joint - joints })
            }
        }
    }
}

/// Number of the first row of foot `foot`.
#[inline(always)]
pub(in crate::balance) fn first_row(foot: usize) -> u8 {
    (foot as u8).wrapping_mul(STRIDE)
}

/// Foot and row of it.
#[inline(always)]
pub(in crate::balance) fn split_row(row: u8) -> (usize, u8) {
    (usize::from(row / STRIDE), row % STRIDE)
}

/// `(s, t)` of a twist row, counted from 0.
#[inline(always)]
fn signs<T: Real>(row: u8) -> (T, T) {
    let sign = |bit: u8| if row & bit == 0 { T::one() } else { -T::one() };
    (sign(2), sign(1))
}

impl<T: Real, const JOINTS: usize> ContactFoot<'_, T, JOINTS> {
    /// Normal of a row, on `w` in frame 1's axes, and its bound.
    #[inline(always)]
    pub(super) fn row(&self, row: u8) -> Option<(Wrench<T>, T)> {
        let one = T::one();
        if let Some(joint) = row.checked_sub(CONTACT_ROWS) {
            let joint = usize::from(joint);
            let (joint, sign) =
                if joint < JOINTS { (joint, one) } else { (joint.wrapping_sub(JOINTS), -one) };
            let (twist, limit) = (self.joints.get(joint)?, self.limits.torques.get(joint)?);
            let normal = Wrench { force: twist.linear * sign, torque: twist.angular * sign };
            return Some((normal, -*limit));
        }
        let (a, bound) = self.limits.contact_row(row)?;
        let carried = &self.carried;
        let bound = bound - a.force.dot(&carried.force) - a.torque.dot(&carried.torque);
        Some((Wrench { force: self.rotation * a.force, torque: self.rotation * a.torque }, bound))
    }

    /// Tests all rows at `w` (frame 1's axes); the first has the number `first`.
    #[inline(always)]
    pub(super) fn scan(&self, w: &Wrench<T>, first: u8, search: &mut Search<'_, T>) {
        let limits = self.limits;
        limits.scan_contact(&(self.in_sole_axes(w) + self.carried), first, search);
        limits.scan_torques(|k| -self.joints[k].power(*w), first, search);
    }
}

impl<T: Real, const JOINTS: usize> ContactLimits<T, JOINTS> {
    /// Normal of a row of the contact, on the ground's wrench in sole axes about the reference point, and
    /// its bound; `None` for the number of a torque's.
    #[inline(always)]
    pub(in crate::balance) fn contact_row(&self, row: u8) -> Option<(Wrench<T>, T)> {
        if row >= CONTACT_ROWS {
            return None;
        }
        let patch = &self.patch;
        let (zero, one) = (T::zero(), T::one());
        let (hx, hy, c) = (patch.half_x, patch.half_y, patch.center);
        let mu = self.friction * T::of(FRAC_1_SQRT_2);
        let wrench =
            |force: [T; 3], torque: [T; 3]| Wrench { force: force.into(), torque: torque.into() };
        let force = |x, y, z| wrench([x, y, z], [zero; 3]);
        let mut bound = zero;
        let a = match row {
            0 => {
                bound = self.least_force;
                force(zero, zero, one)
            }
            1 => {
                bound = -self.greatest_force;
                force(zero, zero, -one)
            }
            2 => force(-one, zero, mu),
            3 => force(one, zero, mu),
            4 => force(zero, -one, mu),
            5 => force(zero, one, mu),
            6 => wrench([-c.z, zero, hx + c.x], [zero, one, zero]),
            7 => wrench([c.z, zero, hx - c.x], [zero, -one, zero]),
            8 => wrench([zero, -c.z, hy + c.y], [-one, zero, zero]),
            9 => wrench([zero, c.z, hy - c.y], [one, zero, zero]),
            _ => {
                let (s, t) = signs::<T>(row.wrapping_sub(10));
                // Factors of Mx, My, Mz.
                let z = if row < 14 { -one } else { one };
                let (x, y) = (z * s * mu, z * t * mu);
                wrench(
                    [-s * hy - y * c.z + z * c.y, -t * hx + x * c.z - z * c.x, {
                        mu * (hx + hy) - x * c.y + y * c.x
                    }],
                    [x, y, z],
                )
            }
        };
        Some((a, bound))
    }

    /// The term of a row's limit, in the row's unit, that is scaled where the limit is widened, with
    /// the ground's force `fz` normal to the sole.
    #[inline(always)]
    pub(super) fn limit_term(&self, limit: ContactLimit, row: u8, fz: T) -> T {
        let patch = &self.patch;
        let cap = self.friction * T::of(FRAC_1_SQRT_2) * fz;
        match limit {
            ContactLimit::Lift => self.least_force,
            ContactLimit::Press => self.greatest_force,
            ContactLimit::Slip => cap,
            ContactLimit::Tip if row % STRIDE < 8 => patch.half_x * fz,
            ContactLimit::Tip => patch.half_y * fz,
            ContactLimit::Twist => cap * (patch.half_x + patch.half_y),
            ContactLimit::Range(_) => T::zero(),
            ContactLimit::Torque(joint) => {
                self.torques.get(usize::from(joint)).map_or(T::zero(), |limit| *limit)
            }
        }
    }

    /// Tests the rows of the contact at the wrench `ground` of the ground, in sole axes about the
    /// reference point; the foot's first row has the number `first`.
    #[inline(always)]
    pub(in crate::balance) fn scan_contact(
        &self,
        ground: &Wrench<T>,
        first: u8,
        search: &mut Search<'_, T>,
    ) {
        let limits = self;
        let patch = &limits.patch;
        let (f, n) = (ground.force, ground.torque);
        search.offer(first, f.z - limits.least_force);
        search.offer(first | 1, limits.greatest_force - f.z);
        let mu = limits.friction * T::of(FRAC_1_SQRT_2);
        let cap = mu * f.z;
        search.offer_pair(cap, f.x, [first | 2, first | 3]);
        search.offer_pair(cap, f.y, [first | 4, first | 5]);
        // (1)
        let (hx, hy, c) = (patch.half_x, patch.half_y, patch.center);
        let mx = n.x + c.z * f.y - c.y * f.z;
        let my = n.y - c.z * f.x + c.x * f.z;
        let mz = n.z - c.x * f.y + c.y * f.x;
        let (long, wide) = (hx > T::zero(), hy > T::zero());
        if long {
            search.offer_pair(hx * f.z, -my, [first | 6, first | 7]);
        }
        if wide {
            search.offer_pair(hy * f.z, mx, [first | 8, first | 9]);
        }
        if long || wide {
            let limit = cap * (hx + hy);
            let (x, y, p, q) = (hy * f.x, hx * f.y, mu * mx, mu * my);
            for (at, limit, x, y) in
                [(10, limit - mz, x + p, y + q), (14, limit + mz, x - p, y - q)]
            {
                // Of four rows the most broken follows from two signs.
                if search.wants(limit - x.abs() - y.abs()) {
                    for four in 0..4 {
                        let (s, t) = signs::<T>(four);
                        let twice = (!wide && s < T::zero()) || (!long && t < T::zero());
                        if !twice {
                            search.offer(first | (at + four), limit - s * x - t * y);
                        }
                    }
                }
            }
        }
    }

    /// Tests the rows of torques, which `torque` gives for each joint.
    #[inline(always)]
    pub(in crate::balance) fn scan_torques(
        &self,
        torque: impl Fn(usize) -> T,
        first: u8,
        search: &mut Search<'_, T>,
    ) {
        for (k, limit) in self.torques.iter().enumerate() {
            let plus = first | (CONTACT_ROWS + k as u8);
            search.offer_pair(*limit, torque(k), [plus, plus + JOINTS as u8]);
        }
    }
}
