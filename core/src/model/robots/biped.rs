//! The biped of §4.1: a floating central body and two legs of six revolute joints, 18 degrees of
//! freedom, 74.548 kg. It faces −x; left is −y; z is up.
//!
//! Bodies by number (index in arrays is one less): 1 central; left leg 2, 3 (hip), 4 (thigh),
//! 5 (shank), 6 (ankle), 7 (foot); right leg 8 to 13 likewise. Joint axes, all positive: x, y, z
//! (hip), y (knee), x, y (ankle).

use crate::balance::{JointDamping, JointLimits, SafetyLimits, Thresholds};
use crate::model::compile_time::{cosine, sine};
use crate::model::{Link, Tree};
use nalgebra::Vector3;

/// The 13 bodies in precision `T`, with 19 coordinates (position, quaternion, 12 angles) and
/// 18 velocities (body twist, 12 rates).
pub type Biped<T> = Tree<T, 13, 19, 18>;

/// In double precision.
pub const TREE: Biped<f64> = Tree::new(LINKS);

/// In single precision, for the target.
pub const TREE_F32: Biped<f32> = TREE.to_f32();

/// Index of the left and of the right foot.
pub const FEET: [usize; 2] = [6, 12];

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A foot's principal axes are tilted by 8.547° about −y (§4.1).
const FOOT_TILT: f64 = -8.547 * core::f64::consts::PI / 180.0;
const FOOT_ORIENTATION: [f64; 4] = [cosine(0.5 * FOOT_TILT), 0.0, sine(0.5 * FOOT_TILT), 0.0];

/// The small bodies inside a hip and an ankle: mass and inertia (§4.1).
const fn small(link: Link, center: [f64; 3]) -> Link {
    link.body(0.343, [0.00028; 3], center)
}

/// The central body.
pub const CENTRAL: Link = Link::floating(0).body(45.0, [1.67, 1.58, 0.581], [0.0, 0.0, 1.23]);

/// The six links of a leg whose joints are above `[x, y]`, its first hanging from link 1; `first` is
/// the number of that first link.
pub const fn leg(first: usize, [x, y]: [f64; 2]) -> [Link; 6] {
    let hip = [x, y, 0.96];
    let knee = [x, y, 0.50];
    let ankle = [x, y, 0.06];
    [
        small(Link::revolute(1, X, hip), hip),
        small(Link::revolute(first, Y, hip), hip),
        Link::revolute(first + 1, Z, hip).body(7.5, [0.163, 0.171, 0.0198], [x, y, 0.73]),
        Link::revolute(first + 2, Y, knee).body(4.79, [0.0961, 0.0959, 0.00784], [x, y, 0.28]),
        small(Link::revolute(first + 3, X, ankle), ankle),
        Link::revolute(first + 4, Y, ankle)
            .body(1.455, [0.00189, 0.00608, 0.00662], [x - 0.05325, y, 0.03473])
            .oriented(FOOT_ORIENTATION),
    ]
}

const LEFT: [Link; 6] = leg(2, [0.0, -0.15]);
const RIGHT: [Link; 6] = leg(8, [0.0, 0.15]);

const LINKS: [Link; 13] = [
    CENTRAL, LEFT[0], LEFT[1], LEFT[2], LEFT[3], LEFT[4], LEFT[5], RIGHT[0], RIGHT[1], RIGHT[2],
    RIGHT[3], RIGHT[4], RIGHT[5],
];

/// Where a sole touches the floor. The outline is not printed in the dissertation; these fit its
/// printed mass, centre of mass, inertia and tilt of the foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoleOutline {
    /// Heel behind the ankle's vertical line, m (towards +x).
    pub heel: f64,
    /// Toe ahead of the ankle's vertical line, m (towards −x).
    pub toe: f64,
    /// Half the width, m.
    pub half_width: f64,
}

impl SoleOutline {
    /// Outline "A": heel +5.03 cm, toe −20.15 cm, width 10 cm.
    pub const A: Self = Self { heel: 0.0503, toe: 0.2015, half_width: 0.05 };
    /// Outline "M": heel +4.0 cm, toe −15.5 cm.
    pub const M: Self = Self { heel: 0.040, toe: 0.155, half_width: 0.05 };
    /// Outline "R": heel +4.4 cm, toe −15.9 cm.
    pub const R: Self = Self { heel: 0.044, toe: 0.159, half_width: 0.05 };

    /// The four corners in the foot's body frame, m: heel left, heel right, toe left, toe right.
    ///
    /// At home the sole lies on the floor, 3.473 cm below the foot's centre of mass, which is 5.325 cm
    /// ahead of the ankle; the body frame is tilted by `FOOT_TILT` about y.
    pub fn corners(&self) -> [Vector3<f64>; 4] {
        let (s, c) = (sine(FOOT_TILT), cosine(FOOT_TILT));
        let corner = |x: f64, y: f64| {
            let (dx, dz) = (x + 0.05325, -0.03473);
            // Rᵀ of the tilt about y.
            Vector3::new(c * dx - s * dz, y, s * dx + c * dz)
        };
        let (w, heel, toe) = (self.half_width, self.heel, -self.toe);
        [corner(heel, -w), corner(heel, w), corner(toe, -w), corner(toe, w)]
    }
}

/// What its supervisor allows. The dissertation prints no limits of motors or sensors; these are ours:
/// torques twice the largest of Experiment 1 at the knee. Thresholds stand well above what both
/// experiments show on their feet, at 500 ticks a second and steps of the simulator from 20 µs to 2 ms,
/// and well below what faults and falls do.
pub const LIMITS: SafetyLimits<f64, 2> = SafetyLimits {
    joints: [JOINT_LIMITS; 2],
    damping: [JOINT_DAMPING; 2],
    stop_s: 1.0,
    thresholds: Thresholds {
        // A fifth of a count of a 12-bit encoder.
        angle_noise: 3e-4,
        // All rates off by this at once leap a torque by 15 N·m. Impacts step a rate by 23 rad/s, and
        // leave residuals of 14 mrad at most, for six ticks in a row.
        rate_step: 0.8,
        doubtful_ticks: 12,
        // The block of Experiment 2 leaves residuals of 0.02 mm and 0.1 mrad, which are steps of
        // 0.02 m/s and 0.1 rad/s.
        velocity_step: 0.05,
        angular_velocity_step: 0.5,
        // 44 mrad of a joint, 2 mm and 20 mrad of the body.
        gross: 40.0,
        frozen_angle: 5e-4,
        torque_step: 12.0,
        bridged_ticks: 1,
        recovery_ticks: 10,
        // 35°, of which the experiments reach 17°.
        least_upright: 0.819,
        // The experiments sink by 3 mm, and 32 mm with prediction.
        drop: 0.12,
        look_ahead_s: 0.1,
        // Three quarters of gravity; the experiments have 8.2 m/s² for a tick.
        free_fall: 7.4,
        free_fall_s: 0.1,
        // No motor is at its limit in the experiments.
        saturation_s: 6e-3,
    },
};

const JOINT_LIMITS: [JointLimits<f64>; 6] = [
    joint_limits(200.0),
    joint_limits(300.0),
    joint_limits(100.0),
    joint_limits(400.0),
    joint_limits(200.0),
    joint_limits(200.0),
];

/// Encoders read half a turn either way; rates of impacts reach 25 rad/s.
const fn joint_limits(torque: f64) -> JointLimits<f64> {
    JointLimits { torque, angle: [-3.2, 3.2], rate: 100.0 }
}

/// The least inertia that each joint turns over all postures, everything else free: near the postures at
/// which hip x and hip z are parallel, they turn no more than the small bodies between them.
const JOINT_DAMPING: [JointDamping<f64>; 6] = [
    JointDamping { damping: 30.0, inertia: 5.5e-4 },
    JointDamping { damping: 30.0, inertia: 0.28 },
    JointDamping { damping: 30.0, inertia: 5.5e-4 },
    JointDamping { damping: 30.0, inertia: 0.117 },
    JointDamping { damping: 30.0, inertia: 2.2e-3 },
    JointDamping { damping: 30.0, inertia: 7.5e-3 },
];
