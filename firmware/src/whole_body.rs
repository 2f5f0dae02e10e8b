//! The whole-body controller of a robot that stands.

use crate::control::Measurement;
use crate::robot::{FEET, GAINS, JOINTS, ROWS, gains};
use crate::stance::{self, MODEL, Stance};
#[cfg(not(estimates))]
use surefoot::balance::whole_body_tick;
use surefoot::balance::{
    Command, Fault, Reference, RobotState, WholeBodyController, WholeBodyMemory, WholeBodyState,
};
#[cfg(estimates)]
use surefoot::{balance::whole_body_tick_under, spatial::Wrench};
use surefoot_link::{Acknowledged, Settings, StanceSettings, TickLimits, WalkerSettings};

/// What is told before the robot is armed.
pub type Limits = Stance;
/// It must know how the robot stands.
pub const NEEDED: [bool; 2] = [true, false];

/// The controller, what a tick leaves for the next, and what the last one met.
pub struct Balance {
    stance: Option<Stance>,
    /// Diagonals.
    gains: [[f32; 3]; 4],
    memory: WholeBodyMemory<f32>,
    /// Of the last tick.
    met: Option<TickLimits<f32>>,
    /// A wrench from outside on the central body, if one is known.
    #[cfg(estimates)]
    external: Option<Wrench<f32>>,
}

impl Balance {
    /// With the gains of the robot's file; it does not know yet how the robot stands.
    pub fn new() -> Self {
        Self {
            stance: None,
            gains: GAINS,
            memory: WholeBodyMemory::new(),
            met: None,
            #[cfg(estimates)]
            external: None,
        }
    }

    /// New gains; how it stands must be said again.
    pub fn configure(&mut self, settings: &Settings<JOINTS>) {
        *self = Self { gains: settings.gains, ..Self::new() };
    }

    /// How it stands. Apart, so that no tick has its stack.
    #[cold]
    #[inline(never)]
    pub fn limit(&mut self, mut stance: Stance) {
        stance.settings.gains = gains(self.gains);
        self.stance = Some(stance);
        self.memory = WholeBodyMemory::new();
    }

    /// What limits made of the last tick.
    pub fn take_limits(&mut self) -> Option<TickLimits<f32>> {
        self.met.take()
    }

    /// Under a wrench from outside at the next tick.
    #[cfg(estimates)]
    pub fn under(&mut self, external: Option<Wrench<f32>>) {
        self.external = external;
    }

    /// One tick.
    #[inline(never)]
    pub fn tick(
        &mut self,
        state: &RobotState<f32, ROWS>,
        reference: &Reference<f32>,
        measured: Option<&Measurement>,
    ) -> Result<Command<f32, ROWS>, Fault> {
        let Self { stance, memory, met, .. } = self;
        // None is armed without one.
        let Stance { robot, settings } = stance.as_ref().ok_or(Fault::NotHeld)?;
        let controller = WholeBodyController { tree: &MODEL, robot, settings };
        let contacts = measured.map_or(&[true; FEET], |measured| &measured.contacts);
        let state = WholeBodyState::of_rows(state);
        #[cfg(not(estimates))]
        let answer = whole_body_tick(&controller, &state, reference, contacts, memory)?;
        #[cfg(estimates)]
        let answer = {
            let around = (contacts, self.external);
            whole_body_tick_under(&controller, &state, reference, around, memory)?
        };
        *met = Some(TickLimits::from(&answer.limits));
        Ok(answer.in_rows())
    }
}

/// How it stands, as a message says it.
pub fn standing(message: &StanceSettings<JOINTS>) -> Result<Limits, Acknowledged> {
    stance::stance(message)
}

/// It does not walk.
pub fn walker(_: &WalkerSettings) -> Result<Limits, Acknowledged> {
    Err(Acknowledged::Unsupported)
}
