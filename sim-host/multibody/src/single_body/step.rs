//! The equations of a free body's step, and Newton's method for them.
//!
//! # Notation
//! `(c, v)` the turn over the step in the body's axes at its beginning, `I` the principal inertias, `d` the way of
//! the centre of mass, `π` and `λ` momentum and spin at the beginning, `R` the world from the body, `f` the floor's
//! forces, `ℓ⁻, ℓ⁺` their arms at the step's ends.
//! ```text
//! m d/h − π + ½h m g ẑ − ½h Σ f = 0                                                      (1)
//! 2/h (c I v + v × I v) − Rᵀ (λ + ½h Σ ℓ⁻ × f) = 0                                       (2.51), (2)
//! π ← π − h m g ẑ + h Σ f,   λ ← λ + ½h Σ (ℓ⁻ + ℓ⁺) × f
//! ```
//! Without forces (1) says what `d` is, and (2) is left, in body axes, where `I` is diagonal.

use super::super::scale::{Scale, away};
use super::super::stepping::{LEAST_TURN, StepEquations};
use super::checkpoint::{BodyCheckpoint, Move};
use super::simulation::SingleBody;
use crate::contact::{ContactPoint, StepForce};
use nalgebra::{Matrix3, Vector3};
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::Progress;

/// A point that can touch the floor.
#[derive(Clone, Debug)]
pub(super) struct Touch {
    /// In the body.
    pub arm: Vector3<f64>,
    /// From the centre of mass, at the beginning and at the trial's end, world axes.
    begin: Vector3<f64>,
    end: Vector3<f64>,
    force: StepForce,
}

impl Touch {
    pub fn new(position: [f64; 3]) -> Self {
        let (zero, point) = (Vector3::zeros(), ContactPoint::default());
        let force = StepForce { force: zero, slope: Matrix3::zeros(), point };
        Self { arm: position.into(), begin: zero, end: zero, force }
    }
}

/// A trial of a step's end, and what is known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial {
    pub by: Move,
    /// Scalar part of the turn.
    c: f64,
    /// Residuals of (1), world axes, and of (2), body axes.
    linear: Vector3<f64>,
    angular: Vector3<f64>,
    touches: bool,
}

impl Trial {
    pub const NONE: Self = {
        let zero = Vector3::new(0.0, 0.0, 0.0);
        Self { by: Move::NONE, c: 1.0, linear: zero, angular: zero, touches: false }
    };
}

/// How a trial answers to impulses: what finds corrections.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer {
    /// Inverse of the derivative of (2): alone, in the body's axes; with the floor's forces, of what (1) leaves of it,
    /// `(D − C A⁻¹ B)⁻¹`, in the world's axes.
    turn: Matrix3<f64>,
    /// None in flight.
    coupling: Option<Coupling>,
}

/// `A⁻¹`, `B`, `C A⁻¹` of the derivatives `[A B; C D]` of (1) and (2), world axes.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    a_inverse: Matrix3<f64>,
    b: Matrix3<f64>,
    c_a_inverse: Matrix3<f64>,
}

impl Answer {
    pub const NONE: Self =
        Self { turn: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), coupling: None };
}

fn skew(r: &Vector3<f64>) -> Matrix3<f64> {
    r.cross_matrix()
}

impl SingleBody {
    /// Derivative of (2) without forces, for more turn at the step's end.
    fn turning(&self, h: f64) -> Matrix3<f64> {
        // As in space: ∂L/∂φ = 1/h [(c I − (I v)^ + v̂ I) (c 1 − v̂) − (I v) vᵀ].
        let Trial { by: Move { turn: v, .. }, c, .. } = &self.trial;
        let iv = self.inertia.component_mul(v);
        let v_hat = skew(v);
        let inertia = Matrix3::from_diagonal(&self.inertia);
        let left = inertia * *c - skew(&iv) + v_hat * inertia;
        let n = Matrix3::from_diagonal_element(*c) - v_hat;
        (left * n - iv * v.transpose()) / h
    }

    /// None where it is singular.
    fn answer(&self, h: f64) -> Option<Answer> {
        let turning = self.turning(h);
        if !self.trial.touches {
            return turning.try_inverse().map(|turn| Answer { turn, coupling: None });
        }
        let mut a = Matrix3::from_diagonal_element(self.mass / h);
        let (mut b, mut c) = (Matrix3::zeros(), Matrix3::zeros());
        let mut d = self.rotation * turning * self.rotation.transpose();
        for touch in &self.touches {
            if touch.force.slope == Matrix3::zeros() {
                continue;
            }
            let k = touch.force.slope * (-0.5 * h);
            let (by_turn, begin) = (k * skew(&touch.end), skew(&touch.begin));
            a += k;
            b -= by_turn;
            c += begin * k;
            d -= begin * by_turn;
        }
        let a_inverse = a.try_inverse()?;
        let c_a_inverse = c * a_inverse;
        let turn = (d - c_a_inverse * b).try_inverse()?;
        Some(Answer { turn, coupling: Some(Coupling { a_inverse, b, c_a_inverse }) })
    }

    /// Forces of the floor at the trial, with their impulses in the residuals.
    fn meet_floor(&mut self, h: f64) {
        let Some((floor, switching)) = self.system.ground() else { return };
        let Trial { by, c, .. } = self.trial;
        let v = self.rotation * by.turn;
        let mut moment = Vector3::zeros();
        for (touch, memory) in self.touches.iter_mut().zip(&self.at.memories) {
            let across = v.cross(&touch.begin);
            let moved = (across * c + v.cross(&across)) * 2.0;
            touch.end = touch.begin + moved;
            let p = self.at.center + touch.begin;
            touch.force = memory.over_step(floor, *switching, p, by.way + moved, h);
            if touch.force.force.z != 0.0 {
                self.trial.touches = true;
                let half = touch.force.force * (0.5 * h);
                self.trial.linear -= half;
                moment += touch.begin.cross(&half);
            }
        }
        if self.trial.touches {
            self.trial.angular -= self.rotation.tr_mul(&moment);
        }
    }
}

impl SingleBody {
    /// (2) and (3) of [`crate::scale`] where a step begins.
    fn scale(&self, h: f64) -> Scale {
        let weight = 0.5 * h * self.system.gravity();
        let motion = self.spin_in_body.dot(&self.omega()) + self.mass * weight * weight;
        Scale { motion, terms: self.at.momentum.norm_squared() / self.mass }
    }

    /// What the floor adds to (3) at a trial.
    fn felt(&self, h: f64) -> f64 {
        let center = away(&self.at.center);
        let mut sum = 0.0;
        for touch in &self.touches {
            let force = touch.force.terms(center + away(&touch.begin));
            sum += force * force;
        }
        sum * (0.25 * h * h / self.mass)
    }
}

impl StepEquations for SingleBody {
    fn progress(&self) -> &Progress {
        &self.at.progress
    }

    fn progress_mut(&mut self) -> &mut Progress {
        &mut self.at.progress
    }

    fn save(&mut self) {
        self.saved.copy_from(&self.at);
    }

    fn go_back(&mut self) {
        self.at.copy_from(&self.saved);
        self.find_place();
    }

    fn begin(&mut self, h: f64) {
        let [last, before] = &self.at.last;
        self.trial.by = last.beyond(before, h / self.at.last_h);
        if self.system.ground().is_none() {
            let weight = Vector3::z() * (0.5 * h * self.mass * self.system.gravity());
            self.trial.by.way = (self.at.momentum - weight) * (h / self.mass);
        }
        for touch in &mut self.touches {
            touch.begin = self.rotation * touch.arm;
        }
        self.scale = self.scale(h);
    }

    fn evaluate(&mut self, h: f64) -> f64 {
        let Move { way, turn: v } = self.trial.by;
        let c = (1.0 - v.norm_squared()).max(0.0).sqrt();
        let velocity = way / h;
        let mut linear = velocity * self.mass - self.at.momentum;
        linear.z += 0.5 * h * self.mass * self.system.gravity();
        let iv = self.inertia.component_mul(&v);
        let angular = (iv * c + v.cross(&iv)) * (2.0 / h) - self.spin_in_body;
        self.trial = Trial { by: self.trial.by, c, linear, angular, touches: false };
        self.meet_floor(h);
        let Trial { linear, angular, .. } = &self.trial;
        let residual = linear.norm_squared() / self.mass
            + angular.dot(&angular.component_mul(&self.turn_weights));
        let mut scale = self.scale;
        if self.trial.touches {
            scale.terms += self.felt(h);
        }
        scale.relative(residual)
    }

    fn correct(&mut self, anew: bool, h: f64) -> Result<(), usize> {
        if anew {
            self.answer = self.answer(h).ok_or(0_usize)?;
        }
        let Trial { linear, angular, .. } = &self.trial;
        let inverse = &self.answer.turn;
        self.correction = match &self.answer.coupling {
            None => Move { way: linear * (-h / self.mass), turn: inverse * -angular },
            Some(Coupling { a_inverse, b, c_a_inverse }) => {
                let turn = inverse * (c_a_inverse * linear - self.rotation * angular);
                let way = -(a_inverse * (linear + b * turn));
                Move { way, turn: self.rotation.tr_mul(&turn) }
            }
        };
        self.base = self.trial;
        Ok(())
    }

    fn take(&mut self, share: f64) {
        let (base, by) = (&self.base.by, &self.correction);
        // (1, u)/√(1 + |u|²) after the base.
        let u = by.turn * (0.5 * share);
        let scale = 1.0 / (1.0 + u.norm_squared()).sqrt();
        let turn = (base.turn + u * self.base.c + u.cross(&base.turn)) * scale;
        self.trial.by = Move { way: base.way + by.way * share, turn };
    }

    fn is_folded(&self) -> bool {
        self.trial.c < LEAST_TURN
    }

    fn accept(&mut self, h: f64) {
        let Trial { by, c, .. } = self.trial;
        let mut impulse = Vector3::new(0.0, 0.0, -self.mass * self.system.gravity());
        let BodyCheckpoint { memories, forces, spin, .. } = &mut self.at;
        for ((touch, memory), felt) in self.touches.iter().zip(memories).zip(forces) {
            *memory = touch.force.point;
            let force = &touch.force.force;
            *felt = (*force).into();
            if force.z != 0.0 {
                impulse += force;
                *spin += (touch.begin + touch.end).cross(force) * (0.5 * h);
            }
        }
        self.at.momentum += impulse * h;
        self.at.center += by.way;
        let turned =
            Quaternion::from_array(self.at.orientation).product(Quaternion { s: c, v: by.turn });
        let [s, i, j, k] = turned.to_array();
        let scale = 1.0 / turned.norm_squared().sqrt();
        self.at.orientation = [s * scale, i * scale, j * scale, k * scale];
        let ratio = h / self.at.last_h;
        let before = self.at.last[0];
        self.at.last = [by, if ratio == 1.0 { before } else { before.scaled(ratio) }];
        self.at.last_h = h;
        self.find_place();
    }
}
