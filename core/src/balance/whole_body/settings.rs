//! Gains, postures and limits.

use super::{MotionWeights, WholeBodyRobotFault};
use crate::Real;
use crate::balance::{ContactWeights, Gains, SafetyLimits};
use crate::qp::{Settings, Work};
use crate::spatial::SymmetricMatrix3;

/// What a robot is to do beside its reference, and what its motors can. Entries of joints are by
/// velocity; those of the central body (the first six) are not read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeBodySettings<T, const NV: usize> {
    /// Of the central body.
    pub gains: Gains<T>,
    /// Angles (rad, or m) which joints track that no contact needs: other limbs, legs in the air, and
    /// what is free in a leg of more joints than its contact has directions.
    pub posture: [T; NV],
    /// With these gains: from angle (1/s²) and from rate (1/s) to acceleration.
    pub posture_gains: [T; 2],
    /// Greatest torques (N·m) or forces (N) of the joints, in either sense; may be infinite.
    pub torques: [T; NV],
    /// Least and greatest angles (rad, or m) of joints, where a tick whose feet may swing is to keep them.
    pub ranges: Option<[[T; 2]; NV]>,
    /// Rate at which an angle may approach the end of its range, 1/s.
    pub range_rate: T,
    /// Rate at which feet that creep come to rest, 1/s.
    pub rest_rate: T,
    /// What is given up first where not all can be had.
    pub weights: ContactWeights<T>,
    /// The same of a tick whose feet may swing.
    pub motion: MotionWeights<T>,
    /// How limits give way, and what a tick may spend.
    pub limits: Settings<T>,
    /// `ε₀`: damping of a leg in a singular posture, in units of its reach.
    pub damping: T,
}

impl<T: Real, const NV: usize> WholeBodySettings<T, NV> {
    /// Multiplications that a tick may spend on limits, with room for `feet` feet: what some twenty
    /// limits taken in and let go cost.
    pub const fn most_work(feet: usize) -> Work {
        let joints = NV.saturating_sub(6);
        // A row, its response, its products with the others, and a test of all.
        let change = 250 + 150 * feet + 12 * joints;
        20 * change as Work
    }

    /// The same for ticks whose feet may swing: what fourteen limits taken in and let go cost on a robot that fills
    /// its feet, and eight on two feet of four: a tick that needs more goes on from there in the next. Twice as much
    /// for more than twelve joints: G1 with half of it tips its feet in double support.
    pub const fn most_motion_work(feet: usize) -> Work {
        let joints = NV.saturating_sub(6);
        let change = 240 + 430 * feet + 12 * joints;
        // Torques of waist and arms are limits too.
        let changes = if joints > 12 { 28 } else { 14 };
        changes * change as Work
    }

    /// Documented starting values for a robot whose central body stands at the height `z` (m) above its
    /// feet under gravity `g` (m/s²), by `ω = √(g/z)`: body `10 ω²` and `5.2 ω`, posture the same, feet
    /// to rest at `5.8 ω`, a moment in a force's weight at `z`. Posture zero, torques without limit.
    pub fn scaled(height: T, gravity: T, feet: usize) -> Self {
        let frequency = (gravity / height).sqrt();
        let stiffness = frequency * frequency * T::of(10.0);
        let damping = frequency * T::of(5.2);
        let standing = ContactWeights::standing();
        let [x, y, z, tilt, pitch, yaw] = standing.task;
        let per_length = T::one() / height;
        Self {
            gains: Gains {
                position: SymmetricMatrix3::scalar(stiffness),
                velocity: SymmetricMatrix3::scalar(damping),
                orientation: SymmetricMatrix3::scalar(stiffness * T::of(2.0)),
                angular_velocity: SymmetricMatrix3::scalar(damping),
            },
            posture: [T::zero(); NV],
            posture_gains: [stiffness, damping],
            torques: [T::of(f64::from(f32::MAX)); NV],
            ranges: None,
            range_rate: frequency * T::of(12.0),
            rest_rate: frequency * T::of(5.8),
            weights: ContactWeights {
                task: [x, y, z, tilt * per_length, pitch * per_length, yaw * per_length],
                norm_length: height,
                ..standing
            },
            motion: MotionWeights::scaled(height, gravity),
            limits: Settings { work: Self::most_work(feet), ..Settings::new(T::of(1e-3)) },
            damping: T::of(0.01),
        }
    }

    /// The same for [`whole_body_motion_tick`](super::whole_body_motion_tick) under a planner of walks: what
    /// that may spend, and three times the weight of swinging feet. Of 26 pushes of the biped in MuJoCo,
    /// standing and walking, 19 are survived with the plain starting values, 22 with these, 19 with twice these.
    pub fn walking(height: T, gravity: T, feet: usize) -> Self {
        let scaled = Self::scaled(height, gravity, feet);
        let limits = Settings { work: Self::most_motion_work(feet), ..scaled.limits };
        let (weights, swing) = (scaled.motion, T::of(3.0));
        let motion = MotionWeights {
            swing_linear: weights.swing_linear * swing,
            swing_angular: weights.swing_angular * swing,
            ..weights
        };
        Self { motion, limits, ..scaled }
    }

    /// These settings with what of [`walking`](Self::walking) belongs to the height (m) of the centre of mass:
    /// not torques, posture and gains.
    pub fn for_walks(self, height: T, gravity: T, feet: usize) -> Self {
        let Self { motion, limits, posture_gains, rest_rate, .. } =
            Self::walking(height, gravity, feet);
        Self { motion, limits, posture_gains, rest_rate, ..self }
    }

    /// These settings with the ranges of a supervisor's limits, by `margin` (rad, m) narrower; none where no joint's
    /// ends before half a turn.
    pub fn within<const ROWS: usize>(self, limits: &SafetyLimits<T, ROWS>, margin: T) -> Self {
        let joints = limits.joints.as_flattened();
        let is_free = |[least, greatest]: [T; 2]| least <= -T::pi() && greatest >= T::pi();
        if joints.iter().all(|joint| is_free(joint.angle)) {
            return self;
        }
        let far = T::of(f64::from(f32::MAX) * 1e-6);
        let mut ranges = [[-far, far]; NV];
        for (to, joint) in ranges.iter_mut().skip(6).zip(joints) {
            let [least, greatest] = joint.angle;
            let margin = margin.min((greatest - least) * T::of(0.25));
            *to = [least + margin, greatest - margin];
        }
        Self { ranges: Some(ranges), ..self }
    }

    /// Whether every number can be.
    ///
    /// # Errors
    /// [`WholeBodyRobotFault::Setting`], [`WholeBodyRobotFault::Gain`].
    pub fn check(&self) -> Result<(), WholeBodyRobotFault> {
        for (velocity, (torque, posture)) in self.torques.iter().zip(&self.posture).enumerate() {
            // NaN compares as false.
            if !(*torque >= T::zero() && posture.is_finite()) {
                return Err(WholeBodyRobotFault::Setting { velocity });
            }
        }
        let mut ranges = self.ranges.iter().flatten().enumerate();
        // NaN compares as false.
        if let Some((velocity, _)) = ranges.find(|(_, [least, greatest])| !(least <= greatest)) {
            return Err(WholeBodyRobotFault::Setting { velocity });
        }
        let weights = &self.weights;
        let gains = [
            self.rest_rate,
            self.range_rate,
            self.damping,
            weights.regularization,
            weights.norm_length,
        ];
        let motion = &self.motion;
        // Those that are divided by.
        let positive = [motion.swing_linear, motion.swing_angular, motion.regularization];
        let is_positive = positive.iter().all(|x| *x > T::zero());
        let motion = [motion.linear, motion.angular, motion.norm_length];
        let all = self.posture_gains.iter().chain(&gains).chain(&weights.task);
        let mut all = all.chain(&motion).chain(&positive);
        let is_good = is_positive && all.all(|x| *x >= T::zero() && x.is_finite());
        if is_good { Ok(()) } else { Err(WholeBodyRobotFault::Gain) }
    }
}
