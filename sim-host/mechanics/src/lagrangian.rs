//! What a person writes of a mechanical system.

use super::{Momenta, Scalar, differentiation};
use num_dual::Dual;

/// A mechanical system in the linear space `V = ℝᴺ` with `C` holonomic constraints (§2.3.1).
///
/// `L` and `g` are enough; a force may be added. The rest follows by differentiation.
pub trait Lagrangian<const N: usize, const C: usize> {
    /// `L(v, v̇)`, J.
    fn lagrangian<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> D;

    /// `g(v)`, zero on the configuration manifold.
    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C];

    /// `F(v, v̇)`: external and dissipative forces (§5.1), if there are any.
    fn force<D: Scalar>(&self, _v: &[D; N], _v_dot: &[D; N]) -> Option<[D; N]> {
        None
    }

    /// `D₂L · v̇ − L`, J.
    fn energy<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> D {
        let v = v.map(Dual::from_re);
        let v_dot = v_dot.map(|rate| Dual::new(rate, rate));
        let l = self.lagrangian(&v, &v_dot);
        l.eps - l.re
    }

    /// First derivatives of `L` along the directions `(α eᵢ, eᵢ)` in `(v, v̇)` (`begin`) and
    /// `(β eⱼ, eⱼ)` (`end`), and its second derivatives along both (`stiffness`).
    ///
    /// Only where speed asks for it need a system write its own.
    ///
    /// # Cost
    /// N² evaluations in hyper-dual numbers.
    fn slopes<D: Scalar>(
        &self,
        v: &[D; N],
        v_dot: &[D; N],
        alpha: f64,
        beta: f64,
    ) -> Momenta<N, D> {
        differentiation::momenta(v, v_dot, [alpha, 1.0], [beta, 1.0], |v, v_dot| {
            self.lagrangian(v, v_dot)
        })
    }

    /// `D₂₂L`, by rows, and `D₁L − D₁₂L v̇`: what multiplies the acceleration, and what is equal to it
    /// without constraints and forces.
    ///
    /// # Cost
    /// N² + 2 N evaluations.
    fn inertia_and_force<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> ([[D; N]; N], [D; N]) {
        let inertia = self.slopes(v, v_dot, 0.0, 0.0).stiffness;
        let carried = differentiation::along_path(v, v_dot, |v, v_dot| self.lagrangian(v, v_dot));
        let still = v_dot.map(Dual::from_re);
        let (_, [slope]) = differentiation::jacobian(v, |v| [self.lagrangian(v, &still)]);
        (inertia, std::array::from_fn(|i| slope[i] - carried[i]))
    }
}
