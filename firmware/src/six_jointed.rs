//! The controller of robots on legs of six joints, with or without limits of ground and motors.

use crate::control::Measurement;
use crate::robot::{GAINS, JOINTS, LIMITS, ROBOT, ROW, ROWS, SOLES, gains};
#[cfg(not(estimates))]
use surefoot::balance::limited_tick;
use surefoot::balance::{
    Command, Controller, Fault, LimitError, LimitFault, LimitField, LimitMemory, Reference,
    RobotState, Sole, WorkspaceForm, WrenchLimits, tick,
};
#[cfg(estimates)]
use surefoot::{balance::limited_tick_under, spatial::Wrench};
use surefoot_link::{
    Acknowledged, Settings, StanceSettings, TickLimits, WalkerSettings, WrenchSettings, by_leg,
};

/// Nothing is needed before the robot is armed.
pub const NEEDED: [bool; 2] = [false, false];

/// What ground and motors give.
pub type Limits = WrenchLimits<f32, ROWS>;

/// The controller, and what it keeps within limits.
pub struct Balance {
    controller: Controller<'static, f32, ROWS>,
    limiting: Option<Limiting>,
}

/// The limits, what a tick leaves for the next, and what the last one met.
struct Limiting {
    limits: Limits,
    memory: LimitMemory<f32>,
    met: Option<TickLimits<f32>>,
    /// A wrench from outside on the central body, if one is known.
    #[cfg(estimates)]
    external: Option<Wrench<f32>>,
}

impl Balance {
    /// With the gains of the robot's file, without limits.
    pub fn new() -> Self {
        Self { controller: controller(), limiting: None }
    }

    /// New constants, and no limits.
    pub fn configure(&mut self, settings: &Settings<JOINTS>) {
        self.limiting = None;
        configure(&mut self.controller, settings);
    }

    /// Within these limits from now on. Apart, so that no tick has its stack.
    #[cold]
    #[inline(never)]
    pub fn limit(&mut self, limits: Limits) {
        self.limiting = Some(Limiting {
            limits,
            memory: LimitMemory::new(),
            met: None,
            #[cfg(estimates)]
            external: None,
        });
    }

    /// Under a wrench from outside at the next tick. Without limits of the ground nothing takes it.
    #[cfg(estimates)]
    pub fn under(&mut self, external: Option<Wrench<f32>>) {
        if let Some(limiting) = &mut self.limiting {
            limiting.external = external;
        }
    }

    /// What limits made of the last tick; none where there are none.
    pub fn take_limits(&mut self) -> Option<TickLimits<f32>> {
        self.limiting.as_mut().and_then(|limiting| limiting.met.take())
    }

    /// One tick; without a measurement of contacts, no limits.
    #[inline(always)]
    pub fn tick(
        &mut self,
        state: &RobotState<f32, ROWS>,
        reference: &Reference<f32>,
        measured: Option<&Measurement>,
    ) -> Result<Command<f32, ROWS>, Fault> {
        match (&mut self.limiting, measured) {
            (Some(limiting), Some(measured)) => {
                limiting.tick(&self.controller, state, reference, &measured.contacts)
            }
            _ => tick(&self.controller, state, reference),
        }
    }
}

impl Limiting {
    #[inline(never)]
    fn tick(
        &mut self,
        controller: &Controller<'static, f32, ROWS>,
        state: &RobotState<f32, ROWS>,
        reference: &Reference<f32>,
        contacts: &[bool; ROWS],
    ) -> Result<Command<f32, ROWS>, Fault> {
        let Self { limits, memory, met, .. } = self;
        #[cfg(not(estimates))]
        let answer = limited_tick(controller, limits, state, reference, contacts, memory)?;
        #[cfg(estimates)]
        let answer = {
            let around = (contacts, self.external);
            limited_tick_under(controller, limits, state, reference, around, memory)?
        };
        *met = Some(TickLimits::from(&answer.limits));
        Ok(answer.command)
    }
}

/// With the gains of the robot's file.
pub fn controller() -> Controller<'static, f32, ROWS> {
    Controller { gains: gains(GAINS), ..Controller::new(&ROBOT) }
}

/// The controller's part of the settings.
pub fn configure(controller: &mut Controller<'static, f32, ROWS>, settings: &Settings<JOINTS>) {
    controller.gains = gains(settings.gains);
    controller.form = match settings.big_base {
        None => WorkspaceForm::FixedFoot,
        Some(factor) => WorkspaceForm::BigBase { factor },
    };
}

/// It does not walk.
pub fn walker(_: &WalkerSettings) -> Result<Limits, Acknowledged> {
    Err(Acknowledged::Unsupported)
}

/// How a robot stands is said of other ones.
pub fn standing(_: &StanceSettings<JOINTS>) -> Result<Limits, Acknowledged> {
    Err(Acknowledged::Unsupported)
}

/// Limits of a message, which may be tighter than the robot's own and no wider.
#[inline(never)]
pub fn limits(settings: &WrenchSettings<JOINTS>) -> Result<Limits, Acknowledged> {
    let Some(own) = &SOLES else { return Err(Acknowledged::Unsupported) };
    let soles = settings.soles.as_slice().try_into().map_err(|_| Acknowledged::Invalid)?;
    for (leg, (own, sole)) in own.iter().zip(soles as &[Sole<f32>; ROWS]).enumerate() {
        let is_within = |own: &[f32; 2], other: &[f32; 2]| other[0] >= own[0] && other[1] <= own[1];
        if !(is_within(&own.x, &sole.x) && is_within(&own.y, &sole.y)) {
            return Err(Acknowledged::Sole(leg as u8));
        }
    }
    let torques: [[f32; ROW]; ROWS] = by_leg(&settings.torques, f32::NAN);
    for (leg, (own, torques)) in LIMITS.joints.iter().zip(&torques).enumerate() {
        for (joint, (own, torque)) in own.iter().zip(torques).enumerate() {
            if *torque > own.torque {
                let joint = Some((leg, joint));
                let (field, fault) = (LimitField::Torque, LimitFault::Widens);
                return Err(Acknowledged::Limit(LimitError { joint, field, fault }));
            }
        }
    }
    WrenchLimits::new(&ROBOT, soles, settings.ground, &torques).map_err(|fault| {
        defmt::warn!("limits are refused: {}", defmt::Display2Format(&fault));
        Acknowledged::Invalid
    })
}
