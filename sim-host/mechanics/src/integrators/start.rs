//! Any method on any system, from a configuration and a velocity.

use super::{
    Composition, DormandPrince, EnergyMomentum, Form, ImplicitMidpoint, Integrator, LieGroup,
    Method, Rattle, RungeKutta, SemiImplicitEuler, Shake, StepError, Variational, YOSHIDA_4,
    YOSHIDA_6, scale,
};
use crate::jacobian;
use crate::systems::FreeRigidBody;
use crate::{DiscreteLagrangian, Endpoint, Lagrangian, Midpoint, Natural, Scalar};
use std::any::Any;

/// A motion under a method chosen at run time.
pub type Motion<const N: usize, D = f64> = Box<dyn Integrator<N, D>>;

/// Why a motion cannot be started.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StartError {
    /// The step is no time.
    #[error("a step of {h} s: a positive number is needed")]
    Step {
        /// s
        h: f64,
    },
    /// A coordinate or a velocity is not finite.
    #[error("coordinate {coordinate} or its velocity is not finite")]
    NotFinite {
        /// Which one.
        coordinate: usize,
    },
    /// The start violates a constraint, or moves against it.
    #[error(
        "the start is off the manifold: constraint {constraint} is {value:.1e}, rate {rate:.1e}"
    )]
    OffManifold {
        /// Which one.
        constraint: usize,
        /// `g`
        value: f64,
        /// `Dg v̇`
        rate: f64,
    },
    /// The method is not made for this kind of system.
    #[error("{method} takes {takes} only")]
    NotFor {
        /// Which one.
        method: Method,
        /// What it takes.
        takes: &'static str,
    },
    /// The first step failed, for a method that makes it at once.
    #[error(transparent)]
    FirstStep(#[from] StepError),
}

/// Constraints, and their rates, that count as satisfied, relative to their terms.
const ON_MANIFOLD: f64 = 1e-9;
/// Tolerance of [`Method::DormandPrince8`].
pub const ADAPTIVE_TOLERANCE: f64 = 1e-12;

/// Starts any method that takes a general Lagrangian.
///
/// # Errors
/// A [`StartError`].
pub fn start_lagrangian<S, D: Scalar, const N: usize, const C: usize, const U: usize>(
    method: Method,
    system: S,
    h: f64,
    x: [D; N],
    v_dot: [D; N],
) -> Result<Motion<N, D>, StartError>
where
    S: Lagrangian<N, C> + Clone + 'static,
{
    check_start(h, &x, &v_dot, |v| system.constraints(v))?;
    Ok(match method {
        Method::VariationalEndpoint => {
            Box::new(Variational::<_, N, C, U, D>::from_velocity(Endpoint(system), h, x, v_dot))
        }
        Method::ImplicitMidpoint => {
            Box::new(ImplicitMidpoint::<_, N, C, U, D>::new(system, h, x, v_dot))
        }
        Method::Variational | Method::Yoshida4 | Method::Yoshida6 => {
            discrete::<_, D, N, C, U>(method, Midpoint(system), h, x, v_dot)?
        }
        _ => differential::<_, D, N, C, U>(method, system, h, x, v_dot)?,
    })
}

/// Starts any method on a natural system.
///
/// # Errors
/// A [`StartError`].
pub fn start_natural<S, D: Scalar, const N: usize, const C: usize, const U: usize>(
    method: Method,
    system: S,
    h: f64,
    x: [D; N],
    v_dot: [D; N],
) -> Result<Motion<N, D>, StartError>
where
    S: Natural<N, C> + Clone + 'static,
{
    check_start(h, &x, &v_dot, |v| Natural::constraints(&system, v))?;
    if let Method::Verlet | Method::Shake | Method::VelocityShake | Method::Rattle = method
        && Natural::force(&system, &x, &v_dot).is_some()
    {
        return Err(StartError::NotFor { method, takes: "systems without external forces" });
    }
    Ok(match method {
        Method::Verlet if C > 0 => {
            return Err(StartError::NotFor { method, takes: "systems without constraints" });
        }
        Method::Verlet | Method::VelocityShake => {
            Box::new(Shake::new(system, Form::Velocities, h, x, v_dot)?)
        }
        Method::Shake => Box::new(Shake::new(system, Form::Positions, h, x, v_dot)?),
        Method::Rattle => Box::new(Rattle::new(system, h, x, &v_dot)),
        Method::EnergyMomentum => {
            Box::new(EnergyMomentum::<_, N, C, U, D>::new(system, h, x, &v_dot))
        }
        _ => return start_lagrangian::<_, D, N, C, U>(method, system, h, x, v_dot),
    })
}

/// Starts any method that takes a free rigid body, from a unit quaternion and its rate. The
/// variational ones are those of (2.51).
///
/// # Errors
/// A [`StartError`].
pub fn start_free_body<D: Scalar>(
    method: Method,
    body: FreeRigidBody,
    h: f64,
    q: [D; 4],
    q_dot: [D; 4],
) -> Result<Motion<4, D>, StartError> {
    check_start(h, &q, &q_dot, |q| Lagrangian::constraints(&body, q))?;
    match method {
        Method::LieGroup => Ok(Box::new(LieGroup::new(body, h, q, &q_dot))),
        Method::Variational | Method::Yoshida4 | Method::Yoshida6 => {
            discrete::<_, D, 4, 1, 5>(method, body, h, q, q_dot)
        }
        _ => start_lagrangian::<_, D, 4, 1, 5>(method, body, h, q, q_dot),
    }
}

/// Variational steps, and compositions of them.
fn discrete<S, D: Scalar, const N: usize, const C: usize, const U: usize>(
    method: Method,
    system: S,
    h: f64,
    x: [D; N],
    v_dot: [D; N],
) -> Result<Motion<N, D>, StartError>
where
    S: DiscreteLagrangian<N, C> + Clone + 'static,
{
    let stages: &[f64] = match method {
        Method::Yoshida4 => &YOSHIDA_4,
        Method::Yoshida6 => &YOSHIDA_6,
        _ => return Ok(Box::new(Variational::<_, N, C, U, D>::from_velocity(system, h, x, v_dot))),
    };
    Ok(Box::new(Composition::<_, N, C, U, D>::new(system, stages, h, x, v_dot)))
}

/// Methods on the differential equations.
fn differential<S, D: Scalar, const N: usize, const C: usize, const U: usize>(
    method: Method,
    system: S,
    h: f64,
    x: [D; N],
    v_dot: [D; N],
) -> Result<Motion<N, D>, StartError>
where
    S: Lagrangian<N, C> + Clone + 'static,
{
    Ok(match method {
        Method::SemiImplicitEuler => {
            Box::new(SemiImplicitEuler::<_, N, C, U, D>::new(system, h, x, v_dot))
        }
        Method::RungeKutta4 => Box::new(RungeKutta::<_, N, C, U, D>::new(system, h, x, v_dot)),
        Method::RungeKutta4Projected => {
            Box::new(RungeKutta::<_, N, C, U, D>::projected(system, h, x, v_dot))
        }
        Method::DormandPrince8 => {
            let [x, v] = [x, v_dot].map(|vector| vector.map(|x| x.re()));
            let motion = DormandPrince::<_, N, C, U>::new(system, ADAPTIVE_TOLERANCE, h, x, v);
            let motion: Motion<N> = Box::new(motion);
            let mut motion = Some(motion);
            let plain = (&mut motion as &mut dyn Any).downcast_mut::<Option<Motion<N, D>>>();
            plain
                .and_then(Option::take)
                .ok_or(StartError::NotFor { method, takes: "plain numbers" })?
        }
        Method::LieGroup => return Err(StartError::NotFor { method, takes: "free rigid bodies" }),
        _ => return Err(StartError::NotFor { method, takes: "natural systems (2.29)" }),
    })
}

fn check_start<D: Scalar, const N: usize, const C: usize>(
    h: f64,
    x: &[D; N],
    v_dot: &[D; N],
    constraints: impl Fn(&[num_dual::Dual<f64>; N]) -> [num_dual::Dual<f64>; C],
) -> Result<(), StartError> {
    if !(h > 0.0 && h.is_finite()) {
        return Err(StartError::Step { h });
    }
    let [x, v_dot] = [x, v_dot].map(|vector| vector.map(|x| x.re()));
    if let Some(coordinate) = (0..N).find(|i| !(x[*i].is_finite() && v_dot[*i].is_finite())) {
        return Err(StartError::NotFinite { coordinate });
    }
    let (values, rows) = jacobian(&x, constraints);
    let extents = scale::constraints(&rows, &x, |_| 0.0);
    for (constraint, (value, row)) in values.into_iter().zip(rows).enumerate() {
        let rate: f64 = row.iter().zip(&v_dot).map(|(g, v)| g * v).sum();
        let rates: f64 = row.iter().zip(&v_dot).map(|(g, v)| (g * v).abs()).sum();
        let fits = value.abs() <= ON_MANIFOLD * extents[constraint];
        if !(fits && rate.abs() <= ON_MANIFOLD * rates) {
            return Err(StartError::OffManifold { constraint, value, rate });
        }
    }
    Ok(())
}
