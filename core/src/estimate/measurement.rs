//! (4), (5) and the options (7) to (9): rows, and what they find.

use super::covariance::{
    ACCELEROMETER, Covariance, FOOT_ORIENTATION, FOOT_POSITION, POSITION, PerError, Present, TILT,
};
use super::predict::widen;
use super::update::rows;
use crate::Real;
use crate::spatial::{Quaternion, SymmetricMatrix3};
use nalgebra::{Matrix1, Matrix3, SMatrix, Vector1, Vector3};

/// What measurements change until the end of a tick.
pub(super) struct Update<'a, T, const FEET: usize> {
    pub covariance: &'a mut Covariance<T, FEET>,
    pub errors: PerError<Vector3<T>, FEET>,
    pub present: Present<FEET>,
    /// A covariance that was not positive.
    pub is_indefinite: bool,
}

impl<T: Real, const FEET: usize> Update<'_, T, FEET> {
    /// (4): the innovation `y`, `m` of the foot, `R`, and the variance of each row.
    #[inline(always)]
    pub fn position(
        &mut self,
        foot: usize,
        (y, m): (Vector3<T>, Vector3<T>),
        rotation: &Matrix3<T>,
        variance: T,
    ) {
        // Q_j = (P_jp − P_jr) R + P_jθ [m]ᵀ
        let mut q = self.covariance.foot_column(foot, FOOT_POSITION);
        let r = self.covariance.column::<POSITION>();
        let tilt = self.covariance.column::<TILT>();
        let row = |p: &Matrix3<T>, r: &Matrix3<T>, tilt: &Matrix3<T>| {
            let mut sum = (p - r) * rotation;
            for i in 0..3 {
                // (P [m]ᵀ)' = m × the row of P.
                let turned = m.cross(&tilt.row(i).transpose());
                for k in 0..3 {
                    sum[(i, k)] += turned[k];
                }
            }
            sum
        };
        for j in 0..q.body.len() {
            q.body[j] = row(&q.body[j], &r.body[j], &tilt.body[j]);
        }
        self.each_present(&mut q, &r, &tilt, row);
        let own = entry(&q.feet, foot, FOOT_POSITION);
        let mut s = rotation.tr_mul(&(own - q.body[POSITION]));
        for k in 0..3 {
            let turned = m.cross(&q.body[TILT].column(k));
            for i in 0..3 {
                s[(i, k)] += turned[i];
            }
        }
        widen(&mut s, variance);
        let known = entry(&self.errors.feet, foot, FOOT_POSITION);
        let e = y
            - rotation.tr_mul(&(known - self.errors.body[POSITION]))
            - m.cross(&self.errors.body[TILT]);
        self.three(&q, &s, e);
    }

    /// (5), likewise.
    #[inline(always)]
    pub fn orientation(&mut self, foot: usize, y: Vector3<T>, rotation: &Matrix3<T>, variance: T) {
        // Q_j = P_jφ R − P_jθ
        let mut q = self.covariance.foot_column(foot, FOOT_ORIENTATION);
        let tilt = self.covariance.column::<TILT>();
        let row = |phi: &Matrix3<T>, tilt: &Matrix3<T>, _: &Matrix3<T>| phi * rotation - tilt;
        for j in 0..q.body.len() {
            q.body[j] = row(&q.body[j], &tilt.body[j], &tilt.body[j]);
        }
        self.each_present(&mut q, &tilt, &tilt, row);
        let own = entry(&q.feet, foot, FOOT_ORIENTATION);
        let mut s = rotation.tr_mul(&own) - q.body[TILT];
        widen(&mut s, variance);
        let known = entry(&self.errors.feet, foot, FOOT_ORIENTATION);
        let e = y - rotation.tr_mul(&known) + self.errors.body[TILT];
        self.three(&q, &s, e);
    }

    /// (7): `δφ_x, δφ_y` of a foot are these.
    #[inline(always)]
    pub fn level(&mut self, foot: usize, orientation: Quaternion<T>, variance: T) {
        let n = orientation.rotate(Vector3::z());
        for (axis, y) in [(0, n.y), (1, -n.x)] {
            self.foot_row((foot, FOOT_ORIENTATION, axis), y, variance);
        }
    }

    /// (7), (8): one error of a foot.
    #[inline(always)]
    pub fn foot_row(&mut self, (foot, part, axis): (usize, usize, usize), y: T, variance: T) {
        let q = self.covariance.foot_axis(foot, part, axis);
        let known = entry(&self.errors.feet, foot, part);
        let own = entry(&q.feet, foot, part);
        let at = |v: &Vector3<T>| v.get(axis).copied().unwrap_or(T::zero());
        self.one(&q, at(&own) + variance, y - at(&known));
    }

    /// (9): what x and y of `b_f` are, and what they were taken to be.
    #[inline(always)]
    pub fn force_direction(&mut self, measured: Vector3<T>, bias: Vector3<T>, variance: T) {
        for axis in 0..2 {
            let q = self.covariance.axis::<ACCELEROMETER>(axis);
            let s = q.body[ACCELEROMETER][axis] + variance;
            let e = measured[axis] - bias[axis] - self.errors.body[ACCELEROMETER][axis];
            self.one(&q, s, e);
        }
    }

    #[inline(always)]
    fn each_present(
        &self,
        q: &mut PerError<Matrix3<T>, FEET>,
        a: &PerError<Matrix3<T>, FEET>,
        b: &PerError<Matrix3<T>, FEET>,
        row: impl Fn(&Matrix3<T>, &Matrix3<T>, &Matrix3<T>) -> Matrix3<T>,
    ) {
        for (((q, a), b), present) in q.feet.iter_mut().zip(&a.feet).zip(&b.feet).zip(&self.present)
        {
            for part in 0..2 {
                if present[part] {
                    q[part] = row(&q[part], &a[part], &b[part]);
                }
            }
        }
    }

    #[inline(always)]
    fn three(&mut self, q: &PerError<Matrix3<T>, FEET>, s: &Matrix3<T>, e: Vector3<T>) {
        let Self { covariance, errors, present, is_indefinite } = self;
        match SymmetricMatrix3::from_matrix(s).inverse() {
            Some(inverse) => rows(covariance, errors, present, q, (&inverse.to_matrix(), e)),
            None => *is_indefinite = true,
        }
    }

    #[inline(always)]
    fn one(&mut self, q: &PerError<Vector3<T>, FEET>, s: T, e: T) {
        let Self { covariance, errors, present, is_indefinite } = self;
        // NaN compares as false.
        if s > T::zero() {
            let inverse = Matrix1::new(T::one() / s);
            rows(covariance, errors, present, q, (&inverse, Vector1::new(e)));
        } else {
            *is_indefinite = true;
        }
    }
}

/// Of error `part` of a foot.
#[inline(always)]
fn entry<T: Real, const C: usize, const FEET: usize>(
    feet: &[[SMatrix<T, 3, C>; 2]; FEET],
    foot: usize,
    part: usize,
) -> SMatrix<T, 3, C> {
    feet.get(foot).and_then(|parts| parts.get(part)).copied().unwrap_or_else(SMatrix::zeros)
}

/// The rotation vector of a unit quaternion, of less than half a turn.
#[inline(always)]
pub(super) fn logarithm<T: Real>(q: Quaternion<T>) -> Vector3<T> {
    let q = if q.s < T::zero() { Quaternion { s: -q.s, v: -q.v } } else { q };
    let n = q.v.norm_squared();
    // 2 arcsin(√n)/√n = 2 (1 + n/6 + 3 n²/40 + …): the next term is 15 n³/336.
    let scale = if n < T::of(1e-4) {
        T::of(2.0) + n * (T::of(1.0 / 3.0) + n * T::of(0.15))
    } else {
        let sine = n.sqrt();
        T::of(2.0) * sine.atan2(q.s) / sine
    };
    q.v * scale
}
