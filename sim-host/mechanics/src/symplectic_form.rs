//! The symplectic form of displacements.
//!
//! How a displacement is carried along by a method needs no tangent map of its own: a motion started
//! in dual numbers carries it in their derivative parts, exactly.

use super::{Lagrangian, jacobian};
use num_dual::{Dual, Dual64};

/// A displacement of configuration and momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement<const N: usize> {
    /// `δx`
    pub configuration: [f64; N],
    /// `δp`
    pub momentum: [f64; N],
}

impl<const N: usize> Displacement<N> {
    /// The derivative parts of a state, with the momentum `p = D₂L`.
    pub fn of<const C: usize>(
        system: &impl Lagrangian<N, C>,
        x: &[Dual64; N],
        v_dot: &[Dual64; N],
    ) -> Self {
        let still = x.map(Dual::from_re);
        let (_, [momentum]) = jacobian(v_dot, |v_dot| [system.lagrangian(&still, v_dot)]);
        Self { configuration: x.map(|x| x.eps), momentum: momentum.map(|p| p.eps) }
    }
}

/// The canonical symplectic form (2.10) of two displacements: `δ₁x · δ₂p − δ₂x · δ₁p`.
pub fn symplectic_form<const N: usize>(a: &Displacement<N>, b: &Displacement<N>) -> f64 {
    (0..N).map(|i| a.configuration[i] * b.momentum[i] - b.configuration[i] * a.momentum[i]).sum()
}
