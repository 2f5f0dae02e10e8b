//! A variational method on the group of rotations itself (discrete Euler–Poincaré equations with the
//! Cayley map; Bou-Rabee and Marsden 2009): three unknowns, no constraint, no multiplier.
//!
//! # Notation
//! `ξ`: body angular velocity of a step; `Π`: body angular momentum; `I`: inertia
//!
//! ```text
//! (I + h/2 ξ̂ I + h²/4 ξ ξᵀ I) ξ = Π                                      (1)
//! Π := (I − h/2 ξ̂ I + h²/4 ξ ξᵀ I) ξ,   q := q ⋆ (1, h ξ/2)/|(1, h ξ/2)|  (2)
//! ```
//! (2) turns `Π` back by the step's rotation, so that `R Π` is constant.

use super::branch::on_branch_of_short_steps;
use super::{Integrator, Progress, StepError, scale};
use crate::newton::{Evaluation, solve};
use crate::systems::FreeRigidBody;
use crate::{Scalar, jacobian};
use num_dual::Dual;

/// A free body's motion on the group of rotations.
#[derive(Clone, Debug)]
pub struct LieGroup<D = f64> {
    body: FreeRigidBody,
    q: [D; 4],
    momentum: [D; 3],
    xi: [D; 3],
    progress: Progress,
}

impl<D: Scalar> LieGroup<D> {
    /// From a unit quaternion, and its rate.
    pub fn new(body: FreeRigidBody, h: f64, q: [D; 4], q_dot: &[D; 4]) -> Self {
        let xi = FreeRigidBody::angular_velocity(&q, q_dot);
        let momentum = std::array::from_fn(|i| xi[i] * body.inertia[i]);
        Self { body, q, momentum, xi, progress: Progress::new(h) }
    }

    fn angular_velocity(&self) -> [D; 3] {
        std::array::from_fn(|i| self.momentum[i] / self.body.inertia[i])
    }
}

/// The momentum at a step's beginning, for `h`, and at its end, for `−h`: (1), (2).
fn momentum<D: Scalar>(inertia: &[f64; 3], xi: &[D; 3], h: f64) -> [D; 3] {
    let i_xi: [D; 3] = std::array::from_fn(|i| xi[i] * inertia[i]);
    let twice_energy: D = (0..3).map(|i| xi[i] * i_xi[i]).sum();
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let cross = xi[j] * i_xi[k] - xi[k] * i_xi[j];
        i_xi[i] + cross * (0.5 * h) + xi[i] * twice_energy * (0.25 * h * h)
    })
}

impl<D: Scalar> Integrator<4, D> for LieGroup<D> {
    fn step(&mut self) -> Result<(), StepError> {
        let Self { body, momentum: wanted, xi, progress, .. } = &*self;
        let h = progress.h;
        let root = solve(*xi, &[scale::largest(wanted); 3], |xi: &[D; 3]| {
            let (values, jacobian) =
                jacobian(xi, |xi: &[Dual<D>; 3]| momentum(&body.inertia, xi, h));
            let residual = std::array::from_fn(|i| values[i] - wanted[i]);
            Evaluation { residual, jacobian, known: () }
        })
        .map_err(|failure| progress.error(failure))?;
        on_branch_of_short_steps(&root.at.jacobian).map_err(|failure| progress.error(failure))?;
        self.momentum = momentum(&body.inertia, &root.x, -h);
        self.xi = root.x;
        self.q = FreeRigidBody::turned(&self.q, &self.xi.map(|rate| rate * h));
        self.progress.solved(&root);
        self.progress.advance();
        Ok(())
    }

    fn configuration(&self) -> &[D; 4] {
        &self.q
    }

    fn velocity(&self) -> Result<[D; 4], StepError> {
        Ok(FreeRigidBody::rate(&self.q, &self.angular_velocity()))
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}
