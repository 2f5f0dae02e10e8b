//! The problems whose limits are sought.

use super::problem::Problem;
use surefoot_mechanics::systems::{
    DoubleSphericalPendulum, FreeRigidBody, Pendulum, Planet, PolarAngles,
};
use surefoot_mechanics::{Chart, Natural, Scalar, jacobian};

/// All problems.
pub fn problems() -> Vec<Problem> {
    let double = DoubleSphericalPendulum::PRINTED;
    let triple = Pendulum { masses: [1.0, 0.8, 0.6], lengths: [0.5, 0.4, 0.3], gravity: 9.81 };
    vec![
        Problem::free_body(
            "rigid-body",
            "free rigid body of (2.52)",
            FreeRigidBody::PRINTED,
            [0.0, 3.0, 4.0],
        ),
        Problem::free_body(
            "spinning-top",
            "free body, nearly a rod, turning about a short axis",
            FreeRigidBody { inertia: [0.2, 1.0, 1.1] },
            [0.1, 6.0, 0.2],
        ),
        Problem::natural::<_, 6, 2, 8>(
            "double-pendulum",
            "double spherical pendulum of §2.4.2",
            double,
            double.printed_start(),
        ),
        Problem::natural::<_, 9, 3, 12>(
            "triple-pendulum",
            "three links, from rest near the horizontal",
            triple,
            from_angles(&triple.lengths, [1.4, 0.0, 1.2, 0.5, 1.0, 1.0], [0.0; 6]),
        ),
        Problem::natural::<_, 2, 0, 2>(
            "planet",
            "Kepler's problem, eccentricity 0.3",
            Planet,
            Planet::perihelion(0.3),
        ),
        Problem::natural::<_, 3, 0, 3>(
            "elastic-pendulum",
            "a mass on a stiff spring (20 rad/s) that swings",
            ElasticPendulum,
            ([0.9, 0.0, -0.7], [0.0, 1.0, 0.0]),
        ),
    ]
}

/// Positions and velocities from angles and their rates.
fn from_angles<const M: usize, const N: usize, const L: usize>(
    lengths: &[f64; L],
    angles: [f64; M],
    rates: [f64; M],
) -> ([f64; N], [f64; N]) {
    let chart = PolarAngles { lengths: *lengths };
    let (x, slope) = jacobian(&angles, |q| chart.embed(q));
    (x, slope.map(|row| row.iter().zip(&rates).map(|(s, r)| s * r).sum()))
}

/// 1 kg on a spring of 1 m and 400 N/m.
#[derive(Clone, Copy)]
struct ElasticPendulum;

impl Natural<3, 0> for ElasticPendulum {
    fn masses(&self) -> [f64; 3] {
        [1.0; 3]
    }

    fn potential<D: Scalar>(&self, q: &[D; 3]) -> D {
        let stretch = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]).sqrt() - 1.0;
        stretch * stretch * 200.0 + q[2] * 9.81
    }

    fn constraints<D: Scalar>(&self, _: &[D; 3]) -> [D; 0] {
        []
    }
}
