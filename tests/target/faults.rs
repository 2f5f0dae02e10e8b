//! Fault injection: the robot is stopped, the reason is logged, motors brake, and torques stay within
//! their limits (which the bench checks at every tick).

use crate::bench::{Bench, JOINTS, Sensors, ToTarget, Torques, arm};
use surefoot::balance::{Fault, Input, LimitError, LimitFault, LimitField, Mode, StopReason};
use surefoot_link::{Acknowledged, Crash, Injection, RobotId, Sender, frame_bytes};

/// The robot is rising then, with joint rates of up to 2 rad/s.
const MIDDLE: usize = 60;

/// Ticks that `fault` makes, until the target stops: at most `ticks`, during which torques leap by less than
/// 20 N·m.
fn stops_within(
    ticks: u32,
    mut bench: Bench,
    mut fault: impl FnMut(&mut Bench) -> Torques,
) -> StopReason {
    let mut before = bench.tick(|_| {});
    for tick in 1.. {
        let torques = fault(&mut bench);
        if torques.mode == Mode::Active {
            let pairs = torques.joint_torques.iter().zip(&before.joint_torques);
            assert!(pairs.into_iter().all(|(now, before)| (now - before).abs() < 20.0));
            assert!(tick < ticks, "still active {tick} ticks after the fault");
            before = torques;
            continue;
        }
        let reason = torques.reason.expect("a reason");
        brakes(&mut bench);
        let status = bench.target.status().expect("an answer");
        assert_eq!(status.mode, Mode::Stopped);
        let last = status.log.stops.last().expect("a stop in the log");
        assert_eq!((last.reason, last.tick), (reason, torques.tick));
        return reason;
    }
    unreachable!()
}

fn stops(bench: Bench, fault: impl FnMut(&mut Bench) -> Torques) -> StopReason {
    stops_within(2, bench, fault)
}

/// Motors take energy out of the joints, and put none in; then there are no torques, to stay, whatever is
/// measured.
fn brakes(bench: &mut Bench) {
    let period = 1.0 / bench.scene.controller.rate_hz;
    let ticks = (f64::from(bench.limits.stop_s) / period).round() as u32;
    let mut work = 0.0;
    for tick in 1..=ticks + 5 {
        let sensors = bench.sensors();
        let torques = bench.target.tick(&sensors).expect("an answer");
        let rates = &sensors.joint_rates;
        for (torque, rate) in torques.joint_torques.iter().zip(rates) {
            assert!(torque * rate <= 0.0, "{tick} ticks after: {torque} N·m at {rate} rad/s");
            work += f64::from(torque * rate) * period;
        }
        assert_eq!(torques.mode == Mode::Stopped, tick >= ticks - 1, "{tick} ticks after");
        // A tenth of a second of the collapse is enough; then it repeats.
        if tick < 50 {
            bench.obey(&torques);
        }
    }
    assert!(work < 0.0, "{work} J");
}

fn stops_at(spoil: impl Fn(&mut Sensors) + Copy) -> StopReason {
    stops(Bench::after(MIDDLE), |bench| bench.tick(spoil))
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn numbers_that_are_none() {
    for (bad, joint) in [(f32::NAN, 0), (f32::INFINITY, 3), (f32::NEG_INFINITY, 5)] {
        let encoder = StopReason::Encoder { leg: 1, joint };
        assert_eq!(stops_at(|sensors| sensors.joint_angles[6 + joint] = bad), encoder);
        assert_eq!(stops_at(|sensors| sensors.joint_rates[6 + joint] = bad), encoder);
    }
    for bad in [f32::NAN, f32::INFINITY] {
        for spoil in [
            (|sensors: &mut Sensors, bad| sensors.position[1] = bad) as fn(&mut Sensors, f32),
            |sensors, bad| sensors.orientation[0] = bad,
            |sensors, bad| sensors.velocity[5] = bad,
        ] {
            let reason = stops_at(|sensors| spoil(sensors, bad));
            assert!(matches!(reason, StopReason::Tick(Fault::NotFinite(_))), "{reason:?}");
        }
    }
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn numbers_out_of_range() {
    let reason = stops_at(|sensors| sensors.joint_angles[2] = 1e30);
    assert_eq!(reason, StopReason::Encoder { leg: 0, joint: 2 });
    let reason = stops_at(|sensors| sensors.orientation = [0.5, 0.0, 0.0, 0.0]);
    // It is off by a leap before it is off unit norm.
    assert_eq!(reason, StopReason::BodyJump(Input::Orientation));
    // A quarter turn, from one tick to the next.
    let reason = stops_at(|sensors| {
        sensors.orientation =
            [std::f32::consts::FRAC_1_SQRT_2, std::f32::consts::FRAC_1_SQRT_2, 0.0, 0.0];
    });
    assert_eq!(reason, StopReason::Tilt);
    let reason = stops_at(|sensors| sensors.joint_rates[10] = 150.0);
    assert_eq!(reason, StopReason::Encoder { leg: 1, joint: 4 });
    let reason = stops_at(|sensors| sensors.joint_angles[10] += 0.2);
    assert_eq!(reason, StopReason::Jump { leg: 1, joint: 4 });
    let reason = stops_at(|sensors| sensors.velocity[1] += 3.0);
    assert_eq!(reason, StopReason::BodyJump(Input::Position));
    let reason = stops_at(|sensors| sensors.velocity[4] += 30.0);
    assert_eq!(reason, StopReason::BodyJump(Input::Orientation));
}

/// An encoder that stands still while its joint moves: the angle alone, and angle and rate.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn a_frozen_encoder() {
    let mut bench = Bench::after(MIDDLE);
    let frozen = bench.sensors();
    let rate = frozen.joint_rates[3].abs();
    assert!(rate > 0.5, "the knee moves: {rate} rad/s");
    bench.tick(|_| {});
    let reason = stops_within(6, bench, |bench| {
        bench.tick(|sensors| sensors.joint_angles[3] = frozen.joint_angles[3])
    });
    assert_eq!(reason, StopReason::Frozen { leg: 0, joint: 3 });

    let mut bench = Bench::after(MIDDLE);
    let mut held = None;
    let reason = stops_within(
        7,
        {
            bench.tick(|_| {});
            bench
        },
        |bench| {
            let now = bench.sensors();
            let (angle, rate) = *held.get_or_insert((now.joint_angles[9], now.joint_rates[9]));
            bench.tick(|sensors| {
                sensors.joint_angles[9] = angle;
                sensors.joint_rates[9] = rate;
            })
        },
    );
    assert_eq!(reason, StopReason::Frozen { leg: 1, joint: 3 });
}

/// One lost measurement is bridged by holding the torques; a second one stops the robot.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn lost_frames() {
    let reason = stops(Bench::after(MIDDLE), |bench| bench.tick_with_frame(|_| vec![0]));
    assert_eq!(reason, StopReason::Stale);

    let mut bench = Bench::after(MIDDLE);
    let before = bench.tick(|_| {});
    let held = bench.tick_with_frame(|_| vec![0]);
    assert_eq!((held.mode, held.joint_torques), (Mode::Active, before.joint_torques));
    for _ in 0..10 {
        assert_eq!(bench.tick(|_| {}).mode, Mode::Active, "one lost frame is no reason to stop");
    }
}

/// Frames cut short, changed, and sent twice are no measurements, and are counted.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn spoilt_frames() {
    let mut bench = Bench::after(MIDDLE);
    let mut last = Vec::new();
    bench.tick_with_frame(|frame| {
        last.clone_from(&frame);
        frame
    });
    // Each loss is made up for before the next: more than two in twenty ticks stop the robot.
    let recover = |bench: &mut Bench| {
        for _ in 0..10 {
            bench.tick(|_| {});
        }
    };
    assert_eq!(bench.tick_with_frame(|_| last.clone()).mode, Mode::Active);
    recover(&mut bench);
    bench.tick_with_frame(|frame| [&frame[..20], &[0]].concat());
    recover(&mut bench);
    bench.tick_with_frame(|mut frame| {
        frame[30] ^= 0x11;
        frame
    });
    assert_eq!(bench.tick(|_| {}).mode, Mode::Active);
    let received = bench.target.status().expect("an answer").received;
    assert_eq!(received.out_of_order, 1);
    // Where a frame is cut decides whether it is its end or its checksum that is missing.
    assert_eq!(received.truncated + received.corrupted, 3, "with the empty one of the greeting");
    assert_eq!(
        received.lost, 3,
        "the two that were spoilt, and the one for which the old one came"
    );
    let reason = stops(bench, |bench| bench.tick_with_frame(|_| last.clone()));
    assert_eq!(reason, StopReason::Stale);
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn an_overrun() {
    let mut bench = Bench::after(MIDDLE);
    // 4 ms of the emulator's time more than a tick takes, of the 2 ms that the board has.
    let delay = 4 * bench.target.identity().per_second / 1000;
    bench.target.order("delay", &ToTarget::Inject(Injection::Delay(delay))).expect("obeyed");
    let late = bench.tick(|_| {});
    assert!(late.cost > delay);
    // The one before was the late one.
    let torques = bench.tick(|_| {});
    assert_eq!(torques.reason, Some(StopReason::Overrun));
    brakes(&mut bench);
    let status = bench.target.status().expect("an answer");
    assert_eq!(status.overruns, 1);
    assert_eq!(status.log.stops.last().map(|stop| stop.reason), Some(StopReason::Overrun));
}

/// Power fails in the middle of a run: after the reset torques are zero until someone arms the robot,
/// and the log knows what happened, if the memory has kept it.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn a_brown_out() {
    for (injection, is_kept) in [(Injection::Reset, true), (Injection::ResetAndForget, false)] {
        let mut bench = Bench::after(MIDDLE);
        // A stop in the log before.
        let reason = bench.tick(|sensors| sensors.joint_rates[0] = f32::NAN).reason;
        assert_eq!(reason, Some(StopReason::Encoder { leg: 0, joint: 0 }));
        let scene = bench.scene.clone();
        arm(&mut bench.target, &scene);
        assert_eq!(bench.tick(|_| {}).mode, Mode::Active);

        let identity = bench.target.reset(injection).expect("an answer");
        for _ in 0..3 {
            let sensors = bench.sensors();
            let torques = bench.target.tick(&sensors).expect("an answer");
            assert_eq!(torques.mode, Mode::Standby);
            assert_eq!(torques.joint_torques, [0.0; JOINTS].into());
        }
        let log = bench.target.status().expect("an answer").log;
        if is_kept {
            assert_eq!(identity.resets, 2);
            assert_eq!(identity.mode_at_reset, Some(Mode::Active));
            assert_eq!(
                log.stops.iter().map(|stop| Some(stop.reason)).collect::<Vec<_>>(),
                [reason]
            );
        } else {
            assert_eq!((identity.resets, identity.mode_at_reset), (1, None));
            assert!(log.stops.is_empty());
        }
        arm(&mut bench.target, &scene);
        let sensors = bench.sensors();
        assert_eq!(bench.target.tick(&sensors).expect("an answer").mode, Mode::Active);
    }
}

/// The program ends in the middle of a run, of a panic, a hard fault, and an interrupt that nothing
/// handles: it is reset, torques are zero, and the log knows of what.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn crashes() {
    let mut bench = Bench::after(MIDDLE);
    let scene = bench.scene.clone();
    let crashes = [
        Crash::Panic { line: 0 },
        Crash::HardFault { at: 0, status: 0 },
        Crash::Unhandled { number: 0 },
    ];
    for (number, crash) in (1..).zip(crashes) {
        let identity = bench.target.reset(Injection::Crash(crash)).expect("an answer");
        assert_eq!((identity.resets, identity.mode_at_reset), (number + 1, Some(Mode::Active)));
        let log = bench.target.status().expect("an answer").log;
        assert_eq!(log.crashes, number);
        match log.crash.expect("one in the log") {
            Crash::Panic { line } => assert!(number == 1 && line > 0),
            Crash::HardFault { at, status } => {
                assert_eq!(number, 2);
                assert!((0x0800_0000..0x0810_0000).contains(&at), "{at:#x} is not in flash");
                // UNDEFINSTR (ARMv7-M B3.2.15).
                assert_eq!(status, 1 << 16);
            }
            // CAN1_TX (RM0090, table 61).
            Crash::Unhandled { number: interrupt } => assert_eq!((number, interrupt), (3, 19)),
        }
        let sensors = bench.sensors();
        let torques = bench.target.tick(&sensors).expect("an answer");
        assert_eq!((torques.mode, torques.joint_torques), (Mode::Standby, [0.0; JOINTS].into()));
        arm(&mut bench.target, &scene);
        assert_eq!(bench.target.tick(&sensors).expect("an answer").mode, Mode::Active);
    }
}

/// Frames of another session: the first is no measurement, the second is one.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn a_host_that_begins_anew() {
    let mut bench = Bench::after(MIDDLE);
    let mut other = Sender::new(7);
    for _ in 0..3 {
        let sensors = bench.sensors();
        let measurement = bench.target.measurement(&sensors);
        let mut wire = [0; frame_bytes(JOINTS)];
        let frame = other.encode(&measurement, &mut wire).expect("it fits").to_vec();
        assert_eq!(bench.tick_with_frame(|_| frame).mode, Mode::Active);
    }
    for _ in 0..3 {
        assert_eq!(bench.tick(|_| {}).mode, Mode::Active);
    }
    let received = bench.target.status().expect("an answer").received;
    assert_eq!((received.session, received.out_of_order), (2, 0));
}

/// Orders with numbers that make no sense, or at the wrong time, are refused, and change nothing.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn orders_that_make_no_sense() {
    use surefoot_link::Acknowledged::{Busy, Invalid, Limit, TooFast, TooSlow};
    use surefoot_link::{BAUD, Pacing, shortest_period_us};
    use surefoot_sim::closed_loop::firmware::{LinkError, set_point, settings};
    let mut bench = Bench::after(5);
    let good = settings(&bench.scene);
    let refused = |bench: &mut Bench, order| match bench.target.order("it", &order) {
        Err(LinkError::Refused { answer, .. }) => answer,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(&mut bench, ToTarget::Configure(good)), Busy);
    let mut pose = set_point(&bench.scene);
    pose.position[2] = f32::NAN;
    assert_eq!(refused(&mut bench, ToTarget::SetPoint(pose)), Invalid);
    bench.target.order("disarm", &ToTarget::Disarm).expect("obeyed");
    let mut bad = good;
    bad.gains[2][1] = f32::INFINITY;
    assert_eq!(refused(&mut bench, ToTarget::Configure(bad)), Invalid);
    bad = good;
    bad.period = 0.0;
    assert_eq!(refused(&mut bench, ToTarget::Configure(bad)), Invalid);
    // Limits that are none, and such as allow more than the firmware's own.
    let limit = |joint, field, fault| Limit(LimitError { joint, field, fault });
    bad = good;
    bad.joint_limits[9].torque = f32::NAN;
    let answer = limit(Some((1, 3)), LimitField::Torque, LimitFault::NotFinite);
    assert_eq!(refused(&mut bench, ToTarget::Configure(bad)), answer);
    bad = good;
    bad.joint_limits[5].torque *= 1.01;
    let answer = limit(Some((0, 5)), LimitField::Torque, LimitFault::Widens);
    assert_eq!(refused(&mut bench, ToTarget::Configure(bad)), answer);
    bad = good;
    bad.thresholds.least_upright = 0.5;
    let answer = limit(None, LimitField::Upright, LimitFault::Widens);
    assert_eq!(refused(&mut bench, ToTarget::Configure(bad)), answer);
    // On its own clock the line, and the emulator's timer, have their limits.
    bad = good;
    bad.pacing = Pacing::FreeRunning;
    bad.period = 7e-4;
    assert_eq!(
        refused(&mut bench, ToTarget::Configure(bad)),
        TooFast(shortest_period_us::<JOINTS>(BAUD, 0))
    );
    bad.period = 0.5;
    assert_eq!(refused(&mut bench, ToTarget::Configure(bad)), TooSlow(99_864));
    let scene = bench.scene.clone();
    arm(&mut bench.target, &scene);
    assert_eq!(bench.tick(|_| {}).mode, Mode::Active);
    // Tighter ones are kept.
    bench.target.order("disarm", &ToTarget::Disarm).expect("obeyed");
    let mut tight = good;
    tight.joint_limits[3].torque = 1.0;
    bench.target.order("configure", &ToTarget::Configure(tight)).expect("obeyed");
    bench
        .target
        .order("arm", &ToTarget::Arm(scene.robot().id().expect("legs of six joints")))
        .expect("obeyed");
    assert_eq!(bench.tick(|_| {}).joint_torques[3].abs(), 1.0);
}

/// Limits of ground and motors that are none, or wider than the robot's own.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn limits_that_make_no_sense() {
    use surefoot_sim::closed_loop::firmware::{LinkError, wrench_settings};
    let scene = surefoot_sim::scene::load("stand").expect("built in");
    let good = wrench_settings::<JOINTS>(&scene).expect("a limited distribution");
    let mut target = crate::bench::target();
    let mut answer = |limits: &surefoot_link::WrenchSettings<JOINTS>| match target
        .order("limits", &ToTarget::Limit(limits.clone()))
    {
        Ok(()) => Acknowledged::Done,
        Err(LinkError::Refused { answer, .. }) => answer,
        Err(other) => panic!("{other}"),
    };
    assert_eq!(answer(&good), Acknowledged::Done);
    let mut bad = good.clone();
    bad.ground.friction = f32::NAN;
    assert_eq!(answer(&bad), Acknowledged::Invalid);
    bad = good.clone();
    bad.soles.pop();
    assert_eq!(answer(&bad), Acknowledged::Invalid);
    bad = good.clone();
    bad.soles[1].x[0] = -0.3;
    assert_eq!(answer(&bad), Acknowledged::Sole(1));
    bad.soles[1].x[0] = f32::NAN;
    assert_eq!(answer(&bad), Acknowledged::Sole(1));
    bad = good.clone();
    bad.torques[9] *= 1.01;
    let joint = Some((1, 3));
    let widens = LimitError { joint, field: LimitField::Torque, fault: LimitFault::Widens };
    assert_eq!(answer(&bad), Acknowledged::Limit(widens));
    bad.torques[9] = f32::NAN;
    assert_eq!(answer(&bad), Acknowledged::Invalid);
}

/// A host of another robot is told which one this is; the motors stay off.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn another_robot_is_not_armed() {
    use surefoot_sim::closed_loop::firmware::LinkError;
    let mut target = crate::bench::target();
    let own = target.identity().robot;
    let scene = surefoot_sim::scene::load("experiment-1").expect("built in");
    assert_eq!(own, scene.robot().id().expect("legs of six joints"));
    let other = RobotId { fingerprint: own.fingerprint ^ 1, ..own };
    let Err(LinkError::Refused { answer, .. }) = target.order("arm", &ToTarget::Arm(other)) else {
        panic!("it is armed for another robot")
    };
    assert_eq!(answer, Acknowledged::Robot(own));
    let torques = target.tick(&Bench::sensors_of(&scene)).expect("an answer");
    assert_eq!((torques.mode, torques.joint_torques), (Mode::Standby, [0.0; JOINTS].into()));
}
