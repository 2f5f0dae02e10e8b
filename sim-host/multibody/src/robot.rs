//! Robots of `core` as systems of the simulator.

use super::body::{Body, BodyState};
use super::joint::{Joint, JointConstraint};
use super::joint_law::JointLaw;
use super::system::{Link, System};
use super::system_error::SystemError;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use surefoot::dynamics::{DynamicsFault, body_poses, body_velocities, joint_poses};
use surefoot::model::{BodyShape, JointKind, Tree};
use surefoot::spatial::{Pose, Quaternion};

/// The system that moves as a tree does: links and bodies' frames are the tree's, in its order.
///
/// # Errors
/// [`SystemError::Unsupported`] for general joints, bodies whose frame is not along their principal axes,
/// and gravity in another direction than −z; [`SystemError::Inertia`] for bodies without inertia.
pub fn system_of_tree<const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, N, NQ, NV>,
) -> Result<System, SystemError> {
    let (system, axes) = principal_system_of_tree(tree, N)?;
    match axes.iter().position(Option::is_some) {
        Some(link) => {
            let what = "a body frame along the body's principal axes";
            Err(SystemError::Unsupported { link, what })
        }
        None => Ok(system),
    }
}

/// Principal axes of each body, seen from its frame; `None` where they are the frame's.
pub type PrincipalAxes = Vec<Option<Rotation3<f64>>>;

/// The same of the first `bodies` with links' frames along their principal axes: these seen from the bodies' frames of
/// the tree.
///
/// # Errors
/// As for [`system_of_tree`], but of principal axes.
pub fn principal_system_of_tree<const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, N, NQ, NV>,
    bodies: usize,
) -> Result<(System, PrincipalAxes), SystemError> {
    let gravity = tree.gravity();
    if gravity.x != 0.0 || gravity.y != 0.0 {
        return Err(SystemError::Unsupported { link: 0, what: "gravity along z" });
    }
    let mut home = home_poses(tree)?;
    let mut axes = Vec::with_capacity(N);
    let mut links = Vec::with_capacity(N);
    let mut rotors = Vec::new();
    for k in 0..bodies.min(N) {
        let unsupported = |what| SystemError::Unsupported { link: k, what };
        // k < N, so that both are there.
        let (Some(mut shape), Some(kind)) = (tree.body_shape(k), tree.joint(k)) else { break };
        let diagonal = shape.inertia.diagonal();
        let products = (shape.inertia - Matrix3::from_diagonal(&diagonal)).abs().max();
        let turned = (products > 1e-12 * diagonal.sum()).then(|| principal_axes(&mut shape));
        if let Some(turned) = &turned {
            home[k].rotation *= turned.matrix();
        }
        axes.push(turned);
        let diagonal = shape.inertia.diagonal();
        if shape.rotor_inertia != 0.0 {
            rotors.push((k, shape.rotor_inertia));
        }
        let inboard = tree.inboard(k);
        let of_inboard = inboard.map_or(Pose::identity(), |i| home[i]);
        let relative = of_inboard.inverse().compose(&home[k]);
        let axis: [f64; 3] = shape.axis.into();
        let constraint = match kind {
            JointKind::Fixed => JointConstraint::Fixed,
            JointKind::Revolute(_) => JointConstraint::Revolute { axis },
            JointKind::Prismatic(_) => {
                JointConstraint::Prismatic { axis: (relative.rotation * shape.axis).into() }
            }
            JointKind::Spherical => JointConstraint::Spherical,
            JointKind::Floating => JointConstraint::Floating,
            JointKind::General(_) => return Err(unsupported("a joint of a standard kind")),
        };
        links.push(Link {
            inboard,
            joint: Joint {
                outboard: shape.joint.into(),
                inboard: relative.transform_point(shape.joint).into(),
                home: quaternion(&relative.rotation),
                constraint,
            },
            body: Body { mass: shape.mass, inertia: diagonal.into() },
        });
    }
    let system = System::new(links, -gravity.z)?;
    let with_rotor = |system: System, (link, rotor_inertia)| {
        system.with_law(link, JointLaw { rotor_inertia, ..JointLaw::default() })
    };
    Ok((rotors.into_iter().try_fold(system, with_rotor)?, axes))
}

/// Turns a body's frame along its principal axes; gives these, seen from the frame before.
fn principal_axes(shape: &mut BodyShape<f64>) -> Rotation3<f64> {
    let found = SymmetricEigen::new(shape.inertia);
    let mut axes = found.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.column_mut(2).neg_mut();
    }
    shape.inertia = Matrix3::from_diagonal(&found.eigenvalues);
    shape.joint = axes.tr_mul(&shape.joint);
    shape.axis = axes.tr_mul(&shape.axis);
    Rotation3::from_matrix_unchecked(axes)
}

/// States and rates of all bodies of a tree.
///
/// # Errors
/// A [`DynamicsFault`] for what is no configuration.
pub fn states_of_tree<const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, N, NQ, NV>,
    positions: &[f64; NQ],
    velocities: &[f64; NV],
) -> Result<(Vec<BodyState>, Vec<BodyState>), DynamicsFault> {
    let relative = joint_poses(tree, positions)?;
    let poses = body_poses(tree, &relative);
    let twists = body_velocities(tree, &relative, velocities);
    let both = poses.iter().zip(&twists).map(|(pose, twist)| {
        let q = quaternion(&pose.rotation);
        let v = pose.rotation * twist.linear;
        let q_dot = Quaternion::from_array(q).rate(twist.angular).to_array();
        (state(&pose.position, q), state(&v, q_dot))
    });
    Ok(both.unzip())
}

fn state(x: &Vector3<f64>, [s, i, j, k]: [f64; 4]) -> BodyState {
    [x.x, x.y, x.z, s, i, j, k]
}

/// Poses where all joints are at home, a floating body's being the identity.
fn home_poses<const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, N, NQ, NV>,
) -> Result<[Pose<f64>; N], SystemError> {
    let mut positions = [0.0; NQ];
    for k in 0..N {
        let scalar_part = match tree.joint(k) {
            Some(JointKind::Floating) => 3,
            Some(JointKind::Spherical) => 0,
            _ => continue,
        };
        if let Some((start, _)) = tree.starts(k) {
            positions[start + scalar_part] = 1.0;
        }
    }
    let poses = joint_poses(tree, &positions);
    let poses =
        poses.map_err(|_| SystemError::Unsupported { link: 0, what: "a home configuration" })?;
    Ok(body_poses(tree, &poses))
}

fn quaternion(rotation: &Matrix3<f64>) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    [q.w, q.i, q.j, q.k]
}
