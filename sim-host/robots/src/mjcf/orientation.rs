//! Positions and the five ways to write an orientation.

use super::compiler::Compiler;
use crate::error::ImportError;
use crate::xml::Element;
use nalgebra::{
    Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3,
};

/// The frame of an element in its parent's.
pub(super) fn frame(element: &Element, compiler: &Compiler) -> Result<Isometry3<f64>, ImportError> {
    let [x, y, z] = element.numbers("pos")?.unwrap_or_default();
    Ok(Isometry3::from_parts(Translation3::new(x, y, z), orientation(element, compiler)?))
}

pub(super) fn orientation(
    element: &Element,
    compiler: &Compiler,
) -> Result<UnitQuaternion<f64>, ImportError> {
    let length = |v: Vector3<f64>| {
        Unit::try_new(v, 1e-12).ok_or_else(|| element.malformed("a vector with a length", "none"))
    };
    if let Some([w, x, y, z]) = element.numbers("quat")? {
        let q = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-12);
        return q.ok_or_else(|| element.malformed("a quaternion with a length", "none"));
    }
    if let Some([x, y, z, angle]) = element.numbers("axisangle")? {
        let axis = length(Vector3::new(x, y, z))?;
        return Ok(UnitQuaternion::from_axis_angle(&axis, compiler.angle(angle)));
    }
    if let Some(euler) = element.numbers::<3>("euler")? {
        return Ok(euler_angles(euler.map(|a| compiler.angle(a)), &compiler.euler_sequence));
    }
    if let Some([a, b, c, d, e, f]) = element.numbers("xyaxes")? {
        let x = length(Vector3::new(a, b, c))?;
        let y = Vector3::new(d, e, f);
        let y = length(y - *x * x.dot(&y))?;
        let z = x.cross(&y);
        let axes = Matrix3::from_columns(&[*x, *y, z]);
        return Ok(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes)));
    }
    if let Some(z) = element.numbers::<3>("zaxis")? {
        return Ok(from_z(&length(z.into())?));
    }
    Ok(UnitQuaternion::identity())
}

/// The smallest rotation that takes z to `axis`.
pub(super) fn from_z(axis: &Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), axis)
        // To −z there are many; MuJoCo takes the one about x.
        .unwrap_or_else(|| {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        })
}

/// Rotations about x, y, z in the order of `sequence`: small letters about axes that move along, capital
/// ones about fixed axes.
fn euler_angles(angles: [f64; 3], sequence: &[char; 3]) -> UnitQuaternion<f64> {
    angles.iter().zip(sequence).fold(UnitQuaternion::identity(), |so_far, (angle, letter)| {
        let axis = match letter.to_ascii_lowercase() {
            'x' => Vector3::x_axis(),
            'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let next = UnitQuaternion::from_axis_angle(&axis, *angle);
        if letter.is_ascii_lowercase() { so_far * next } else { next * so_far }
    })
}
