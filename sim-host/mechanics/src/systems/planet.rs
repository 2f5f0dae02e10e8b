//! Kepler's problem: no constraint, and a potential that is no polynomial.

use crate::{Natural, Scalar};

/// A planet about a sun of unit mass and unit gravitational constant, in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planet;

impl Planet {
    /// Where an orbit of eccentricity `e` and semi-major axis 1 begins: at its perihelion. Its period
    /// is 2π.
    pub fn perihelion(e: f64) -> ([f64; 2], [f64; 2]) {
        ([1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
    }
}

impl Natural<2, 0> for Planet {
    fn masses(&self) -> [f64; 2] {
        [1.0; 2]
    }

    fn potential<D: Scalar>(&self, q: &[D; 2]) -> D {
        -(q[0] * q[0] + q[1] * q[1]).sqrt().recip()
    }

    fn constraints<D: Scalar>(&self, _: &[D; 2]) -> [D; 0] {
        []
    }
}
