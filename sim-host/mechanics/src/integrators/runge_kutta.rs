//! The classical Runge–Kutta method of fourth order on the differential equations, the usual
//! alternative: constraints differentiated twice, and so left to drift unless projected back.

use super::projection::projected;
use super::{Integrator, Progress, StepError};
use crate::newton::NewtonFailure;
use crate::{Lagrangian, Scalar, acceleration};

/// A motion under the Runge–Kutta method.
#[derive(Clone, Debug)]
pub struct RungeKutta<S, const N: usize, const C: usize, const U: usize, D = f64> {
    system: S,
    projects: bool,
    x: [D; N],
    v: [D; N],
    progress: Progress,
}

impl<S: Lagrangian<N, C>, D: Scalar, const N: usize, const C: usize, const U: usize>
    RungeKutta<S, N, C, U, D>
{
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [D; N], v_dot: [D; N]) -> Self {
        Self { system, projects: false, x, v: v_dot, progress: Progress::new(h) }
    }

    /// The same with configuration and velocity projected onto the constraints after each step.
    pub fn projected(system: S, h: f64, x: [D; N], v_dot: [D; N]) -> Self {
        Self { projects: true, ..Self::new(system, h, x, v_dot) }
    }
}

impl<S: Lagrangian<N, C>, D: Scalar, const N: usize, const C: usize, const U: usize>
    Integrator<N, D> for RungeKutta<S, N, C, U, D>
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, projects, x, v, progress } = &*self;
        let h = progress.h;
        let moved = |a: &[D; N], b: &[D; N], share: f64| -> [D; N] {
            std::array::from_fn(|i| a[i] + b[i] * (share * h))
        };
        let rate = |x: &[D; N], v: &[D; N]| {
            acceleration::<_, D, N, C, U>(system, x, v).map_err(|failure| progress.error(failure))
        };
        let (v1, a1) = (*v, rate(x, v)?);
        let v2 = moved(v, &a1, 0.5);
        let a2 = rate(&moved(x, &v1, 0.5), &v2)?;
        let v3 = moved(v, &a2, 0.5);
        let a3 = rate(&moved(x, &v2, 0.5), &v3)?;
        let v4 = moved(v, &a3, 1.0);
        let a4 = rate(&moved(x, &v3, 1.0), &v4)?;
        let mean = |[a, b, c, d]: [&[D; N]; 4]| -> [D; N] {
            std::array::from_fn(|i| (a[i] + (b[i] + c[i]) * 2.0 + d[i]) * (1.0 / 6.0))
        };
        let mut x = moved(x, &mean([&v1, &v2, &v3, &v4]), 1.0);
        let mut v = moved(v, &mean([&a1, &a2, &a3, &a4]), 1.0);
        if !x.iter().chain(&v).all(|x| x.re().is_finite()) {
            return Err(progress.error(NewtonFailure::NotFinite));
        }
        let mut after = *progress;
        after.evaluated(4);
        if *projects {
            (x, v) = projected::<_, D, N, C, U>(system, x, v, &mut after)?;
        }
        after.advance();
        (self.x, self.v, self.progress) = (x, v, after);
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
