//! What a plan leaves for the next.

use super::{JumpPhase, PlaneMotion, PlannedStep, RunPhase, Side, SwingFoot};
use crate::Real;
use nalgebra::Vector2;

pub use super::speed::TouchDown;

/// What the robot is doing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase<T, const FEET: usize> {
    /// Standing on all feet.
    Standing,
    /// One side stands, the other swings.
    Single {
        /// The side that stands.
        stance: Side,
        /// Since lift-off, s.
        elapsed: T,
        /// What the swing goes to, heading frame.
        step: PlannedStep<T>,
        /// References of the swinging feet.
        swing: [Option<SwingFoot<T>>; FEET],
    },
    /// The weight goes from one side to the other.
    Double {
        /// The side that has landed, and will stand.
        stance: Side,
        /// Since touch-down, s.
        elapsed: T,
        /// Old stance point, world, m.
        old: Vector2<T>,
    },
    /// Jumping, from the crouch to standing again.
    Jump(JumpPhase<T, FEET>),
    /// Running: on one side, or on none.
    Run(RunPhase<T>),
}

/// All that a [`Planner`](super::Planner) remembers: given it, another goes on to the same bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkMemory<T, const FEET: usize> {
    /// What the robot is doing.
    pub phase: Phase<T, FEET>,
    /// `ψ`: yaw that the central body is to have, rad.
    pub heading: T,
    /// The command as far as it is followed yet.
    pub commanded: PlaneMotion<T>,
    /// What the speed loop adds to it, m/s.
    pub correction: Vector2<T>,
    /// The last two.
    pub touch_downs: [Option<TouchDown<T>>; 2],
    /// The side that a walk first stands on.
    pub first: Side,
    /// Steps so far.
    pub steps: u32,
    /// Number of the order to jump that was followed last.
    pub jumped: Option<u8>,
    /// Flights so far, of runs and jumps.
    pub flights: u32,
}

impl<T: Real, const FEET: usize> WalkMemory<T, FEET> {
    /// Of a robot that stands, its central body at the yaw `heading` (rad).
    pub fn standing(heading: T) -> Self {
        Self {
            phase: Phase::Standing,
            heading,
            commanded: PlaneMotion::in_place(),
            correction: Vector2::zeros(),
            touch_downs: [None; 2],
            first: Side::Left,
            steps: 0,
            jumped: None,
            flights: 0,
        }
    }

    /// Nothing is known of the speed yet.
    pub(super) fn forget_speed(&mut self) {
        self.correction = Vector2::zeros();
        self.touch_downs = [None; 2];
    }

    /// Wanted velocity, with the speed loop's part.
    pub(super) fn velocity(&self) -> Vector2<T> {
        self.commanded.velocity + self.correction
    }
}
