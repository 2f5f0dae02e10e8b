//! Articulated inertias along a limb of revolute joints: (3.51), (3.52) in the coordinates of each
//! joint, whose projection leaves a row and a column of zeros.
//!
//! # Notation
//! As in `forward_dynamics.rs`; `I` is the joint's axis, `(I, j, k)` cyclic, `ρ` its rotor inertia.

use super::lanes::{Lanes, V, cross, dot, plus, times, turned};

/// `P` of (3.36) in blocks, the coupling by columns; symmetric blocks as `(xx, yy, zz)` and
/// `(yz, zx, xy)`.
#[derive(Clone, Copy)]
pub(super) struct LimbInertia<L> {
    pub linear: [V<L>; 2],
    pub coupling: [V<L>; 3],
    pub angular: [V<L>; 2],
}

/// `F = P a' + z`.
#[derive(Clone, Copy)]
pub(super) struct Articulated<L> {
    pub inertia: LimbInertia<L>,
    /// `z`: force and torque.
    pub bias: [V<L>; 2],
}

/// What a joint's projection leaves for the outboard pass.
#[derive(Clone, Copy)]
pub(super) struct Projection<L> {
    /// `U`: force and torque.
    pub image: [V<L>; 2],
    /// `D⁻¹`
    pub inverse: L,
    /// `u`
    pub excess: L,
}

/// A revolute joint at one state.
pub(super) struct Hinge<L> {
    /// Cosine and sine.
    pub turn: (L, L),
    /// Of the joint, where it differs from zero, in the inboard frame.
    pub offset: Option<V<L>>,
    /// Inboard from this frame at home, rows, where they are not parallel.
    pub home: Option<[V<L>; 3]>,
    /// `ρ` where the tree has rotors.
    pub rotor: Option<L>,
    pub torque: L,
    /// Components `j` and `k` of the angular velocity product, `ω × H β`.
    pub product: [L; 2],
    /// The linear one, zero where the offset is.
    pub linear_product: V<L>,
}

impl<L: Lanes> Articulated<L> {
    /// Nothing.
    #[inline(always)]
    pub fn zero() -> Self {
        let none = [L::splat(nalgebra::zero()); 3];
        let inertia = LimbInertia { linear: [none; 2], coupling: [none; 3], angular: [none; 2] };
        Self { inertia, bias: [none; 2] }
    }
}

impl<L: Lanes> LimbInertia<L> {
    /// Entry `(row, column)` of a symmetric block.
    #[inline(always)]
    fn entry(block: &[V<L>; 2], i: usize, j: usize) -> L {
        if i == j { block[0][i] } else { block[1][3 - i - j] }
    }
}

/// `U`, `D` and `u` of a turn about axis `I`.
#[inline(always)]
pub(super) fn projection<L: Lanes, const I: usize>(
    of: &Articulated<L>,
    torque: L,
    rotor: Option<L>,
) -> (Projection<L>, L) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let p = &of.inertia;
    let mut column = p.angular[0];
    column[j] = p.angular[1][k];
    column[k] = p.angular[1][j];
    let d = rotor.map_or(column[I], |rotor| column[I] + rotor);
    let projection = Projection {
        image: [p.coupling[I], column],
        inverse: d.reciprocal(),
        excess: torque - of.bias[1][I],
    };
    (projection, d)
}

/// `Aᵀ (P − U D⁻¹ Uᵀ) A` and `Aᵀ (z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u)`: across a turn about axis `I`.
#[inline(always)]
pub(super) fn across_turn<L: Lanes, const I: usize>(
    of: &mut Articulated<L>,
    hinge: &Hinge<L>,
    projection: &Projection<L>,
) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let (p, z) = (&of.inertia, &of.bias);
    let [f, u] = &projection.image;
    let inverse = projection.inverse;

    // P − U D⁻¹ Uᵀ but for row and column I of the angular part, which are zero, or ρ D⁻¹ U with a rotor.
    let g = times(f, inverse);
    let (u_j, u_k) = (u[j] * inverse, u[k] * inverse);
    let minus = |a: L, b: L, c: L| a - b * c;
    let linear = [
        [0, 1, 2].map(|i| minus(p.linear[0][i], f[i], g[i])),
        [0, 1, 2].map(|i| minus(p.linear[1][i], f[(i + 1) % 3], g[(i + 2) % 3])),
    ];
    let column_j = [0, 1, 2].map(|i| minus(p.coupling[j][i], f[i], u_j));
    let column_k = [0, 1, 2].map(|i| minus(p.coupling[k][i], f[i], u_k));
    let jj = minus(p.angular[0][j], u[j], u_j);
    let kk = minus(p.angular[0][k], u[k], u_k);
    let jk = minus(p.angular[1][I], u[j], u_k);

    // The bias; its component I is τ where there is no rotor.
    let share = inverse * projection.excess;
    let [w_j, w_k] = hinge.product;
    let mut force =
        [0, 1, 2].map(|i| z[0][i] + column_j[i] * w_j + column_k[i] * w_k + f[i] * share);
    let mut torque = [hinge.torque; 3];
    torque[j] = z[1][j] + jj * w_j + jk * w_k + u[j] * share;
    torque[k] = z[1][k] + jk * w_j + kk * w_k + u[k] * share;
    if hinge.offset.is_some() {
        let v = &hinge.linear_product;
        for i in 0..3 {
            force[i] = force[i]
                + LimbInertia::entry(&linear, i, 0) * v[0]
                + LimbInertia::entry(&linear, i, 1) * v[1]
                + LimbInertia::entry(&linear, i, 2) * v[2];
        }
        torque[j] = torque[j] + dot(&column_j, v);
        torque[k] = torque[k] + dot(&column_k, v);
    }

    // Turned.
    let (c, s) = hinge.turn;
    let linear = turned_symmetric::<L, I>(hinge.turn, &linear);
    let (a, b) = (turned::<L, I>(hinge.turn, &column_j), turned::<L, I>(hinge.turn, &column_k));
    let zero = L::splat(nalgebra::zero());
    let mut inertia = LimbInertia { linear, coupling: [[zero; 3]; 3], angular: [[zero; 3]; 2] };
    inertia.coupling[j] = [0, 1, 2].map(|i| a[i] * c - b[i] * s);
    inertia.coupling[k] = [0, 1, 2].map(|i| a[i] * s + b[i] * c);
    let (difference, twice) = (jj - kk, jk + jk);
    let change = s * (s * difference + c * twice);
    inertia.angular[0][j] = jj - change;
    inertia.angular[0][k] = kk + change;
    inertia.angular[1][I] = jk + s * (c * difference - s * twice);
    if let Some(rotor) = hinge.rotor {
        let ratio = rotor * inverse;
        let v = &hinge.linear_product;
        torque[I] = z[1][I] + (dot(f, v) + u[j] * w_j + u[k] * w_k) * ratio + u[I] * share;
        inertia.coupling[I] = times(&turned::<L, I>(hinge.turn, f), ratio);
        let row = times(&turned::<L, I>(hinge.turn, u), ratio);
        inertia.angular[0][I] = row[I];
        inertia.angular[1][k] = row[j];
        inertia.angular[1][j] = row[k];
    }
    let mut bias = [turned::<L, I>(hinge.turn, &force), turned::<L, I>(hinge.turn, &torque)];
    if let Some(home) = &hinge.home {
        inertia = in_home(&inertia, home);
        bias = bias.map(|v| home.map(|row| dot(&row, &v)));
    }
    if let Some(arm) = &hinge.offset {
        bias[1] = plus(&bias[1], &cross(arm, &bias[0]));
        shift(&mut inertia, arm);
    }
    *of = Articulated { inertia, bias };
}

/// `R S Rᵀ` of a turn, by its block across the axis as in [`crate::spatial::AxisTurn`].
#[inline(always)]
fn turned_symmetric<L: Lanes, const I: usize>((c, s): (L, L), m: &[V<L>; 2]) -> [V<L>; 2] {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let [d, o] = m;
    let (twice, difference) = (o[I] + o[I], d[j] - d[k]);
    let change = s * (s * difference + c * twice);
    let mut turned = *m;
    turned[0][j] = d[j] - change;
    turned[0][k] = d[k] + change;
    turned[1][I] = o[I] + s * (c * difference - s * twice);
    turned[1][k] = c * o[k] - s * o[j];
    turned[1][j] = s * o[k] + c * o[j];
    turned
}

/// Seen from an origin from which this one lies at `arm`; as [`crate::spatial::ArticulatedInertia`] has it.
#[inline(always)]
fn shift<L: Lanes>(p: &mut LimbInertia<L>, r: &V<L>) {
    let m = |i, j| LimbInertia::entry(&p.linear, i, j);
    let o = p.coupling;
    let mut n = o;
    for i in 0..3 {
        n[0][i] = o[0][i] - (m(1, i) * r[2] - m(2, i) * r[1]);
        n[1][i] = o[1][i] - (m(2, i) * r[0] - m(0, i) * r[2]);
        n[2][i] = o[2][i] - (m(0, i) * r[1] - m(1, i) * r[0]);
    }
    p.coupling = n;
    for x in 0..3 {
        let (y, z) = ((x + 1) % 3, (x + 2) % 3);
        p.angular[0][x] =
            p.angular[0][x] + (r[y] * (n[x][z] + o[x][z]) - r[z] * (n[x][y] + o[x][y]));
        // Entry (y, z): row y of r̂ C', and (r̂ C)(z, y).
        p.angular[1][x] =
            p.angular[1][x] + (r[z] * n[z][x] - r[x] * n[z][z] + r[x] * o[y][y] - r[y] * o[y][x]);
    }
}

/// In the axes of the inboard frame, given as rows.
#[inline(always)]
fn in_home<L: Lanes>(p: &LimbInertia<L>, rows: &[V<L>; 3]) -> LimbInertia<L> {
    let symmetric = |block: &[V<L>; 2]| {
        let half = rows.map(|row| {
            [0, 1, 2].map(|j| dot(&row, &[0, 1, 2].map(|i| LimbInertia::entry(block, i, j))))
        });
        [
            [0, 1, 2].map(|i| dot(&half[i], &rows[i])),
            [0, 1, 2].map(|i| dot(&half[(i + 1) % 3], &rows[(i + 2) % 3])),
        ]
    };
    // R C by columns, then (R C) Rᵀ.
    let half = p.coupling.map(|column| rows.map(|row| dot(&row, &column)));
    LimbInertia {
        linear: symmetric(&p.linear),
        coupling: rows.map(|row| {
            [0, 1, 2].map(|i| half[0][i] * row[0] + half[1][i] * row[1] + half[2][i] * row[2])
        }),
        angular: symmetric(&p.angular),
    }
}
