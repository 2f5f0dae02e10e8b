//! Systems whose Lagrangian is kinetic energy of constant masses less a potential (2.29).

use super::{Lagrangian, Momenta, Scalar, hessian, jacobian};

/// `L = ½ v̇ᵀ M v̇ − V(v)` with a diagonal `M`, and `C` constraints. Every such system is a
/// [`Lagrangian`], and the methods that need this form take it too.
pub trait Natural<const N: usize, const C: usize> {
    /// Diagonal of `M`.
    fn masses(&self) -> [f64; N];

    /// `V(v)`, J.
    fn potential<D: Scalar>(&self, v: &[D; N]) -> D;

    /// `g(v)`
    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C];

    /// `F(v, v̇)`: external and dissipative forces (§5.1), if there are any.
    fn force<D: Scalar>(&self, _v: &[D; N], _v_dot: &[D; N]) -> Option<[D; N]> {
        None
    }
}

/// `−DᵀV(v)`
pub fn potential_force<D: Scalar, const N: usize, const C: usize>(
    system: &impl Natural<N, C>,
    v: &[D; N],
) -> [D; N] {
    let (_, [slope]) = jacobian(v, |v| [system.potential(v)]);
    slope.map(|slope| -slope)
}

/// With derivatives written out, as tables 2.2's times ask for it: masses are constant, and the
/// potential knows no velocity.
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

    fn force<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> Option<[D; N]> {
        Natural::force(self, v, v_dot)
    }

    fn slopes<D: Scalar>(
        &self,
        v: &[D; N],
        v_dot: &[D; N],
        alpha: f64,
        beta: f64,
    ) -> Momenta<N, D> {
        let masses = self.masses();
        let (slope, bend) = if alpha == 0.0 && beta == 0.0 {
            ([D::from(0.0); N], None)
        } else if alpha == 0.0 || beta == 0.0 {
            (potential_force(self, v).map(|f| -f), None)
        } else {
            let (slope, bend) = hessian(v, |v| self.potential(v));
            (slope, Some(bend))
        };
        let momentum = |share: f64| -> [D; N] {
            std::array::from_fn(|i| v_dot[i] * masses[i] - slope[i] * share)
        };
        let mut stiffness = match bend {
            None => [[D::from(0.0); N]; N],
            Some(bend) => bend.map(|row| row.map(|x| x * (-alpha * beta))),
        };
        for i in 0..N {
            stiffness[i][i] += masses[i];
        }
        Momenta { begin: momentum(alpha), end: momentum(beta), stiffness }
    }

    fn inertia_and_force<D: Scalar>(&self, v: &[D; N], _: &[D; N]) -> ([[D; N]; N], [D; N]) {
        let mut inertia = [[D::from(0.0); N]; N];
        for (i, mass) in self.masses().into_iter().enumerate() {
            inertia[i][i] = D::from(mass);
        }
        (inertia, potential_force(self, v))
    }
}
