//! Where a robot should be at rest, and how far it is from there: its own centre of mass, with loads and whatever
//! else its controller does not know, over its feet.

use crate::plant::BodyDifference;
use crate::record::Sample;
use crate::robot::stance;
use crate::scene::Scene;
use nalgebra::Vector3;
use surefoot::spatial::{Pose, Quaternion};

/// How far from rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestError {
    /// Of the centre of mass from where that of a robot as the model has it would be, against the middle of the
    /// feet, in the ground's plane, m.
    pub center_of_mass: [f64; 2],
    /// Of the central body's upright axis from the set point's, rad.
    pub tilt: f64,
}

/// Of a sample; `None` for robots whose feet or links are not those of the model, of which the sample's angles do not
/// tell where its bodies are.
pub fn rest_error(scene: &Scene, sample: &Sample) -> Option<RestError> {
    let robot = scene.robot();
    let differences = scene.plant.differences(&robot);
    if differences.joints.iter().any(|joint| joint.shift != Vector3::zeros()) {
        return None;
    }
    let poses = robot.tree.body_poses(&sample.positions).ok()?;
    let (mut moment, mut mass) = (Vector3::zeros(), 0.0);
    for (body, pose) in poses.iter().enumerate() {
        let model = robot.tree.body_mass(body);
        let other = differences.bodies.iter().find(|other| other.body == body);
        let own = other.copied().unwrap_or(BodyDifference {
            body,
            mass_factor: 1.0,
            inertia_factor: 1.0,
            center_shift: Vector3::zeros(),
            added: None,
        });
        let own_mass = model * own.mass_factor;
        moment += pose.transform_point(own.center_shift) * own_mass;
        mass += own_mass;
        if let Some((added, at)) = own.added {
            moment += pose.transform_point(at) * added;
            mass += added;
        }
    }
    let off = moment / mass - stance::feet_middle(&robot, &poses)?;
    let ([x, y], _) = nominal(scene);
    let up = |q: Quaternion<f64>| q.normalized().unwrap_or(q).rotate(Vector3::z());
    let [s, a, b, c] = std::array::from_fn(|i| sample.positions[3 + i]);
    let (own, wanted) = (
        up(Quaternion::from_array([s, a, b, c])),
        up(Quaternion::from_array(scene.set_point.orientation)),
    );
    let tilt = own.cross(&wanted).norm().atan2(own.dot(&wanted));
    Some(RestError { center_of_mass: [off.x - x, off.y - y], tilt })
}

/// Where the model's centre of mass is to stand from the feet's middle, m, and how high the central body is above
/// it: at the set point, with the feet where they start; where it starts, if the legs do not reach that.
pub(super) fn nominal(scene: &Scene) -> ([f64; 2], f64) {
    let (robot, start) = (scene.robot(), scene.start());
    let turned = Quaternion::from_array(scene.set_point.orientation);
    let rotation = turned.normalized().unwrap_or(Quaternion::identity()).to_matrix();
    let to = Pose { rotation, position: Vector3::from(scene.set_point.position_m) };
    let state = stance::moved(&robot, &start, &to).unwrap_or(start);
    let offset = stance::center_from_feet(&robot, &state).unwrap_or_default();
    let poses = robot.tree.body_poses(&state.positions).unwrap_or_default();
    let feet = stance::feet_middle(&robot, &poses).unwrap_or_default();
    (offset, (state.positions[2] - feet.z).max(0.01))
}
