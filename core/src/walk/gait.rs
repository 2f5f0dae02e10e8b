//! How a robot walks: all constants, from its measures alone.
//!
//! Each is a number made dimensionless by the robot it was found on (74.5 kg, `z` = 0.82 m), times what its
//! unit scales with: times with `√(z/g)`, lengths with `z`, speeds with `√(g z)`, gains with `ω²` and `ω`,
//! forces with `m g`.

use super::{Side, Stature};
use crate::Real;

/// A sole is narrow whose half width is below this share of `z`: the one of the robot of the constants is 0.061 `z`.
const NARROW: f64 = 0.055;
/// `T_s` and `T_d` on narrow soles and on points, `√(z/g)`: 0.75 and half of those on others.
const QUICK: [f64; 2] = [0.934, 0.1038];

/// Constants of a walk. [`Gait::scaled`] gives those of a robot; a field may be changed before it walks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gait<T> {
    /// `ω`, 1/s.
    pub omega: T,
    /// `z`, m.
    pub height: T,
    /// `W`, m.
    pub width: T,
    /// `T_s`, s.
    pub single: T,
    /// `T_d`, s.
    pub double: T,
    /// Shortest and longest time on one side, s.
    pub times: [T; 2],
    /// Before its touch-down a step is left as it is for this long, s.
    pub freeze: T,
    /// Of a swinging foot above the ground, m.
    pub apex: T,
    /// Least and greatest step forward, m.
    pub reach: [T; 2],
    /// The same outwards, m: legs do not cross while the least is more than a sole's width.
    pub outwards: [T; 2],
    /// From the step in place, m.
    pub farthest: T,
    /// A step that leaves `b` this near is not searched for, m.
    pub tolerance: T,
    /// A walk starts when the capture point is this near to where it is at a lift-off, m.
    pub shift: T,
    /// A swinging foot's greatest mean speed, m/s.
    pub foot_speed: T,
    /// Vertical speed of a landing foot, m/s; negative.
    pub landing_speed: T,
    /// Of the centre of mass's height: 1/s², 1/s.
    pub height_gains: [T; 2],
    /// Of the central body's orientation.
    pub trunk_gains: [T; 2],
    /// Of a swinging foot.
    pub foot_gains: [T; 2],
    /// A foot presses that carries this, N.
    pub touch: T,
    /// What the leaving feet may carry at the end of double support, N.
    pub leaving: T,
    /// Share of its straight length to which a leg may stretch where the trailing foot leaves; sets how
    /// far the hips are lowered for a long step.
    pub straight: T,
    /// Double support ends at once where the trailing leg is longer than this share.
    pub strut: T,
    /// Of the capture point's error, beyond what keeps it from growing.
    pub feedback: T,
    /// Share of the sole within which a centre of pressure is asked for.
    pub margin: T,
    /// In the choice of a step: cost of its length (1), and of its time (m²/s²), beside that of `b`.
    pub costs: [T; 2],
    /// Speed loop: share of the error that goes into the step, and most of it, m/s.
    pub speed_loop: [T; 2],
    /// How fast a command is followed: m/s², rad/s².
    pub command_accelerations: [T; 2],
    /// A walk may end at a slower command than this, m/s.
    pub stopping_speed: T,
    /// A walk ends with the feet this near abreast, and the capture point this far inside, m.
    pub stopping: [T; 2],
}

impl<T: Real> Gait<T> {
    /// Of a robot by its measures.
    pub fn scaled<const FEET: usize>(stature: &Stature<T, FEET>) -> Self {
        let (z, g) = (stature.height, stature.robot.gravity);
        let weight = stature.robot.mass * g;
        let omega = (g / z).sqrt();
        let time = |x: f64| T::of(x) / omega;
        let length = |x: f64| T::of(x) * z;
        let speed = |x: f64| T::of(x) * z * omega;
        let gains = |k: f64, d: f64| [T::of(k) * omega * omega, T::of(d) * omega];
        let width = stature.width;
        // `z` is only 0.7 of the short, strong legs of a robot that steps with pairs of points.
        let is_pair = stature.is_on_points() && stature.count(Side::Left) > 1;
        let (reach, farthest, foot_speed) =
            if is_pair { ([-1.0, 1.2], 1.3, 2.5) } else { ([-0.55, 0.73], 0.915, 1.587) };
        // On soles that are narrow the moment of a weight that goes across tips a foot: quicker, with less of both sides.
        // G1 falls at 0.5 m/s with the times of a wide sole, and walks at 1.2 with these; Bolt 0.55 and 0.70.
        let is_narrow = stature.robot.pressure_reach.y < z * T::of(NARROW);
        let [single, double] = if is_narrow && width > T::zero() { QUICK } else { [1.245, 0.2075] };
        let outwards = if width > T::zero() {
            [length(0.16).min(width * T::of(0.7)), length(0.85)]
        } else {
            [length(-0.8), length(0.8)]
        };
        Self {
            omega,
            height: z,
            width,
            single: time(single),
            double: time(double),
            times: [time(0.692), time(1.902)],
            freeze: time(0.2075),
            apex: length(0.061),
            reach: reach.map(length),
            outwards,
            farthest: length(farthest),
            tolerance: length(0.0122),
            shift: length(0.0183),
            foot_speed: speed(foot_speed),
            landing_speed: speed(-0.088),
            height_gains: gains(8.36, 4.63),
            trunk_gains: gains(10.03, 5.2),
            foot_gains: gains(33.4, 11.6),
            touch: weight * T::of(0.082) / T::of(stature.count(Side::Left).max(1) as f64),
            leaving: weight * T::of(0.055),
            straight: T::of(0.95),
            strut: T::of(0.98),
            feedback: T::one(),
            margin: T::of(0.85),
            // 0.05 m²/s² at z = 0.82 m
            costs: [T::of(0.02), z * T::of(0.05 / 0.82)],
            speed_loop: [T::of(0.3), speed(0.14)],
            command_accelerations: [g * T::of(0.05), omega * T::of(0.44)],
            stopping_speed: speed(0.01763),
            stopping: [length(0.146), length(0.037)],
        }
    }
}
