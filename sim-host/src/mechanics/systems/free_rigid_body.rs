//! §2.4.1: a free rigid body in unit quaternions (scalar first), `V = ℝ⁴`.

use crate::mechanics::{DiscreteLagrangian, Scalar, momenta};

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
    pub fn angular_velocity(x: &[f64; 4], d: &[f64; 4]) -> [f64; 3] {
        let [_, a, b, c] = conjugate_product(x, d);
        [a, b, c].map(|component| 2.0 * component)
    }

    /// `½ ωᵀ I ω`, J.
    pub fn energy(&self, omega: &[f64; 3]) -> f64 {
        0.5 * omega.iter().zip(&self.inertia).map(|(w, i)| i * w * w).sum::<f64>()
    }

    /// Spatial angular momentum of a step: the momentum map (2.22) of left multiplication by unit
    /// quaternions, `½ ⟨−h D₂𝕃, ξ ⋆ x⟩` for the three units `ξ`, N·m·s.
    pub fn discrete_momentum(&self, x: &[f64; 4], d: &[f64; 4], h: f64) -> [f64; 3] {
        let p = momenta(self, x, d, h).begin;
        [1, 2, 3].map(|unit| {
            let mut xi = [0.0; 4];
            xi[unit] = 1.0;
            let along = product(&xi, x);
            0.5 * p.iter().zip(&along).map(|(p, d)| p * d).sum::<f64>()
        })
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
        [v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3] - 1.0]
    }
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
