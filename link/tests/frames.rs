//! Frames that arrive whole give the message that was sent; all others are rejected, and counted.

use proptest::prelude::*;
use surefoot::balance::{Mode, StopReason};
use surefoot::model::robots::biped;
use surefoot_link::{
    BAUD, Crash, FRAME, FaultLog, FromTarget, LineErrors, LoggedFault, Pacing, Receiver, Rejected,
    Sender, Sensors, Settings, Status, Tally, ToTarget, Torques, VERSION, most_wire_bytes,
    shortest_period_us, wire_us,
};

const SESSION: u32 = 0x1234_5678;

fn sender() -> Sender {
    Sender::new(SESSION)
}

fn measurement(seed: f32) -> ToTarget {
    ToTarget::Sensors { taken_us: 250_000, sensors: sensors(seed) }
}

fn sensors(seed: f32) -> Sensors {
    Sensors {
        position: [seed, 0.0, -0.0],
        orientation: [1.0, f32::NAN, f32::INFINITY, seed],
        velocity: [seed; 6],
        joint_angles: [[seed; 6]; 2],
        joint_rates: [[0.0; 6]; 2],
    }
}

fn frame<M: serde::Serialize>(sender: &mut Sender, message: &M) -> Vec<u8> {
    let mut wire = [0; FRAME];
    sender.encode(message, &mut wire).expect("it fits").to_vec()
}

/// What a receiver makes of these bytes.
fn receive<M: serde::de::DeserializeOwned>(
    receiver: &mut Receiver<M>,
    bytes: &[u8],
) -> Vec<Result<M, Rejected>> {
    bytes.iter().filter_map(|byte| receiver.take(*byte)).collect()
}

/// Bits, since NaN is not equal to itself.
fn bits(sensors: &Sensors) -> Vec<u32> {
    let all = [&sensors.position[..], &sensors.orientation, &sensors.velocity];
    all.concat().iter().map(|x| x.to_bits()).collect()
}

#[test]
fn numbers_arrive_bit_for_bit() {
    let (mut sender, mut receiver) = (sender(), Receiver::<ToTarget>::new());
    let sent = sensors(0.1);
    let bytes = frame(&mut sender, &measurement(0.1));
    let Some(Ok(ToTarget::Sensors { sensors: got, .. })) = receive(&mut receiver, &bytes).pop()
    else {
        panic!("no sensors arrived")
    };
    assert_eq!(bits(&got), bits(&sent));
}

/// The longest messages there can be, with numbers whose variable-length forms are longest.
#[test]
fn the_longest_messages_fit_a_frame() {
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
    let status = Status {
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
    };
    let mut sender = sender();
    let longest = frame(&mut sender, &FromTarget::Status(status)).len();
    let settings = Settings {
        period: 0.001,
        pacing: Pacing::FreeRunning,
        gains: [[50.0; 3]; 4],
        big_base: Some(1e3),
        joint_limits: biped::LIMITS.to_f32().joints,
        thresholds: biped::LIMITS.to_f32().thresholds,
    };
    let longest = longest.max(frame(&mut sender, &ToTarget::Configure(settings)).len());
    let torques = Torques {
        tick: most,
        joint_torques: [[1.0; 6]; 2],
        desired_wrench: [1.0; 6],
        mode: Mode::Stopping { left: u16::MAX },
        reason: Some(reason),
        cost: most,
        latency: most,
    };
    // Torques leave room for a reason to stop that is longer by ten bytes.
    let measurement = ToTarget::Sensors { taken_us: most, sensors: sensors(1.0) };
    let measurement = most_wire_bytes(&measurement).expect("it fits");
    let torques = most_wire_bytes(&FromTarget::Torques(torques)).expect("it fits");
    assert!(torques + 10 <= measurement, "{torques} and {measurement}: the line is one for both");
    assert!(longest <= FRAME);
    println!("the longest frame has {longest} bytes of {FRAME}");
}

#[test]
fn repeated_and_reordered_frames_are_rejected_and_lost_ones_counted() {
    let mut sender = sender();
    let frames: Vec<_> = (0..5).map(|_| frame(&mut sender, &ToTarget::Status)).collect();
    let mut receiver = Receiver::<ToTarget>::new();
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
            let mut receiver = Receiver::<ToTarget>::new();
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
        let mut receiver = Receiver::<ToTarget>::new();
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
    let mut receiver = Receiver::<ToTarget>::new();
    assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::Version(1))]);
}

#[test]
fn what_is_no_frame_is_rejected_by_its_kind() {
    let mut receiver = Receiver::<ToTarget>::new();
    assert_eq!(receive(&mut receiver, &[0]), [Err(Rejected::Truncated)]);
    assert_eq!(receive(&mut receiver, &[9, 1, 0]), [Err(Rejected::Truncated)]);
    let long = [vec![1; FRAME + 1], vec![0]].concat();
    assert_eq!(receive(&mut receiver, &long), [Err(Rejected::TooLong)]);
    // Whole, but a message of the other direction, which has another shape.
    let torques = FromTarget::Acknowledged(surefoot_link::Acknowledged::Done);
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
        let mut receiver = Receiver::<ToTarget>::new();
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
        let mut receiver = Receiver::<ToTarget>::new();
        let mut host = Receiver::<FromTarget>::new();
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
        let frames = [frame(&mut sender, &ToTarget::Hello), frame(&mut sender, &ToTarget::Arm)];
        prop_assert_eq!(receive(&mut receiver, &frames.concat()).pop(), Some(Ok(ToTarget::Arm)));
    }

    /// After any bytes the receiver is in step again within one frame: the next may be spoilt, where
    /// the bytes had no end; the one after it is not.
    #[test]
    fn noise_spoils_one_frame_at_most(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        let (mut sender, mut receiver) = (sender(), Receiver::<ToTarget>::new());
        let before = frame(&mut sender, &ToTarget::Hello);
        prop_assert_eq!(receive(&mut receiver, &before), [Ok(ToTarget::Hello)]);
        receive(&mut receiver, &bytes);
        let first = receive(&mut receiver, &frame(&mut sender, &ToTarget::Status));
        let has_ended = bytes.last().is_none_or(|last| *last == 0);
        prop_assert!(!has_ended || first == [Ok(ToTarget::Status)], "{:?}", first);
        let second = receive(&mut receiver, &frame(&mut sender, &ToTarget::Arm));
        prop_assert_eq!(second, [Ok(ToTarget::Arm)]);
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
        let mut receiver = Receiver::<ToTarget>::new();
        let results = receive(&mut receiver, &bytes);
        prop_assert!(!results.is_empty() && results.iter().all(Result::is_err), "{:?}", results);
        let next = frame(&mut sender, &ToTarget::Arm);
        prop_assert_eq!(receive(&mut receiver, &next), [Ok(ToTarget::Arm)]);
    }

    /// However a stream is cut into pieces, shuffled or doubled, only messages that were sent come
    /// out, in the order in which they were sent.
    #[test]
    fn order_is_kept(order in prop::collection::vec(0_usize..12, 1..40)) {
        let mut sender = sender();
        let frames: Vec<_> = (0..12)
            .map(|i| frame(&mut sender, &measurement(i as f32)))
            .collect();
        let mut receiver = Receiver::<ToTarget>::new();
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
    let answer = Torques {
        tick: 30_000,
        joint_torques: [[1.5; 6]; 2],
        desired_wrench: [1.5; 6],
        mode: Mode::Active,
        reason: None,
        cost: 20_721,
        latency: 28,
    };
    let received = frame(&mut sender(), &FromTarget::Torques(answer)).len();
    assert_eq!((sent, received), (164, 94));
}

/// The line's arithmetic, as docs/firmware.md has it.
#[test]
fn the_line_carries_a_measurement_a_tick() {
    let longest = ToTarget::Sensors { taken_us: u32::MAX, sensors: sensors(1.0) };
    // Version, session, number; variant, time, 37 numbers; checksum, COBS, end.
    assert_eq!(most_wire_bytes(&longest), Some((1 + 4 + 5) + (1 + 5 + 37 * 4) + (4 + 1 + 1)));
    // 1700 bits at three a microsecond, and a quarter more.
    assert_eq!((wire_us(170, BAUD), shortest_period_us(BAUD)), (567, 709));
    // The rate of version 1 had no room for 1 kHz: 1 845 µs, and a quarter more.
    assert_eq!((wire_us(170, 921_600), shortest_period_us(921_600)), (1845, 2307));
    // The largest number has the largest frame: 2²⁸ and more take five bytes.
    let mut late = sender();
    let mut bytes = vec![];
    for _ in 0..300 {
        bytes = frame(&mut late, &longest);
    }
    assert!(bytes.len() <= 170 && bytes.len() >= 167, "{}", bytes.len());
}
