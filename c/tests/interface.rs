//! What calls say that cannot be answered.

// Calls of C are made as C makes them.
#![allow(unsafe_code)]

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};
use surefoot_c::{
    SUREFOOT_JOINTS, SUREFOOT_LEGS, SurefootCommand, SurefootController, SurefootMeasurement,
    SurefootMode, SurefootSettings, SurefootStatus, SurefootStop, surefoot_arm,
    surefoot_default_settings, surefoot_disarm, surefoot_init, surefoot_set_pose, surefoot_tick,
};

fn settings() -> SurefootSettings {
    let mut settings = MaybeUninit::uninit();
    // SAFETY: it is written where the answer is Ok.
    unsafe {
        assert_eq!(surefoot_default_settings(settings.as_mut_ptr()), SurefootStatus::Ok);
        settings.assume_init()
    }
}

fn measurement() -> SurefootMeasurement {
    let leg = [0.0, 25.1202_f32, 0.0, -61.6617, 0.0, 36.5415];
    SurefootMeasurement {
        position: [-0.01, 0.0, 1.1],
        orientation: [1.0, 0.0, 0.0, 0.0],
        velocity: [0.0; 6],
        joint_angles: std::array::from_fn(|joint| leg[joint % 6].to_radians()),
        joint_rates: [0.0; SUREFOOT_JOINTS],
        feet_touch: [true; SUREFOOT_LEGS],
    }
}

/// Zeroed memory, as of a static of C.
fn memory() -> Box<SurefootController> {
    // SAFETY: any content is one, and zeros are no controller.
    unsafe { Box::new(MaybeUninit::zeroed().assume_init()) }
}

fn tick(
    controller: &mut SurefootController,
    measurement: Option<&SurefootMeasurement>,
) -> (SurefootStatus, SurefootCommand) {
    let mut command = MaybeUninit::<SurefootCommand>::uninit();
    let from = measurement.map_or(null(), std::ptr::from_ref);
    // SAFETY: all pointers are of what is there; the command is written in any case.
    unsafe {
        let status = surefoot_tick(controller, from, command.as_mut_ptr());
        (status, command.assume_init())
    }
}

#[test]
fn null_is_refused() {
    let (mut controller, settings, mut command) = (memory(), settings(), MaybeUninit::uninit());
    let null_pointer = SurefootStatus::NullPointer;
    // SAFETY: null is allowed for every pointer.
    unsafe {
        assert_eq!(surefoot_default_settings(null_mut()), null_pointer);
        assert_eq!(surefoot_init(null_mut(), &settings), null_pointer);
        assert_eq!(surefoot_init(&mut *controller, null()), null_pointer);
        assert_eq!(surefoot_arm(null_mut()), null_pointer);
        assert_eq!(surefoot_disarm(null_mut()), null_pointer);
        assert_eq!(surefoot_set_pose(&mut *controller, null(), null()), null_pointer);
        assert_eq!(surefoot_tick(null_mut(), null(), command.as_mut_ptr()), null_pointer);
        assert_eq!(surefoot_tick(&mut *controller, null(), null_mut()), null_pointer);
    }
}

#[test]
fn nothing_is_done_before_a_controller_is_made() {
    let mut controller = memory();
    let (status, command) = tick(&mut controller, Some(&measurement()));
    assert_eq!((status, command.torques), (SurefootStatus::NotMade, [0.0; SUREFOOT_JOINTS]));
    let bad = SurefootSettings { period: f32::NAN, ..settings() };
    let gain = SurefootSettings { position_gain: [f32::INFINITY; 3], ..settings() };
    let ground = SurefootSettings { is_limited: true, friction: -0.1, ..settings() };
    let share = SurefootSettings { is_limited: true, sole_share: f32::NAN, ..settings() };
    // SAFETY: the pointers are of what is there.
    unsafe {
        assert_eq!(surefoot_init(&mut *controller, &bad), SurefootStatus::BadSettings);
        assert_eq!(surefoot_init(&mut *controller, &gain), SurefootStatus::BadSettings);
        assert_eq!(surefoot_init(&mut *controller, &ground), SurefootStatus::BadLimits);
        assert_eq!(surefoot_init(&mut *controller, &share), SurefootStatus::BadLimits);
        assert_eq!(surefoot_arm(&mut *controller), SurefootStatus::NotMade);
        assert_eq!(surefoot_init(&mut *controller, &settings()), SurefootStatus::Ok);
        let bad_pose = [[f32::NAN, 0.0, 1.0], [0.0, 0.0, 1.0]];
        for (position, turn) in
            bad_pose.iter().zip([[1.0, 0.0, 0.0, 0.0], [0.5; 4].map(|x: f32| 2.0 * x)])
        {
            let status = surefoot_set_pose(&mut *controller, position, &turn);
            assert_eq!(status, SurefootStatus::BadPose);
        }
    }
}

#[test]
fn a_lost_measurement_stops_it_and_says_why() {
    let mut controller = memory();
    // SAFETY: the pointers are of what is there.
    unsafe {
        assert_eq!(surefoot_init(&mut *controller, &settings()), SurefootStatus::Ok);
    }
    let (_, command) = tick(&mut controller, Some(&measurement()));
    assert_eq!((command.mode, command.torques), (SurefootMode::Standby, [0.0; SUREFOOT_JOINTS]));
    // SAFETY: the pointer is of what is there.
    unsafe {
        assert_eq!(surefoot_arm(&mut *controller), SurefootStatus::Ok);
    }
    let (_, command) = tick(&mut controller, Some(&measurement()));
    assert_eq!((command.mode, command.stop), (SurefootMode::Active, SurefootStop::None));
    assert!(command.torques.iter().any(|torque| torque.abs() > 1.0));
    let ends = (0..20).map(|_| tick(&mut controller, None).1).collect::<Vec<_>>();
    let last = ends.last().expect("twenty");
    assert_eq!((last.mode, last.stop), (SurefootMode::Stopping, SurefootStop::Stale));
    assert!(ends.iter().flat_map(|end| end.torques).all(f32::is_finite));
    // SAFETY: the pointer is of what is there.
    unsafe {
        assert_eq!(surefoot_disarm(&mut *controller), SurefootStatus::Ok);
    }
    assert_eq!(tick(&mut controller, Some(&measurement())).1.mode, SurefootMode::Standby);
    let mut wrong = measurement();
    wrong.joint_angles[3] = f32::NAN;
    // SAFETY: the pointer is of what is there.
    unsafe {
        assert_eq!(surefoot_arm(&mut *controller), SurefootStatus::Ok);
    }
    let (_, command) = tick(&mut controller, Some(&wrong));
    assert_eq!((command.stop, command.stop_joint), (SurefootStop::Encoder, 3));
}
