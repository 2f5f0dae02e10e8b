//! Starts of the library's systems, and a closed form.

use surefoot_mechanics::integrators::{Method, Motion, StartError, start_free_body, start_natural};
use surefoot_mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody, Planet};

/// Where a planet from its perihelion is after a time: Kepler's equation, by Newton's method on a convex
/// function.
pub fn planet_at(e: f64, time: f64) -> [f64; 2] {
    let mut anomaly = time + e;
    for _ in 0..50 {
        anomaly -= (anomaly - e * anomaly.sin() - time) / (1.0 - e * anomaly.cos());
    }
    [anomaly.cos() - e, (1.0 - e * e).sqrt() * anomaly.sin()]
}

pub const PENDULUM: DoubleSphericalPendulum = DoubleSphericalPendulum::PRINTED;

pub fn pendulum(method: Method, h: f64) -> Result<Motion<6>, StartError> {
    let (q, v) = PENDULUM.printed_start();
    start_natural::<_, f64, 6, 2, 8>(method, PENDULUM, h, q, v)
}

pub fn body(method: Method, h: f64) -> Result<Motion<4>, StartError> {
    let (q, rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 2.0]);
    start_free_body(method, FreeRigidBody::PRINTED, h, q, rate)
}

pub fn planet(method: Method, h: f64) -> Result<Motion<2>, StartError> {
    let (q, v) = Planet::perihelion(0.3);
    start_natural::<_, f64, 2, 0, 2>(method, Planet, h, q, v)
}
