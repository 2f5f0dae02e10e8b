//! How far a robot is from its set point, whatever its sensors say.

use crate::plant::PlantState;
use crate::scene::SetPoint;
use surefoot::spatial::{Quaternion, orientation_error};

/// `p − p_d` (m) and the orientation error `q_e` of (4.17), both in the world frame. Quaternions are of unit
/// norm to the few digits that a scene has, and are made so here.
pub(super) fn set_point_errors(state: &PlantState, set_point: &SetPoint) -> ([f64; 3], [f64; 4]) {
    let [x, y, z, q @ ..] = std::array::from_fn::<_, 7, _>(|i| state.positions[i]);
    let unit = |q: [f64; 4]| {
        let q = Quaternion::from_array(q);
        q.normalized().unwrap_or(q)
    };
    let [x_d, y_d, z_d] = set_point.position_m;
    let error = orientation_error(unit(q), unit(set_point.orientation));
    ([x - x_d, y - y_d, z - z_d], error.to_array())
}
