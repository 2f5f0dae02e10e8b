//! What viewers plot: errors and forces as JSON, with its schema.

use crate::record::Sample;
use serde_json::{Value, json};

/// The message of a sample.
pub(super) fn message(sample: &Sample) -> Value {
    let vector = |[x, y, z]: [f64; 3]| json!({ "x": x, "y": y, "z": z });
    let [fx, fy, fz, tx, ty, tz] = sample.desired_wrench;
    json!({
        "position_error_m": vector(sample.position_error),
        "distance_m": sample.error_distance(),
        "angle_rad": sample.error_angle(),
        "desired_force_n": vector([fx, fy, fz]),
        "desired_torque_nm": vector([tx, ty, tz]),
        "left_foot_n": sample.foot_forces[0],
        "right_foot_n": sample.foot_forces[1],
        "kinetic_j": sample.energy[0],
        "potential_j": sample.energy[1],
    })
}

/// Its JSON schema.
pub(super) fn schema() -> Value {
    let number = json!({ "type": "number" });
    let vector = json!({
        "type": "object",
        "properties": { "x": number, "y": number, "z": number },
    });
    json!({
        "type": "object",
        "title": "surefoot.Tracking",
        "properties": {
            "position_error_m": vector,
            "distance_m": number,
            "angle_rad": number,
            "desired_force_n": vector,
            "desired_torque_nm": vector,
            "left_foot_n": number,
            "right_foot_n": number,
            "kinetic_j": number,
            "potential_j": number,
        },
    })
}
