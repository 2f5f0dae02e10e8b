//! What the filter is told of sensors, feet and floor.

use super::EstimateFault;
use crate::Real;
use crate::spatial::Pose;

/// What a foot is to the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FootKind {
    /// It stands still: position and orientation.
    Sole,
    /// Its point stands still, about which it turns: position alone.
    Point,
}

/// Which standing feet are measured in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// One, in turn: of `k` that stand, number `n mod k` at tick `n`.
    One,
    /// All of them.
    All,
}

/// What is known of the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Floor<T> {
    /// Nothing.
    Unknown,
    /// It is level, (7). On a slope this tilts the estimate by the slope.
    Level,
    /// It is level at this height (m), (7) and (8).
    LevelAt(T),
}

/// Standard deviations: of what drifts per √s, of what is measured at each tick of 2 ms.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SensorNoise<T> {
    /// Accelerometer, m/s²/√Hz.
    pub accelerometer: T,
    /// Gyroscope, rad/s/√Hz.
    pub gyroscope: T,
    /// Drift of the accelerometer's bias, m/s²/√s.
    pub accelerometer_drift: T,
    /// Drift of the gyroscope's bias, rad/s/√s.
    pub gyroscope_drift: T,
    /// Creep of a standing foot, m/√s.
    pub foot_position: T,
    /// Its rocking, about horizontal axes, rad/√s.
    pub foot_tilt: T,
    /// Its turning about the vertical, rad/√s.
    pub foot_heading: T,
    /// `s_i` of (4), m.
    pub leg_position: T,
    /// `Z_i` of (5), rad.
    pub leg_orientation: T,
    /// (7) over a second, rad √s.
    pub level: T,
    /// (8), m.
    pub height: T,
    /// (9) over a second, m/s² √s.
    pub force_direction: T,
    /// At the start: tilt (rad), biases of accelerometer (m/s²) and gyroscope (rad/s).
    pub start: [T; 3],
}

/// Beyond these the filter says so ([`super::Health`]), and goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T> {
    /// `|b_f|`, m/s²: an estimate that was started wrong, or a sensor that is not mounted as said.
    pub accelerometer_bias: T,
    /// `|b_w|`, rad/s.
    pub gyroscope_bias: T,
    /// Largest component of (4) once a foot has settled, m: a slip, or a switch that lies.
    pub position_innovation: T,
    /// Of (5), rad.
    pub orientation_innovation: T,
    /// A switch and the plan disagree for so long, s.
    pub disagreement_s: T,
    /// No foot has stood for so long, s.
    pub airborne_s: T,
}

/// The filter's settings: all that does not change from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator<T, const FEET: usize> {
    /// `h`, s.
    pub period_s: T,
    /// `g`, m/s².
    pub gravity: T,
    /// Body from inertial sensor: how it is turned, and where it sits from the central body's centre of mass.
    pub imu: Pose<T>,
    /// `None` is no foot, for a robot with fewer than `FEET`.
    pub feet: [Option<FootKind>; FEET],
    /// Sensors.
    pub noise: SensorNoise<T>,
    /// Ground.
    pub floor: Floor<T>,
    /// Feet in turn, or all at once.
    pub turn: Turn,
    /// After touch-down variances are a hundred times as large for so long, s.
    pub settling_s: T,
    /// A component of (4) beyond this makes the foot anew, m.
    pub gate: T,
    /// When it says that something is wrong.
    pub bounds: Bounds<T>,
}

impl<T: Real> SensorNoise<T> {
    /// Of the reference (`estimation.md`, section b): an industrial inertial sensor whose noise is taken twenty
    /// and five times as large as it is, for what vibration and the model leave out.
    pub fn standard() -> Self {
        Self {
            accelerometer: T::of(0.02),
            gyroscope: T::of(5e-4),
            accelerometer_drift: T::of(1e-3),
            gyroscope_drift: T::of(1e-4),
            foot_position: T::of(2e-3),
            foot_tilt: T::of(3e-3),
            foot_heading: T::of(3e-3),
            leg_position: T::of(1e-3),
            leg_orientation: T::of(2e-3),
            // 0.02 √0.1: a variance of 0.02 at each tick of 2 ms.
            level: T::of(6.324_555_320_336_759e-3),
            height: T::of(0.02),
            // A variance of 5 at each tick of 2 ms.
            force_direction: T::of(0.1),
            start: [T::of(0.02), T::of(0.1), T::of(0.01)],
        }
    }

    /// The same where sole or floor yields, so that a standing foot rocks: on rubber (75 kN/m a corner of a sole of a
    /// person's size) by 10 to 30 mrad as the weight shifts. Taken for a foot at rest, that makes an error of tilt of
    /// its size, and steps of the estimate that a supervisor takes for faults; on a hard floor this noise costs no
    /// more than some of the soles' word on tilt.
    pub fn yielding_ground() -> Self {
        Self {
            foot_tilt: T::of(0.03),
            leg_position: T::of(2e-3),
            leg_orientation: T::of(4e-3),
            ..Self::standard()
        }
    }

    /// The same of a robot that walks on it: soles roll and twist as they carry more than half of the weight's moments.
    /// Less is believed of how a foot is turned, and of its heading; more would make errors of tilt and heading of
    /// what a foot does.
    pub fn walking() -> Self {
        Self {
            foot_tilt: T::of(0.02),
            foot_heading: T::of(0.02),
            leg_position: T::of(3e-3),
            leg_orientation: T::of(0.01),
            ..Self::yielding_ground()
        }
    }

    fn all(&self) -> [T; 15] {
        let [tilt, acceleration, rate] = self.start;
        [
            self.accelerometer,
            self.gyroscope,
            self.accelerometer_drift,
            self.gyroscope_drift,
            self.foot_position,
            self.foot_tilt,
            self.foot_heading,
            self.leg_position,
            self.leg_orientation,
            self.level,
            self.height,
            self.force_direction,
            tilt,
            acceleration,
            rate,
        ]
    }
}

impl<T: Real> Bounds<T> {
    /// 0.4 m/s², 0.1 rad/s, 2 cm, 0.1 rad, 0.2 s, 1 s.
    pub fn standard() -> Self {
        Self {
            accelerometer_bias: T::of(0.4),
            gyroscope_bias: T::of(0.1),
            position_innovation: T::of(0.02),
            orientation_innovation: T::of(0.1),
            disagreement_s: T::of(0.2),
            airborne_s: T::of(1.0),
        }
    }
}

/// A gain of Kalman's divides by variances, which must not vanish in f32 beside a robot's other numbers.
const LEAST_DEVIATION: f64 = 1e-9;
/// Nor overflow.
const GREATEST_DEVIATION: f64 = 1e3;

impl<T: Real, const FEET: usize> Estimator<T, FEET> {
    /// Standard noise and bounds, a sensor at the central body's centre of mass in its axes, feet in turn, a floor
    /// of which nothing is known.
    pub fn new(period_s: T, gravity: T, feet: [Option<FootKind>; FEET]) -> Self {
        Self {
            period_s,
            gravity,
            imu: Pose::identity(),
            feet,
            noise: SensorNoise::standard(),
            floor: Floor::Unknown,
            turn: Turn::One,
            settling_s: T::of(0.02),
            gate: T::of(0.06),
            bounds: Bounds::standard(),
        }
    }

    /// Whether every number can be.
    ///
    /// # Errors
    /// [`EstimateFault::Setting`] with its name.
    pub fn check(&self) -> Result<(), EstimateFault> {
        const { assert!(FEET >= 1 && FEET <= 4, "one to four feet") };
        let between = |x: T, least: f64, most: f64| x >= T::of(least) && x <= T::of(most);
        let good = |is_good: bool, name| {
            if is_good { Ok(()) } else { Err(EstimateFault::Setting(name)) }
        };
        good(between(self.period_s, 1e-5, 0.1), "period_s: 10 µs to 0.1 s")?;
        good(between(self.gravity, 0.1, 100.0), "gravity: 0.1 to 100 m/s²")?;
        let all = self.noise.all();
        let is_noise = all.iter().all(|x| between(*x, LEAST_DEVIATION, GREATEST_DEVIATION));
        good(is_noise, "noise: standard deviations of 1e-9 to 1e3")?;
        good(between(self.settling_s, 0.0, 10.0), "settling_s: 0 to 10 s")?;
        good(between(self.gate, 1e-6, 1e3), "gate: 1e-6 to 1e3 m")?;
        let r = &self.imu.rotation;
        let off = (r.transpose() * r - nalgebra::Matrix3::identity()).norm();
        let is_turned = off < T::of(1e-3) && r.determinant() > T::zero();
        let is_near = self.imu.position.iter().all(|x| between(x.abs(), 0.0, 100.0));
        good(is_turned && is_near, "imu: a rotation, and a point within 100 m")?;
        if let Floor::LevelAt(height) = self.floor {
            good(height.is_finite(), "floor: a finite height")?;
        }
        good(self.feet.iter().any(Option::is_some), "feet: one at least")
    }

    /// Ticks in a time, at least 0, at most 65 535.
    #[inline(always)]
    pub(super) fn ticks(&self, seconds: T) -> u16 {
        // Half a tick, so that a time of whole ticks is that many.
        let ticks = (seconds / self.period_s + T::of(0.5)).to_f64();
        if ticks > 65_535.0 { u16::MAX } else { ticks as u16 }
    }
}
