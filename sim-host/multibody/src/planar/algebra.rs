//! Turns, forces and stiffnesses in a plane.
//!
//! # Notation
//! `r⊥ = (−y, x)`, so that a turn by `δ` moves the end of an arm `r` by `δ r⊥`; `a × b = a⊥ · b`, a number.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

/// `r⊥`
#[inline]
pub(super) fn quarter(r: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-r.y, r.x)
}

/// `a × b`
#[inline]
pub(super) fn cross(a: &Vector2<f64>, b: &Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

/// A turn, by cosine and sine of half its angle: the unit quaternion `(c, s n̂)` about the plane's normal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Turn {
    pub c: f64,
    pub s: f64,
}

impl Turn {
    pub const NONE: Self = Self { c: 1.0, s: 0.0 };

    /// By an angle whose half has the tangent `t`.
    #[inline]
    pub fn of_tangent(t: f64) -> Self {
        let c = 1.0 / (1.0 + t * t).sqrt();
        Self { c, s: t * c }
    }

    /// Both, in whatever order.
    #[inline]
    pub fn and(&self, other: &Self) -> Self {
        Self { c: self.c * other.c - self.s * other.s, s: self.s * other.c + self.c * other.s }
    }

    /// Of unit norm again, after round-off: one step of Newton's method for the root.
    #[inline]
    pub fn unit(&self) -> Self {
        let scale = 1.5 - 0.5 * (self.c * self.c + self.s * self.s);
        Self { c: self.c * scale, s: self.s * scale }
    }

    #[inline]
    pub fn rotation(&self) -> Rotation {
        Rotation { sine: 2.0 * self.c * self.s, versine: 2.0 * self.s * self.s }
    }
}

/// What a turn does to arms: `sin θ` and `1 − cos θ`, so that small displacements are no differences of nearly
/// equal numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rotation {
    pub sine: f64,
    pub versine: f64,
}

impl Rotation {
    pub const NONE: Self = Self { sine: 0.0, versine: 0.0 };

    /// `R r − r`
    #[inline]
    pub fn displacement(&self, r: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(-self.sine * r.y - self.versine * r.x, self.sine * r.x - self.versine * r.y)
    }

    /// `R r`
    #[inline]
    pub fn rotate(&self, r: &Vector2<f64>) -> Vector2<f64> {
        r + self.displacement(r)
    }
}

/// Force and moment; or way and turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub linear: Vector2<f64>,
    pub angular: f64,
}

impl Pair {
    pub const ZERO: Self = Self { linear: Vector2::new(0.0, 0.0), angular: 0.0 };

    /// A force taken at another point, `arm` away from the one where it acts.
    #[inline]
    pub fn add_shifted(&mut self, force: &Self, arm: &Vector2<f64>) {
        self.linear += force.linear;
        self.angular += force.angular + cross(arm, &force.linear);
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

/// How the impulse on a tree's part answers to the motion of its end: a 3 × 3 matrix in four blocks, about one
/// point. As in space the arms of moments are those of the beginning, the arms of motions those of the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stiffness {
    pub force_by_place: Matrix2<f64>,
    pub force_by_turn: Vector2<f64>,
    pub moment_by_place: Vector2<f64>,
    pub moment_by_turn: f64,
}

impl Stiffness {
    pub const ZERO: Self = Self {
        force_by_place: Matrix2::new(0.0, 0.0, 0.0, 0.0),
        force_by_turn: Vector2::new(0.0, 0.0),
        moment_by_place: Vector2::new(0.0, 0.0),
        moment_by_turn: 0.0,
    };

    /// A body's own about its reference point: mass over the step, and `turning` about the centre of mass, from
    /// which the arms lead.
    #[inline]
    pub fn add_body(&mut self, mass: f64, turning: f64, begin: &Vector2<f64>, end: &Vector2<f64>) {
        self.force_by_place[(0, 0)] += mass;
        self.force_by_place[(1, 1)] += mass;
        self.force_by_turn += quarter(end) * mass;
        self.moment_by_place += quarter(begin) * mass;
        self.moment_by_turn += turning + mass * begin.dot(end);
    }

    /// A point's own, at the end of these arms.
    #[inline]
    pub fn add_point(&mut self, k: &Matrix2<f64>, begin: &Vector2<f64>, end: &Vector2<f64>) {
        let by_turn = k * quarter(end);
        self.force_by_place += k;
        self.force_by_turn += by_turn;
        self.moment_by_place += k.tr_mul(&quarter(begin));
        self.moment_by_turn += cross(begin, &by_turn);
    }

    /// Another part's, whose point lies at the end of these arms.
    #[inline(always)]
    pub fn add_shifted(&mut self, part: &Self, begin: &Vector2<f64>, end: &Vector2<f64>) {
        let (begin_quarter, end_quarter) = (quarter(begin), quarter(end));
        let by_turn = part.force_by_turn + part.force_by_place * end_quarter;
        self.force_by_place += part.force_by_place;
        self.force_by_turn += by_turn;
        self.moment_by_turn += part.moment_by_turn
            + part.moment_by_place.dot(&end_quarter)
            + begin_quarter.dot(&by_turn);
        self.moment_by_place += part.moment_by_place + part.force_by_place.tr_mul(&begin_quarter);
    }

    /// Eliminates a turn about the point; `own` is the slope of its own law. None where the pivot is no number,
    /// or none to divide by.
    #[inline]
    pub fn eliminate_turn(&mut self, own: f64) -> Option<Column> {
        let turn = self.moment_by_turn;
        let impulse = Pair { linear: self.force_by_turn, angular: turn };
        let answer = Pair { linear: self.moment_by_place, angular: turn };
        let inverse = 1.0 / (turn + own);
        let column = Column { impulse, answer, inverse };
        let by = answer.linear * inverse;
        self.force_by_place -= impulse.linear * by.transpose();
        // What is left of the turn is what its law carries.
        let carried = own * inverse;
        self.force_by_turn *= carried;
        self.moment_by_place *= carried;
        self.moment_by_turn *= carried;
        inverse.is_finite().then_some(column)
    }

    /// Eliminates a translation: `begin` and `end` are its axis.
    #[inline]
    pub fn eliminate_shift(
        &mut self,
        begin: &Vector2<f64>,
        end: &Vector2<f64>,
        own: f64,
    ) -> Option<Column> {
        let impulse =
            Pair { linear: self.force_by_place * end, angular: self.moment_by_place.dot(end) };
        let answer = Pair {
            linear: self.force_by_place.tr_mul(begin),
            angular: self.force_by_turn.dot(begin),
        };
        let inverse = 1.0 / (begin.dot(&impulse.linear) + own);
        let by = Pair { linear: answer.linear * inverse, angular: answer.angular * inverse };
        self.force_by_place -= impulse.linear * by.linear.transpose();
        self.force_by_turn -= impulse.linear * by.angular;
        self.moment_by_place -= by.linear * impulse.angular;
        self.moment_by_turn -= impulse.angular * by.angular;
        inverse.is_finite().then_some(Column { impulse, answer, inverse })
    }
}
