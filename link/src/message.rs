//! The messages, of a robot with so many joints. Numbers are single precision: what the target computes
//! with, bit for bit. Joints stand in the robot's order: on legs of six joints, leg after leg from hip to foot.
//!
//! Greetings are the same for robots of all sizes, so that ends of different robots can say so.

use crate::joints::Joints;
use crate::limits::{MOST_FEET, StanceSettings, TickLimits, WrenchSettings};
use crate::robot::RobotId;
use crate::sensing::{Estimated, FilterSettings, ObserverSettings, Readings, by_foot};
use crate::status::{Clock, Crash, Status};
use crate::walking::{WalkOrder, WalkerSettings};
use serde::{Deserialize, Serialize};
use surefoot::balance::{JointLimits, LimitError, Mode, RobotState, StopReason, Thresholds};
use surefoot::spatial::{Quaternion, Twist};

/// From host to target.
// Without a heap there is no box for the largest.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ToTarget<const JOINTS: usize> {
    /// Who are you? Answered by [`FromTarget::Identity`].
    Hello,
    /// New settings, in standby only, and no limits of ground and motors. Answered by
    /// [`FromTarget::Acknowledged`].
    Configure(Settings<JOINTS>),
    /// Distribute wrenches within these limits, from the next tick on; in standby only. Acknowledged.
    Limit(WrenchSettings<JOINTS>),
    /// How a robot stands that the whole-body controller balances; in standby only, and it must be said
    /// before such a robot is armed. Acknowledged; others refuse it, as such robots refuse `Limit`.
    Stand(StanceSettings<JOINTS>),
    /// The measures of a robot that walks; after `Stand`, in standby only, and before such a robot is armed.
    /// Acknowledged; refused by firmware that does not walk.
    Walker(WalkerSettings),
    /// What a robot that walks is to do from the next tick on. Acknowledged.
    Walk(WalkOrder),
    /// Estimate the state from [`Readings`](ToTarget::Readings), from the next of them on; in standby only.
    /// Acknowledged; refused by firmware that does not estimate.
    Filter(FilterSettings),
    /// Observe disturbances; in standby only. Acknowledged; refused by firmware that does not estimate.
    Observe(ObserverSettings),
    /// A pose to hold from now on. Acknowledged.
    SetPoint(SetPoint),
    /// Begin to balance this robot at the next tick. Acknowledged; refused by a target of another.
    Arm(RobotId),
    /// Zero torques. Acknowledged.
    Disarm,
    /// One measurement. Answered by [`FromTarget::Torques`] when a tick has used it.
    Sensors {
        /// When it was taken, by the sender's clock, µs. A free-running target refuses one that has
        /// been on its way for longer than a period; in lock step nobody reads it.
        taken_us: u32,
        /// What was measured.
        sensors: Sensors<JOINTS>,
    },
    /// What sensors read, in the place of a measurement, for firmware with a filter. Answered likewise.
    Readings {
        /// As of a measurement.
        taken_us: u32,
        /// What they read.
        readings: Readings<JOINTS>,
    },
    /// How are you? Answered by [`FromTarget::Status`].
    Status,
    /// What does each stage of a tick cost, for this measurement? Answered by
    /// [`FromTarget::Stages`], in standby only.
    Profile(Sensors<JOINTS>),
    /// Something that should not happen. Emulation builds do it; others refuse.
    Inject(Injection),
}

/// From target to host.
// Without a heap there is no box for the largest.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FromTarget<const JOINTS: usize> {
    /// Sent on reset, and on [`ToTarget::Hello`].
    Identity(Identity),
    /// An answer to an order.
    Acknowledged(Acknowledged),
    /// What one tick gave.
    Torques(Torques<JOINTS>),
    /// Counts and logs.
    Status(Status),
    /// Costs by stage.
    Stages(Stages),
}

/// What became of an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Acknowledged {
    /// It is done.
    Done,
    /// Not in this mode.
    Busy,
    /// Its numbers make no sense: not finite, or out of range.
    Invalid,
    /// A limit makes no sense, or allows more than the target's own.
    Limit(LimitError),
    /// The target has been built for another robot: this one.
    Robot(RobotId),
    /// It has not been told how the robot stands: see [`ToTarget::Stand`].
    NoStance,
    /// This leg's sole is larger than the target's own robot has it.
    Sole(u8),
    /// This build does not do that.
    Unsupported,
    /// The period is shorter than the line needs for a measurement: this much, µs.
    TooFast(u32),
    /// The period is longer than the target's timer counts: this much, µs.
    TooSlow(u32),
}

/// What a cost is counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Counter {
    /// Clock cycles, of the debug unit's counter.
    Cycles,
    /// Instructions, of an emulator's clock that goes by instructions.
    Instructions,
}

/// Who the target is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    /// What it has been built for.
    pub robot: RobotId,
    /// Unit of all costs.
    pub counter: Counter,
    /// Cost that takes one second.
    pub per_second: u32,
    /// Resets that the log has seen.
    pub resets: u32,
    /// Mode in which the last reset came, if the log has survived it.
    pub mode_at_reset: Option<Mode>,
    /// What it is clocked by.
    pub clock: Clock,
}

/// How time goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Pacing {
    /// A tick for every frame that arrives, whole or not: the plant's time is the host's.
    LockStep,
    /// A tick for every period of the target's timer: the plant's time is the world's.
    FreeRunning,
}

/// Constants of controller and supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings<const JOINTS: usize> {
    /// Seconds between ticks.
    pub period: f32,
    /// What makes a tick.
    pub pacing: Pacing,
    /// Diagonals of the gain matrices, in the order of `Gains`.
    pub gains: [[f32; 3]; 4],
    /// Factor of the printed big base; exactly fixed feet without one.
    pub big_base: Option<f32>,
    /// Limits of the joints: none wider than the target's own.
    pub joint_limits: Joints<JointLimits<f32>, JOINTS>,
    /// Thresholds of the supervisor: none wider than the target's own.
    pub thresholds: Thresholds<f32>,
}

/// A pose to hold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SetPoint {
    /// m
    pub position: [f32; 3],
    /// Scalar first.
    pub orientation: [f32; 4],
}

/// A measured state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensors<const JOINTS: usize> {
    /// m, world frame.
    pub position: [f32; 3],
    /// World from body, scalar first.
    pub orientation: [f32; 4],
    /// Body twist, linear first.
    pub velocity: [f32; 6],
    /// rad
    pub joint_angles: Joints<f32, JOINTS>,
    /// rad/s
    pub joint_rates: Joints<f32, JOINTS>,
    /// Which feet touch the ground: bit 0 is the first. Looked at only within limits.
    pub contacts: u8,
    /// Normal forces on the feet, N; none where the robot does not walk.
    pub forces: Joints<f32, MOST_FEET>,
}

/// What a tick sends to the motors, and what it cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Torques<const JOINTS: usize> {
    /// Ticks since the last reset.
    pub tick: u32,
    /// N·m
    pub joint_torques: Joints<f32, JOINTS>,
    /// Wrench asked of the legs, force first; zero where there was no tick.
    pub desired_wrench: [f32; 6],
    /// Mode after the tick.
    pub mode: Mode,
    /// Why it stopped.
    pub reason: Option<StopReason>,
    /// What limits of ground and motors made of it, where there are any.
    pub limits: Option<TickLimits<f32>>,
    /// Steps so far, of a robot that walks.
    pub steps: u32,
    /// What the filter has made of the readings, where there is one.
    pub estimated: Option<Estimated>,
    /// Cost of the tick, from measurement to torques.
    pub cost: u32,
    /// Cost between the tick's being due and its beginning.
    pub latency: u32,
}

/// Costs of a tick's stages, each alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stages {
    /// Pose and velocity of the central body.
    pub central_body: u32,
    /// Alg. 4.1 and 4.2.
    pub leg_kinematics: u32,
    /// Alg. 4.4.
    pub desired_acceleration: u32,
    /// Alg. 4.3, or the fixed foot.
    pub workspace_dynamics: u32,
    /// Alg. 4.5.
    pub wrench_distribution: u32,
    /// Alg. 4.6.
    pub joint_torques: u32,
    /// The whole tick.
    pub tick: u32,
}

/// What should not happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Injection {
    /// The next tick takes this much longer.
    Delay(u32),
    /// Power fails for a moment: a reset, the memory keeps its contents.
    Reset,
    /// Power fails for longer: a reset, the memory loses its contents.
    ResetAndForget,
    /// The program ends of this, whatever the numbers in it.
    Crash(Crash),
    /// Ends the emulator.
    Exit,
}

impl<const JOINTS: usize> ToTarget<JOINTS> {
    /// Whether it is of a robot with so many joints; where it names none, of any.
    pub fn is_of(&self, joints: usize) -> bool {
        let has = |sensors: &Sensors<JOINTS>| {
            sensors.joint_angles.len() == joints && sensors.joint_rates.len() == joints
        };
        match self {
            Self::Configure(settings) => settings.joint_limits.len() == joints,
            Self::Limit(settings) => settings.torques.len() == joints,
            Self::Stand(settings) => {
                settings.torques.len() == joints && settings.posture.len() == joints
            }
            Self::Sensors { sensors, .. } | Self::Profile(sensors) => has(sensors),
            Self::Readings { readings, .. } => {
                readings.joint_angles.len() == joints && readings.joint_rates.len() == joints
            }
            _ => true,
        }
    }
}

impl<const JOINTS: usize> Sensors<JOINTS> {
    /// As the controller takes it; joints that the message does not have are at 0.
    pub fn state<const LEGS: usize>(&self) -> RobotState<f32, LEGS> {
        RobotState {
            position: self.position.into(),
            orientation: Quaternion::from_array(self.orientation),
            velocity: Twist::from_array(self.velocity),
            joint_angles: by_leg(&self.joint_angles, 0.0),
            joint_rates: by_leg(&self.joint_rates, 0.0),
        }
    }

    /// Which feet touch the ground, leg by leg.
    pub fn contacts<const LEGS: usize>(&self) -> [bool; LEGS] {
        by_foot(self.contacts)
    }

    /// The same as bits.
    pub fn contact_bits(feet: &[bool]) -> u8 {
        feet.iter().take(8).enumerate().fold(0, |bits, (k, touches)| bits | u8::from(*touches) << k)
    }
}

/// The entries of all joints by leg; `missing` for those that are not there.
pub fn by_leg<T: Copy, const LEGS: usize, const LEG: usize>(
    joints: &[T],
    missing: T,
) -> [[T; LEG]; LEGS] {
    core::array::from_fn(|leg| {
        core::array::from_fn(|k| joints.get(LEG * leg + k).copied().unwrap_or(missing))
    })
}

/// The entries of all legs, joint by joint; `missing` for those that are not there.
pub fn by_joint<T: Copy, const JOINTS: usize, const LEG: usize>(
    legs: &[[T; LEG]],
    missing: T,
) -> Joints<T, JOINTS> {
    let all = legs.as_flattened();
    core::array::from_fn(|joint| all.get(joint).copied().unwrap_or(missing)).into()
}

impl<const JOINTS: usize> Settings<JOINTS> {
    /// Time between ticks, µs.
    pub fn period_us(&self) -> u32 {
        (self.period * 1e6 + 0.5) as u32
    }

    /// Whether all numbers but limits make sense: of these the target's own decide.
    pub fn is_valid(&self) -> bool {
        let positive = |x: f32| x.is_finite() && x > 0.0;
        positive(self.period)
            && self.period >= 1e-4
            && self.period <= 1.0
            && self.gains.iter().flatten().all(|x| positive(*x))
            && self.big_base.is_none_or(|factor| factor.is_finite() && factor >= 1.0)
    }
}

impl SetPoint {
    /// Whether it is a pose.
    pub fn is_valid(&self) -> bool {
        let norm: f32 = self.orientation.iter().map(|x| x * x).sum();
        self.position.iter().all(|x| x.is_finite()) && (norm - 1.0).abs() < 2e-3
    }
}

impl core::fmt::Display for Acknowledged {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Done => f.write_str("done"),
            Self::Busy => f.write_str("not in this mode"),
            Self::Invalid => f.write_str("numbers out of range"),
            Self::Limit(error) => error.fmt(f),
            Self::Robot(robot) => write!(f, "it has been built for {robot}"),
            Self::NoStance => f.write_str("it has not been told how the robot stands"),
            Self::Sole(leg) => write!(f, "the sole of leg {leg} is larger than its robot's"),
            Self::Unsupported => f.write_str("this firmware does not do that"),
            Self::TooFast(us) => {
                write!(f, "a measurement a tick needs periods of {us} µs or more on this line")
            }
            Self::TooSlow(us) => write!(f, "its timer counts periods of up to {us} µs"),
        }
    }
}
