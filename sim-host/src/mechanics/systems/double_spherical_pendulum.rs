//! §2.4.2: two point masses on massless rods, one below the other, `V = ℝ³ × ℝ³`.

use super::spherical_pendulum::polar;
use crate::mechanics::{Chart, Natural, Scalar};

/// The double spherical pendulum; z is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleSphericalPendulum {
    /// kg
    pub masses: [f64; 2],
    /// m
    pub lengths: [f64; 2],
    /// m/s²
    pub gravity: f64,
}

impl DoubleSphericalPendulum {
    /// The pendulum of §2.4.2.
    pub const PRINTED: Self = Self { masses: [2.0, 3.5], lengths: [4.0, 3.0], gravity: 9.81 };

    /// §2.4.2's initial positions and velocities: x and y are printed, z and its rate follow from the
    /// rods, with z below.
    pub fn printed_start(&self) -> ([f64; 6], [f64; 6]) {
        let [x1, y1, x2, y2] = [2.820, 0.025, 5.085, 0.105];
        let [vx1, vy1, vx2, vy2] = [3.381, 2.506, 2.497, 10.495];
        let [l1, l2] = self.lengths;
        let z1 = -(l1 * l1 - x1 * x1 - y1 * y1).sqrt();
        let vz1 = -(x1 * vx1 + y1 * vy1) / z1;
        let (dx, dy): (f64, f64) = (x2 - x1, y2 - y1);
        let dz = -(l2 * l2 - dx * dx - dy * dy).sqrt();
        let dvz = -(dx * (vx2 - vx1) + dy * (vy2 - vy1)) / dz;
        ([x1, y1, z1, x2, y2, z1 + dz], [vx1, vy1, vz1, vx2, vy2, vz1 + dvz])
    }

    /// Angular momentum about the vertical, N·m·s.
    pub fn vertical_momentum(&self, q: &[f64; 6], v: &[f64; 6]) -> f64 {
        let [m1, m2] = self.masses;
        m1 * (q[0] * v[1] - q[1] * v[0]) + m2 * (q[3] * v[4] - q[4] * v[3])
    }
}

impl Natural<6, 2> for DoubleSphericalPendulum {
    fn masses(&self) -> [f64; 6] {
        let [m1, m2] = self.masses;
        [m1, m1, m1, m2, m2, m2]
    }

    fn potential<D: Scalar>(&self, q: &[D; 6]) -> D {
        let [m1, m2] = self.masses;
        (q[2] * m1 + q[5] * m2) * self.gravity
    }

    /// (2.54)
    fn constraints<D: Scalar>(&self, q: &[D; 6]) -> [D; 2] {
        let [l1, l2] = self.lengths;
        let d: [D; 3] = std::array::from_fn(|i| q[3 + i] - q[i]);
        [
            q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - l1 * l1,
            d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - l2 * l2,
        ]
    }
}

/// The chart of two pairs of polar angles, one for each rod: (θ₁, φ₁, θ₂, φ₂), θ from straight down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PendulumAngles {
    /// m
    pub lengths: [f64; 2],
}

impl Chart<4, 6> for PendulumAngles {
    fn embed<D: Scalar>(&self, q: &[D; 4]) -> [D; 6] {
        let [l1, l2] = self.lengths;
        let a = polar(q[0], q[1], l1);
        let b = polar(q[2], q[3], l2);
        [a[0], a[1], a[2], a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    }
}
