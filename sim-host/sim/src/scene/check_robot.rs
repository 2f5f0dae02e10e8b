//! What a scene asks of its robot: that it has what the scene uses, and reaches where it is held.

use super::check::wrong;
use super::{Distribution, Feet, ModelChoice, Scene, SceneError, Workspace};
use crate::robot::LEG;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::Method;

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
    if !scene.robot().tree.is_six_jointed() {
        let controller = &scene.controller;
        let what = "for a robot whose legs have not six joints each, or that moves other limbs";
        if controller.distribution != Distribution::Limited {
            let expected = format!("\"limited\", {what}");
            return Err(wrong(scene, "controller.distribution", "least-norm", expected));
        }
        if controller.workspace != Workspace::FixedFoot {
            let expected = format!("\"fixed-foot\", {what}");
            return Err(wrong(scene, "controller.workspace", "big-base", expected));
        }
        if !matches!(scene.feet, Feet::Floor { .. }) {
            let expected = format!("\"floor\", {what}");
            return Err(wrong(scene, "feet.on", "welded", expected));
        }
        if let Some(limits) = scene.acting.torque_limits_nm {
            let expected = format!("nothing, {what}: its file has them");
            return Err(wrong(scene, "acting.torque_limits_nm", limits, expected));
        }
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
        let own = robot.leg_joints.get(leg).map_or(&[][..], Vec::as_slice);
        // A joint that slides has no length of its own.
        if own.is_empty() || own.iter().any(|joint| robot.slides[*joint]) {
            continue;
        }
        let mut joints: Vec<Vector3<f64>> = own.iter().map(|k| joint(k + 1)).collect();
        if own.len() < LEG
            && let Some(foot) = robot.feet.get(leg)
        {
            // The last joint is no ankle.
            joints.push(poses[foot.body].transform_point(foot.points[0].at));
        }
        let length: f64 = joints.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let hip = poses[0].rotation.tr_mul(&(joints[0] - poses[0].position));
        let distance = (desired + orientation.rotate(hip) - joints[joints.len() - 1]).norm();
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
