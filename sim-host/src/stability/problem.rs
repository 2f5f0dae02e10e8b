//! A problem: a system, a start, a time, and what its motion must keep.

use num_dual::Dual64;
use surefoot_mechanics::forecast::Course;
use surefoot_mechanics::forecast::Forecast;
use surefoot_mechanics::forecast::{RANGE_S, bounds, foretell};
use surefoot_mechanics::forecast::{Verdict, attempt};
use surefoot_mechanics::integrators::{Method, start_free_body, start_natural};
use surefoot_mechanics::systems::FreeRigidBody;
use surefoot_mechanics::{Lagrangian, Natural};

type Attempt = Box<dyn Fn(Method, f64) -> Option<Verdict> + Send + Sync>;
type Foretell = Box<dyn Fn(Method) -> Option<Forecast> + Send + Sync>;

/// A system, a start, and a time.
pub struct Problem {
    /// Its name.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// The shortest and the longest step in question, s.
    pub range_s: [f64; 2],
    /// Shorter steps than this must go into it a whole number of times, s.
    pub period_s: Option<f64>,
    pub(super) attempt: Attempt,
    pub(super) foretell: Foretell,
}

/// Time that motions of mechanisms must last, s.
pub(super) const DURATION_S: f64 = 30.0;

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
        let start = move |method, h, q, q_dot| start_free_body(method, body, h, q, q_dot);
        let course = Course::along::<_, 1, 5>(&body, q, q_dot, DURATION_S, start);
        let bounds = bounds::<_, 4, 1>(&body, &course, (&q, &q_dot), DURATION_S);
        Problem {
            name,
            description,
            range_s: RANGE_S,
            period_s: None,
            attempt: Box::new(move |method, h| {
                attempt(
                    start(method, h, q, q_dot),
                    &bounds,
                    |q, v| body.energy(q, v),
                    |q| largest_constraint::<4, 1>(&body, q),
                )
            }),
            foretell: Box::new(move |method| {
                foretell::<_, 4, 1>(&body, &course, method, |h, q, v| start(method, h, q, v))
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
        let start =
            move |method, h, x, v| start_natural::<_, f64, N, C, U>(method, system, h, x, v);
        let course = Course::along::<_, C, U>(&system, x, v, DURATION_S, start);
        let bounds = bounds::<_, N, C>(&system, &course, (&x, &v), DURATION_S);
        Problem {
            name,
            description,
            range_s: RANGE_S,
            period_s: None,
            attempt: Box::new(move |method, h| {
                attempt(
                    start(method, h, x, v),
                    &bounds,
                    |q, v| Lagrangian::energy(&system, q, v),
                    |q| largest_constraint::<N, C>(&system, q),
                )
            }),
            foretell: Box::new(move |method| {
                foretell::<_, N, C>(&system, &course, method, |h, x, v| start(method, h, x, v))
            }),
        }
    }

    /// Whether a method works with a step; `None` if it is not made for this system.
    pub fn attempt(&self, method: Method, h: f64) -> Option<Verdict> {
        (self.attempt)(method, h)
    }

    /// The longest step that a method should bear; `None` if it is not made for this system.
    pub fn forecast(&self, method: Method) -> Option<Forecast> {
        (self.foretell)(method)
    }
}

fn largest_constraint<const N: usize, const C: usize>(
    system: &impl Lagrangian<N, C>,
    q: &[f64; N],
) -> f64 {
    let values: [Dual64; C] = system.constraints(&q.map(Dual64::from_re));
    values.iter().fold(0.0, |m, g| if g.re.abs() > m || g.re.is_nan() { g.re.abs() } else { m })
}
