//! How the impulse on a tree's part answers to the motion of its end: a 6 × 6 matrix in four blocks, about
//! one point.

use super::turn::skew;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// Change of impulse and moment of impulse for a change of place and of orientation at the step's end.
/// The arm of the moment is that of the beginning, the arm of the motion that of the end, so that the
/// matrix is not symmetric; for steps of no length it is the articulated-body inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stiffness {
    pub force_by_place: Matrix3<f64>,
    pub force_by_turn: Matrix3<f64>,
    pub moment_by_place: Matrix3<f64>,
    pub moment_by_turn: Matrix3<f64>,
}

/// Force and moment; or place and turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Pair {
    pub linear: Vector3<f64>,
    pub angular: Vector3<f64>,
}

impl Pair {
    pub const ZERO: Self =
        Self { linear: Vector3::new(0.0, 0.0, 0.0), angular: Vector3::new(0.0, 0.0, 0.0) };

    /// As one column, the linear part first.
    pub fn vector(&self) -> Vector6<f64> {
        let (l, a) = (&self.linear, &self.angular);
        Vector6::new(l.x, l.y, l.z, a.x, a.y, a.z)
    }

    /// From its six numbers.
    pub fn of_columns(of: impl Fn(usize) -> f64) -> Self {
        Self {
            linear: Vector3::new(of(0), of(1), of(2)),
            angular: Vector3::new(of(3), of(4), of(5)),
        }
    }

    /// From one column.
    pub fn of_vector(v: &Vector6<f64>) -> Self {
        Self { linear: v.fixed_rows::<3>(0).into(), angular: v.fixed_rows::<3>(3).into() }
    }

    #[inline]
    pub fn dot(&self, other: &Self) -> f64 {
        self.linear.dot(&other.linear) + self.angular.dot(&other.angular)
    }

    #[inline]
    pub fn subtract(&mut self, other: &Self) {
        self.linear -= other.linear;
        self.angular -= other.angular;
    }

    /// A force taken at another point, `arm` away from the one where it acts.
    #[inline]
    pub fn add_shifted(&mut self, force: &Self, arm: &Vector3<f64>) {
        self.linear += force.linear;
        self.angular += force.angular + arm.cross(&force.linear);
    }
}

/// What the elimination of one column keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column {
    /// Impulse for a unit of its motion.
    pub impulse: Pair,
    /// Its own impulse for motions of what is inboard.
    pub answer: Pair,
    /// Its motion for a unit of its own impulse.
    pub inverse: f64,
}

impl Column {
    pub const NONE: Self = Self { impulse: Pair::ZERO, answer: Pair::ZERO, inverse: 0.0 };
}

impl Stiffness {
    pub const ZERO: Self = {
        let zero = Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        Self {
            force_by_place: zero,
            force_by_turn: zero,
            moment_by_place: zero,
            moment_by_turn: zero,
        }
    };

    /// As one matrix, the linear part first.
    pub fn matrix(&self) -> Matrix6<f64> {
        let mut all = Matrix6::zeros();
        all.fixed_view_mut::<3, 3>(0, 0).copy_from(&self.force_by_place);
        all.fixed_view_mut::<3, 3>(0, 3).copy_from(&self.force_by_turn);
        all.fixed_view_mut::<3, 3>(3, 0).copy_from(&self.moment_by_place);
        all.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.moment_by_turn);
        all
    }

    /// From one matrix.
    pub fn of_matrix(all: &Matrix6<f64>) -> Self {
        Self {
            force_by_place: all.fixed_view::<3, 3>(0, 0).into(),
            force_by_turn: all.fixed_view::<3, 3>(0, 3).into(),
            moment_by_place: all.fixed_view::<3, 3>(3, 0).into(),
            moment_by_turn: all.fixed_view::<3, 3>(3, 3).into(),
        }
    }

    /// A body's own about its reference point: mass over the step, and `turning` about the centre of
    /// mass, from which the arms lead.
    #[inline]
    pub fn of_body(
        mass: f64,
        turning: &Matrix3<f64>,
        begin: &Vector3<f64>,
        end: &Vector3<f64>,
    ) -> Self {
        // −m b̂ ê = m ((b·e) 1 − e bᵀ)
        let along = mass * begin.dot(end);
        let mut moment_by_turn = turning - (end * mass) * begin.transpose();
        for i in 0..3 {
            moment_by_turn[(i, i)] += along;
        }
        Self {
            force_by_place: Matrix3::from_diagonal_element(mass),
            force_by_turn: skew(&(end * -mass)),
            moment_by_place: skew(&(begin * mass)),
            moment_by_turn,
        }
    }

    /// A point's own, at the end of these arms.
    #[inline]
    pub fn add_point(&mut self, k: &Matrix3<f64>, begin: &Vector3<f64>, end: &Vector3<f64>) {
        let by_turn = times_skew(k, end);
        self.force_by_place += k;
        self.force_by_turn -= by_turn;
        self.moment_by_place += skew_times(begin, k);
        self.moment_by_turn -= skew_times(begin, &by_turn);
    }

    /// Another part's, whose point lies at the end of these arms.
    #[inline(always)]
    pub fn add_shifted(&mut self, part: &Self, begin: &Vector3<f64>, end: &Vector3<f64>) {
        let by_turn = part.force_by_turn - times_skew(&part.force_by_place, end);
        let moment_by_turn = part.moment_by_turn - times_skew(&part.moment_by_place, end);
        self.moment_by_place += part.moment_by_place + skew_times(begin, &part.force_by_place);
        self.moment_by_turn += moment_by_turn + skew_times(begin, &by_turn);
        self.force_by_place += part.force_by_place;
        self.force_by_turn += by_turn;
    }

    /// Eliminates a rotation about the point: `begin` and `end` are its axis, `own` the slope of its own
    /// law.
    #[inline]
    pub fn eliminate_turn(
        &mut self,
        begin: &Vector3<f64>,
        end: &Vector3<f64>,
        own: f64,
    ) -> Option<Column> {
        let impulse = Pair { linear: self.force_by_turn * end, angular: self.moment_by_turn * end };
        let answer = Pair {
            linear: self.moment_by_place.tr_mul(begin),
            angular: self.moment_by_turn.tr_mul(begin),
        };
        let pivot = begin.dot(&impulse.angular) + own;
        self.eliminate(impulse, answer, pivot)
    }

    /// Eliminates a translation.
    #[inline]
    pub fn eliminate_shift(
        &mut self,
        begin: &Vector3<f64>,
        end: &Vector3<f64>,
        own: f64,
    ) -> Option<Column> {
        let impulse =
            Pair { linear: self.force_by_place * end, angular: self.moment_by_place * end };
        let answer = Pair {
            linear: self.force_by_place.tr_mul(begin),
            angular: self.force_by_turn.tr_mul(begin),
        };
        let pivot = begin.dot(&impulse.linear) + own;
        self.eliminate(impulse, answer, pivot)
    }

    /// Eliminates one of a ball's turns: about a unit axis at the beginning.
    #[inline]
    pub fn eliminate_ball_turn(&mut self, axis: usize, end: &Vector3<f64>) -> Option<Column> {
        let impulse = Pair { linear: self.force_by_turn * end, angular: self.moment_by_turn * end };
        let answer = Pair {
            linear: self.moment_by_place.row(axis).transpose(),
            angular: self.moment_by_turn.row(axis).transpose(),
        };
        self.eliminate(impulse, answer, impulse.angular[axis])
    }

    /// Eliminates one of a free body's six motions: along unit axes, then about them.
    #[inline]
    pub fn eliminate_free(&mut self, motion: usize) -> Option<Column> {
        let i = motion % 3;
        let [by_motion, of_motion] = if motion < 3 {
            [
                [&self.force_by_place, &self.moment_by_place],
                [&self.force_by_place, &self.force_by_turn],
            ]
        } else {
            [
                [&self.force_by_turn, &self.moment_by_turn],
                [&self.moment_by_place, &self.moment_by_turn],
            ]
        };
        let [linear, angular] = by_motion.map(|m| m.column(i).into_owned());
        let impulse = Pair { linear, angular };
        let [linear, angular] = of_motion.map(|m| m.row(i).transpose());
        let answer = Pair { linear, angular };
        let pivot = if motion < 3 { answer.linear[i] } else { answer.angular[i] };
        self.eliminate(impulse, answer, pivot)
    }

    /// None where the pivot is no number, or none to divide by.
    #[inline]
    fn eliminate(&mut self, impulse: Pair, answer: Pair, pivot: f64) -> Option<Column> {
        let inverse = 1.0 / pivot;
        let by = Pair { linear: answer.linear * inverse, angular: answer.angular * inverse };
        subtract_outer(&mut self.force_by_place, &impulse.linear, &by.linear);
        subtract_outer(&mut self.force_by_turn, &impulse.linear, &by.angular);
        subtract_outer(&mut self.moment_by_place, &impulse.angular, &by.linear);
        subtract_outer(&mut self.moment_by_turn, &impulse.angular, &by.angular);
        inverse.is_finite().then_some(Column { impulse, answer, inverse })
    }
}

/// `m −= a bᵀ`
#[inline]
fn subtract_outer(m: &mut Matrix3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) {
    for j in 0..3 {
        for i in 0..3 {
            m[(i, j)] -= a[i] * b[j];
        }
    }
}

/// `m r̂`: its rows are those of `m`, each × `r`.
#[inline]
pub(super) fn times_skew(m: &Matrix3<f64>, r: &Vector3<f64>) -> Matrix3<f64> {
    let [x, y, z] = [m.column(0), m.column(1), m.column(2)];
    Matrix3::from_columns(&[y * r.z - z * r.y, z * r.x - x * r.z, x * r.y - y * r.x])
}

/// `r̂ m`: its columns are `r ×` those of `m`.
#[inline]
pub(super) fn skew_times(r: &Vector3<f64>, m: &Matrix3<f64>) -> Matrix3<f64> {
    let column = |j: usize| r.cross(&m.column(j).into_owned());
    Matrix3::from_columns(&[column(0), column(1), column(2)])
}
