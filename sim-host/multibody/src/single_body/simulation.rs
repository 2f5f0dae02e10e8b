//! A free body's motion: what it is made of, and what can be asked of it.

use super::super::body::BodyState;
use super::super::joint::JointConstraint;
use super::super::scale::{Scale, not_too_thin};
use super::super::stepping::make_step;
use super::super::system::System;
use super::super::system_error::SystemError;
use super::checkpoint::{BodyCheckpoint, Move};
use super::step::{Answer, Touch, Trial};
use crate::contact::ContactPoint;
use nalgebra::{Matrix3, Vector3};
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::{Progress, StepError};

/// Why a system is no single free body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotSingle {
    /// There are others, or none.
    #[error("there are {links} links")]
    Links {
        /// How many.
        links: usize,
    },
    /// It hangs on something.
    #[error("the only link is held by a joint")]
    Held,
    /// Something holds it from elsewhere.
    #[error("a loop holds the only link")]
    Loop,
    /// Trees alone stand on slopes.
    #[error("its floor is not level")]
    Terrain,
}

/// Why there is no motion of a single free body.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SingleBodyError {
    /// It is no system, or no start of it.
    #[error(transparent)]
    System(#[from] SystemError),
    /// It is no single free body.
    #[error(transparent)]
    NotSingle(#[from] NotSingle),
}

/// A motion of one free body.
#[derive(Clone, Debug)]
pub struct SingleBody {
    pub(super) system: System,
    pub(super) mass: f64,
    /// Principal, body axes.
    pub(super) inertia: Vector3<f64>,
    /// `1/I`, about no axis thinner than residuals are measured by.
    pub(super) turn_weights: Vector3<f64>,
    /// Of the step that is being made, without what its trials touch.
    pub(super) scale: Scale,
    /// Where it is, and where it was when the step began that is being made.
    pub(super) at: BodyCheckpoint,
    pub(super) saved: BodyCheckpoint,
    /// World from body.
    pub(super) rotation: Matrix3<f64>,
    /// `Rᵀ π` of the spin.
    pub(super) spin_in_body: Vector3<f64>,
    pub(super) touches: Vec<Touch>,
    pub(super) trial: Trial,
    pub(super) base: Trial,
    pub(super) correction: Move,
    pub(super) answer: Answer,
}

impl SingleBody {
    /// From a state and its rates, as [`super::super::Simulation::new`] takes them.
    ///
    /// # Errors
    /// A [`SingleBodyError`]: also where there is more than a free body, with what there is.
    pub fn new(
        system: System,
        h: f64,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Result<Self, SingleBodyError> {
        if !(h > 0.0 && h.is_finite()) {
            return Err(SystemError::Step { h }.into());
        }
        system.check_start(states, rates)?;
        let ([link], [x], [v]) = (system.links(), states, rates) else {
            return Err(NotSingle::Links { links: system.links().len() }.into());
        };
        if link.joint.constraint != JointConstraint::Floating {
            return Err(NotSingle::Held.into());
        }
        // A striker strikes another link, of which there is none.
        if !system.closures().is_empty() {
            return Err(NotSingle::Loop.into());
        }
        if !system.terrain().is_empty() {
            return Err(NotSingle::Terrain.into());
        }
        let (mass, inertia) = (link.body.mass, Vector3::from(link.body.inertia));
        let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let rate = Quaternion::from_array([v[3], v[4], v[5], v[6]]);
        // ω = 2 q̄ ⋆ q̇, in the body.
        let omega = q.conjugate().product(rate).v * 2.0;
        let velocity = Vector3::new(v[0], v[1], v[2]);
        let first = Move { way: velocity * h, turn: omega * (0.5 * h) };
        let at = BodyCheckpoint {
            center: Vector3::new(x[0], x[1], x[2]),
            orientation: q.to_array(),
            momentum: velocity * mass,
            spin: q.rotate(inertia.component_mul(&omega)),
            last: [first; 2],
            last_h: h,
            memories: vec![ContactPoint::default(); system.sites().len()],
            forces: vec![[0.0; 3]; system.sites().len()],
            progress: Progress::new(h),
        };
        let touches = system.sites().iter().map(|site| Touch::new(site.position)).collect();
        let mut body = Self {
            mass,
            inertia,
            turn_weights: inertia.map(|moment| 1.0 / not_too_thin(moment, inertia.max())),
            scale: Scale::default(),
            saved: at.clone(),
            at,
            rotation: Matrix3::identity(),
            spin_in_body: Vector3::zeros(),
            touches,
            trial: Trial::NONE,
            base: Trial::NONE,
            correction: Move::NONE,
            answer: Answer::NONE,
            system,
        };
        body.find_place();
        Ok(body)
    }

    /// One step. Where its equations have no solution nearby it is made in 2, 4, … 64 shorter ones.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    ///
    /// # Cost
    /// Three unknowns a Newton iteration in flight, six where a point touches; no allocation.
    pub fn step(&mut self) -> Result<(), StepError> {
        make_step(self)
    }

    /// The same motion from here on, in steps of another length, as of time zero.
    #[must_use]
    pub fn in_steps_of(&self, h: f64) -> Self {
        let mut other = self.clone();
        other.at.progress = Progress::new(h);
        other
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Time and statistics.
    pub fn progress(&self) -> &Progress {
        &self.at.progress
    }

    /// What Newton's method solves for: where there is no floor the way is known beforehand.
    pub fn unknowns(&self) -> usize {
        if self.system.ground().is_some() { 6 } else { 3 }
    }

    /// All that is needed to go on from here.
    pub fn checkpoint(&self) -> &BodyCheckpoint {
        &self.at
    }

    /// Goes on from a checkpoint of the same system and step.
    ///
    /// # Errors
    /// [`SystemError::OtherCheckpoint`].
    pub fn restore(&mut self, checkpoint: &BodyCheckpoint) -> Result<(), SystemError> {
        let fits = checkpoint.memories.len() == self.at.memories.len()
            && checkpoint.forces.len() == self.at.forces.len()
            && checkpoint.progress.h == self.at.progress.h;
        if !fits {
            return Err(SystemError::OtherCheckpoint);
        }
        self.at.copy_from(checkpoint);
        self.find_place();
        Ok(())
    }

    /// Memories of the contact sites, in the system's order.
    pub fn contacts(&self) -> &[ContactPoint] {
        &self.at.memories
    }

    /// Mean forces on the contact sites in the last step, N, world frame.
    pub fn contact_forces(&self) -> &[[f64; 3]] {
        &self.at.forces
    }

    /// The body's state.
    pub fn state(&self) -> BodyState {
        let (x, [s, i, j, k]) = (&self.at.center, self.at.orientation);
        [x.x, x.y, x.z, s, i, j, k]
    }

    /// The rates that belong to its momentum.
    pub fn rate(&self) -> BodyState {
        let v = self.at.momentum / self.mass;
        let q = Quaternion::from_array(self.at.orientation).rate(self.omega()).to_array();
        [v.x, v.y, v.z, q[0], q[1], q[2], q[3]]
    }

    /// Angular velocity, body axes.
    pub(super) fn omega(&self) -> Vector3<f64> {
        self.spin_in_body.component_div(&self.inertia)
    }

    /// Kinetic energy, and potential energy of gravity and of the floor's springs, J.
    pub fn energies(&self) -> (f64, f64) {
        let BodyCheckpoint { momentum, center, memories, .. } = &self.at;
        let moving = momentum.norm_squared() / self.mass + self.spin_in_body.dot(&self.omega());
        let weight = self.mass * self.system.gravity() * center.z;
        let in_floor: f64 = self.system.ground().map_or(0.0, |(floor, _)| {
            let each = self.touches.iter().zip(memories);
            each.map(|(touch, memory)| {
                memory.spring_energy(floor, &(center + self.rotation * touch.arm))
            })
            .sum()
        });
        (0.5 * moving, weight + in_floor)
    }

    pub(super) fn find_place(&mut self) {
        self.rotation = Quaternion::from_array(self.at.orientation).to_matrix();
        self.spin_in_body = self.rotation.tr_mul(&self.at.spin);
    }
}
