//! What a scene asks of its robot: that it has what the scene uses, and reaches where it is held.

use super::check::wrong;
use super::{Feet, ModelChoice, Scene, SceneError};
use crate::integrators::Method;
use crate::robot::LEG;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// What a robot from a file cannot have, as only the biped has it.
pub(super) fn of_file(scene: &Scene) -> Result<(), SceneError> {
    if scene.robot.is_none() {
        return Ok(());
    }
    let expected = "nothing: the robot comes from a file";
    if let Feet::Floor { outline: Some(outline), .. } = scene.feet {
        return Err(wrong(scene, "feet.outline", outline, expected));
    }
    if scene.acting.joint_stops.is_some() {
        return Err(wrong(scene, "acting.joint_stops", "", expected));
    }
    if scene.block.is_some() {
        return Err(wrong(scene, "block", "", expected));
    }
    if scene.integrator.name != Method::Variational {
        let expected = format!("{} for a robot from a file", Method::Variational);
        return Err(wrong(scene, "integrator.name", scene.integrator.name, expected));
    }
    if scene.model == ModelChoice::Lumped {
        return Err(wrong(scene, "model", scene.model, "full, for a robot from a file"));
    }
    Ok(())
}

/// A set point that the legs reach with the feet where they start.
pub(super) fn reach(scene: &Scene) -> Result<(), SceneError> {
    let (robot, start) = (scene.robot(), scene.initial.state());
    let poses = robot.tree.body_poses(&start.positions).map_err(|fault| {
        wrong(scene, "initial", &scene.initial, format!("a state to start from: {fault}"))
    })?;
    // World frame; a body's frame moves with what it is fixed to.
    let joint = |body: usize| {
        let point = robot.tree.body_shape(body).map_or(Vector3::zeros(), |shape| shape.joint);
        poses[body].transform_point(point)
    };
    let orientation = Quaternion::from_array(scene.set_point.orientation);
    let desired = Vector3::from(scene.set_point.position_m);
    for (leg, name) in robot.legs.iter().enumerate() {
        let joints: Vec<Vector3<f64>> = (1..=LEG).map(|k| joint(LEG * leg + k)).collect();
        let length: f64 = joints.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let hip = poses[0].rotation.tr_mul(&(joints[0] - poses[0].position));
        let distance = (desired + orientation.rotate(hip) - joints[LEG - 1]).norm();
        if distance >= length {
            let expected = format!(
                "a pose that the {name} reaches: its hip would be {distance:.3} m from its \
                 ankle, and the leg is {length:.3} m long"
            );
            return Err(wrong(scene, "set_point", scene.set_point, expected));
        }
    }
    Ok(())
}
