//! Moving a configuration along a velocity.

use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// A floating robot's configuration after turning and moving at constant `velocities` for `h` seconds.
///
/// The quaternion follows the exponential map, so that it stays of unit norm; the position moves
/// along the body velocity in the orientation half way, which is second order in h.
pub fn retract<const NQ: usize, const NV: usize>(
    positions: &[f64; NQ],
    velocities: &[f64; NV],
    h: f64,
) -> [f64; NQ] {
    let mut next = *positions;
    let [px, py, pz, s, x, y, z] = std::array::from_fn(|i| positions[i]);
    let [vx, vy, vz, wx, wy, wz] = std::array::from_fn(|i| velocities[i]);
    let q = Quaternion::from_array([s, x, y, z]);
    let omega = Vector3::new(wx, wy, wz);
    let half = q.product(Quaternion::from_rotation_vector(omega * (0.5 * h)));
    let p = Vector3::new(px, py, pz) + half.rotate(Vector3::new(vx, vy, vz)) * h;
    let turned = q.product(Quaternion::from_rotation_vector(omega * h));
    // Round-off of the product is the only thing that moves the norm; it is taken away here.
    let turned = turned.normalized().unwrap_or(turned);
    next[..3].copy_from_slice(p.as_slice());
    next[3..7].copy_from_slice(&turned.to_array());
    for (angle, rate) in next[7..].iter_mut().zip(&velocities[6..]) {
        *angle += h * rate;
    }
    next
}
