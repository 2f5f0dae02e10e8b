//! States along an accurate motion, from which a forecast makes single steps.

use super::local::oscillation;
use crate::Lagrangian;
use crate::integrators::{Method, Motion, StartError};

/// States along a motion, evenly spaced in time, and what they say about it.
#[derive(Clone, Debug)]
pub struct Course<const N: usize> {
    /// Configurations and velocities.
    pub states: Vec<([f64; N], [f64; N])>,
    /// Time between them, s.
    pub spacing_s: f64,
    /// `Ω`: how fast the motion oscillates at most, the square root of the norm of `∂a/∂x` along the
    /// manifold, 1/s.
    pub oscillation: f64,
    /// Largest kinetic energy, J.
    pub kinetic_j: f64,
}

/// States kept of a motion.
const STATES: usize = 600;
/// Steps between them.
const STEPS: usize = 20;

impl<const N: usize> Course<N> {
    /// Along the projected Runge–Kutta method in short steps, as far as it can be followed. `start` begins
    /// a motion with a method and a step. `U` is `N + C`.
    ///
    /// # Cost
    /// 12 000 short steps.
    pub fn along<S, const C: usize, const U: usize>(
        system: &S,
        x: [f64; N],
        v: [f64; N],
        duration_s: f64,
        start: impl Fn(Method, f64, [f64; N], [f64; N]) -> Result<Motion<N>, StartError>,
    ) -> Self
    where
        S: Lagrangian<N, C>,
    {
        let spacing_s = duration_s / STATES as f64;
        let mut course = Self {
            states: Vec::with_capacity(STATES),
            spacing_s,
            oscillation: 0.0,
            kinetic_j: 0.0,
        };
        let h = spacing_s / STEPS as f64;
        let Ok(mut motion) = start(Method::RungeKutta4Projected, h, x, v) else { return course };
        for _ in 0..STATES {
            let x = *motion.configuration();
            let Ok(v) = motion.velocity() else { break };
            let (inertia, _) = system.inertia_and_force(&x, &v);
            let still = inertia
                .iter()
                .zip(&v)
                .map(|(row, vi)| vi * row.iter().zip(&v).map(|(m, vj)| m * vj).sum::<f64>());
            course.kinetic_j = course.kinetic_j.max(0.5 * still.sum::<f64>());
            let here = oscillation::<S, N, C, U>(system, &x, &inertia);
            course.oscillation = course.oscillation.max(here);
            course.states.push((x, v));
            if (0..STEPS).any(|_| motion.step().is_err()) {
                break;
            }
        }
        course
    }
}
