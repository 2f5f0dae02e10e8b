//! §2.4.1: a free rigid body in unit quaternions (scalar first), `V = ℝ⁴`.

use crate::{DiscreteLagrangian, Lagrangian, Momenta, Scalar};

/// A rigid body with principal inertias, turning freely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRigidBody {
    /// kg·m²
    pub inertia: [f64; 3],
}

impl FreeRigidBody {
    /// The body of (2.52).
    pub const PRINTED: Self = Self { inertia: [1.0, 2.0, 3.0] };

    /// Body angular velocity of a step: `2 vec(x̄ ⋆ d)`, which is `2 vec(x̄ ⋆ y)/h`, rad/s.
    pub fn angular_velocity<D: Scalar>(x: &[D; 4], d: &[D; 4]) -> [D; 3] {
        let [_, a, b, c] = conjugate_product(x, d);
        [a, b, c].map(|component| component * 2.0)
    }

    /// The rate of a quaternion, `q ⋆ (0, ω/2)`, 1/s.
    pub fn rate<D: Scalar>(q: &[D; 4], omega: &[D; 3]) -> [D; 4] {
        let [a, b, c] = omega.map(|component| component * 0.5);
        product(q, &[D::from(0.0), a, b, c])
    }

    /// A quaternion turned by a Cayley vector `a`: `q ⋆ (1, a/2)`, normalized.
    pub fn turned<D: Scalar>(q: &[D; 4], a: &[D; 3]) -> [D; 4] {
        let [x, y, z] = a.map(|component| component * 0.5);
        let norm = (x * x + y * y + z * z + 1.0).sqrt();
        product(q, &[D::from(1.0), x, y, z]).map(|component| component / norm)
    }

    /// `½ ωᵀ I ω`, J.
    pub fn kinetic_energy(&self, omega: &[f64; 3]) -> f64 {
        0.5 * omega.iter().zip(&self.inertia).map(|(w, i)| i * w * w).sum::<f64>()
    }

    /// Spatial angular momentum of a step: the momentum map (2.22) of left multiplication by unit
    /// quaternions, `½ ⟨−h D₂𝕃, ξ ⋆ x⟩` for the three units `ξ`, N·m·s.
    pub fn discrete_momentum(&self, x: &[f64; 4], d: &[f64; 4], h: f64) -> [f64; 3] {
        let p = self.momenta(x, d, h).begin;
        [1, 2, 3].map(|unit| {
            let mut xi = [0.0; 4];
            xi[unit] = 1.0;
            let along = product(&xi, x);
            0.5 * p.iter().zip(&along).map(|(p, d)| p * d).sum::<f64>()
        })
    }
}

/// (2.46)
impl Lagrangian<4, 1> for FreeRigidBody {
    fn lagrangian<D: Scalar>(&self, q: &[D; 4], q_dot: &[D; 4]) -> D {
        let omega = Self::angular_velocity(q, q_dot);
        omega.into_iter().zip(self.inertia).map(|(w, i)| w * w * (0.5 * i)).sum()
    }

    fn constraints<D: Scalar>(&self, q: &[D; 4]) -> [D; 1] {
        unit_norm(q)
    }
}

/// (2.51): `𝕃 = wᵀ I w / 2h²` with `w = vec(x̄ ⋆ y − ȳ ⋆ x)`, which is `h vec(x̄ ⋆ d − d̄ ⋆ x)`.
impl DiscreteLagrangian<4, 1> for FreeRigidBody {
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; 4], d: &[D; 4], _: f64) -> D {
        let forward = conjugate_product(x, d);
        let backward = conjugate_product(d, x);
        let mut sum = D::from(0.0);
        for (i, inertia) in self.inertia.iter().enumerate() {
            let w = forward[i + 1] - backward[i + 1];
            sum += w * w * *inertia;
        }
        sum * 0.5
    }

    fn constraints<D: Scalar>(&self, v: &[D; 4]) -> [D; 1] {
        unit_norm(v)
    }

    /// Written out, as differentiation took nine tenths of a step: `w = W(x) d` is linear in both, with
    /// `W(x) d = −W(d) x`.
    fn derivatives<D: Scalar>(&self, x: &[D; 4], d: &[D; 4], h: f64) -> Momenta<4, D> {
        let y = std::array::from_fn(|i| x[i] + d[i] * h);
        let (at_x, at_y) = (rate_map(x), rate_map(&y));
        // I w
        let momentum: [D; 3] = std::array::from_fn(|i| {
            let w: D = (0..4).map(|j| at_x[i][j] * d[j]).sum();
            w * self.inertia[i]
        });
        let [m0, m1, m2] = momentum.map(|m| m * (2.0 * h));
        let zero = D::from(0.0);
        // h Σ I w ∂W/∂d, antisymmetric
        let mut stiffness =
            [[zero, -m0, -m1, -m2], [m0, zero, m2, -m1], [m1, -m2, zero, m0], [m2, m1, -m0, zero]];
        for (j, row) in stiffness.iter_mut().enumerate() {
            for (k, entry) in row.iter_mut().enumerate() {
                for i in 0..3 {
                    *entry += at_y[i][j] * at_x[i][k] * self.inertia[i];
                }
            }
        }
        let pulled = |map: &[[D; 4]; 3]| -> [D; 4] {
            std::array::from_fn(|j| (0..3).map(|i| map[i][j] * momentum[i]).sum())
        };
        Momenta { begin: pulled(&at_y), end: pulled(&at_x), stiffness }
    }
}

/// `W(x)` with `W(x) d = 2 vec(x̄ ⋆ d)`.
fn rate_map<D: Scalar>(&[s, a, b, c]: &[D; 4]) -> [[D; 4]; 3] {
    [[-a, s, c, -b], [-b, -c, s, a], [-c, b, -a, s]].map(|row| row.map(|x| x * 2.0))
}

fn unit_norm<D: Scalar>(q: &[D; 4]) -> [D; 1] {
    [q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0]
}

/// `a ⋆ b`
fn product<D: Scalar>(a: &[D; 4], b: &[D; 4]) -> [D; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3],
        a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1],
    ]
}

/// `ā ⋆ b`
fn conjugate_product<D: Scalar>(a: &[D; 4], b: &[D; 4]) -> [D; 4] {
    product(&[a[0], -a[1], -a[2], -a[3]], b)
}
