//! The messages. Numbers are single precision: what the target computes with, bit for bit.

use crate::status::{Clock, Crash, Status};
use serde::{Deserialize, Serialize};
use surefoot::balance::{JointLimits, LimitError, Mode, RobotState, StopReason, Thresholds};
use surefoot::spatial::{Quaternion, Twist};

/// Legs of the robot on the link.
pub const LEGS: usize = 2;
/// Joints of a leg.
pub(crate) const LEG: usize = 6;

/// From host to target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ToTarget {
    /// Who are you? Answered by [`FromTarget::Identity`].
    Hello,
    /// New settings, in standby only. Answered by [`FromTarget::Acknowledged`].
    Configure(Settings),
    /// A pose to hold from now on. Acknowledged.
    SetPoint(SetPoint),
    /// Begin to balance at the next tick. Acknowledged.
    Arm,
    /// Zero torques. Acknowledged.
    Disarm,
    /// One measurement. Answered by [`FromTarget::Torques`] when a tick has used it.
    Sensors {
        /// When it was taken, by the sender's clock, µs. A free-running target refuses one that has
        /// been on its way for longer than a period; in lock step nobody reads it.
        taken_us: u32,
        /// What was measured.
        sensors: Sensors,
    },
    /// How are you? Answered by [`FromTarget::Status`].
    Status,
    /// What does each stage of a tick cost, for this measurement? Answered by
    /// [`FromTarget::Stages`], in standby only.
    Profile(Sensors),
    /// Something that should not happen. Emulation builds do it; others refuse.
    Inject(Injection),
}

/// From target to host.
// Without a heap there is no box for the largest.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FromTarget {
    /// Sent on reset, and on [`ToTarget::Hello`].
    Identity(Identity),
    /// An answer to an order.
    Acknowledged(Acknowledged),
    /// What one tick gave.
    Torques(Torques),
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
pub struct Settings {
    /// Seconds between ticks.
    pub period: f32,
    /// What makes a tick.
    pub pacing: Pacing,
    /// Diagonals of the gain matrices, in the order of `Gains`.
    pub gains: [[f32; 3]; 4],
    /// Factor of the printed big base; exactly fixed feet without one.
    pub big_base: Option<f32>,
    /// Limits of the joints: none wider than the target's own.
    pub joint_limits: [[JointLimits<f32>; LEG]; LEGS],
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
pub struct Sensors {
    /// m, world frame.
    pub position: [f32; 3],
    /// World from body, scalar first.
    pub orientation: [f32; 4],
    /// Body twist, linear first.
    pub velocity: [f32; 6],
    /// rad
    pub joint_angles: [[f32; LEG]; LEGS],
    /// rad/s
    pub joint_rates: [[f32; LEG]; LEGS],
}

/// What a tick sends to the motors, and what it cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Torques {
    /// Ticks since the last reset.
    pub tick: u32,
    /// N·m
    pub joint_torques: [[f32; LEG]; LEGS],
    /// Wrench asked of the legs, force first; zero where there was no tick.
    pub desired_wrench: [f32; 6],
    /// Mode after the tick.
    pub mode: Mode,
    /// Why it stopped.
    pub reason: Option<StopReason>,
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

impl Sensors {
    /// As the controller takes it.
    pub fn state(&self) -> RobotState<f32, LEGS> {
        RobotState {
            position: self.position.into(),
            orientation: Quaternion::from_array(self.orientation),
            velocity: Twist::from_array(self.velocity),
            joint_angles: self.joint_angles,
            joint_rates: self.joint_rates,
        }
    }
}

impl From<&RobotState<f32, LEGS>> for Sensors {
    fn from(state: &RobotState<f32, LEGS>) -> Self {
        Self {
            position: state.position.into(),
            orientation: state.orientation.to_array(),
            velocity: state.velocity.to_array(),
            joint_angles: state.joint_angles,
            joint_rates: state.joint_rates,
        }
    }
}

impl Settings {
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
            Self::Unsupported => f.write_str("this firmware does not do that"),
            Self::TooFast(us) => {
                write!(f, "a measurement a tick needs periods of {us} µs or more on this line")
            }
            Self::TooSlow(us) => write!(f, "its timer counts periods of up to {us} µs"),
        }
    }
}
