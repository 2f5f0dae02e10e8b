//! A controller in a caller's memory.

use crate::command::SurefootCommand;
use crate::measurement::SurefootMeasurement;
use crate::robot::{self, LEG, LIMITS, ROBOT, SOLES, SUREFOOT_JOINTS, SUREFOOT_LEGS};
use crate::settings::SurefootSettings;
use crate::status::SurefootStatus;
use core::mem::{MaybeUninit, align_of, size_of};
use surefoot::balance::{
    Controller, LimitMemory, Reference, Sole, Supervisor, WrenchLimits, limited_tick, tick,
};
use surefoot::spatial::Quaternion;

/// Words of eight bytes that a controller takes.
pub const SUREFOOT_CONTROLLER_WORDS: usize = 128 + 32 * SUREFOOT_JOINTS;

/// Bytes of a controller, for programs that read it when they run.
#[unsafe(no_mangle)]
#[allow(non_upper_case_globals, reason = "a name of C")]
pub static surefoot_controller_bytes: usize = size_of::<SurefootController>();

/// A controller: memory that belongs to the caller, of which `surefoot_init` makes one. To be looked at by this library
/// alone; it holds no pointer into itself, and may be copied.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurefootController {
    opaque: [MaybeUninit<u64>; SUREFOOT_CONTROLLER_WORDS],
}

/// What the memory holds.
#[repr(C)]
#[derive(Clone, Copy)]
struct Held {
    /// [`MADE`] where a controller was made of it.
    tag: u32,
    balance: MaybeUninit<Balance>,
}

/// No usual content of memory.
const MADE: u32 = 0x5ef0_07c1;

const _: () = assert!(
    size_of::<Held>() <= size_of::<SurefootController>()
        && align_of::<Held>() <= align_of::<SurefootController>(),
    "a controller needs more memory than it is given"
);

impl SurefootController {
    fn held(&mut self) -> &mut Held {
        // SAFETY: the memory is large enough and aligned (above); a tag is any 32 bits, and the rest may be anything.
        unsafe { &mut *self.opaque.as_mut_ptr().cast::<Held>() }
    }

    /// Makes one.
    pub(crate) fn put(&mut self, balance: Balance) {
        *self.held() = Held { tag: MADE, balance: MaybeUninit::new(balance) };
    }

    /// There is none.
    pub(crate) fn clear(&mut self) {
        self.held().tag = 0;
    }

    /// Does something with the one that was made.
    pub(crate) fn with(
        &mut self,
        act: impl FnOnce(&mut Balance) -> SurefootStatus,
    ) -> SurefootStatus {
        let held = self.held();
        if held.tag != MADE {
            return SurefootStatus::NotMade;
        }
        // SAFETY: the tag is written with it, in `put` alone.
        act(unsafe { held.balance.assume_init_mut() })
    }
}

/// Controller, supervisor, and what is between two ticks.
#[derive(Clone, Copy)]
pub(crate) struct Balance {
    controller: Controller<'static, f32, SUREFOOT_LEGS>,
    supervisor: Supervisor<f32, SUREFOOT_LEGS>,
    reference: Reference<f32>,
    limits: Option<WrenchLimits<f32, SUREFOOT_LEGS>>,
    memory: LimitMemory<f32>,
}

impl Balance {
    /// In standby.
    pub fn new(settings: &SurefootSettings) -> Result<Self, SurefootStatus> {
        let mut controller = Controller::new(&ROBOT);
        controller.gains = settings.gains().ok_or(SurefootStatus::BadSettings)?;
        let supervisor = Supervisor::new(LIMITS, settings.period);
        Ok(Self {
            controller,
            supervisor: supervisor.map_err(|_| SurefootStatus::BadSettings)?,
            reference: robot::reference(),
            limits: if settings.is_limited { Some(limits(settings)?) } else { None },
            memory: LimitMemory::new(),
        })
    }

    pub fn set_pose(&mut self, position: &[f32; 3], orientation: &[f32; 4]) -> SurefootStatus {
        let finite = position.iter().chain(orientation).all(|x| x.is_finite());
        let square: f32 = orientation.iter().map(|x| x * x).sum();
        if !(finite && (square - 1.0).abs() < 2e-3) {
            return SurefootStatus::BadPose;
        }
        self.reference =
            Reference::at_rest((*position).into(), Quaternion::from_array(*orientation));
        SurefootStatus::Ok
    }

    pub fn arm(&mut self) -> SurefootStatus {
        self.supervisor.arm();
        SurefootStatus::Ok
    }

    pub fn disarm(&mut self) -> SurefootStatus {
        self.supervisor.disarm();
        SurefootStatus::Ok
    }

    /// One tick.
    pub fn tick(
        &mut self,
        measurement: Option<&SurefootMeasurement>,
        command: &mut SurefootCommand,
    ) {
        let Self { controller, supervisor, reference, limits, memory } = self;
        let state = measurement.map(SurefootMeasurement::state);
        let mut met = None;
        let supervised = supervisor.step_with(state.as_ref(), reference, false, |now| {
            match (&limits, measurement) {
                (Some(limits), Some(measured)) => {
                    let feet = &measured.feet_touch;
                    let answer = limited_tick(controller, limits, now, reference, feet, memory)?;
                    met = Some(answer.limits);
                    Ok(answer.command)
                }
                _ => tick(controller, now, reference),
            }
        });
        for (to, torque) in command.torques.iter_mut().zip(supervised.joint_torques.as_flattened())
        {
            *to = *torque;
        }
        command.tell_mode(supervisor.mode(), supervisor.reason());
        if let Some(met) = &met {
            command.tell_limits(met);
        }
        command.cut_torques = supervisor.cut_torques();
    }
}

/// Of the settings' ground, the robot's soles and its motors.
fn limits(settings: &SurefootSettings) -> Result<WrenchLimits<f32, SUREFOOT_LEGS>, SurefootStatus> {
    let refused = SurefootStatus::BadLimits;
    let mut soles: [Sole<f32>; SUREFOOT_LEGS] = SOLES.ok_or(refused)?;
    let share = settings.sole_share;
    if !(share > 0.0 && share <= 1.0) {
        return Err(refused);
    }
    for sole in &mut soles {
        for ends in [&mut sole.x, &mut sole.y] {
            let [low, high] = *ends;
            let (middle, half) = (0.5 * (low + high), 0.5 * share * (high - low));
            *ends = [middle - half, middle + half];
        }
    }
    let mut torques = [[0.0; LEG]; SUREFOOT_LEGS];
    for (to, limit) in torques.as_flattened_mut().iter_mut().zip(LIMITS.joints.as_flattened()) {
        *to = limit.torque;
    }
    WrenchLimits::new(&ROBOT, &soles, settings.ground(), &torques).map_err(|_| refused)
}
