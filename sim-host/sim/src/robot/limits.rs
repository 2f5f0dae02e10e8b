//! What the supervisor of a robot from a file allows: what the file says of its joints, and the biped's thresholds by
//! Froude's similarity.
//!
//! # Notation
//! - `m`, `l`: mass, and height of the central body with all joints at 0; `m₀`, `l₀`: the biped's
//! - `λ = l/l₀`, `μ = m/m₀`
//!
//! Under one gravity lengths scale by `λ`, times by `√λ`, speeds by `√λ`, angular speeds by `1/√λ`, torques by `μλ`,
//! what damps a joint by `μ λ √λ`. Angles, accelerations, ratios and numbers of ticks stay.

use super::{Limits, Robot, SizedTree, with_tree};
use nalgebra::DMatrix;
use surefoot::balance::{JointDamping, JointLimits, Thresholds};
use surefoot::dynamics::{joint_poses, mass_matrix};
use surefoot::model::robots::biped;
use surefoot_robots::Robot as FileRobot;

/// Height of the biped's central body where it stands upright, m.
pub(super) const BIPED_HEIGHT: f64 = 1.23;
/// Rate of a joint whose file says none, rad/s; angle either way, rad.
const RATE: f64 = 100.0;
const ANGLE: f64 = 3.2;
/// Torque of a joint whose file says none: weight times height times this.
const TORQUE: f64 = 1.0;
/// Velocities of the central body.
const BASE: usize = 6;
/// Postures in which a joint's least inertia is looked for, and what is taken of the least that was found.
const POSTURES: usize = 64;
const SURELY_LESS: f64 = 0.5;

impl Limits {
    /// Of no joint.
    pub(super) fn none() -> Self {
        let (stop_s, thresholds) = (biped::LIMITS.stop_s, biped::LIMITS.thresholds);
        Self { joints: Vec::new(), damping: Vec::new(), stop_s, thresholds }
    }

    /// Of a robot from a file whose central body is so high (m) with all joints at 0.
    pub(super) fn of_file(file: &FileRobot, robot: &Robot, height: f64) -> Self {
        let tree = &robot.tree;
        let (length, mass) = (height / BIPED_HEIGHT, tree.mass() / biped::TREE.mass());
        let time = length.sqrt();
        let weight = tree.mass() * tree.gravity().norm();
        let joints = file.links.iter().skip(1).map(|link| {
            let properties = &link.joint.properties;
            JointLimits {
                torque: properties.effort.filter(|x| *x > 0.0).unwrap_or(TORQUE * weight * height),
                angle: properties.range.unwrap_or([-ANGLE, ANGLE]),
                rate: properties.rate.filter(|x| *x > 0.0).unwrap_or(RATE),
            }
        });
        let inertias = least_inertias(file, tree);
        let of_biped = biped::LIMITS.damping[0][0].damping * mass * length * time;
        let damping =
            inertias.into_iter().map(|inertia| JointDamping { damping: of_biped, inertia });
        let of = biped::LIMITS.thresholds;
        Self {
            joints: joints.collect(),
            damping: damping.collect(),
            stop_s: biped::LIMITS.stop_s * time,
            thresholds: Thresholds {
                rate_step: of.rate_step / time,
                velocity_step: of.velocity_step * time,
                angular_velocity_step: of.angular_velocity_step / time,
                torque_step: of.torque_step * mass * length,
                drop: of.drop * length,
                look_ahead_s: of.look_ahead_s * time,
                free_fall_s: of.free_fall_s * time,
                ..of
            },
        }
    }
}

/// The least inertia that each joint turns, everything else free: `1/(M⁻¹)ᵢᵢ`, over postures spread over the joints'
/// ranges, less a margin.
fn least_inertias(file: &FileRobot, tree: &SizedTree) -> Vec<f64> {
    let joints = file.links.len() - 1;
    let mut least = vec![f64::INFINITY; joints];
    for posture in 0..POSTURES {
        let angle = |joint: usize| {
            let range = file.links[1 + joint].joint.properties.range;
            let [low, high] = range.unwrap_or([-ANGLE, ANGLE]);
            // Multiples of irrational numbers fill the ranges evenly.
            let share = (posture as f64 * (2.0 + joint as f64).sqrt()).fract();
            low + share * (high - low)
        };
        let angles: Vec<f64> = (0..joints).map(angle).collect();
        let Some(inverse) = inertia(tree, &angles).and_then(DMatrix::try_inverse) else { continue };
        for (joint, least) in least.iter_mut().enumerate() {
            let turned = 1.0 / inverse[(BASE + joint, BASE + joint)];
            if turned > 0.0 {
                *least = least.min(turned);
            }
        }
    }
    // A joint that turns nothing is limp in a stop.
    least
        .into_iter()
        .map(|x| if x.is_finite() { SURELY_LESS * x } else { f64::from(f32::MIN_POSITIVE) })
        .collect()
}

/// The mass matrix at joint angles.
fn inertia(sized: &SizedTree, angles: &[f64]) -> Option<DMatrix<f64>> {
    let mut positions = vec![0.0; 7];
    positions[3] = 1.0;
    positions.extend(angles);
    with_tree!(sized, tree => {
        let poses = joint_poses(tree, &sized.sized(&positions, 7)).ok()?;
        let rows = mass_matrix(tree, &poses);
        let n = BASE + angles.len();
        Some(DMatrix::from_fn(n, n, |i, j| rows[i][j]))
    })
}
