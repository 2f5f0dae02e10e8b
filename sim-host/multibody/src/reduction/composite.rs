//! One rigid body out of several.

use super::super::Body;
use super::frame::Frame;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use surefoot::spatial::Quaternion;

/// Products of inertia that are only round-off, relative to the inertia's trace.
const ROUND_OFF: f64 = 1e-14;

/// The body that these are together, and its frame (centre of mass, principal axes) in the frame that theirs
/// are given in. Axes stay as they are where they are principal already.
pub(super) fn composite(parts: &[(Body, Frame)]) -> (Body, Frame) {
    if let [(body, frame)] = parts {
        return (*body, *frame);
    }
    let mass: f64 = parts.iter().map(|(body, _)| body.mass).sum();
    let moment: Vector3<f64> = parts.iter().map(|(body, at)| at.position * body.mass).sum();
    let center = moment / mass;
    let mut inertia = Matrix3::zeros();
    for (body, at) in parts {
        let turn = at.orientation.to_matrix();
        let own = turn * Matrix3::from_diagonal(&body.inertia.into()) * turn.transpose();
        // Parallel axes.
        let arm = at.position - center;
        let square = Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose();
        inertia += own + square * body.mass;
    }
    let diagonal = inertia.diagonal();
    let products = (inertia - Matrix3::from_diagonal(&diagonal)).abs().max();
    if products <= ROUND_OFF * diagonal.sum() {
        let frame = Frame { position: center, ..Frame::IDENTITY };
        return (Body { mass, inertia: diagonal.into() }, frame);
    }
    let SymmetricEigen { eigenvalues, mut eigenvectors } = inertia.symmetric_eigen();
    if eigenvectors.determinant() < 0.0 {
        let mirrored = -eigenvectors.column(2);
        eigenvectors.set_column(2, &mirrored);
    }
    let turn =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(eigenvectors));
    let orientation = Quaternion::from_array([turn.w, turn.i, turn.j, turn.k]);
    (Body { mass, inertia: eigenvalues.into() }, Frame { position: center, orientation })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two boxes side by side, askew in their frame, are a box of twice the size.
    #[test]
    fn two_boxes_are_a_box() {
        let inertia = |m: f64, [x, y, z]: [f64; 3]| {
            [y * y + z * z, x * x + z * z, x * x + y * y].map(|s| m * s / 12.0)
        };
        let half = Body { mass: 1.5, inertia: inertia(1.5, [0.3, 0.2, 0.1]) };
        let askew = Frame {
            position: Vector3::new(0.4, -0.2, 1.1),
            orientation: Quaternion::from_rotation_vector(Vector3::new(0.3, -0.9, 0.5)),
        };
        let beside =
            |x: f64| askew.then(&Frame { position: Vector3::new(x, 0.0, 0.0), ..Frame::IDENTITY });
        let (whole, at) = composite(&[(half, beside(-0.15)), (half, beside(0.15))]);
        let mut expected = inertia(3.0, [0.6, 0.2, 0.1]);
        let mut found = whole.inertia;
        expected.sort_by(f64::total_cmp);
        found.sort_by(f64::total_cmp);
        assert!((whole.mass - 3.0).abs() < 1e-15);
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-15, "{found:?}");
        }
        assert!((at.position - askew.position).norm() < 1e-15);
        let turn = at.orientation.to_matrix();
        let in_world = turn * Matrix3::from_diagonal(&whole.inertia.into()) * turn.transpose();
        let box_turn = askew.orientation.to_matrix();
        let of_box = box_turn
            * Matrix3::from_diagonal(&inertia(3.0, [0.6, 0.2, 0.1]).into())
            * box_turn.transpose();
        assert!((in_world - of_box).abs().max() < 1e-14);
    }
}
