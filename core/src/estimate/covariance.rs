//! Storage of `P`, in blocks of 3 × 3.

use crate::Real;
use nalgebra::{Matrix3, SMatrix, Vector3};

/// Errors of the body: `δr, δv, δθ, δb_f, δb_w`.
pub(super) const BODY: usize = 5;
pub(super) const POSITION: usize = 0;
pub(super) const VELOCITY: usize = 1;
pub(super) const TILT: usize = 2;
pub(super) const ACCELEROMETER: usize = 3;
pub(super) const GYROSCOPE: usize = 4;
/// Errors of a foot: `δp, δφ`.
pub(super) const FOOT: usize = 2;
pub(super) const FOOT_POSITION: usize = 0;
pub(super) const FOOT_ORIENTATION: usize = 1;

/// Something of each error.
#[derive(Clone, Copy, Debug)]
pub(super) struct PerError<B, const FEET: usize> {
    pub body: [B; BODY],
    pub feet: [[B; FOOT]; FEET],
}

/// Which errors of feet there are now.
pub(super) type Present<const FEET: usize> = [[bool; FOOT]; FEET];

/// Rows of a foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FootRows<T, const FEET: usize> {
    /// With the body's errors.
    pub body: [[Matrix3<T>; BODY]; FOOT],
    /// With its own (lower triangle) and those of feet before it.
    pub feet: [[[Matrix3<T>; FOOT]; FOOT]; FEET],
}

/// `P`. Of the body's blocks and of the feet's only those are used whose column is not after their row.
/// Blocks on the diagonal are symmetric to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Covariance<T, const FEET: usize> {
    pub body: [[Matrix3<T>; BODY]; BODY],
    pub feet: [FootRows<T, FEET>; FEET],
}

impl<T: Real, const C: usize, const FEET: usize> PerError<SMatrix<T, 3, C>, FEET> {
    /// All zero.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { body: [SMatrix::zeros(); BODY], feet: [[SMatrix::zeros(); FOOT]; FEET] }
    }
}

impl<T: Real, const FEET: usize> Covariance<T, FEET> {
    /// Independent errors with these variances of the body's; feet have none yet.
    pub fn diagonal(variances: [Vector3<T>; BODY]) -> Self {
        let rows = FootRows {
            body: [[Matrix3::zeros(); BODY]; FOOT],
            feet: [[[Matrix3::zeros(); FOOT]; FOOT]; FEET],
        };
        let mut covariance = Self { body: [[Matrix3::zeros(); BODY]; BODY], feet: [rows; FEET] };
        for (k, variance) in variances.iter().enumerate() {
            covariance.body[k][k] = Matrix3::from_diagonal(variance);
        }
        covariance
    }

    /// `P_jk` for all `j` and the body's error `K`; of errors that are not present, whatever was there.
    #[inline(always)]
    pub fn column<const K: usize>(&self) -> PerError<Matrix3<T>, FEET> {
        let mut column = PerError::<Matrix3<T>, FEET>::zero();
        for j in 0..BODY {
            column.body[j] = if j < K { self.body[K][j].transpose() } else { self.body[j][K] };
        }
        for (to, rows) in column.feet.iter_mut().zip(&self.feet) {
            to[0] = rows.body[0][K];
            to[1] = rows.body[1][K];
        }
        column
    }

    /// Component `axis` of it: a column of `P`.
    #[inline(always)]
    pub fn axis<const K: usize>(&self, axis: usize) -> PerError<Vector3<T>, FEET> {
        let mut column = PerError::<Vector3<T>, FEET>::zero();
        for j in 0..BODY {
            column.body[j] = if j < K {
                row_of(&self.body[K][j], axis)
            } else {
                column_of(&self.body[j][K], axis)
            };
        }
        for (to, rows) in column.feet.iter_mut().zip(&self.feet) {
            to[0] = column_of(&rows.body[0][K], axis);
            to[1] = column_of(&rows.body[1][K], axis);
        }
        column
    }

    /// `P_jk` for all `j` and error `part` of a foot.
    #[inline(always)]
    pub fn foot_column(&self, foot: usize, part: usize) -> PerError<Matrix3<T>, FEET> {
        self.of_foot((foot, part), |block| *block, Matrix3::transpose)
    }

    /// Component `axis` of it.
    #[inline(always)]
    pub fn foot_axis(&self, foot: usize, part: usize, axis: usize) -> PerError<Vector3<T>, FEET> {
        self.of_foot((foot, part), |block| column_of(block, axis), |block| row_of(block, axis))
    }

    /// Something of each `P_jk`, from the block as it is kept or the other way round.
    #[inline(always)]
    fn of_foot<const C: usize>(
        &self,
        (foot, part): (usize, usize),
        upright: impl Fn(&Matrix3<T>) -> SMatrix<T, 3, C>,
        transposed: impl Fn(&Matrix3<T>) -> SMatrix<T, 3, C>,
    ) -> PerError<SMatrix<T, 3, C>, FEET> {
        let mut column = PerError::<SMatrix<T, 3, C>, FEET>::zero();
        let Some(own) = self.feet.get(foot) else { return column };
        for j in 0..BODY {
            column.body[j] =
                transposed(if part == FOOT_POSITION { &own.body[0][j] } else { &own.body[1][j] });
        }
        let all = column.feet.iter_mut().zip(&self.feet).zip(&own.feet).enumerate();
        for (other, ((to, rows), pair)) in all {
            for (p, to) in to.iter_mut().enumerate() {
                // The block at (other, p) and (foot, part), whichever way round it is kept.
                if other > foot || (other == foot && p >= part) {
                    if let Some(pair) = rows.feet.get(foot) {
                        *to = upright(entry(pair, p, part));
                    }
                } else {
                    *to = transposed(entry(pair, part, p));
                }
            }
        }
        column
    }

    /// Makes a foot's rows and columns those of `P_jk` in a column, its own block among them; a position before an
    /// orientation, whose row has both.
    #[inline(always)]
    pub fn set_foot_column(
        &mut self,
        (foot, part): (usize, usize),
        column: &PerError<Matrix3<T>, FEET>,
    ) {
        for (other, rows) in self.feet.iter_mut().enumerate() {
            if other == foot {
                let [position, orientation] = &mut rows.body;
                let row = if part == FOOT_POSITION { position } else { orientation };
                *row = column.body.each_ref().map(Matrix3::transpose);
                for (before, (pair, from)) in rows.feet.iter_mut().zip(&column.feet).enumerate() {
                    let [a, b] = pair;
                    let row = if part == FOOT_POSITION { a } else { b };
                    for (p, (to, from)) in row.iter_mut().zip(from).enumerate() {
                        if before < foot || (before == foot && p <= part) {
                            *to = from.transpose();
                        }
                    }
                }
            } else if other > foot
                && let (Some(pair), Some(from)) = (rows.feet.get_mut(foot), column.feet.get(other))
            {
                for (row, from) in pair.iter_mut().zip(from) {
                    let [a, b] = row;
                    *if part == FOOT_POSITION { a } else { b } = *from;
                }
            }
        }
    }

    /// Variances, in the order of errors.
    #[inline(always)]
    pub fn variances(&self) -> [Vector3<T>; BODY] {
        core::array::from_fn(|k| self.body[k][k].diagonal())
    }
}

#[inline(always)]
fn entry<T>(pair: &[[Matrix3<T>; FOOT]; FOOT], row: usize, column: usize) -> &Matrix3<T> {
    let [[aa, ab], [ba, bb]] = pair;
    match (row, column) {
        (FOOT_POSITION, FOOT_POSITION) => aa,
        (FOOT_POSITION, _) => ab,
        (_, FOOT_POSITION) => ba,
        _ => bb,
    }
}

#[inline(always)]
fn column_of<T: Real>(m: &Matrix3<T>, axis: usize) -> Vector3<T> {
    match axis {
        0 => Vector3::new(m.m11, m.m21, m.m31),
        1 => Vector3::new(m.m12, m.m22, m.m32),
        _ => Vector3::new(m.m13, m.m23, m.m33),
    }
}

#[inline(always)]
fn row_of<T: Real>(m: &Matrix3<T>, axis: usize) -> Vector3<T> {
    match axis {
        0 => Vector3::new(m.m11, m.m12, m.m13),
        1 => Vector3::new(m.m21, m.m22, m.m23),
        _ => Vector3::new(m.m31, m.m32, m.m33),
    }
}
