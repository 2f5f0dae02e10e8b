//! Semi-implicit Euler: velocities first, then positions along the new velocities. First order, one
//! evaluation a step, symplectic for natural systems without constraints; most simulators' method.

use super::{Integrator, Progress, StepError};
use crate::newton::NewtonFailure;
use crate::{Lagrangian, Scalar, acceleration};

/// A motion under semi-implicit Euler.
#[derive(Clone, Debug)]
pub struct SemiImplicitEuler<S, const N: usize, const C: usize, const U: usize, D = f64> {
    system: S,
    x: [D; N],
    v: [D; N],
    progress: Progress,
}

impl<S: Lagrangian<N, C>, D: Scalar, const N: usize, const C: usize, const U: usize>
    SemiImplicitEuler<S, N, C, U, D>
{
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [D; N], v_dot: [D; N]) -> Self {
        Self { system, x, v: v_dot, progress: Progress::new(h) }
    }
}

impl<S: Lagrangian<N, C>, D: Scalar, const N: usize, const C: usize, const U: usize>
    Integrator<N, D> for SemiImplicitEuler<S, N, C, U, D>
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, x, v, progress } = &*self;
        let h = progress.h;
        let a = acceleration::<_, D, N, C, U>(system, x, v)
            .map_err(|failure| progress.error(failure))?;
        let v: [D; N] = std::array::from_fn(|i| v[i] + a[i] * h);
        let x: [D; N] = std::array::from_fn(|i| x[i] + v[i] * h);
        if !x.iter().chain(&v).all(|x| x.re().is_finite()) {
            return Err(progress.error(NewtonFailure::NotFinite));
        }
        (self.x, self.v) = (x, v);
        self.progress.evaluated(1);
        self.progress.advance();
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        &self.x
    }

    fn velocity(&self) -> Result<[D; N], StepError> {
        Ok(self.v)
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}
