//! Arithmetic on plain arrays that the compiler can do: everything here runs while a tree is built,
//! nothing of it while a robot moves.

pub(super) type V = [f64; 3];
pub(super) type M = [[f64; 3]; 3];

pub(super) const IDENTITY: M = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(super) const fn minus(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) const fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) const fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) const fn scale(a: V, factor: f64) -> V {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

pub(super) const fn transpose(m: M) -> M {
    [[m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]], [m[0][2], m[1][2], m[2][2]]]
}

pub(super) const fn times(m: M, v: V) -> V {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

pub(super) const fn product(a: M, b: M) -> M {
    let t = transpose(b);
    [
        [dot(a[0], t[0]), dot(a[0], t[1]), dot(a[0], t[2])],
        [dot(a[1], t[0]), dot(a[1], t[1]), dot(a[1], t[2])],
        [dot(a[2], t[0]), dot(a[2], t[1]), dot(a[2], t[2])],
    ]
}

/// Square root by Newton's iteration, which decreases to the root from above.
pub(crate) const fn square_root(x: f64) -> f64 {
    assert!(x >= 0.0 && x.is_finite(), "square root of a negative or infinite number");
    if x == 0.0 {
        return 0.0;
    }
    let mut root = if x > 1.0 { x } else { 1.0 };
    let mut next = 0.5 * (root + x / root);
    while next < root {
        root = next;
        next = 0.5 * (root + x / root);
    }
    root
}

/// The unit vector along `v`, or `None` where `v` is zero or not finite.
pub(super) const fn normalized(v: V) -> Option<V> {
    if !is_finite(v) {
        return None;
    }
    let [x, y, z] = [v[0].abs(), v[1].abs(), v[2].abs()];
    let xy = if x > y { x } else { y };
    let largest = if xy > z { xy } else { z };
    if largest == 0.0 {
        return None;
    }
    // Scaled, so that no square overflows or vanishes.
    Some(unit([v[0] / largest, v[1] / largest, v[2] / largest]))
}

/// The same for a vector of moderate length.
const fn unit(v: V) -> V {
    scale(v, 1.0 / square_root(dot(v, v)))
}

pub(super) const fn is_finite(v: V) -> bool {
    v[0].is_finite() && v[1].is_finite() && v[2].is_finite()
}

/// Sine by its Taylor series, for constants such as a tilt given in degrees.
pub(super) const fn sine(x: f64) -> f64 {
    assert!(x > -3.2 && x < 3.2, "the angle of a constant is given within half a turn");
    let mut term = x;
    let mut sum = x;
    let mut n = 1.0;
    while n < 40.0 {
        term *= -x * x / ((n + 1.0) * (n + 2.0));
        sum += term;
        n += 2.0;
    }
    sum
}

/// Cosine, likewise.
pub(super) const fn cosine(x: f64) -> f64 {
    let s = sine(0.5 * x);
    1.0 - 2.0 * s * s
}

/// The rotation of a unit quaternion, scalar first; `None` where its squared norm is off by 1 in 10⁶.
pub(super) const fn matrix_of_quaternion(q: [f64; 4]) -> Option<M> {
    let [s, x, y, z] = q;
    let norm = s * s + x * x + y * y + z * z;
    if !(norm > 0.999_999 && norm < 1.000_001) {
        return None;
    }
    let f = 2.0 / norm;
    Some([
        [1.0 - f * (y * y + z * z), f * (x * y - s * z), f * (x * z + s * y)],
        [f * (x * y + s * z), 1.0 - f * (x * x + z * z), f * (y * z - s * x)],
        [f * (x * z - s * y), f * (y * z + s * x), 1.0 - f * (x * x + y * y)],
    ])
}

/// A right-handed frame, as a matrix of columns, whose z axis is the unit vector `n`.
pub(super) const fn frame_with_z(n: V) -> M {
    // The coordinate axis farthest from n gives the best conditioned x axis.
    let helper = if n[0].abs() <= n[1].abs() && n[0].abs() <= n[2].abs() {
        [1.0, 0.0, 0.0]
    } else if n[1].abs() <= n[2].abs() {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let x = unit(cross(helper, n));
    transpose([x, cross(n, x), n])
}
