//! Arrows as viewers draw them.

use super::messages::{quaternion, vector};
use ::foxglove::messages::{ArrowPrimitive, Color, Pose};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};

/// An arrow from a point along a vector (m, world frame); `None` for one too short to see.
pub(super) fn arrow(
    from: Vector3<f64>,
    along: Vector3<f64>,
    color: Color,
) -> Option<ArrowPrimitive> {
    let length = along.norm();
    if length < 1e-3 {
        return None;
    }
    // Arrows point along +x; one against it turns about any axis across.
    let turn = Rotation3::rotation_between(&Vector3::x(), &along)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::y_axis(), std::f64::consts::PI));
    let head_length = (0.3 * length).min(0.04);
    Some(ArrowPrimitive {
        pose: Some(Pose {
            position: Some(vector(from)),
            orientation: Some(quaternion(&UnitQuaternion::from_rotation_matrix(&turn))),
        }),
        shaft_length: length - head_length,
        shaft_diameter: 0.008,
        head_length,
        head_diameter: 0.02,
        color: Some(color),
    })
}
