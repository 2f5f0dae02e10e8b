//! Exact derivatives, by dual and hyper-dual numbers (Fike and Alonso 2011): no difference quotients,
//! so no step to choose. Their parts may carry derivatives themselves.

use super::Scalar;
use num_dual::{Dual, HyperDual};

/// The discrete momenta of a step from `x` with mean velocity `d`: the fibre derivatives (2.4) at both
/// its ends, scaled so that they tend to `D₂L` as the step does to zero (§2.3.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momenta<const N: usize, D = f64> {
    /// `−h D₂𝕃(y, x)`: momentum at the beginning, in `x`.
    pub begin: [D; N],
    /// `h D₁𝕃(y, x)`: momentum at the end, in `y`.
    pub end: [D; N],
    /// Derivative of `begin` with respect to `d`, by rows: `−h² D₁₂𝕃` of (2.43).
    pub stiffness: [[D; N]; N],
}

/// Derivatives of a function of `(a, b)` along `begin[0] eᵢ, begin[1] eᵢ`, along the same of `end`, and
/// along both.
pub(super) fn momenta<D: Scalar, const N: usize>(
    a: &[D; N],
    b: &[D; N],
    begin: [f64; 2],
    end: [f64; 2],
    function: impl Fn(&[HyperDual<D>; N], &[HyperDual<D>; N]) -> HyperDual<D>,
) -> Momenta<N, D> {
    let zero = D::from(0.0);
    let mut all = Momenta { begin: [zero; N], end: [zero; N], stiffness: [[zero; N]; N] };
    let mut a = a.map(HyperDual::from_re);
    let mut b = b.map(HyperDual::from_re);
    for i in 0..N {
        (a[i].eps1, b[i].eps1) = (D::from(begin[0]), D::from(begin[1]));
        for j in 0..N {
            (a[j].eps2, b[j].eps2) = (D::from(end[0]), D::from(end[1]));
            let value = function(&a, &b);
            all.begin[i] = value.eps1;
            all.end[j] = value.eps2;
            all.stiffness[i][j] = value.eps1eps2;
            (a[j].eps2, b[j].eps2) = (zero, zero);
        }
        (a[i].eps1, b[i].eps1) = (zero, zero);
    }
    all
}

/// Derivatives along `eᵢ` in `b` of a function of `(a, b)`, as `a` moves at the rate `b`.
pub(super) fn along_path<D: Scalar, const N: usize>(
    a: &[D; N],
    b: &[D; N],
    function: impl Fn(&[HyperDual<D>; N], &[HyperDual<D>; N]) -> HyperDual<D>,
) -> [D; N] {
    let zero = D::from(0.0);
    let moving = std::array::from_fn(|k| HyperDual::new(a[k], zero, b[k], zero));
    let mut b = b.map(HyperDual::from_re);
    std::array::from_fn(|i| {
        b[i].eps1 = D::from(1.0);
        let value = function(&moving, &b).eps1eps2;
        b[i].eps1 = zero;
        value
    })
}

/// A function's values and its Jacobian by rows, such as `g(v)` and `Dg(v)`.
pub fn jacobian<D: Scalar, const N: usize, const C: usize>(
    v: &[D; N],
    function: impl Fn(&[Dual<D>; N]) -> [Dual<D>; C],
) -> ([D; C], [[D; N]; C]) {
    let mut values = [D::from(0.0); C];
    let mut rows = [[D::from(0.0); N]; C];
    let mut dual = v.map(Dual::from_re);
    for j in 0..N {
        dual[j].eps = D::from(1.0);
        for ((value, row), g) in values.iter_mut().zip(&mut rows).zip(function(&dual)) {
            *value = g.re;
            row[j] = g.eps;
        }
        dual[j].eps = D::from(0.0);
    }
    (values, rows)
}

/// Gradient and Hessian of a function.
pub fn hessian<D: Scalar, const N: usize>(
    v: &[D; N],
    function: impl Fn(&[HyperDual<D>; N]) -> HyperDual<D>,
) -> ([D; N], [[D; N]; N]) {
    let zero = D::from(0.0);
    let mut gradient = [zero; N];
    let mut hessian = [[zero; N]; N];
    let mut dual = v.map(HyperDual::from_re);
    for i in 0..N {
        dual[i].eps1 = D::from(1.0);
        for j in 0..=i {
            dual[j].eps2 = D::from(1.0);
            let value = function(&dual);
            gradient[i] = value.eps1;
            hessian[i][j] = value.eps1eps2;
            hessian[j][i] = value.eps1eps2;
            dual[j].eps2 = zero;
        }
        dual[i].eps1 = zero;
    }
    (gradient, hessian)
}

/// Second derivative of functions along one direction, twice: `D²g(v̇, v̇)`.
pub fn bend<D: Scalar, const N: usize, const C: usize>(
    v: &[D; N],
    v_dot: &[D; N],
    function: impl Fn(&[HyperDual<D>; N]) -> [HyperDual<D>; C],
) -> [D; C] {
    let line = std::array::from_fn(|i| HyperDual::new(v[i], v_dot[i], v_dot[i], D::from(0.0)));
    function(&line).map(|g| g.eps1eps2)
}

/// `a + λᵀ b`, as constraints enter beside a potential, for numbers one level of derivatives above
/// the multipliers.
pub fn augmented<T: Scalar, const C: usize>(a: T, lambda: &[T::InnerDual; C], b: [T; C]) -> T {
    b.into_iter().zip(lambda).fold(a, |sum, (b, lambda)| sum + b.scale(lambda))
}
