//! What step a method will bear, said before the run.
//!
//! # Notation
//! - `κ`: how fast constraints bend the motion, `|a_n|/|v|` with `a_n` the part of the acceleration
//!   that is quadratic in velocities and normal to the manifold; for a rod its angular velocity, for
//!   a unit quaternion half of it
//! - `Ω`: how fast the motion oscillates, the square root of the norm of `∂a/∂x` along the manifold
//! - both at their largest along an accurate motion
//!
//! Constraint forces along `Dgᵀ(x)` can bring the end of a step back to the manifold only while
//! `κ h ≤ 1`; the explicit methods are stable for an oscillation only while `Ω h ≤ 2`.

use crate::integrators::{DormandPrince, Integrator, Method};
use crate::mechanics::{Lagrangian, acceleration, bend, jacobian, saddle};
use crate::newton::solve_linear;
use num_dual::Dual64;
use serde::Serialize;

/// How fast a motion is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Rates {
    /// `κ`, 1/s.
    pub bend: f64,
    /// `Ω`, 1/s.
    pub oscillation: f64,
    /// Largest kinetic energy, J.
    pub kinetic_j: f64,
}

/// Samples of the accurate motion.
const SAMPLES: usize = 600;
/// Its tolerance.
const TOLERANCE: f64 = 1e-8;

impl Rates {
    /// The largest along a motion of some seconds, as far as it can be followed.
    pub fn along_motion<S, const N: usize, const C: usize, const U: usize>(
        system: &S,
        x: [f64; N],
        v: [f64; N],
        duration_s: f64,
    ) -> Self
    where
        S: Lagrangian<N, C> + Clone,
    {
        let h = duration_s / SAMPLES as f64;
        let mut motion = DormandPrince::<_, N, C, U>::new(system.clone(), TOLERANCE, h, x, v);
        let mut all = Self::default();
        for _ in 0..SAMPLES {
            if let Ok(v) = motion.velocity() {
                let here = Self::at::<S, N, C, U>(system, motion.configuration(), &v);
                all.bend = all.bend.max(here.bend);
                all.oscillation = all.oscillation.max(here.oscillation);
                all.kinetic_j = all.kinetic_j.max(here.kinetic_j);
            }
            if motion.step().is_err() {
                break;
            }
        }
        all
    }

    fn at<S, const N: usize, const C: usize, const U: usize>(
        system: &S,
        x: &[f64; N],
        v: &[f64; N],
    ) -> Self
    where
        S: Lagrangian<N, C>,
    {
        let norm = |a: &[f64]| a.iter().map(|a| a * a).sum::<f64>().sqrt();
        let (inertia, _) = system.inertia_and_force(x, v);
        let (_, g) = jacobian(x, |q| system.constraints(q));
        let turn = bend(x, v, |q| system.constraints(q));
        let right = std::array::from_fn(|i| if i < N { 0.0 } else { -turn[i - N] });
        let normal = solve_linear::<f64, U>(saddle(&inertia, &g, -1.0, &g, 1.0), right);
        let bend = normal.map_or(0.0, |a| norm(&a[..N]) / norm(v).max(f64::MIN_POSITIVE));
        let still = inertia
            .iter()
            .zip(v)
            .map(|(row, vi)| vi * row.iter().zip(v).map(|(m, vj)| m * vj).sum::<f64>());
        Self {
            bend: if C == 0 { 0.0 } else { bend },
            oscillation: oscillation::<S, N, C, U>(system, x, &inertia, &g),
            kinetic_j: 0.5 * still.sum::<f64>(),
        }
    }
}

/// `Ω` by power iteration on `−∂a/∂x` at rest, kept along the manifold.
fn oscillation<S, const N: usize, const C: usize, const U: usize>(
    system: &S,
    x: &[f64; N],
    inertia: &[[f64; N]; N],
    g: &[[f64; N]; C],
) -> f64
where
    S: Lagrangian<N, C>,
{
    const ITERATIONS: usize = 30;
    let matrix = saddle::<f64, N, C, U>(inertia, g, -1.0, g, 1.0);
    let along = |direction: [f64; N]| -> Option<[f64; N]> {
        let pulled: [f64; N] =
            std::array::from_fn(|i| (0..N).map(|j| inertia[i][j] * direction[j]).sum());
        let right = std::array::from_fn(|i| if i < N { pulled[i] } else { 0.0 });
        let solved = solve_linear::<f64, U>(matrix, right).ok()?;
        Some(std::array::from_fn(|i| solved[i]))
    };
    let still = [Dual64::from_re(0.0); N];
    let mut direction: [f64; N] = std::array::from_fn(|i| 1.0 + 0.3 * (i as f64).sin());
    let mut growth = 0.0;
    for _ in 0..ITERATIONS {
        let Some(kept) = along(direction) else { return 0.0 };
        let norm = kept.iter().map(|d| d * d).sum::<f64>().sqrt();
        if !(norm > f64::MIN_POSITIVE) {
            return 0.0;
        }
        let unit = kept.map(|d| d / norm);
        let moving = std::array::from_fn(|i| Dual64::new(x[i], unit[i]));
        let Ok(a) = acceleration::<_, Dual64, N, C, U>(system, &moving, &still) else { return 0.0 };
        direction = a.map(|a| a.eps);
        growth = direction.iter().map(|d| d * d).sum::<f64>().sqrt();
    }
    growth.sqrt()
}

/// The step up to which a method should work for half a minute; `None` where nothing limits it but
/// accuracy, or no step does.
///
/// Each method's share of `1/κ` and of `2/Ω` is calibrated on the problems of this module; what it is
/// worth on others, a test measures.
pub fn forecast(method: Method, rates: &Rates) -> Option<f64> {
    let (bend, oscillation) = match method {
        Method::Variational => (0.47, 0.5),
        Method::VariationalEndpoint
        | Method::Verlet
        | Method::Shake
        | Method::VelocityShake
        | Method::Rattle => (0.47, 0.46),
        Method::Yoshida4 => (0.27, 0.36),
        Method::Yoshida6 => (0.37, 0.48),
        Method::LieGroup => (0.95, f64::INFINITY),
        Method::ImplicitMidpoint => (0.65, 0.5),
        Method::EnergyMomentum => (1.2, 0.54),
        // Constraints drift too far at any step of use.
        Method::SemiImplicitEuler if rates.bend > 0.0 => return None,
        Method::SemiImplicitEuler => (0.0, 0.155),
        Method::RungeKutta4 => (0.085, 0.25),
        Method::RungeKutta4Projected => (0.6, 0.25),
        Method::DormandPrince8 => return None,
    };
    let limits = [(bend, rates.bend), (2.0 * oscillation, rates.oscillation)];
    let shortest = limits
        .into_iter()
        .filter(|(_, rate)| *rate > 0.0)
        .fold(f64::INFINITY, |m: f64, (share, rate)| m.min(share / rate));
    shortest.is_finite().then_some(shortest)
}
