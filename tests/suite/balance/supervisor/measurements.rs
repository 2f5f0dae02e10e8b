//! Which measurements are believed, for how long, and what stops the robot.

use super::{Loop, PERIOD, crouch};
use surefoot::balance::{RobotState, StopReason};
use surefoot::model::robots::biped;

/// A robot whose knee and body move, and whose readings say so.
pub fn moving(tick: u32) -> RobotState<f64, 2> {
    let time = PERIOD * f64::from(tick);
    let mut state = crouch();
    state.joint_angles[0][3] += 0.3 * time;
    state.joint_rates[0][3] = 0.3;
    state.position.x += 0.05 * time;
    state.velocity.linear.x = 0.05;
    state
}

/// Ticks until a loop stops under measurements that `measure` makes, and why.
fn until_stopped(
    mut measure: impl FnMut(u32) -> Option<RobotState<f64, 2>>,
) -> Option<(u32, StopReason)> {
    let mut it = Loop::<f64>::new();
    it.supervisor.arm();
    (0..200).find_map(|tick| {
        it.step(measure(tick).as_ref(), false);
        it.supervisor.reason().map(|reason| (tick, reason))
    })
}

/// An encoder that stands still while its joint moves, or that moves alone, is found out at its fifth tick, through
/// a tick that is bridged too.
#[test]
fn angles_must_follow_rates() {
    assert_eq!(until_stopped(|tick| Some(moving(tick))), None);
    let frozen = |tick| {
        let mut state = moving(tick);
        state.joint_angles[0][3] = moving(tick.min(50)).joint_angles[0][3];
        state
    };
    let expected = StopReason::Frozen { leg: 0, joint: 3 };
    assert_eq!(until_stopped(|tick| Some(frozen(tick))), Some((55, expected)));
    assert_eq!(until_stopped(|tick| (tick != 52).then(|| frozen(tick))), Some((56, expected)));
    let still = |tick| {
        let mut state = moving(tick);
        state.joint_rates[0][3] = if tick < 50 { 0.3 } else { 0.0 };
        state
    };
    // At the first tick the step of the rate explains half of it.
    assert_eq!(until_stopped(|tick| Some(still(tick))), Some((55, expected)));
}

/// A whole measurement that comes again and again while joints move is none.
#[test]
fn a_measurement_that_repeats_is_none() {
    let stop = until_stopped(|tick| Some(moving(tick.min(50))));
    assert_eq!(stop, Some((52, StopReason::Stale)));
    // A robot at rest repeats its measurements.
    assert_eq!(until_stopped(|_| Some(crouch())), None);
}

/// One measurement lost now and then is bridged; every second, or every tenth, is not.
#[test]
fn measurements_lost_too_often_stop() {
    let every = |n: u32| until_stopped(|tick| (tick % n != n - 1).then(|| moving(tick)));
    assert_eq!(every(2), Some((5, StopReason::Stale)));
    assert_eq!(every(10).map(|(_, reason)| reason), Some(StopReason::Stale));
    assert_eq!(every(11), None);
}

/// A reading that may be an impact moves torques by a step at most, and not for long.
#[test]
fn doubtful_measurements_act_a_little() {
    let mut it = Loop::<f64>::armed();
    let before = it.step(Some(&crouch()), false).joint_torques;
    let mut doubtful = crouch();
    doubtful.velocity.linear.z = 1.5;
    let step = it.limits.thresholds.torque_step;
    let after = it.step(Some(&doubtful), false);
    let asked = after.command.expect("a tick's answer").joint_torques;
    let pairs = after.joint_torques.iter().flatten().zip(before.iter().flatten());
    for ((now, before), asked) in pairs.zip(asked.iter().flatten()) {
        assert!((now - (before + (asked - before).clamp(-step, step))).abs() < 1e-12);
    }
    assert!((asked[0][3] - before[0][3]).abs() > 2.0 * step, "or this is no test");
    // It is gone: a doubtful step back, and all is as before.
    it.step(Some(&crouch()), false);
    assert_eq!(it.step(Some(&crouch()), false).joint_torques, before);
    // It does not go.
    let stop = until_stopped(|tick| {
        let mut state = crouch();
        state.velocity.linear.z = if tick < 50 { 0.0 } else { 0.3 };
        Some(state)
    });
    let ticks = u32::from(it.limits.thresholds.doubtful_ticks);
    assert_eq!(stop, Some((50 + ticks, StopReason::Doubtful)));
}

/// A hop is borne; a flight is not, though the body is above where it stood: with `free_fall_s` of 0.1 s at
/// the tick after.
#[test]
fn flights_are_told_from_hops() {
    let thrown = |tick: u32| {
        let time = PERIOD * f64::from(tick);
        let mut state = crouch::<f64>();
        state.velocity.linear.z = 1.2 - 9.81 * time;
        state.position.z += 1.2 * time - 0.5 * 9.81 * time * time;
        state
    };
    // The first tick has none before it.
    let ticks = (biped::LIMITS.thresholds.free_fall_s / PERIOD) as u32;
    assert_eq!(until_stopped(|tick| Some(thrown(tick))), Some((ticks, StopReason::FreeFall)));
    assert!(thrown(ticks).position.z > crouch::<f64>().position.z);
    let hop = |tick: u32| {
        let mut state = thrown(tick.min(ticks - 1));
        state.position.z +=
            PERIOD * f64::from(tick.saturating_sub(ticks - 1)) * state.velocity.linear.z;
        state
    };
    assert_eq!(until_stopped(|tick| Some(hop(tick))), None);
}
