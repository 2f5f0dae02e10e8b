//! Trees of bodies: the constants that every algorithm reads.

use super::compile_time::{
    IDENTITY, M, V, frame_with_z, matrix_of_quaternion, minus, normalized, product, times,
    transpose,
};
use super::link::Connection;
use super::node::EMPTY;
use super::{Axis, InertiaShape, JointKind, Link, Node};
use crate::spatial::{RigidInertia, SymmetricMatrix3};
use nalgebra::{Matrix3, Vector3};

/// A tree of `N` bodies with `NQ` coordinates and `NV` velocities, in precision `T`.
///
/// Bodies are numbered from 0 in arrays (the dissertation's link k is index k − 1). A tree is
/// constant data: build it in a `const` or `static`, and an ill-formed one does not compile:
///
/// ```compile_fail
/// use surefoot::model::{Link, Tree};
/// // Link 1 hangs from link 2, which comes later: error at compile time.
/// const TREE: Tree<f64, 2, 2, 2> = Tree::new([
///     Link::revolute(2, [0.0, 0.0, 1.0], [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]),
///     Link::revolute(1, [0.0, 0.0, 1.0], [0.0; 3]).body(1.0, [0.1; 3], [0.0; 3]),
/// ]);
/// let _ = &TREE;
/// ```
/// ```compile_fail
/// use surefoot::model::{Link, Tree};
/// // A floating body has 7 coordinates and 6 velocities, not 6 and 6: error at compile time.
/// const TREE: Tree<f64, 1, 6, 6> =
///     Tree::new([Link::floating(0).body(1.0, [0.1; 3], [0.0; 3])]);
/// let _ = &TREE;
/// ```
/// ```compile_fail
/// use surefoot::model::{Link, Tree};
/// // No body has the principal inertias (1, 1, 3): error at compile time.
/// const TREE: Tree<f64, 1, 7, 6> =
///     Tree::new([Link::floating(0).body(1.0, [1.0, 1.0, 3.0], [0.0; 3])]);
/// let _ = &TREE;
/// ```
/// ```
/// use surefoot::model::{Link, Tree};
/// const TREE: Tree<f64, 1, 7, 6> =
///     Tree::new([Link::floating(0).body(1.0, [1.0, 2.0, 3.0], [0.0; 3])]);
/// const TREE_F32: Tree<f32, 1, 7, 6> = TREE.to_f32();
/// assert_eq!(TREE.mass(), 1.0);
/// # let _ = TREE_F32;
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tree<T, const N: usize, const NQ: usize, const NV: usize> {
    pub(crate) nodes: [Node<T>; N],
    pub(crate) gravity: Vector3<T>,
}

/// Standard gravity of the dissertation (§4.3), m/s².
const GRAVITY: f64 = 9.81;

impl<const N: usize, const NQ: usize, const NV: usize> Tree<f64, N, NQ, NV> {
    /// Builds a tree from its links, inboard ones first. Gravity is 9.81 m/s² along −z.
    ///
    /// # Panics
    /// At compile time, when used in a `const`, where a link hangs from itself or a later link, where
    /// `NQ` or `NV` is not the sum over the joints, where an axis has no length, a quaternion no unit
    /// norm, an inertia is none that a body can have, or a leaf has no mass.
    pub const fn new(links: [Link; N]) -> Self {
        assert!(N > 0, "a tree has at least one body");
        let mut frames = [IDENTITY; N];
        let mut origins = [[0.0; 3]; N];
        let mut is_leaf = [true; N];
        let mut positions = 0;
        let mut velocities = 0;
        let mut nodes = [EMPTY; N];
        let mut k = 0;
        while k < N {
            let link = &links[k];
            assert!(
                link.inboard <= k,
                "a link's inboard link comes before it (0 is the inertial frame, 1 the first link)"
            );
            let (inboard, inboard_frame, inboard_origin) = if link.inboard == 0 {
                (None, IDENTITY, [0.0; 3])
            } else {
                is_leaf[link.inboard - 1] = false;
                (Some(link.inboard - 1), frames[link.inboard - 1], origins[link.inboard - 1])
            };
            let body_frame = matrix_of_quaternion(link.orientation);
            check_inertia(link.mass, link.inertia);

            let (kind, frame, origin) = joint_frame(link, inboard_frame, body_frame);
            frames[k] = frame;
            origins[k] = origin;
            nodes[k] = node(link, kind, inboard, inboard_frame, inboard_origin, frame, origin);
            nodes[k].position_start = positions;
            nodes[k].velocity_start = velocities;
            positions += kind.coordinates();
            velocities += kind.degrees_of_freedom();
            k += 1;
        }
        assert!(positions == NQ, "NQ is not the number of joint coordinates of these links");
        assert!(velocities == NV, "NV is not the number of joint velocities of these links");
        let mut k = 0;
        while k < N {
            assert!(
                !is_leaf[k] || links[k].mass > 0.0,
                "the last link of a branch needs a mass, or its joint can have no acceleration"
            );
            k += 1;
        }
        Self { nodes, gravity: Vector3::new(0.0, 0.0, -GRAVITY) }
    }

    /// The same tree under another gravity (m/s², inertial frame).
    pub const fn with_gravity(self, gravity: [f64; 3]) -> Self {
        let [x, y, z] = gravity;
        Self { nodes: self.nodes, gravity: Vector3::new(x, y, z) }
    }
}

impl<T: crate::Real, const N: usize, const NQ: usize, const NV: usize> Tree<T, N, NQ, NV> {
    /// Total mass (kg).
    pub fn mass(&self) -> T {
        self.nodes.iter().fold(T::zero(), |sum, node| sum + node.inertia.mass)
    }

    /// Mass of body `k` (kg), or `None` where there is no such body.
    pub fn body_mass(&self, k: usize) -> Option<T> {
        self.nodes.get(k).map(|node| node.inertia.mass)
    }

    /// Gravity (m/s²) in the inertial frame.
    pub fn gravity(&self) -> Vector3<T> {
        self.gravity
    }

    /// Kind of joint `k`, the one that carries body `k`.
    pub fn joint(&self, k: usize) -> Option<&JointKind> {
        self.nodes.get(k).map(|node| &node.kind)
    }

    /// Index of the body that carries body `k`; `None` for the inertial frame.
    pub fn inboard(&self, k: usize) -> Option<usize> {
        self.nodes.get(k).and_then(|node| node.inboard)
    }

    /// Where the coordinates and velocities of joint `k` start in the arrays of the whole tree.
    pub fn starts(&self, k: usize) -> Option<(usize, usize)> {
        self.nodes.get(k).map(|node| (node.position_start, node.velocity_start))
    }
}

/// Kind, axes at home (columns) and origin at home of a link's joint frame.
const fn joint_frame(link: &Link, inboard_frame: M, body_frame: M) -> (JointKind, M, V) {
    match link.connection {
        // At the centre of mass: a body fixed to its inboard one has no joint of its own.
        Connection::Fixed => (JointKind::Fixed, inboard_frame, link.center),
        Connection::Revolute { axis, point } => {
            let (axis, frame) = aligned_frame(axis, inboard_frame);
            (JointKind::Revolute(axis), frame, point)
        }
        Connection::Prismatic { axis } => {
            let (axis, frame) = aligned_frame(axis, inboard_frame);
            (JointKind::Prismatic(axis), frame, link.center)
        }
        Connection::Spherical { point } => (JointKind::Spherical, IDENTITY, point),
        Connection::Floating => (JointKind::Floating, body_frame, link.center),
        Connection::General { point, joint } => (JointKind::General(joint), IDENTITY, point),
    }
}

/// A joint frame with a coordinate axis along `axis`: parallel to the inboard frame where one of that
/// frame's axes points along it, so that the joint's rotation is a turn about it and nothing more.
const fn aligned_frame(axis: V, inboard_frame: M) -> (Axis, M) {
    let direction = normalized(axis);
    let seen = times(transpose(inboard_frame), direction);
    let close = 1.0 - 1e-14;
    if seen[0] > close {
        (Axis::X, inboard_frame)
    } else if seen[1] > close {
        (Axis::Y, inboard_frame)
    } else if seen[2] > close {
        (Axis::Z, inboard_frame)
    } else {
        (Axis::Z, frame_with_z(direction))
    }
}

const fn node(
    link: &Link,
    kind: JointKind,
    inboard: Option<usize>,
    inboard_frame: M,
    inboard_origin: V,
    frame: M,
    origin: V,
) -> Node<f64> {
    // A floating joint's coordinates are the pose itself: there is no offset and no home rotation.
    let floating = matches!(kind, JointKind::Floating);
    // The inboard frame of a floating link that hangs from a body would be that body's joint frame.
    assert!(
        !floating || inboard.is_none(),
        "a floating joint carries a body relative to the inertial frame: its inboard link is 0"
    );
    let to_inboard = transpose(inboard_frame);
    let offset = if floating { [0.0; 3] } else { times(to_inboard, minus(origin, inboard_origin)) };
    let home_rotation = if floating { IDENTITY } else { product(to_inboard, frame) };
    let to_frame = transpose(frame);
    let body_rotation = product(to_frame, matrix_of_quaternion(link.orientation));
    let center = times(to_frame, minus(link.center, origin));

    // Inertia about the centre of mass in the joint frame's axes, R I Rᵀ, then about the origin.
    let [xx, yy, zz, yz, zx, xy] = link.inertia;
    let central = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let c = product(product(body_rotation, central), transpose(body_rotation));
    let [x, y, z] = center;
    let m = link.mass;
    let products = [c[1][2] - m * y * z, c[2][0] - m * z * x, c[0][1] - m * x * y];
    let shape = if !is_zero(products) {
        InertiaShape::Full
    } else if is_zero(center) && c[0][0] == c[1][1] && c[1][1] == c[2][2] {
        InertiaShape::Isotropic
    } else {
        InertiaShape::Diagonal
    };
    Node {
        kind,
        inboard,
        position_start: 0,
        velocity_start: 0,
        offset: vector(offset),
        is_offset: !is_zero(offset),
        home_rotation: matrix_unless_identity(home_rotation),
        inertia: RigidInertia {
            mass: m,
            first_moment: Vector3::new(m * x, m * y, m * z),
            rotational: SymmetricMatrix3 {
                diagonal: Vector3::new(
                    c[0][0] + m * (y * y + z * z),
                    c[1][1] + m * (z * z + x * x),
                    c[2][2] + m * (x * x + y * y),
                ),
                off_diagonal: vector(products),
            },
        },
        is_eccentric: !is_zero(center),
        shape,
        center: vector(center),
        body_rotation: matrix_unless_identity(body_rotation),
    }
}

/// Refuses what no body can have. A body without mass and inertia is allowed inside a branch.
const fn check_inertia(mass: f64, inertia: [f64; 6]) {
    assert!(mass >= 0.0 && mass.is_finite(), "a mass is finite and not negative");
    let [xx, yy, zz, yz, zx, xy] = inertia;
    let sum = xx + yy + zz;
    assert!(
        sum.is_finite() && yz.is_finite() && zx.is_finite() && xy.is_finite(),
        "an inertia is finite"
    );
    if mass == 0.0 && sum == 0.0 {
        return;
    }
    // The second moments of the mass, ½ tr(I) 1 − I, form a positive semi-definite matrix
    // (equivalently, principal inertias obey the triangle inequality). Its minors, with a margin for
    // the rounding of printed data:
    let (a, b, c) = (0.5 * sum - xx, 0.5 * sum - yy, 0.5 * sum - zz);
    let slack = 1e-9 * sum;
    assert!(
        xx >= 0.0 && yy >= 0.0 && zz >= 0.0 && a >= -slack && b >= -slack && c >= -slack,
        "no body has this inertia: one principal moment exceeds the sum of the other two"
    );
    let determinant = a * (b * c - yz * yz) - xy * (xy * c + yz * zx) - zx * (xy * yz + b * zx);
    assert!(
        a * b - xy * xy >= -slack * sum
            && b * c - yz * yz >= -slack * sum
            && c * a - zx * zx >= -slack * sum
            && determinant >= -slack * sum * sum,
        "no body has this inertia: its products are too large for its moments"
    );
}

const fn is_zero(v: V) -> bool {
    v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0
}

const fn vector(v: V) -> Vector3<f64> {
    Vector3::new(v[0], v[1], v[2])
}

const fn matrix_unless_identity(m: M) -> Option<Matrix3<f64>> {
    let mut i = 0;
    let mut difference = 0.0;
    while i < 9 {
        difference += (m[i / 3][i % 3] - IDENTITY[i / 3][i % 3]).abs();
        i += 1;
    }
    // Products of exact rotations leave round-off behind.
    if difference < 1e-14 {
        return None;
    }
    Some(Matrix3::new(
        m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2],
    ))
}
