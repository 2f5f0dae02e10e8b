//! Systems whose Lagrangian is kinetic energy of constant masses less a potential (2.29).

use super::{Lagrangian, Scalar};

/// `L = ½ v̇ᵀ M v̇ − V(v)` with a diagonal `M`, and `C` constraints.
pub trait Natural<const N: usize, const C: usize> {
    /// Diagonal of `M`.
    fn masses(&self) -> [f64; N];

    /// `V(v)`, J.
    fn potential<D: Scalar>(&self, v: &[D; N]) -> D;

    /// `g(v)`
    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C];

    /// Kinetic and potential energy, J.
    fn energy(&self, v: &[f64; N], v_dot: &[f64; N]) -> f64 {
        let kinetic: f64 = self.masses().iter().zip(v_dot).map(|(m, v)| m * v * v).sum();
        0.5 * kinetic + self.potential(v)
    }
}

impl<const N: usize, const C: usize, S: Natural<N, C>> Lagrangian<N, C> for S {
    fn lagrangian<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> D {
        let mut kinetic = D::from(0.0);
        for (mass, rate) in self.masses().into_iter().zip(v_dot) {
            kinetic += *rate * *rate * (0.5 * mass);
        }
        kinetic - self.potential(v)
    }

    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C] {
        Natural::constraints(self, v)
    }
}
