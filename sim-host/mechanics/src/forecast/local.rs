//! What step a method will bear, said before the run.
//!
//! A run fails in one of three ways, and each shows in a few steps from states along an accurate
//! motion:
//!
//! 1. *A step has no solution.* Implicit equations lose their root at a fold, which depends on the state
//!    alone, but for what a method carries along: the energy-momentum method's momentum across the
//!    constraints changes sign from step to step and builds up in the first few. The methods' folds differ:
//!    RATTLE's constraint forces along `Dgᵀ(x)` cannot bring the end of a step back once the direction of
//!    motion turns by some 1 rad in it; those along `Dgᵀ` of the chord can; the equations on the group of
//!    rotations (`LieGroup`) have no fold for a body in steady rotation. So no bound on the turn in a step
//!    serves all; the steps' own equations do.
//! 2. *Errors add up.* By the telescoping sum of errors (Hairer, Nørsett and Wanner, *Solving Ordinary
//!    Differential Equations I*, II.3) a run's error in energy is the sum of the steps' own, each carried
//!    along by the flow, which conserves it: `B(t) = Σ e(x_k; h)/h Δt`, with `e` the change of energy in a
//!    step. Methods with a modified energy `H + h^p K` make no error that adds up
//!    ([`has_modified_energy`]): of `B` only what is left beside its trend counts, as the trend is that
//!    of `K` along the accurate motion, not along the method's own. Constraints the same: explicit methods
//!    impose their acceleration alone, so that the drift of their rates adds up once, that of their values
//!    twice. The energy of no single step may be out of bounds either.
//! 3. *Errors grow.* Beyond its limit of linear stability a method makes any disturbance grow, though its
//!    single steps are good. For an oscillation `ẍ = −Ω² x` that limit is where the step's matrix has an
//!    eigenvalue off the unit circle. Methods without such a limit have another one: beyond half a period
//!    in a step they represent another motion than the one that the forecast knows
//!    ([`oscillation_limit`]).
//!
//! One state at which steps fail is not the end of a run that hardly ever comes there. A run of `T` seconds
//! consists of `T/(n h)` stretches as long as a probe of `n` steps, so that one run in ten fails once the share
//! of probes that fail has reached `0.1 · n h/T`. Long runs in short steps bear none of the probed states to
//! fail, a pendulum of thirty steps some. A motion that loses energy comes to rest, and passes each of its
//! states once, whatever the step: one state may fail alone, where a corner meets the floor just so, but no two in
//! a row.
//!
//! The step foretold is the shortest of the three, times a share below 1.
//!
//! # Notation
//! - `Ω`: how fast the motion oscillates, the square root of the norm of `∂a/∂x` along the manifold, at its
//!   largest
//! - `e`: change of energy in a step; `B`: its sum along the motion

use super::verdict::{Bounds, FailureKind};
use crate::integrators::{Method, YOSHIDA_4, YOSHIDA_6, longest_stage};
use crate::newton::solve_linear;
use crate::{Lagrangian, acceleration, jacobian, saddle};
use num_dual::Dual64;
use serde::Serialize;
use std::f64::consts::PI;

/// What a run is foretold to bear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Forecast {
    /// The longest step that should work, s; `None` where none does, or nothing limits it: see `kind`.
    pub step_s: Option<f64>,
    /// How longer steps fail; `None` where nothing limits them but accuracy.
    pub kind: Option<FailureKind>,
}

/// What a few steps do to what a motion must keep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// Of energy, J.
    pub energy: f64,
    /// The largest of energy after any of them, with its sign, J.
    pub largest_energy: f64,
    /// Of constraints, which are zero before.
    pub constraints: Vec<f64>,
    /// Of their rates, for methods that impose neither: empty for others, whose rates do not add up.
    pub rates: Vec<f64>,
}

/// A few steps from states along an accurate motion.
pub struct Probe<'a> {
    /// How many states there are.
    pub states: usize,
    /// Time between them, s.
    pub spacing_s: f64,
    /// How many steps are made from each state at most.
    pub most_steps: usize,
    /// From a state so many steps, each of so many seconds.
    pub step: &'a dyn Fn(usize, usize, f64) -> Result<Change, FailureKind>,
    /// Whether errors of energy do not add up.
    pub has_modified_energy: bool,
    /// `h` beyond which disturbances grow, s.
    pub unstable_s: f64,
    /// Of the step at which probes begin to fail: what is foretold.
    pub share: f64,
    /// Steps in question, s.
    pub range_s: [f64; 2],
}

/// Steps made from a state.
pub const FEW_STEPS: usize = 5;
/// The same of methods that carry momentum across constraints along, which builds up: so many at most, and no
/// more than a tenth of the run. (With half of the run the double pendulum's forecasts get no better: it builds
/// up for longer than that.)
const MANY_STEPS: usize = 48;
const MOST_OF_A_RUN: f64 = 0.1;
/// Steps from a state that all states are worth; with more, fewer states are looked at.
const STEPS_A_STATE: usize = 12;
/// Of the step at which probes begin to fail. A run at that step is on a motion of its own, with other
/// extremes, and looks at far more states than the forecast does: what it meets is a little faster.
pub const SHARE: f64 = 5.0 / 6.0;
/// Of motions that lose energy, whose probes pass over what fails at one state alone: the largest, in thirds, that
/// leaves no forecast of maps with five columns on the unsafe side. Of the chart's twenty, one is: a single step of
/// contact that fails between shorter and longer ones that work.
pub const SHARE_OF_LOSSES: f64 = 2.0 / 3.0;
/// Of methods that carry momentum across constraints along: it builds up for longer than any probe lasts. The
/// largest that leaves no forecast of the catalogue on the unsafe side; random problems are the check.
const SHARE_OF_WHAT_BUILDS_UP: f64 = 0.53;

/// How many steps a method is probed with at most, and the share of the step at which these begin to fail.
pub fn steps_and_share(method: Method, has_constraints: bool) -> (usize, f64) {
    match method {
        Method::EnergyMomentum | Method::ImplicitMidpoint if has_constraints => {
            (MANY_STEPS, SHARE_OF_WHAT_BUILDS_UP)
        }
        _ => (FEW_STEPS, SHARE),
    }
}

/// Of runs at the step at which probes begin to fail, the share that is to fail.
const RUNS_THAT_FAIL: f64 = 0.1;
/// Ratio of steps in a climb.
const CLIMB: f64 = 1.3;
/// Bisections after it: to 1 %.
const BISECTIONS: usize = 5;

impl Probe<'_> {
    /// The longest step within bounds, found by climbing from the shortest.
    ///
    /// # Cost
    /// Up to 200 steps from each state, or 400.
    pub fn forecast(&self, bounds: &Bounds) -> Forecast {
        let [shortest, longest] = self.range_s;
        if self.states == 0 {
            return Forecast { step_s: None, kind: Some(FailureKind::NotFinite) };
        }
        let (mut works, mut h) = (None, shortest);
        // The share is to be within the range.
        while h * self.share <= longest {
            if let Some(kind) = self.fails(h, bounds) {
                let Some(works) = works else { return Forecast { step_s: None, kind: Some(kind) } };
                return self.between(works, (h, kind), bounds);
            }
            works = Some(h);
            h *= CLIMB;
        }
        Forecast::default()
    }

    fn between(&self, mut works: f64, mut fails: (f64, FailureKind), bounds: &Bounds) -> Forecast {
        for _ in 0..BISECTIONS {
            let h = (works * fails.0).sqrt();
            match self.fails(h, bounds) {
                None => works = h,
                Some(kind) => fails = (h, kind),
            }
        }
        Forecast { step_s: Some(self.share * works), kind: Some(fails.1) }
    }

    /// How a run in steps of `h` should fail, if it should.
    fn fails(&self, h: f64, bounds: &Bounds) -> Option<FailureKind> {
        if h > self.unstable_s {
            return Some(FailureKind::Energy);
        }
        let steps =
            ((MOST_OF_A_RUN * bounds.duration_s / h) as usize).min(self.most_steps).max(FEW_STEPS);
        let stride = steps.div_ceil(STEPS_A_STATE);
        let spacing_s = self.spacing_s * stride as f64;
        let probed = self.states.div_ceil(stride);
        let mut energies = Vec::with_capacity(probed);
        let (mut values, mut rates) = (Vec::new(), Vec::new());
        // Probes that would fit between two states, and into a run; of those made, how many may fail.
        let probes = spacing_s / (steps as f64 * h);
        let in_a_run = (bounds.duration_s / (steps as f64 * h)).max(1.0);
        let bearable = RUNS_THAT_FAIL * probed as f64 / in_a_run;
        let (mut failing, mut has_just_failed) = (0, false);
        for state in (0..self.states).step_by(stride) {
            let change = (self.step)(state, steps, h).and_then(|change| {
                let is_off = bounds.is_off(change.largest_energy);
                if is_off { Err(FailureKind::Energy) } else { Ok(change) }
            });
            let change = match change {
                Ok(change) => change,
                Err(kind) => {
                    failing += 1;
                    let is_over = match bounds.dissipates {
                        true => has_just_failed,
                        false => f64::from(failing) >= bearable,
                    };
                    if is_over {
                        return Some(kind);
                    }
                    has_just_failed = true;
                    continue;
                }
            };
            has_just_failed = false;
            energies.push(change.energy * probes);
            values.resize(change.constraints.len(), 0.0);
            rates.resize(change.constraints.len(), 0.0);
            let drifts = change.rates.iter().chain(std::iter::repeat(&0.0));
            for ((value, rate), (by, rate_by)) in
                values.iter_mut().zip(&mut rates).zip(change.constraints.iter().zip(drifts))
            {
                *value += *rate * spacing_s + by * probes;
                *rate += rate_by * probes;
                if !(f64::abs(*value) <= bounds.constraint) {
                    return Some(FailureKind::Constraint);
                }
            }
        }
        let trend = match self.has_modified_energy {
            true => energies.iter().sum::<f64>() / energies.len().max(1) as f64,
            false => 0.0,
        };
        let sums = energies.iter().scan(0.0, |sum, by| {
            *sum += by - trend;
            Some(*sum)
        });
        sums.into_iter().any(|sum| bounds.is_off(sum)).then_some(FailureKind::Energy)
    }
}

/// Whether a method conserves an energy near that of the system, so that errors of energy do not add up:
/// symplectic methods, symmetric ones on reversible systems, and the one that conserves energy itself (Hairer,
/// Lubich and Wanner, *Geometric Numerical Integration*, IX and XI). Constraints that are imposed
/// on accelerations alone take it away.
pub fn has_modified_energy(method: Method, has_constraints: bool) -> bool {
    match method {
        Method::RungeKutta4 | Method::RungeKutta4Projected | Method::DormandPrince8 => false,
        Method::SemiImplicitEuler => !has_constraints,
        _ => true,
    }
}

/// `Ω h` up to which a method bears an oscillation.
///
/// - (2.45) and Verlet's, SHAKE and RATTLE, and semi-implicit Euler: the step's matrix has the trace
///   `2 − (Ω h)²`, which leaves [−2, 2] at `Ω h = 2`.
/// - The classical Runge–Kutta method: `|R(i Ω h)| ≤ 1` up to `2√2`. (What it damps below is in the
///   energies of single steps.)
/// - The variational method (2.23), the implicit midpoint rule and the energy-momentum method turn a linear
///   oscillation by `2 atan(Ω h/2)` in a step: their matrices are rotations for every step, backward ones
///   included (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, VI), and so are those of
///   compositions. There is no instability; but samples further apart than half a period are as well those
///   of another, slower oscillation, so that the states met are not those of the accurate motion. Each
///   stage of a composition counts.
pub fn oscillation_limit(method: Method) -> f64 {
    match method {
        Method::Variational
        | Method::ImplicitMidpoint
        | Method::EnergyMomentum
        | Method::LieGroup => PI,
        Method::Yoshida4 => PI / longest_stage(&YOSHIDA_4),
        Method::Yoshida6 => PI / longest_stage(&YOSHIDA_6),
        Method::DormandPrince8 => f64::INFINITY,
        Method::VariationalEndpoint
        | Method::Verlet
        | Method::Shake
        | Method::VelocityShake
        | Method::Rattle
        | Method::SemiImplicitEuler => 2.0,
        Method::RungeKutta4 | Method::RungeKutta4Projected => 8.0_f64.sqrt(),
    }
}

/// `Ω` by power iteration on `−∂a/∂x` at rest, kept along the manifold.
pub fn oscillation<S, const N: usize, const C: usize, const U: usize>(
    system: &S,
    x: &[f64; N],
    inertia: &[[f64; N]; N],
) -> f64
where
    S: Lagrangian<N, C>,
{
    const ITERATIONS: usize = 30;
    let (_, g) = jacobian(x, |q| system.constraints(q));
    let matrix = saddle::<f64, N, C, U>(inertia, &g, -1.0, &g, 1.0);
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
