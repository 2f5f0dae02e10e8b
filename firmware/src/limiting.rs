//! Ticks within what ground and motors can give.

use crate::robot::{JOINTS, LEG, LEGS, LIMITS, ROBOT, SOLES};
use surefoot::balance::{
    Command, Controller, Fault, LimitError, LimitFault, LimitField, LimitMemory, Reference,
    RobotState, Sole, WrenchLimits, limited_tick,
};
use surefoot_link::{Acknowledged, TickLimits, WrenchSettings, by_leg};

/// The limits, what a tick leaves for the next, and what the last one met.
pub struct Limiting {
    limits: WrenchLimits<f32, LEGS>,
    memory: LimitMemory<f32>,
    /// Of the last tick; none where it was not asked.
    pub met: Option<TickLimits<f32>>,
}

impl Limiting {
    /// Before its first tick.
    pub fn new(limits: WrenchLimits<f32, LEGS>) -> Self {
        Self { limits, memory: LimitMemory::new(), met: None }
    }

    /// One tick.
    #[inline(never)]
    pub fn tick(
        &mut self,
        controller: &Controller<'static, f32, LEGS>,
        state: &RobotState<f32, LEGS>,
        reference: &Reference<f32>,
        contacts: &[bool; LEGS],
    ) -> Result<Command<f32, LEGS>, Fault> {
        let Self { limits, memory, met } = self;
        let answer = limited_tick(controller, limits, state, reference, contacts, memory)?;
        *met = Some(TickLimits::from(&answer.limits));
        Ok(answer.command)
    }
}

/// Limits of a message, which may be tighter than the robot's own and no wider.
#[inline(never)]
pub fn limits(settings: &WrenchSettings<JOINTS>) -> Result<WrenchLimits<f32, LEGS>, Acknowledged> {
    let Some(own) = &SOLES else { return Err(Acknowledged::Unsupported) };
    let soles = settings.soles.as_slice().try_into().map_err(|_| Acknowledged::Invalid)?;
    for (leg, (own, sole)) in own.iter().zip(soles as &[Sole<f32>; LEGS]).enumerate() {
        let is_within = |own: &[f32; 2], other: &[f32; 2]| other[0] >= own[0] && other[1] <= own[1];
        if !(is_within(&own.x, &sole.x) && is_within(&own.y, &sole.y)) {
            return Err(Acknowledged::Sole(leg as u8));
        }
    }
    let torques: [[f32; LEG]; LEGS] = by_leg(&settings.torques, f32::NAN);
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
