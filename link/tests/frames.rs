//! Frames that arrive whole give the message that was sent; all others are rejected, and counted.

use proptest::prelude::*;
use surefoot::balance::{
    ContactLimit, Ground, JointLimits, Mode, Reason, Sole, StopReason, Thresholds,
};
use surefoot::estimate::{Concern, OutOfBounds};
use surefoot_link::{
    BAUD, Clock, Counter, Crash, Estimated, FaultLog, FromTarget, Identity, Joints, LineErrors,
    LoggedFault, MOST_FEET, MOST_FRAME, Pacing, Receiver, Rejected, RobotId, Sender, Sensors,
    Settings, Status, Tally, TickLimits, Torques, VERSION, WrenchSettings, frame_bytes,
    most_wire_bytes, shortest_period_us, wire_us,
};

const SESSION: u32 = 0x1234_5678;

/// Of a robot with so many joints; where the number does not matter, this one.
const JOINTS: usize = 12;
const FRAME: usize = frame_bytes(JOINTS);
type ToTarget = surefoot_link::ToTarget<JOINTS>;
type ToHost = FromTarget<JOINTS>;
type AtTarget = Receiver<ToTarget, FRAME>;
type AtHost = Receiver<ToHost, FRAME>;

const ROBOT: RobotId = RobotId { joints: JOINTS as u8, fingerprint: 0x89ab_cdef };

fn sender() -> Sender {
    Sender::new(SESSION)
}

fn measurement(seed: f32) -> ToTarget {
    ToTarget::Sensors { taken_us: 250_000, sensors: sensors(seed) }
}

fn sensors<const N: usize>(seed: f32) -> Sensors<N> {
    Sensors {
        position: [seed, 0.0, -0.0],
        orientation: [1.0, f32::NAN, f32::INFINITY, seed],
        velocity: [seed; 6],
        joint_angles: [seed; N].into(),
        joint_rates: [0.0; N].into(),
        contacts: 3,
        forces: Joints::new([0.0; MOST_FEET], 0),
    }
}

fn frame<M: serde::Serialize>(sender: &mut Sender, message: &M) -> Vec<u8> {
    let mut wire = [0; MOST_FRAME];
    sender.encode(message, &mut wire).expect("it fits").to_vec()
}

/// What a receiver makes of these bytes.
fn receive<M: serde::de::DeserializeOwned, const N: usize>(
    receiver: &mut Receiver<M, N>,
    bytes: &[u8],
) -> Vec<Result<M, Rejected>> {
    bytes.iter().filter_map(|byte| receiver.take(*byte)).collect()
}

/// Bits, since NaN is not equal to itself.
fn bits<const N: usize>(sensors: &Sensors<N>) -> Vec<u32> {
    let body = [&sensors.position[..], &sensors.orientation, &sensors.velocity];
    let joints = [&sensors.joint_angles[..], &sensors.joint_rates];
    [body.concat(), joints.concat()].concat().iter().map(|x| x.to_bits()).collect()
}

fn arrives<const N: usize>() {
    let (mut sender, mut receiver) =
        (sender(), Receiver::<surefoot_link::ToTarget<N>, MOST_FRAME>::new());
    let sent = surefoot_link::ToTarget::Sensors { taken_us: 250_000, sensors: sensors::<N>(0.1) };
    let bytes = frame(&mut sender, &sent);
    let Some(Ok(surefoot_link::ToTarget::Sensors { sensors: got, taken_us })) =
        receive(&mut receiver, &bytes).pop()
    else {
        panic!("no sensors arrived")
    };
    assert_eq!((bits(&got), got.contacts, taken_us), (bits(&sensors::<N>(0.1)), 3, 250_000));
}

#[test]
fn numbers_arrive_bit_for_bit() {
    arrives::<12>();
    arrives::<18>();
    arrives::<29>();
}

/// Robots of other sizes: greetings are understood, measurements are none of this robot's.
#[test]
fn another_robot_is_known_as_such() {
    let (mut sender, mut receiver) = (sender(), AtTarget::new());
    let other = surefoot_link::ToTarget::<18>::Hello;
    assert_eq!(receive(&mut receiver, &frame(&mut sender, &other)), [Ok(ToTarget::Hello)]);
    let robot = RobotId { joints: 18, ..ROBOT };
    let arm = surefoot_link::ToTarget::<18>::Arm(robot);
    assert_eq!(receive(&mut receiver, &frame(&mut sender, &arm)), [Ok(ToTarget::Arm(robot))]);
    let other = surefoot_link::ToTarget::Sensors { taken_us: 0, sensors: sensors::<18>(1.0) };
    let bytes = frame(&mut sender, &other);
    assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::Malformed)]);
    let other = surefoot_link::ToTarget::Sensors { taken_us: 0, sensors: sensors::<6>(1.0) };
    let bytes = frame(&mut sender, &other);
    // There is room for them: a target looks at their number.
    let Some(Ok(smaller)) = receive(&mut receiver, &bytes).pop() else { panic!("it arrives") };
    assert!(smaller.is_of(6) && !smaller.is_of(JOINTS));
    assert!(measurement(1.0).is_of(JOINTS) && ToTarget::Hello.is_of(JOINTS));

    let mut host = AtHost::new();
    let identity = Identity {
        robot,
        counter: Counter::Cycles,
        per_second: 168_000_000,
        resets: 1,
        mode_at_reset: None,
        clock: Clock::Crystal(8),
    };
    let bytes = frame(&mut sender, &FromTarget::<18>::Identity(identity));
    assert_eq!(receive(&mut host, &bytes), [Ok(ToHost::Identity(identity))]);
    let text = robot.to_string();
    assert!(text.contains("18 joints") && text.contains("89abcdef"), "{text}");
}

const LIMITS: JointLimits<f32> = JointLimits { torque: 1.0, angle: [-1.0, 1.0], rate: 1.0 };

const THRESHOLDS: Thresholds<f32> = Thresholds {
    angle_noise: 1.0,
    rate_step: 1.0,
    velocity_step: 1.0,
    angular_velocity_step: 1.0,
    gross: 1.0,
    frozen_angle: 1.0,
    doubtful_ticks: u8::MAX,
    torque_step: 1.0,
    bridged_ticks: u8::MAX,
    recovery_ticks: u8::MAX,
    least_upright: 1.0,
    drop: 1.0,
    look_ahead_s: 1.0,
    free_fall: 1.0,
    free_fall_s: 1.0,
    saturation_s: 1.0,
};

fn settings<const N: usize>() -> Settings<N> {
    Settings {
        period: 0.001,
        pacing: Pacing::FreeRunning,
        gains: [[50.0; 3]; 4],
        big_base: Some(1e3),
        joint_limits: [LIMITS; N].into(),
        thresholds: THRESHOLDS,
    }
}

fn wrench_settings<const N: usize>() -> WrenchSettings<N> {
    let sole = Sole { x: [1.0; 2], y: [1.0; 2], z: 1.0 };
    WrenchSettings {
        ground: Ground { least_force: 1.0, greatest_force: 1.0, friction: 1.0 },
        soles: [sole; MOST_FEET].into_iter().collect(),
        torques: [1.0; N].into(),
    }
}

fn torques<const N: usize>() -> Torques<N> {
    let worst = Reason { foot: MOST_FEET, limit: ContactLimit::Torque(5), relief: 1.0 };
    Torques {
        tick: u32::MAX,
        joint_torques: [1.0; N].into(),
        desired_wrench: [1.0; 6],
        mode: Mode::Stopping { left: u16::MAX },
        reason: Some(StopReason::Frozen { leg: N, joint: N }),
        limits: Some(TickLimits { is_active: true, is_unfinished: true, worst: Some(worst) }),
        steps: u32::MAX,
        estimated: Some(Estimated {
            central: [1.0; 13],
            made_anew: u8::MAX,
            worst: Some(OutOfBounds {
                concern: Concern::FootPosition(usize::MAX),
                size: 1.0,
                limit: 1.0,
            }),
        }),
        cost: u32::MAX,
        latency: u32::MAX,
    }
}

/// The longest status there can be, with numbers whose variable-length forms are longest.
fn status() -> Status {
    let most = u32::MAX;
    let mut log = FaultLog {
        resets: most,
        mode_at_reset: Some(Mode::Active),
        crashes: most,
        crash: Some(Crash::HardFault { at: most, status: most }),
        ..FaultLog::default()
    };
    let reason = StopReason::Frozen { leg: usize::MAX, joint: usize::MAX };
    while log.stops.push(LoggedFault { reset: u32::MAX, tick: u32::MAX, reason }).is_ok() {}
    let received = Tally {
        accepted: most,
        lost: most,
        truncated: most,
        too_long: most,
        corrupted: most,
        version: most,
        out_of_order: most,
        session: most,
        malformed: most,
    };
    Status {
        mode: Mode::Stopping { left: u16::MAX },
        received,
        telemetry_dropped: most,
        measurements_replaced: most,
        measurements_stale: most,
        line: LineErrors {
            overrun: most,
            framing: most,
            noise: most,
            parity: most,
            unqueued: most,
        },
        overruns: most,
        cut_torques: most,
        stack_bytes: most,
        log,
    }
}

fn all_fit<const N: usize>() {
    let sensors =
        surefoot_link::ToTarget::Sensors { taken_us: u32::MAX, sensors: sensors::<N>(1.0) };
    let settings = surefoot_link::ToTarget::Configure(settings::<N>());
    let limits = surefoot_link::ToTarget::Limit(wrench_settings::<N>());
    let [torques, status] =
        [FromTarget::Torques(torques::<N>()), FromTarget::<N>::Status(status())]
            .map(|message| most_wire_bytes(&message).expect("written"));
    let [sensors, settings, limits] =
        [sensors, settings, limits].map(|message| most_wire_bytes(&message).expect("written"));
    println!("{N} joints: {sensors} {settings} {limits} {torques} {status} of {}", frame_bytes(N));
    for bytes in [sensors, settings, limits, torques, status] {
        assert!(bytes <= frame_bytes(N), "{bytes}");
    }
    // Where settings are the longest, frames are no longer than they need to be.
    assert!(settings < 512 || frame_bytes(N) - settings <= 4, "{settings}");
    // Measurements take four fifths of their direction in the shortest period; answers may take all of theirs.
    assert!(4 * torques <= 5 * sensors, "{torques} and {sensors}");
}

#[test]
fn the_longest_messages_fit_a_frame() {
    all_fit::<12>();
    all_fit::<18>();
    all_fit::<24>();
    all_fit::<29>();
    all_fit::<64>();
    all_fit::<255>();
}

#[test]
fn repeated_and_reordered_frames_are_rejected_and_lost_ones_counted() {
    let mut sender = sender();
    let frames: Vec<_> = (0..5).map(|_| frame(&mut sender, &ToTarget::Status)).collect();
    let mut receiver = AtTarget::new();
    for (number, expected) in [
        (0, Ok(ToTarget::Status)),
        (1, Ok(ToTarget::Status)),
        (1, Err(Rejected::OutOfOrder)),
        (4, Ok(ToTarget::Status)),
        (3, Err(Rejected::OutOfOrder)),
    ] {
        assert_eq!(receive(&mut receiver, &frames[number]), [expected]);
    }
    let tally = receiver.tally();
    assert_eq!((tally.accepted, tally.out_of_order, tally.lost), (3, 2, 2));
}

/// A sender that begins anew is believed from its second frame on, however far the one before had
/// come, and whatever of it arrives first.
#[test]
fn a_sender_that_begins_anew_costs_one_frame() {
    for before in [1, 2, 60_000] {
        for first in [0, 1, 59_998] {
            let (mut old, mut new) = (sender(), Sender::new(SESSION + 1));
            let mut receiver = AtTarget::new();
            for _ in 0..before {
                let bytes = frame(&mut old, &ToTarget::Status);
                assert_eq!(receive(&mut receiver, &bytes), [Ok(ToTarget::Status)]);
            }
            for _ in 0..first {
                frame(&mut new, &ToTarget::Hello);
            }
            let bytes = frame(&mut new, &ToTarget::Hello);
            assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::Session)]);
            assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::OutOfOrder)], "still one");
            for _ in 0..3 {
                let bytes = frame(&mut new, &ToTarget::Hello);
                assert_eq!(receive(&mut receiver, &bytes), [Ok(ToTarget::Hello)]);
            }
            assert_eq!((receiver.session(), receiver.tally().session), (Some(SESSION + 1), 1));
        }
    }
}

/// Every order of a few frames of two sessions, with repetitions: none is accepted twice while its
/// session lasts, none before an earlier one, and a stray frame never ends a session.
#[test]
fn every_order_of_two_sessions() {
    let (mut one, mut other) = (Sender::new(1), Sender::new(2));
    let frames: Vec<(u32, u32, Vec<u8>)> = (0..3)
        .map(|number| (1, number, frame(&mut one, &ToTarget::Status)))
        .chain((0..3).map(|number| (2, number, frame(&mut other, &ToTarget::Status))))
        .collect();
    const LENGTH: u32 = 6;
    let mut takeovers = 0;
    for order in 0..6_usize.pow(LENGTH) {
        let mut receiver = AtTarget::new();
        // Session, its last number, and the last whole frame of the other session since.
        let mut accepted: Option<(u32, u32)> = None;
        let mut stray: Option<(u32, u32)> = None;
        for place in 0..LENGTH {
            let (session, number, bytes) = &frames[order / 6_usize.pow(place) % 6];
            let is_accepted = receive(&mut receiver, bytes)[0].is_ok();
            let should_be = match accepted {
                None => true,
                Some((of, last)) if of == *session => last < *number,
                Some(_) => stray.is_some_and(|(_, first)| first < *number),
            };
            assert_eq!(is_accepted, should_be, "order {order}, place {place}");
            if is_accepted {
                takeovers += u32::from(accepted.is_some_and(|(of, _)| of != *session));
                (accepted, stray) = (Some((*session, *number)), None);
            } else if accepted.is_some_and(|(of, _)| of != *session) && stray.is_none() {
                stray = Some((*session, *number));
            }
        }
    }
    assert!(takeovers > 1000, "{takeovers}");
}

#[test]
fn a_frame_of_version_1_is_known_as_such() {
    // `Hello` as version 1 framed it: version, number 0, variant 0.
    let bytes = whole(&[1, 0, 0]);
    let mut receiver = AtTarget::new();
    assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::Version(1))]);
}

#[test]
fn what_is_no_frame_is_rejected_by_its_kind() {
    let mut receiver = AtTarget::new();
    assert_eq!(receive(&mut receiver, &[0]), [Err(Rejected::Truncated)]);
    assert_eq!(receive(&mut receiver, &[9, 1, 0]), [Err(Rejected::Truncated)]);
    let long = [vec![1; FRAME + 1], vec![0]].concat();
    assert_eq!(receive(&mut receiver, &long), [Err(Rejected::TooLong)]);
    // Whole, but a message of the other direction, which has another shape.
    let torques = ToHost::Acknowledged(surefoot_link::Acknowledged::Done);
    let mut sender = sender();
    let bytes = frame(&mut sender, &torques);
    assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::Malformed)]);
    // And the next is not put out by it.
    let bytes = frame(&mut sender, &ToTarget::Hello);
    assert_eq!(receive(&mut receiver, &bytes), [Ok(ToTarget::Hello)]);
    let tally = receiver.tally();
    assert_eq!((tally.truncated, tally.too_long, tally.malformed, tally.accepted), (2, 1, 1, 1));
}

/// Everything that a receiver has been given is in one of its counts.
fn all(tally: Tally) -> u32 {
    tally.accepted
        + tally.truncated
        + tally.too_long
        + tally.corrupted
        + tally.version
        + tally.out_of_order
        + tally.session
        + tally.malformed
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Noise is never taken for a message, never panics, and every end of a frame is counted.
    #[test]
    fn noise_is_counted(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        let mut receiver = AtTarget::new();
        let results = receive(&mut receiver, &bytes);
        prop_assert!(results.iter().all(Result::is_err));
        let ends = bytes.iter().filter(|byte| **byte == 0).count();
        prop_assert_eq!(all(receiver.tally()) as usize, ends);
    }

    /// Whole frames of this version with anything in place of a message: rejected or a message, never a
    /// panic; and each is in one of the counts.
    #[test]
    fn hostile_messages_are_survived(
        messages in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..300), 1..20),
        session in any::<[u8; 4]>(),
    ) {
        let mut receiver = AtTarget::new();
        let mut host = AtHost::new();
        for (number, message) in messages.iter().enumerate() {
            let plain = [&[VERSION], &session[..], &[number as u8], message].concat();
            let bytes = whole(&plain);
            prop_assert_eq!(receive(&mut receiver, &bytes).len(), 1);
            prop_assert_eq!(receive(&mut host, &bytes).len(), 1);
        }
        prop_assert_eq!(all(receiver.tally()) as usize, messages.len());
        prop_assert_eq!(all(host.tally()) as usize, messages.len());
        // A session of frames that are no messages is a session all the same.
        let mut sender = Sender::new(!u32::from_le_bytes(session));
        let frames = [frame(&mut sender, &ToTarget::Hello), frame(&mut sender, &ToTarget::Arm(ROBOT))];
        prop_assert_eq!(receive(&mut receiver, &frames.concat()).pop(), Some(Ok(ToTarget::Arm(ROBOT))));
    }

    /// After any bytes the receiver is in step again within one frame: the next may be spoilt, where
    /// the bytes had no end; the one after it is not.
    #[test]
    fn noise_spoils_one_frame_at_most(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        let (mut sender, mut receiver) = (sender(), AtTarget::new());
        let before = frame(&mut sender, &ToTarget::Hello);
        prop_assert_eq!(receive(&mut receiver, &before), [Ok(ToTarget::Hello)]);
        receive(&mut receiver, &bytes);
        let first = receive(&mut receiver, &frame(&mut sender, &ToTarget::Status));
        let has_ended = bytes.last().is_none_or(|last| *last == 0);
        prop_assert!(!has_ended || first == [Ok(ToTarget::Status)], "{:?}", first);
        let second = receive(&mut receiver, &frame(&mut sender, &ToTarget::Arm(ROBOT)));
        prop_assert_eq!(second, [Ok(ToTarget::Arm(ROBOT))]);
    }

    /// A frame with any change in it is rejected, and the next one gets through.
    #[test]
    fn damage_is_found(
        seed in any::<f32>(),
        at in any::<prop::sample::Index>(),
        flip in 1_u8..=255,
        cut in any::<bool>(),
    ) {
        let mut sender = sender();
        let mut bytes = frame(&mut sender, &measurement(seed));
        let at = at.index(bytes.len() - 1);
        if cut {
            bytes.remove(at);
        } else {
            bytes[at] ^= flip;
        }
        let mut receiver = AtTarget::new();
        let results = receive(&mut receiver, &bytes);
        prop_assert!(!results.is_empty() && results.iter().all(Result::is_err), "{:?}", results);
        let next = frame(&mut sender, &ToTarget::Arm(ROBOT));
        prop_assert_eq!(receive(&mut receiver, &next), [Ok(ToTarget::Arm(ROBOT))]);
    }

    /// However a stream is cut into pieces, shuffled or doubled, only messages that were sent come
    /// out, in the order in which they were sent.
    #[test]
    fn order_is_kept(order in prop::collection::vec(0_usize..12, 1..40)) {
        let mut sender = sender();
        let frames: Vec<_> = (0..12)
            .map(|i| frame(&mut sender, &measurement(i as f32)))
            .collect();
        let mut receiver = AtTarget::new();
        let mut last = None;
        for number in order {
            for result in receive(&mut receiver, &frames[number]) {
                match result {
                    Ok(ToTarget::Sensors { sensors: got, .. }) => {
                        prop_assert_eq!(got.position[0], number as f32);
                        prop_assert!(last.is_none_or(|last| last < number));
                        last = Some(number);
                    }
                    Err(Rejected::OutOfOrder) => prop_assert!(last.is_some_and(|l| l >= number)),
                    other => prop_assert!(false, "{:?}", other),
                }
            }
        }
    }
}

/// A frame of these bytes, whatever they are.
fn whole(plain: &[u8]) -> Vec<u8> {
    let checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(plain).to_le_bytes();
    let mut bytes = cobs::encode_vec(&[plain, &checksum].concat());
    bytes.push(0);
    bytes
}

/// What docs/firmware.md says of the line's share of a simulated second.
#[test]
fn frames_of_a_tick_are_short() {
    let sent = frame(&mut sender(), &measurement(1.5)).len();
    let answer = Torques::<JOINTS> {
        tick: 30_000,
        joint_torques: [1.5; JOINTS].into(),
        desired_wrench: [1.5; 6],
        mode: Mode::Active,
        reason: None,
        limits: None,
        steps: 0,
        estimated: None,
        cost: 20_721,
        latency: 28,
    };
    let received = frame(&mut sender(), &FromTarget::Torques(answer)).len();
    assert_eq!((sent, received), (168, 98));
}

/// The line's arithmetic, as docs/firmware.md has it.
#[test]
fn the_line_carries_a_measurement_a_tick() {
    let longest = ToTarget::Sensors { taken_us: u32::MAX, sensors: sensors(1.0) };
    // Version, session, number; variant, time, 37 numbers, contacts, and how many
    // joints, twice, and forces; checksum, COBS, end.
    assert_eq!(
        most_wire_bytes(&longest),
        Some((1 + 4 + 5) + (1 + 5 + 37 * 4 + 1 + 3) + (4 + 1 + 1))
    );
    // 1740 bits at three a microsecond, and a quarter more.
    assert_eq!((wire_us(174, BAUD), shortest_period_us::<JOINTS>(BAUD, 0)), (580, 725));
    // The rate of version 1 had no room for 1 kHz: 1 889 µs, and a quarter more.
    let slow = shortest_period_us::<JOINTS>(921_600, 0);
    assert_eq!((wire_us(174, 921_600), slow), (1889, 2362));
    // Twice the joints: 96 bytes more, and one that COBS needs.
    let double =
        surefoot_link::ToTarget::Sensors { taken_us: u32::MAX, sensors: sensors::<24>(1.0) };
    assert_eq!(most_wire_bytes(&double), Some(174 + 96 + 1));
    assert_eq!(shortest_period_us::<24>(BAUD, 0), (wire_us(271, BAUD) * 5).div_ceil(4));
    // The largest number has the largest frame: 2²⁸ and more take five bytes.
    let mut late = sender();
    let mut bytes = vec![];
    for _ in 0..300 {
        bytes = frame(&mut late, &longest);
    }
    assert!(bytes.len() <= 174 && bytes.len() >= 171, "{}", bytes.len());
}
