//! The biped's bodies as solids, and where they are.

use super::Solid;
use crate::plant::NQ;
use nalgebra::{Matrix3, Vector3};
use surefoot::dynamics::{DynamicsFault, body_poses, joint_poses};
use surefoot::model::robots::biped::{FEET, SoleOutline, TREE};
use surefoot::spatial::Pose;

/// Bodies of the biped.
const BODIES: usize = 13;

/// Names of the bodies in the tree's order.
pub const BODY_NAMES: [&str; BODIES] = [
    "central body",
    "left hip, outer",
    "left hip, inner",
    "left thigh",
    "left shank",
    "left ankle",
    "left foot",
    "right hip, outer",
    "right hip, inner",
    "right thigh",
    "right shank",
    "right ankle",
    "right foot",
];

/// Where all bodies are, world from body, at coordinates of a sample.
///
/// # Errors
/// A [`DynamicsFault`] for what is no configuration.
pub fn body_poses_at(positions: &[f64; NQ]) -> Result<[Pose<f64>; BODIES], DynamicsFault> {
    Ok(body_poses(&TREE, &joint_poses(&TREE, positions)?))
}

/// A solid for each body, in its frame: the uniform box of its mass and inertia; the feet are prisms on
/// their soles, up to the ankle.
pub fn robot_solids(sole: &SoleOutline) -> [Solid; BODIES] {
    std::array::from_fn(|k| {
        let Some(shape) = TREE.body_shape(k) else { return Solid::cuboid([0.0; 3]) };
        if FEET.contains(&k) {
            return foot(sole, shape.joint);
        }
        // All of this robot's bodies have such a box; a cube of the same mass would do for others.
        Solid::uniform_box(shape.mass, &shape.inertia)
            .unwrap_or_else(|| Solid::cuboid([(shape.mass / 1e3).cbrt(); 3]))
    })
}

/// A foot in profile: heel and toe on the floor, and an instep that climbs to the ankle.
fn foot(sole: &SoleOutline, ankle: Vector3<f64>) -> Solid {
    let [heel, _, toe, _] = sole.corners();
    // Axes of the sole in the foot's frame: backwards, across, up.
    let back = Vector3::new(heel.x - toe.x, 0.0, heel.z - toe.z).normalize();
    let up = Vector3::new(-back.z, 0.0, back.x);
    let from_toe = ankle - toe;
    let (length, height) = ((heel - toe).dot(&back), from_toe.dot(&up));
    let at = from_toe.dot(&back);
    let profile = [
        [0.0, 0.0],
        [length, 0.0],
        [length, 0.8 * height],
        [at + 0.035, 1.1 * height],
        [at - 0.035, 1.1 * height],
        [0.0, 0.3 * height],
    ];
    let axes = Matrix3::from_columns(&[back, Vector3::y(), up]);
    let origin = Vector3::new(toe.x, 0.0, toe.z);
    Solid::prism(&profile, sole.half_width).moved(&axes, origin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_have_the_sizes_of_a_person() {
        let solids = robot_solids(&SoleOutline::A);
        let centimetres = |k: usize| solids[k].extent().map(|edge| (1e3 * edge).round() / 10.0);
        assert_eq!(centimetres(0), [25.6, 29.9, 59.7]);
        assert_eq!(centimetres(3), [14.9, 9.7, 50.1]);
        assert_eq!(centimetres(5), [7.0, 7.0, 7.0]);
    }

    /// At the printed start the soles are level, 4.6 mm above the floor.
    #[test]
    fn soles_lie_on_the_floor_under_the_robot() {
        let scene = crate::scene::load("experiment-1").expect("a built-in scene");
        let poses = body_poses_at(&scene.initial.state().positions).expect("a configuration");
        let solids = robot_solids(&SoleOutline::A);
        for foot in FEET {
            let heights =
                solids[foot].vertices.iter().map(|v| poses[foot].transform_point((*v).into()).z);
            let lowest = heights.clone().fold(f64::INFINITY, f64::min);
            assert!((lowest - 0.0046).abs() < 1e-4, "{lowest}");
            assert_eq!(heights.filter(|z| z - lowest < 1e-6).count(), 4, "a level sole");
        }
    }
}
