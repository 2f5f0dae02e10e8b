//! Trees of bodies: the constants that every algorithm reads.

use super::body_check::check_body;
use super::compile_time::{
    IDENTITY, M, V, dot, frame_with_z, is_finite, matrix_of_quaternion, minus, normalized, product,
    times, transpose,
};
use super::limbs::with_limbs;
use super::link::Connection;
use super::node::EMPTY;
use super::{Axis, InertiaShape, JointKind, Link, LinkFault, Node, TreeFault};
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
    /// Whether some joint's coordinate counts against its frame's axis.
    pub(crate) has_reversed: bool,
    /// Whether some joint has a rotor.
    pub(crate) has_rotors: bool,
    pub(crate) gravity: Vector3<T>,
}

/// Standard gravity of the dissertation (§4.3), m/s².
const GRAVITY: f64 = 9.81;

impl<const N: usize, const NQ: usize, const NV: usize> Tree<f64, N, NQ, NV> {
    /// Builds a tree from its links, inboard ones first. Gravity is 9.81 m/s² along −z.
    ///
    /// # Panics
    /// At compile time, when used in a `const`, where [`Tree::try_new`] gives a fault. For links that
    /// are known only when the program runs, use that one.
    pub const fn new(links: [Link; N]) -> Self {
        match Self::try_new(links) {
            Ok(tree) => tree,
            Err(fault) => panic!("{}", fault.message()),
        }
    }

    /// The same for links from a file or a program: what is wrong comes back as a value.
    ///
    /// # Errors
    /// A [`TreeFault`] with the index of the first link that is wrong and the reason: it hangs from
    /// itself or a later link, a number is not finite, an axis has no length, a quaternion no unit
    /// norm, an inertia is none that a body can have, or it ends a branch and has no mass; or `NQ` or
    /// `NV` is not the sum over the joints.
    ///
    /// # Accuracy
    /// Everything is computed in f64. An axis that is within 8 units of the last place of one of the
    /// inboard frame's (1.8·10⁻¹⁵ rad) is taken for it; any other keeps its direction.
    ///
    /// ```
    /// use surefoot::model::{Link, LinkFault, Tree, TreeFault};
    /// let link = Link::revolute(0, [0.0, 0.0, 1.0], [0.0; 3]).body(1.0, [0.1, 0.1, 0.3], [0.0; 3]);
    /// let fault = Tree::<f64, 1, 1, 1>::try_new([link]).expect_err("no body");
    /// assert_eq!(fault, TreeFault::Link { index: 0, reason: LinkFault::Moments });
    /// ```
    pub const fn try_new(links: [Link; N]) -> Result<Self, TreeFault> {
        if N == 0 {
            return Err(TreeFault::Empty);
        }
        let mut homes = [Home { axes: IDENTITY, origin: [0.0; 3] }; N];
        let mut is_leaf = [true; N];
        let mut positions = 0;
        let mut velocities = 0;
        let (mut has_reversed, mut has_rotors) = (false, false);
        let mut nodes = [EMPTY; N];
        let mut k = 0;
        while k < N {
            let link = &links[k];
            if link.inboard > k {
                return Err(TreeFault::Link { index: k, reason: LinkFault::Inboard });
            }
            let (inboard, from) = if link.inboard == 0 {
                (None, Home { axes: IDENTITY, origin: [0.0; 3] })
            } else {
                is_leaf[link.inboard - 1] = false;
                (Some(link.inboard - 1), homes[link.inboard - 1])
            };
            match node(link, inboard, from) {
                Ok((node, home)) => {
                    nodes[k] = node;
                    homes[k] = home;
                }
                Err(reason) => return Err(TreeFault::Link { index: k, reason }),
            }
            nodes[k].position_start = positions;
            nodes[k].velocity_start = velocities;
            has_reversed = has_reversed || nodes[k].is_reversed;
            has_rotors = has_rotors || nodes[k].rotor_inertia > 0.0;
            positions += nodes[k].kind.coordinates();
            velocities += nodes[k].kind.degrees_of_freedom();
            k += 1;
        }
        let mut k = 0;
        while k < N {
            if is_leaf[k] && links[k].mass == 0.0 && links[k].rotor_inertia == 0.0 {
                return Err(TreeFault::Link { index: k, reason: LinkFault::LeafWithoutMass });
            }
            k += 1;
        }
        if positions != NQ {
            return Err(TreeFault::Coordinates { given: NQ, needed: positions });
        }
        if velocities != NV {
            return Err(TreeFault::Velocities { given: NV, needed: velocities });
        }
        let nodes = with_limbs(nodes);
        Ok(Self { nodes, has_reversed, has_rotors, gravity: Vector3::new(0.0, 0.0, -GRAVITY) })
    }

    /// The same tree under another gravity (m/s², inertial frame).
    pub const fn with_gravity(self, gravity: [f64; 3]) -> Self {
        let [x, y, z] = gravity;
        Self { gravity: Vector3::new(x, y, z), ..self }
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

/// A joint frame at home, in the describing frame.
#[derive(Clone, Copy)]
struct Home {
    /// Columns.
    axes: M,
    origin: V,
}

/// What a link's connection makes of its joint.
struct Joint {
    kind: JointKind,
    /// Whether the coordinate counts against the frame's axis.
    is_reversed: bool,
    home: Home,
}

const fn joint(link: &Link, inboard_axes: M, body_axes: M) -> Result<Joint, LinkFault> {
    let (kind, axes, origin) = match link.connection {
        // At the centre of mass: a body fixed to its inboard one has no joint of its own.
        Connection::Fixed => (JointKind::Fixed, inboard_axes, link.center),
        Connection::Revolute { axis, point } => {
            let Some((axis, is_reversed, axes)) = aligned_frame(axis, inboard_axes) else {
                return Err(LinkFault::Axis);
            };
            let home = Home { axes, origin: point };
            return Ok(Joint { kind: JointKind::Revolute(axis), is_reversed, home });
        }
        Connection::Prismatic { axis } => {
            let Some((axis, is_reversed, axes)) = aligned_frame(axis, inboard_axes) else {
                return Err(LinkFault::Axis);
            };
            let home = Home { axes, origin: link.center };
            return Ok(Joint { kind: JointKind::Prismatic(axis), is_reversed, home });
        }
        Connection::Spherical { point } => (JointKind::Spherical, IDENTITY, point),
        Connection::Floating => (JointKind::Floating, body_axes, link.center),
        Connection::General { point, joint } => {
            let (d, e) = (joint.degrees_of_freedom, joint.coordinates);
            if !(1 <= d && d <= 6 && d <= e && e <= 7) {
                return Err(LinkFault::GeneralJoint);
            }
            (JointKind::General(joint), IDENTITY, point)
        }
    };
    Ok(Joint { kind, is_reversed: false, home: Home { axes, origin } })
}

/// How far numbers of order 1 that ought to be 0 or 1 may be off after a few operations in f64.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// A joint frame with a coordinate axis along `axis`, and whether `axis` points against it: parallel
/// to the inboard frame where `axis` lies along one of that frame's axes, so that the joint's rotation
/// is a turn about it and nothing more. `None` where `axis` has no direction.
const fn aligned_frame(axis: V, inboard_axes: M) -> Option<(Axis, bool, M)> {
    let Some(direction) = normalized(axis) else { return None };
    let [x, y, z] = times(transpose(inboard_axes), direction);
    // How oblique an axis is shows in the other two components: its own is 1 to second order.
    let is_zero = [x.abs() <= ROUND_OFF, y.abs() <= ROUND_OFF, z.abs() <= ROUND_OFF];
    Some(match is_zero {
        [false, true, true] => (Axis::X, x < 0.0, inboard_axes),
        [true, false, true] => (Axis::Y, y < 0.0, inboard_axes),
        [true, true, false] => (Axis::Z, z < 0.0, inboard_axes),
        _ => (Axis::Z, false, frame_with_z(direction)),
    })
}

/// A link's node (but for where its coordinates start), and its joint frame at home.
const fn node(
    link: &Link,
    inboard: Option<usize>,
    from: Home,
) -> Result<(Node<f64>, Home), LinkFault> {
    let Some(body_axes) = matrix_of_quaternion(link.orientation) else {
        return Err(LinkFault::Orientation);
    };
    if !is_finite(link.center) {
        return Err(LinkFault::Center);
    }
    let Joint { kind, is_reversed, home } = match joint(link, from.axes, body_axes) {
        Ok(joint) => joint,
        Err(fault) => return Err(fault),
    };
    if !is_finite(home.origin) {
        return Err(LinkFault::Point);
    }
    // A floating joint's coordinates are the pose itself: there is no offset and no home rotation.
    let floating = matches!(kind, JointKind::Floating);
    // The inboard frame of a floating link that hangs from a body would be that body's joint frame.
    if floating && inboard.is_some() {
        return Err(LinkFault::FloatingInboard);
    }
    let can_have_rotor = matches!(kind, JointKind::Revolute(_) | JointKind::Prismatic(_));
    let rotor = link.rotor_inertia;
    if !(rotor >= 0.0 && rotor.is_finite() && (rotor == 0.0 || can_have_rotor)) {
        return Err(LinkFault::RotorInertia);
    }
    let to_inboard = transpose(from.axes);
    let offset =
        if floating { [0.0; 3] } else { times(to_inboard, minus(home.origin, from.origin)) };
    let home_rotation = if floating { IDENTITY } else { product(to_inboard, home.axes) };
    let to_frame = transpose(home.axes);
    let body_rotation = product(to_frame, body_axes);
    let center = times(to_frame, minus(link.center, home.origin));
    if let Err(fault) =
        check_body(link.mass, link.inertia, dot(center, center) + dot(offset, offset))
    {
        return Err(fault);
    }

    // Inertia about the centre of mass in the joint frame's axes, R I Rᵀ, then about the origin.
    let [xx, yy, zz, yz, zx, xy] = link.inertia;
    let central = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let c = product(product(body_rotation, central), transpose(body_rotation));
    let [x, y, z] = center;
    let m = link.mass;
    let diagonal = [
        c[0][0] + m * (y * y + z * z),
        c[1][1] + m * (z * z + x * x),
        c[2][2] + m * (x * x + y * y),
    ];
    if !(is_finite(diagonal) && is_finite(offset)) {
        return Err(LinkFault::Center);
    }
    let products = [c[1][2] - m * y * z, c[2][0] - m * z * x, c[0][1] - m * x * y];
    let shape = if !is_zero(products) {
        InertiaShape::Full
    } else if is_zero(center) && c[0][0] == c[1][1] && c[1][1] == c[2][2] {
        InertiaShape::Isotropic
    } else {
        InertiaShape::Diagonal
    };
    let node = Node {
        kind,
        is_reversed,
        inboard,
        is_branch: false,
        limb: 0,
        twin: 0,
        position_start: 0,
        velocity_start: 0,
        offset: vector(offset),
        is_offset: !is_zero(offset),
        home_rotation: matrix_unless_identity(home_rotation),
        home_axes: matrix_unless_identity(home.axes),
        rotor_inertia: link.rotor_inertia,
        inertia: RigidInertia {
            mass: m,
            first_moment: Vector3::new(m * x, m * y, m * z),
            rotational: SymmetricMatrix3 {
                diagonal: vector(diagonal),
                off_diagonal: vector(products),
            },
        },
        is_eccentric: !is_zero(center),
        shape,
        center: vector(center),
        body_rotation: matrix_unless_identity(body_rotation),
    };
    Ok((node, home))
}

const fn is_zero(v: V) -> bool {
    v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0
}

const fn vector(v: V) -> Vector3<f64> {
    Vector3::new(v[0], v[1], v[2])
}

const fn matrix_unless_identity(m: M) -> Option<Matrix3<f64>> {
    let mut i = 0;
    let mut is_identity = true;
    while i < 9 {
        let difference = m[i / 3][i % 3] - IDENTITY[i / 3][i % 3];
        is_identity = is_identity && difference.abs() <= ROUND_OFF;
        i += 1;
    }
    if is_identity {
        return None;
    }
    Some(Matrix3::new(
        m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2],
    ))
}
