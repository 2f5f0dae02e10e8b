//! A point mass on a massless rod, `V = ℝ³`; z is up.

use crate::mechanics::{Chart, Natural, Scalar};

/// The spherical pendulum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalPendulum {
    /// kg
    pub mass: f64,
    /// m
    pub length: f64,
    /// m/s²
    pub gravity: f64,
}

impl Natural<3, 1> for SphericalPendulum {
    fn masses(&self) -> [f64; 3] {
        [self.mass; 3]
    }

    fn potential<D: Scalar>(&self, q: &[D; 3]) -> D {
        q[2] * (self.mass * self.gravity)
    }

    fn constraints<D: Scalar>(&self, q: &[D; 3]) -> [D; 1] {
        [q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - self.length * self.length]
    }
}

/// The chart of the polar angles (θ, φ), θ from straight down. It is singular straight down and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarAngles {
    /// m
    pub length: f64,
}

impl Chart<2, 3> for PolarAngles {
    fn embed<D: Scalar>(&self, q: &[D; 2]) -> [D; 3] {
        polar(q[0], q[1], self.length)
    }
}

/// A point at a distance in the direction of two polar angles.
pub(super) fn polar<D: Scalar>(theta: D, phi: D, length: f64) -> [D; 3] {
    let across = theta.sin() * length;
    [across * phi.cos(), across * phi.sin(), -theta.cos() * length]
}
