//! What a person writes of a mechanical system.

use num_dual::DualNum;

/// A number, or one that carries its derivatives along.
pub trait Scalar: DualNum<Primitive = f64> + Copy {}

impl<D: DualNum<Primitive = f64> + Copy> Scalar for D {}

/// A mechanical system in the linear space `V = ℝᴺ` with `C` holonomic constraints (§2.3.1).
pub trait Lagrangian<const N: usize, const C: usize> {
    /// `L(v, v̇)`, J.
    fn lagrangian<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> D;

    /// `g(v)`, zero on the configuration manifold.
    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C];
}
