//! The equations of motion of a body that floats: `P a + z = τ` by blocks of three.
//!
//! # Notation
//! `A, C, D` blocks of `P` (3.36), `S = D − Cᵀ A⁻¹ C`:
//! `S ω̇ = n − Cᵀ A⁻¹ f`, `A a = f − C ω̇`.

use crate::Real;
use crate::spatial::{ArticulatedInertia, SymmetricMatrix3, Twist, Wrench};
use nalgebra::Vector3;

/// The acceleration `P⁻¹ F`; `None` where `P` is not positive definite.
#[inline(always)]
pub(super) fn acceleration<T: Real>(
    p: &ArticulatedInertia<T>,
    wrench: &Wrench<T>,
) -> Option<Twist<T>> {
    let c = &p.coupling;
    let a_inverse = p.linear.inverse()?;
    let [x, y, z] = c.data.0.map(Vector3::from);
    let [kx, ky, kz] = [x, y, z].map(|column| a_inverse.product(column));
    let schur = SymmetricMatrix3 {
        diagonal: p.angular.diagonal - Vector3::new(x.dot(&kx), y.dot(&ky), z.dot(&kz)),
        off_diagonal: p.angular.off_diagonal - Vector3::new(y.dot(&kz), z.dot(&kx), x.dot(&ky)),
    };
    let f = a_inverse.product(wrench.force);
    let moment = wrench.torque - Vector3::new(x.dot(&f), y.dot(&f), z.dot(&f));
    let angular = schur.inverse()?.product(moment);
    Some(Twist { linear: f - (kx * angular.x + ky * angular.y + kz * angular.z), angular })
}
