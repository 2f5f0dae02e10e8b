//! (1) to (3): one tick on.

use super::covariance::{
    ACCELEROMETER, BODY, Covariance, FOOT, GYROSCOPE, POSITION, Present, TILT, VELOCITY,
};
use super::update::mirror;
use super::{Estimator, EstimatorState};
use crate::Real;
use crate::spatial::Quaternion;
use nalgebra::{Matrix3, Vector3};

/// `F` of (3), each block as far as it is no identity.
struct Transition<T> {
    h: T,
    /// `f`
    force: Vector3<T>,
    /// `−h R`
    bias: Matrix3<T>,
    /// `exp(h w)ᵀ`
    turn: Matrix3<T>,
}

impl<T: Real> Transition<T> {
    /// `X_v − h R ([f] X_θ + X_f)`, by columns.
    #[inline(always)]
    fn velocity(&self, v: &Matrix3<T>, tilt: &Matrix3<T>, bias: &Matrix3<T>) -> Matrix3<T> {
        let mut sum = *bias;
        for c in 0..3 {
            let column = self.force.cross(&tilt.column(c));
            for r in 0..3 {
                sum[(r, c)] += column[r];
            }
        }
        v + self.bias * sum
    }

    /// `exp(h w)ᵀ X_θ − h X_w`
    #[inline(always)]
    fn tilt(&self, tilt: &Matrix3<T>, bias: &Matrix3<T>) -> Matrix3<T> {
        self.turn * tilt - bias * self.h
    }

    /// `F X` of a column's three blocks that change.
    #[inline(always)]
    fn column(&self, x: &[Matrix3<T>; BODY]) -> [Matrix3<T>; 3] {
        let [r, v, t, f, w] = x;
        [r + v * self.h, self.velocity(v, t, f), self.tilt(t, w)]
    }

    /// The same of a row's, `X Fᵀ`, of an error that does not change itself.
    #[inline(always)]
    fn advance_row(&self, row: &mut [Matrix3<T>; BODY]) {
        let [r, v, t] =
            self.column(&row.each_ref().map(Matrix3::transpose)).map(|block| block.transpose());
        row[POSITION] = r;
        row[VELOCITY] = v;
        row[TILT] = t;
    }
}

/// The state and its covariance at the end of a tick with these mean samples, body axes.
#[inline(always)]
pub(super) fn predict<T: Real, const FEET: usize>(
    settings: &Estimator<T, FEET>,
    state: &mut EstimatorState<T, FEET>,
    present: &Present<FEET>,
    (accelerometer, gyroscope): (Vector3<T>, Vector3<T>),
) {
    let h = settings.period_s;
    // (1)
    let force = accelerometer - state.accelerometer_bias;
    let rate = gyroscope - state.gyroscope_bias;
    let rotation = state.orientation.to_matrix();
    let acceleration = rotation * force - Vector3::new(T::zero(), T::zero(), settings.gravity);
    // (2)
    state.position += state.velocity * h + acceleration * (h * h * T::of(0.5));
    state.velocity += acceleration * h;
    let turn = Quaternion::from_rotation_vector(rate * h);
    state.orientation = near_unit(state.orientation.product(turn));
    // (3)
    let f = Transition { h, force, bias: rotation * -h, turn: turn.conjugate().to_matrix() };
    body(&mut state.covariance, &f);
    for (rows, is_present) in state.covariance.feet.iter_mut().zip(present) {
        for part in 0..FOOT {
            if is_present[part] {
                f.advance_row(&mut rows.body[part]);
            }
        }
    }
    add_noise(settings, &mut state.covariance, present);
}

/// `F P Fᵀ` of the body's errors.
#[inline(always)]
fn body<T: Real, const FEET: usize>(p: &mut Covariance<T, FEET>, f: &Transition<T>) {
    // F P, of which only the columns are needed that reach the lower triangle.
    let [c0, c1, c2, c3, c4] = [
        p.column::<POSITION>().body,
        p.column::<VELOCITY>().body,
        p.column::<TILT>().body,
        p.column::<ACCELEROMETER>().body,
        p.column::<GYROSCOPE>().body,
    ];
    let [r0, v0, t0] = f.column(&c0);
    let [r1, v1, t1] = f.column(&c1);
    let (v2, t2) = (
        f.velocity(&c2[VELOCITY], &c2[TILT], &c2[ACCELEROMETER]),
        f.tilt(&c2[TILT], &c2[GYROSCOPE]),
    );
    let (v3, t3) = (
        f.velocity(&c3[VELOCITY], &c3[TILT], &c3[ACCELEROMETER]),
        f.tilt(&c3[TILT], &c3[GYROSCOPE]),
    );
    let t4 = f.tilt(&c4[TILT], &c4[GYROSCOPE]);
    // (F P) Fᵀ, rows of r, v, θ.
    let velocity = |v: &Matrix3<T>, t: &Matrix3<T>, b: &Matrix3<T>| {
        f.velocity(&v.transpose(), &t.transpose(), &b.transpose()).transpose()
    };
    let tilt = |t: &Matrix3<T>, w: &Matrix3<T>| f.tilt(&t.transpose(), &w.transpose()).transpose();
    p.body[POSITION][POSITION] = r0 + r1 * f.h;
    p.body[VELOCITY][POSITION] = v0 + v1 * f.h;
    p.body[VELOCITY][VELOCITY] = velocity(&v1, &v2, &v3);
    p.body[TILT][POSITION] = t0 + t1 * f.h;
    p.body[TILT][VELOCITY] = velocity(&t1, &t2, &t3);
    p.body[TILT][TILT] = tilt(&t2, &t4);
    mirror(&mut p.body[POSITION][POSITION]);
    mirror(&mut p.body[VELOCITY][VELOCITY]);
    mirror(&mut p.body[TILT][TILT]);
    // Rows of the biases, which do not change themselves.
    let mut row = p.body[ACCELEROMETER];
    row[GYROSCOPE] = p.body[GYROSCOPE][ACCELEROMETER].transpose();
    f.advance_row(&mut row);
    row[GYROSCOPE] = Matrix3::zeros();
    p.body[ACCELEROMETER] = row;
    f.advance_row(&mut p.body[GYROSCOPE]);
}

/// Variances that grow in a tick.
#[inline(always)]
fn add_noise<T: Real, const FEET: usize>(
    settings: &Estimator<T, FEET>,
    p: &mut Covariance<T, FEET>,
    present: &Present<FEET>,
) {
    let noise = &settings.noise;
    let variance = |deviation: T| deviation * deviation * settings.period_s;
    widen(&mut p.body[VELOCITY][VELOCITY], variance(noise.accelerometer));
    widen(&mut p.body[TILT][TILT], variance(noise.gyroscope));
    widen(&mut p.body[ACCELEROMETER][ACCELEROMETER], variance(noise.accelerometer_drift));
    widen(&mut p.body[GYROSCOPE][GYROSCOPE], variance(noise.gyroscope_drift));
    let [position_noise, tilt, heading] =
        [noise.foot_position, noise.foot_tilt, noise.foot_heading].map(variance);
    for (number, (rows, [position, orientation])) in p.feet.iter_mut().zip(present).enumerate() {
        if let Some([[a, _], [_, b]]) = rows.feet.get_mut(number) {
            if *position {
                widen(a, position_noise);
            }
            if *orientation {
                b.m11 += tilt;
                b.m22 += tilt;
                b.m33 += heading;
            }
        }
    }
}

/// `M + x I`.
#[inline(always)]
pub(super) fn widen<T: Real>(m: &mut Matrix3<T>, x: T) {
    m.m11 += x;
    m.m22 += x;
    m.m33 += x;
}

/// To unit norm, to first order in what it is off: enough from tick to tick.
#[inline(always)]
pub(super) fn near_unit<T: Real>(q: Quaternion<T>) -> Quaternion<T> {
    let scale = T::of(1.5) - T::of(0.5) * q.norm_squared();
    Quaternion { s: q.s * scale, v: q.v * scale }
}
