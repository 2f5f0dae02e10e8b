//! The supervised balance controller of a robot that is chosen when this is built, callable from C: no allocation, no
//! global state, no call back. `include/surefoot.h` is made of this by `cargo xtask c`.
//!
//! All functions may be called from an interrupt. A controller is used by one caller at a time; different ones are
//! independent. No function keeps a pointer after it has returned.

#![cfg_attr(target_os = "none", no_std)]
// A C interface takes pointers on trust. They are looked at here alone, and in one way.
#![allow(unsafe_code)]

mod command;
mod controller;
mod measurement;
mod robot;
mod settings;
mod status;
mod version;

pub use command::{SurefootCommand, SurefootLimit, SurefootMode, SurefootStop};
pub use controller::{SUREFOOT_CONTROLLER_WORDS, SurefootController};
pub use measurement::SurefootMeasurement;
pub use robot::{SUREFOOT_JOINTS, SUREFOOT_LEGS};
pub use settings::SurefootSettings;
pub use status::SurefootStatus;
pub use version::{
    SUREFOOT_VERSION_MAJOR, SUREFOOT_VERSION_MINOR, SUREFOOT_VERSION_PATCH, surefoot_version,
};

use controller::Balance;

/// Where a chip stops that has come to a panic. No function of this library has a way there.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// Name of the robot, ends with a zero.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_robot_name() -> *const core::ffi::c_char {
    robot::NAME.as_ptr().cast()
}

/// Writes what the robot's file gives: a tick each millisecond, its gains, its pose, limits of ground that are not
/// looked at.
///
/// # Safety
/// `settings` is null, or may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surefoot_default_settings(
    settings: *mut SurefootSettings,
) -> SurefootStatus {
    // SAFETY: by the caller; null is none.
    let Some(settings) = (unsafe { settings.as_mut() }) else { return SurefootStatus::NullPointer };
    *settings = SurefootSettings::of_robot();
    SurefootStatus::Ok
}

/// Makes a controller in a caller's memory, in standby. To be called before all others, and again for other settings.
///
/// # Safety
/// `controller` is null, or may be written to; `settings` is null, or may be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surefoot_init(
    controller: *mut SurefootController,
    settings: *const SurefootSettings,
) -> SurefootStatus {
    // SAFETY: by the caller; null is none.
    let pointers = unsafe { (controller.as_mut(), settings.as_ref()) };
    let (Some(controller), Some(settings)) = pointers else { return SurefootStatus::NullPointer };
    match Balance::new(settings) {
        Ok(balance) => {
            controller.put(balance);
            SurefootStatus::Ok
        }
        Err(status) => {
            controller.clear();
            status
        }
    }
}

/// A pose to hold from the next tick on: where the central body's centre of mass is (m), and its unit quaternion,
/// scalar first.
///
/// # Safety
/// `controller` is null, or may be written to; the others are null, or point to 3 and 4 numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surefoot_set_pose(
    controller: *mut SurefootController,
    position: *const [f32; 3],
    orientation: *const [f32; 4],
) -> SurefootStatus {
    // SAFETY: by the caller; null is none.
    let pointers = unsafe { (controller.as_mut(), position.as_ref(), orientation.as_ref()) };
    let (Some(controller), Some(position), Some(orientation)) = pointers else {
        return SurefootStatus::NullPointer;
    };
    controller.with(|balance| balance.set_pose(position, orientation))
}

/// Begins to balance at the next tick.
///
/// # Safety
/// `controller` is null, or may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surefoot_arm(controller: *mut SurefootController) -> SurefootStatus {
    // SAFETY: by the caller; null is none.
    let Some(controller) = (unsafe { controller.as_mut() }) else {
        return SurefootStatus::NullPointer;
    };
    controller.with(Balance::arm)
}

/// Zero torques from the next tick on.
///
/// # Safety
/// `controller` is null, or may be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surefoot_disarm(controller: *mut SurefootController) -> SurefootStatus {
    // SAFETY: by the caller; null is none.
    let Some(controller) = (unsafe { controller.as_mut() }) else {
        return SurefootStatus::NullPointer;
    };
    controller.with(Balance::disarm)
}

/// One tick, to be called once a period: from a measurement, or null where none has come, to the torques for the
/// motors. They are finite and within the robot's limits in every mode. Where an error comes back, they are zero.
///
/// # Safety
/// `controller` and `command` are null, or may be written to; `measurement` is null, or may be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn surefoot_tick(
    controller: *mut SurefootController,
    measurement: *const SurefootMeasurement,
    command: *mut SurefootCommand,
) -> SurefootStatus {
    // SAFETY: by the caller; null is none.
    let pointers = unsafe { (controller.as_mut(), measurement.as_ref(), command.as_mut()) };
    let (controller, measurement, Some(command)) = pointers else {
        return SurefootStatus::NullPointer;
    };
    *command = SurefootCommand::NOTHING;
    let Some(controller) = controller else { return SurefootStatus::NullPointer };
    controller.with(|balance| {
        balance.tick(measurement, command);
        SurefootStatus::Ok
    })
}
