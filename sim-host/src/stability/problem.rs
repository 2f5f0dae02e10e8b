//! A problem: a system, a start, a time, and what its motion must keep.

use super::forecast::Rates;
use super::verdict::{Bounds, Verdict, attempt};
use crate::integrators::{Method, start_free_body, start_natural};
use crate::mechanics::systems::FreeRigidBody;
use crate::mechanics::{Lagrangian, Natural};
use num_dual::Dual64;

type Attempt = Box<dyn Fn(Method, f64) -> Option<Verdict> + Send + Sync>;

/// A system, a start, and a time.
pub struct Problem {
    /// Its name.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// How fast its motion is: what forecasts are made from.
    pub rates: Rates,
    attempt: Attempt,
}

impl Problem {
    /// A free rigid body from a body angular velocity (rad/s).
    pub fn free_body(
        name: &'static str,
        description: &'static str,
        body: FreeRigidBody,
        omega: [f64; 3],
    ) -> Self {
        let q = [1.0, 0.0, 0.0, 0.0];
        let q_dot = FreeRigidBody::rate(&q, &omega);
        let rates = Rates::along_motion::<_, 4, 1, 5>(&body, q, q_dot, DURATION_S);
        let bounds = bounds_of(&body, &q, &q_dot, &rates);
        Problem {
            name,
            description,
            rates,
            attempt: Box::new(move |method, h| {
                attempt(
                    start_free_body(method, body, h, q, q_dot),
                    &bounds,
                    |q, v| body.energy(q, v),
                    |q| largest_constraint::<4, 1>(&body, q),
                )
            }),
        }
    }

    /// A natural system from a configuration and a velocity. `U` is `N + C`.
    pub fn natural<S, const N: usize, const C: usize, const U: usize>(
        name: &'static str,
        description: &'static str,
        system: S,
        (x, v): ([f64; N], [f64; N]),
    ) -> Self
    where
        S: Natural<N, C> + Copy + Send + Sync + 'static,
    {
        let rates = Rates::along_motion::<_, N, C, U>(&system, x, v, DURATION_S);
        let bounds = bounds_of::<_, N, C>(&system, &x, &v, &rates);
        Problem {
            name,
            description,
            rates,
            attempt: Box::new(move |method, h| {
                attempt(
                    start_natural::<_, f64, N, C, U>(method, system, h, x, v),
                    &bounds,
                    |q, v| Lagrangian::energy(&system, q, v),
                    |q| largest_constraint::<N, C>(&system, q),
                )
            }),
        }
    }

    /// Whether a method works with a step; `None` if it is not made for this system.
    pub fn attempt(&self, method: Method, h: f64) -> Option<Verdict> {
        (self.attempt)(method, h)
    }
}

/// Time that motions must last, s.
pub(super) const DURATION_S: f64 = 30.0;
/// Share of the largest kinetic energy by which energy may be off.
const ENERGY_BAND: f64 = 0.1;
/// Constraints' bound, relative to squares of coordinates.
const CONSTRAINT: f64 = 0.01;

fn bounds_of<S, const N: usize, const C: usize>(
    system: &S,
    x: &[f64; N],
    v: &[f64; N],
    rates: &Rates,
) -> Bounds
where
    S: Lagrangian<N, C>,
{
    let extent = x.iter().fold(1.0_f64, |m, x| m.max(x * x));
    Bounds {
        duration_s: DURATION_S,
        energy: system.energy(x, v),
        energy_band: ENERGY_BAND * rates.kinetic_j,
        constraint: CONSTRAINT * extent,
    }
}

fn largest_constraint<const N: usize, const C: usize>(
    system: &impl Lagrangian<N, C>,
    q: &[f64; N],
) -> f64 {
    let values: [Dual64; C] = system.constraints(&q.map(Dual64::from_re));
    values.iter().fold(0.0, |m, g| if g.re.abs() > m || g.re.is_nan() { g.re.abs() } else { m })
}
