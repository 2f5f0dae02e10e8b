//! What viewers plot: errors and forces as JSON, with its schema.

use crate::record::Sample;
use crate::robot::Robot;
use serde_json::{Value, json};

/// The message of a sample.
pub(super) fn message(robot: &Robot, sample: &Sample) -> Value {
    let vector = |[x, y, z]: [f64; 3]| json!({ "x": x, "y": y, "z": z });
    let [fx, fy, fz, tx, ty, tz] = sample.desired_wrench;
    let mut message = json!({
        "position_error_m": vector(sample.position_error),
        "distance_m": sample.error_distance(),
        "angle_rad": sample.error_angle(),
        "desired_force_n": vector([fx, fy, fz]),
        "desired_torque_nm": vector([tx, ty, tz]),
        "kinetic_j": sample.energy[0],
        "potential_j": sample.energy[1],
    });
    for (foot, force) in robot.feet.iter().zip(&sample.foot_forces) {
        message[format!("{}_n", foot.column)] = json!(force);
    }
    message
}

/// Its JSON schema.
pub(super) fn schema(robot: &Robot) -> Value {
    let number = json!({ "type": "number" });
    let vector = json!({
        "type": "object",
        "properties": { "x": number, "y": number, "z": number },
    });
    let mut schema = json!({
        "type": "object",
        "title": "surefoot.Tracking",
        "properties": {
            "position_error_m": vector,
            "distance_m": number,
            "angle_rad": number,
            "desired_force_n": vector,
            "desired_torque_nm": vector,
            "kinetic_j": number,
            "potential_j": number,
        },
    });
    for foot in &robot.feet {
        schema["properties"][format!("{}_n", foot.column)] = number.clone();
    }
    schema
}
