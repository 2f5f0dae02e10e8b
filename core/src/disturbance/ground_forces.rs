//! The ground's wrench on each foot, from the rows of its leg's joints.
//!
//! # Notation
//! `J`: c directions of a foot's contact by n ≥ c joints of its leg, about its reference point, lengths in
//! units of the leg's reach; `r` those joints' rows of the residual.
//! ```text
//! F = (Jᵀ)⁺ r:    (J Jᵀ + ε²) F = J r                                            (1)
//! ε² = ε₀² (1 − p/4ε₀²)²  for p < 4ε₀², else 0                                    (2)
//! F ← F + (J Jᵀ + ε²)⁻¹ (J r − J Jᵀ F)                                           (3)
//! ```
//! with `p` the least pivot of `J Jᵀ`, which is not less than its least eigenvalue: near a singular posture
//! (a straight knee) the joints do not feel one direction, and (1) gives little of it. (3) makes up for what
//! (1) loses by squaring the condition (least squares of a floating base's legs: Flacco, Paolillo and
//! Kheddar, Humanoids 2016).
//!
//! A leg of six joints on a sole has `F` from `Jᵀ F = r` directly, while all pivots are far above ε₀.
//!
//! A load on the leg itself reads as a force on its foot.

use super::ResidualReading;
use crate::Real;
use crate::balance::square::Square;
use crate::balance::{Leg, MOST_LEG_JOINTS, WholeBody, edge_axes};
use crate::model::{Axis, JointKind, Node, Tree};
use crate::qp::Ldl;
use crate::spatial::{Pose, Wrench};
use nalgebra::{Matrix3, Vector3};

/// `ε₀` of (2): as the whole-body controller has it.
const LEAST: f64 = 0.01;
/// Pivots of a leg whose posture is far from a singular one: five times what (2) begins at.
const LEAST_PIVOT: f64 = 0.1;

/// What the ground does to a foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootForce<T> {
    /// About the foot's reference point, world axes, N and N·m. Directions that the contact does not have
    /// are zero.
    pub wrench: Wrench<T>,
    /// The reference point, from the central body's centre of mass in world axes, m.
    pub position: Vector3<T>,
}

/// (1) to (3) for all feet; `None` for those that the robot does not have, and where numbers overflow.
///
/// # Cost
/// About 350 multiplications a foot; 150 for a point. No allocation, no panic.
#[inline(always)]
pub fn ground_forces<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    tree: &Tree<T, N, NQ, NV>,
    robot: &WholeBody<T, FEET, NV>,
    reading: &ResidualReading<T, N, NV>,
) -> [Option<FootForce<T>>; FEET] {
    forces(tree, robot, &reading.r, &reading.frames)
}

/// The same of the parts of a reading.
#[inline(always)]
pub(super) fn forces<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    tree: &Tree<T, N, NQ, NV>,
    robot: &WholeBody<T, FEET, NV>,
    r: &[T; NV],
    frames: &[Pose<T>; N],
) -> [Option<FootForce<T>>; FEET] {
    let mut feet = [None; FEET];
    for (foot, leg) in feet.iter_mut().zip(&robot.legs) {
        let Some(leg) = leg else { continue };
        let at = leg.foot.body;
        let (Some(node), Some(frame)) = (tree.nodes.get(at), frames.get(at)) else {
            continue;
        };
        let rotation = match &node.body_rotation {
            None => frame.rotation,
            Some(body) => frame.rotation * body,
        };
        let position =
            frame.position + frame.rotation * node.center + rotation * leg.foot.reference;
        *foot = wrench(tree, robot, leg, (r, frames), (&rotation, position))
            .map(|wrench| FootForce { wrench, position });
    }
    feet
}

/// (1) to (3) for a leg.
#[inline(always)]
fn wrench<T: Real, const N: usize, const NQ: usize, const NV: usize, const FEET: usize>(
    tree: &Tree<T, N, NQ, NV>,
    robot: &WholeBody<T, FEET, NV>,
    leg: &Leg<T>,
    (of_joints, frames): (&[T; NV], &[Pose<T>; N]),
    (foot, position): (&Matrix3<T>, Vector3<T>),
) -> Option<Wrench<T>> {
    let per_reach = T::one() / leg.reach;
    // Columns of J in world axes: the foot's twist per rate of each joint.
    let mut columns = [[T::zero(); 6]; MOST_LEG_JOINTS];
    let mut r = [T::zero(); MOST_LEG_JOINTS];
    for ((column, r), velocity) in
        columns.iter_mut().zip(&mut r).zip(leg.joints.iter().take(leg.count))
    {
        let joint = robot.joints.get(*velocity)?.as_ref()?;
        let (node, frame) = (tree.nodes.get(joint.node)?, frames.get(joint.node)?);
        let (linear, angular) = match &node.kind {
            JointKind::Revolute(axis) => {
                let along = along(node, frame, *axis);
                (along.cross(&(position - frame.position)), along)
            }
            JointKind::Prismatic(axis) => (along(node, frame, *axis), Vector3::zeros()),
            _ => return None,
        };
        let linear = linear * per_reach;
        *column = [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z];
        *r = *of_joints.get(*velocity)?;
    }
    let moments = leg.foot.limits.patch.moments();
    let found = match moments {
        [false, false, false] => {
            let linear = columns.map(|[x, y, z, ..]| [x, y, z]);
            let [x, y, z] = least_squares(&linear, &r, leg.count, None)?;
            [x, y, z, T::zero(), T::zero(), T::zero()]
        }
        [true, true, true] => match square(&columns, &r, leg.count) {
            Some(found) => found,
            None => least_squares(&columns, &r, leg.count, None)?,
        },
        _ => on_edge(leg, foot, &columns, &r, moments)?,
    };
    let wrench = Wrench::from_array(found);
    // F of J in units of the reach is a force times it.
    let wrench = Wrench { force: wrench.force * per_reach, torque: wrench.torque };
    wrench.is_finite().then_some(wrench)
}

/// A joint's axis in the sense in which its coordinate counts.
#[inline(always)]
fn along<T: Real>(node: &Node<T>, frame: &Pose<T>, axis: Axis) -> Vector3<T> {
    let [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]] = frame.rotation.into();
    let along = match axis {
        Axis::X => Vector3::new(xx, yx, zx),
        Axis::Y => Vector3::new(xy, yy, zy),
        Axis::Z => Vector3::new(xz, yz, zz),
    };
    if node.is_reversed { -along } else { along }
}

/// `F` with `Jᵀ F = r`, which is (1), for six joints that are far from a singular posture; `None` for others.
#[inline(always)]
fn square<T: Real>(
    columns: &[[T; 6]; MOST_LEG_JOINTS],
    r: &[T; MOST_LEG_JOINTS],
    count: usize,
) -> Option<[T; 6]> {
    if count != 6 {
        return None;
    }
    let factors = Square::new(*columns.first_chunk::<6>()?, T::of(LEAST_PIVOT))?;
    Some(factors.solve(r.first_chunk::<6>()?))
}

/// The same for an edge: without the moment about it.
#[inline(never)]
fn on_edge<T: Real>(
    leg: &Leg<T>,
    foot: &Matrix3<T>,
    columns: &[[T; 6]; MOST_LEG_JOINTS],
    r: &[T; MOST_LEG_JOINTS],
    [x, _, _]: [bool; 3],
) -> Option<[T; 6]> {
    let axes = edge_axes(&Matrix3::identity(), &(foot * leg.axes), !x);
    let missing = if x { axes.column(1) } else { axes.column(0) };
    let missing: Vector3<T> = missing.into();
    let without = columns.map(|[a, b, c, d, e, f]| {
        let w = Vector3::new(d, e, f);
        let w = w - missing * missing.dot(&w);
        [a, b, c, w.x, w.y, w.z]
    });
    let none = T::zero();
    let alone = [none, none, none, missing.x, missing.y, missing.z];
    least_squares(&without, r, leg.count, Some(&alone))
}

/// (1) to (3) for the first `count` columns; `missing` is a direction in which they have nothing, and F
/// neither.
#[inline(always)]
fn least_squares<T: Real, const D: usize>(
    columns: &[[T; D]; MOST_LEG_JOINTS],
    r: &[T; MOST_LEG_JOINTS],
    count: usize,
    missing: Option<&[T; D]>,
) -> Option<[T; D]> {
    // The lower triangle alone, which fits the target's registers.
    let mut square = [[T::zero(); D]; D];
    let mut right = [T::zero(); D];
    if let Some(missing) = missing {
        for i in 0..D {
            for j in 0..=i {
                square[i][j] = missing[i] * missing[j];
            }
        }
    }
    for (column, r) in columns.iter().zip(r).take(count) {
        for i in 0..D {
            right[i] += column[i] * *r;
            for j in 0..=i {
                square[i][j] += column[i] * column[j];
            }
        }
    }
    let from = T::of(4.0 * LEAST * LEAST);
    let least = Ldl::new(&square).map(|factors| (factors, factors.least_pivot()));
    let factors = match least {
        Some((factors, pivot)) if pivot >= from => factors,
        found => damped(&square, found.map_or(T::zero(), |(_, pivot)| pivot))?,
    };
    let mut x = factors.solve(&right);
    for i in 0..D {
        right[i] -= square[i][i] * x[i];
        for j in 0..i {
            right[i] -= square[i][j] * x[j];
            right[j] -= square[i][j] * x[i];
        }
    }
    for (x, more) in x.iter_mut().zip(factors.solve(&right)) {
        *x += more;
    }
    Some(x)
}

/// (2) for a least pivot.
#[cold]
#[inline(never)]
fn damped<T: Real, const D: usize>(square: &[[T; D]; D], pivot: T) -> Option<Ldl<T, D>> {
    let share = T::one() - pivot / T::of(4.0 * LEAST * LEAST);
    let damping = T::of(LEAST * LEAST) * share * share;
    let mut square = *square;
    for (i, row) in square.iter_mut().enumerate() {
        if let Some(entry) = row.get_mut(i) {
            *entry += damping;
        }
    }
    Ldl::new(&square)
}
