//! §2.4.2, for any number of links: point masses on massless rods, each below the one before,
//! `V = ℝ³ × … × ℝ³`.

use crate::{Chart, Natural, Scalar};

/// A spherical pendulum of `L` links; z is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum<const L: usize> {
    /// kg
    pub masses: [f64; L],
    /// m
    pub lengths: [f64; L],
    /// m/s²
    pub gravity: f64,
}

/// The pendulum of §2.4.2.
pub type DoubleSphericalPendulum = Pendulum<2>;

impl Pendulum<2> {
    /// As printed.
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
}

impl<const L: usize> Pendulum<L> {
    /// Angular momentum about the vertical, N·m·s.
    pub fn vertical_momentum<const N: usize>(&self, q: &[f64; N], v: &[f64; N]) -> f64 {
        (0..L).map(|k| self.masses[k] * (q[3 * k] * v[3 * k + 1] - q[3 * k + 1] * v[3 * k])).sum()
    }
}

impl<const N: usize, const L: usize> Natural<N, L> for Pendulum<L> {
    fn masses(&self) -> [f64; N] {
        const { assert!(N == 3 * L, "three coordinates a link") }
        std::array::from_fn(|i| self.masses[i / 3])
    }

    fn potential<D: Scalar>(&self, q: &[D; N]) -> D {
        (0..L).map(|k| q[3 * k + 2] * self.masses[k] * self.gravity).sum()
    }

    /// (2.54)
    fn constraints<D: Scalar>(&self, q: &[D; N]) -> [D; L] {
        std::array::from_fn(|k| {
            let rod: [D; 3] = std::array::from_fn(|i| match k {
                0 => q[i],
                _ => q[3 * k + i] - q[3 * k + i - 3],
            });
            rod[0] * rod[0] + rod[1] * rod[1] + rod[2] * rod[2] - self.lengths[k].powi(2)
        })
    }
}

/// The chart of two polar angles for each rod: (θ₁, φ₁, θ₂, φ₂, …), θ from straight down. It is singular
/// where a rod is straight down or up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarAngles<const L: usize> {
    /// m
    pub lengths: [f64; L],
}

impl<const M: usize, const N: usize, const L: usize> Chart<M, N> for PolarAngles<L> {
    fn embed<D: Scalar>(&self, q: &[D; M]) -> [D; N] {
        const { assert!(M == 2 * L && N == 3 * L, "two angles and three coordinates a link") }
        let mut end = [D::from(0.0); N];
        for k in 0..L {
            let (theta, phi, length) = (q[2 * k], q[2 * k + 1], self.lengths[k]);
            let across = theta.sin() * length;
            let rod = [across * phi.cos(), across * phi.sin(), -theta.cos() * length];
            for (i, rod) in rod.into_iter().enumerate() {
                end[3 * k + i] = if k == 0 { rod } else { end[3 * k + i - 3] + rod };
            }
        }
        end
    }
}
