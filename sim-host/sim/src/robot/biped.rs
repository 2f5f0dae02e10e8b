//! The biped of §4.1 as one robot among others.

use super::{Foot, FootPoint, LEG, Limits, Passive, Robot, SharedRobot, SizedTree};
use crate::picture::Solid;
use crate::scene::Outline;
use nalgebra::{Matrix3, Vector3};
use std::sync::{Arc, LazyLock};
use surefoot::model::robots::biped::{FEET, LIMITS, SoleOutline, TREE};
use surefoot_multibody::Side;

/// Names of the bodies in the tree's order.
const BODIES: [&str; 13] = [
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

const LEGS: [&str; 2] = ["left", "right"];
/// Joints of a leg, for people and in columns of a record.
const JOINTS: [(&str, &str); LEG] = [
    ("hip x", "hip_x"),
    ("hip y", "hip_y"),
    ("hip z", "hip_z"),
    ("knee", "knee"),
    ("ankle x", "ankle_x"),
    ("ankle y", "ankle_y"),
];
/// Corners of a sole.
const CORNERS: [&str; 4] = ["heel_minus_y", "heel_plus_y", "toe_minus_y", "toe_plus_y"];

/// Links of the small bodies inside hips and ankles, and the neighbour that each is given to. A leg moves most about
/// the lateral axis: about that a hip's inner body turns with the central body, its outer one with the thigh, and
/// an ankle's with the shank. Their centres of mass lie where the joint's axes meet.
pub const SMALL_BODIES: [(usize, Side); 6] = [
    (1, Side::Inboard),
    (2, Side::Outboard),
    (5, Side::Inboard),
    (7, Side::Inboard),
    (8, Side::Outboard),
    (11, Side::Inboard),
];

/// A central body this low has fallen, m.
const FALLEN_HEIGHT: f64 = 0.55;

/// The biped on soles of an outline.
pub fn biped(outline: Outline) -> SharedRobot {
    static ALL: LazyLock<[SharedRobot; 3]> =
        LazyLock::new(|| [Outline::A, Outline::M, Outline::R].map(|o| Arc::new(made(o))));
    let [a, m, r] = &*ALL;
    Arc::clone(match outline {
        Outline::A => a,
        Outline::M => m,
        Outline::R => r,
    })
}

fn made(outline: Outline) -> Robot {
    let sole = outline.sole();
    let of_legs = |name: fn(&str, usize, (&str, &str)) -> String| -> Vec<String> {
        let joints = move |(leg, side): (usize, &&str)| {
            let side = (*side).to_owned();
            let numbered = JOINTS.into_iter().enumerate();
            numbered.map(move |(k, joint)| name(&side, LEG * leg + k, joint))
        };
        LEGS.iter().enumerate().flat_map(joints).collect()
    };
    let foot = |(side, body): (&&str, usize)| Foot {
        name: format!("{side} foot"),
        column: format!("{side}_foot"),
        body,
        points: CORNERS
            .iter()
            .zip(sole.corners())
            .map(|(corner, at)| FootPoint { column: format!("{side}_{corner}"), at })
            .collect(),
        ends: [vec![0, 1], vec![2, 3]],
    };
    Robot {
        name: "biped".to_owned(),
        tree: SizedTree::Two(TREE),
        bodies: BODIES.map(str::to_owned).to_vec(),
        slides: vec![false; LEG * LEGS.len()],
        // With the dissertation's numbers.
        joints: of_legs(|side, number, (joint, _)| format!("{side} {joint} ({})", number + 2)),
        columns: of_legs(|side, _, (_, joint)| format!("{side}_{joint}")),
        legs: LEGS.map(|side| format!("{side} leg")).to_vec(),
        leg_joints: (0..LEGS.len()).map(|leg| (LEG * leg..LEG * (leg + 1)).collect()).collect(),
        feet: LEGS.iter().zip(FEET).map(foot).collect(),
        shapes: shapes(&sole),
        small_bodies: &SMALL_BODIES,
        passive: vec![Passive::default(); LEG * LEGS.len()],
        limits: Limits {
            joints: LIMITS.joints.as_flattened().to_vec(),
            damping: LIMITS.damping.as_flattened().to_vec(),
            stop_s: LIMITS.stop_s,
            thresholds: LIMITS.thresholds,
        },
        fallen_height: FALLEN_HEIGHT,
    }
}

/// A solid for each body, in its frame: the uniform box of its mass and inertia; the feet are prisms on
/// their soles, up to the ankle.
fn shapes(sole: &SoleOutline) -> Vec<Solid> {
    let shape = |k: usize| {
        let Some(shape) = TREE.body_shape(k) else { return Solid::cuboid([0.0; 3]) };
        if FEET.contains(&k) {
            return foot(sole, shape.joint);
        }
        // All of this robot's bodies have such a box; a cube of the same mass would do for others.
        Solid::uniform_box(shape.mass, &shape.inertia)
            .unwrap_or_else(|| Solid::cuboid([(shape.mass / 1e3).cbrt(); 3]))
    };
    (0..BODIES.len()).map(shape).collect()
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
        let solids = shapes(&SoleOutline::A);
        let centimetres = |k: usize| solids[k].extent().map(|edge| (1e3 * edge).round() / 10.0);
        assert_eq!(centimetres(0), [25.6, 29.9, 59.7]);
        assert_eq!(centimetres(3), [14.9, 9.7, 50.1]);
        assert_eq!(centimetres(5), [7.0, 7.0, 7.0]);
    }

    /// At the printed start the soles are level, 4.6 mm above the floor.
    #[test]
    fn soles_lie_on_the_floor_under_the_robot() {
        let scene = crate::scene::load("experiment-1").expect("a built-in scene");
        let start = scene.initial.state();
        let poses = scene.robot().tree.body_poses(&start.positions).expect("a configuration");
        let solids = &scene.robot().shapes;
        for foot in FEET {
            let heights =
                solids[foot].vertices.iter().map(|v| poses[foot].transform_point((*v).into()).z);
            let lowest = heights.clone().fold(f64::INFINITY, f64::min);
            assert!((lowest - 0.0046).abs() < 1e-4, "{lowest}");
            assert_eq!(heights.filter(|z| z - lowest < 1e-6).count(), 4, "a level sole");
        }
    }
}
