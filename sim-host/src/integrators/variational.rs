//! The discrete Euler–Lagrange equations with constraints (2.27).
//!
//! # Notation
//! - `w, x, y` = `v_{k−1}, v_k, v_{k+1}`; `d = (y − x)/h`; `G = Dg(x)`
//! - `p⁻ = −h D₂𝕃`, `p⁺ = h D₁𝕃`: the discrete momenta of a step at its beginning and its end
//! - unknowns `(d, μ)`, `U = N + C` of them, with `μ = −h λ/h` of (2.27) scaled as a force
//!
//! ```text
//! p⁻(x, d) = p + h Gᵀ μ,   g(x + h d) = 0                             (1) = −h (2.27)
//! p := p⁺(x, d)
//! ```
//! With `p = p⁺` of the step before, (1) is the two-step form. That `p` is also the momentum of the
//! equivalent one-step form, so that a motion may begin from two configurations or from one with its
//! momentum. Writing (1) in `d` instead of `y` keeps the digits that `y − x` would lose.

use super::{StepError, StepFailure};
use crate::mechanics::{DiscreteLagrangian, Momenta, jacobian, momenta};
use crate::newton::{Factors, solve};

/// A motion under the discrete Euler–Lagrange equations.
#[derive(Clone, Debug)]
pub struct Variational<S, const N: usize, const C: usize, const U: usize> {
    system: S,
    h: f64,
    x: [f64; N],
    d: [f64; N],
    /// `p⁺` of the last step.
    p: [f64; N],
    mu: [f64; C],
    time: f64,
    steps: u64,
    iterations: u64,
}

impl<S, const N: usize, const C: usize, const U: usize> Variational<S, N, C, U>
where
    S: DiscreteLagrangian<N, C>,
{
    /// From two configurations a step apart, both on the manifold. The motion is then at the first,
    /// about to make the step to the second.
    pub fn from_two(system: S, h: f64, first: [f64; N], second: [f64; N]) -> Self {
        let d = std::array::from_fn(|i| (second[i] - first[i]) / h);
        let p = momenta(&system, &first, &d, h).begin;
        Self::from_momentum(system, h, first, p, d)
    }

    /// From a configuration on the manifold, its momentum, and a guess of its velocity.
    pub fn from_momentum(system: S, h: f64, x: [f64; N], p: [f64; N], velocity: [f64; N]) -> Self {
        const { assert!(U == N + C, "unknowns are coordinates and multipliers") }
        Self { system, h, x, d: velocity, p, mu: [0.0; C], time: 0.0, steps: 0, iterations: 0 }
    }

    /// From a configuration on the manifold and its velocity, without spoiling the order.
    pub fn from_velocity(system: S, h: f64, x: [f64; N], v_dot: [f64; N]) -> Self {
        let p = system.start(&x, &v_dot, h);
        Self::from_momentum(system, h, x, p, v_dot)
    }

    /// The configuration.
    pub fn configuration(&self) -> &[f64; N] {
        &self.x
    }

    /// The momentum `p⁺` there.
    pub fn momentum(&self) -> &[f64; N] {
        &self.p
    }

    /// Constraint forces' multipliers in the last step, `λ` of (2.30).
    pub fn multipliers(&self) -> &[f64; C] {
        &self.mu
    }

    /// Newton iterations a step, on average.
    pub fn mean_iterations(&self) -> f64 {
        self.iterations as f64 / self.steps.max(1) as f64
    }

    /// One step, looked for where the last one leads.
    ///
    /// # Returns
    /// Its mean velocity `d`.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    pub fn step(&mut self) -> Result<[f64; N], StepError> {
        self.step_by(self.h)
    }

    /// The same for a step of another length, which may be negative: the one-step form allows it.
    ///
    /// # Errors
    /// As before.
    pub fn step_by(&mut self, h: f64) -> Result<[f64; N], StepError> {
        let Self { system, x, d, p, mu, .. } = &*self;
        let (_, g) = jacobian(x, |v| system.constraints(v));
        let start = std::array::from_fn(|i| if i < N { d[i] } else { mu[i - N] });
        // What residuals are differences of: momenta, and squares of coordinates.
        let momentum = p.iter().fold(f64::MIN_POSITIVE, |m, p| m.max(p.abs()));
        let extent = x.iter().fold(1.0_f64, |m, q| m.max(q * q));
        let scale = std::array::from_fn(|i| if i < N { momentum } else { extent });
        let root = solve::<U>(start, &scale, |unknowns| {
            let d: [f64; N] = std::array::from_fn(|i| unknowns[i]);
            let y: [f64; N] = std::array::from_fn(|i| x[i] + h * d[i]);
            let step = momenta(system, x, &d, h);
            let (values, rows) = jacobian(&y, |v| system.constraints(v));
            let mut residual = [0.0; U];
            for i in 0..N {
                residual[i] = step.begin[i] - p[i];
                for c in 0..C {
                    residual[i] -= h * g[c][i] * unknowns[N + c];
                }
            }
            residual[N..].copy_from_slice(&values);
            (residual, slope(&step, &g, &rows, h))
        })
        .map_err(|failure| StepError {
            step: self.steps,
            h,
            time_s: self.time,
            failure: failure.into(),
        })?;
        let d: [f64; N] = std::array::from_fn(|i| root.x[i]);
        // The solver's last evaluation need not be the one at its root.
        let step = momenta(system, x, &d, h);
        let y = std::array::from_fn(|i| x[i] + h * d[i]);
        let (_, rows) = jacobian(&y, |v| system.constraints(v));
        if !is_on_the_branch_of_short_steps::<N, C, U>(&step, &g, &rows, h) {
            let failure = StepFailure::WrongBranch;
            return Err(StepError { step: self.steps, h, time_s: self.time, failure });
        }
        self.time += h;
        self.d = d;
        self.mu = std::array::from_fn(|c| root.x[N + c]);
        self.p = step.end;
        for (x, d) in self.x.iter_mut().zip(&self.d) {
            *x += h * d;
        }
        self.steps += 1;
        self.iterations += u64::from(root.iterations);
        Ok(self.d)
    }
}

/// Jacobian of (1), by rows: `−h` times (2.43) in `(d, μ)`.
fn slope<const N: usize, const C: usize, const U: usize>(
    step: &Momenta<N>,
    g: &[[f64; N]; C],
    g_end: &[[f64; N]; C],
    h: f64,
) -> [[f64; U]; U] {
    let mut slope = [[0.0; U]; U];
    for i in 0..N {
        slope[i][..N].copy_from_slice(&step.stiffness[i]);
        for c in 0..C {
            slope[i][N + c] = -h * g[c][i];
            slope[N + c][i] = h * g_end[c][i];
        }
    }
    slope
}

/// For a short step the Jacobian's determinant is positive, as kinetic energy is: there it is
/// `h^{2C} det(M) det(G M⁻¹ Gᵀ)`. Along the branch of roots that short steps lead to it can change its
/// sign only at a fold, so that behind the first fold it is negative.
fn is_on_the_branch_of_short_steps<const N: usize, const C: usize, const U: usize>(
    step: &Momenta<N>,
    g: &[[f64; N]; C],
    g_end: &[[f64; N]; C],
    h: f64,
) -> bool {
    Factors::<U>::new(slope(step, g, g_end, h))
        .is_ok_and(|factors| factors.determinant_is_positive())
}
