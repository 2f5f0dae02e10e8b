//! Frames that arrive whole give the message that was sent; all others are rejected, and counted.

use proptest::prelude::*;
use surefoot::balance::{Mode, StopReason};
use surefoot::model::robots::biped;
use surefoot_link::{
    FRAME, FaultLog, FromTarget, LoggedFault, Pacing, Receiver, Rejected, Sender, Sensors,
    Settings, Status, Tally, ToTarget, Torques,
};

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
    let (mut sender, mut receiver) = (Sender::new(), Receiver::<ToTarget>::new());
    let sent = sensors(0.1);
    let bytes = frame(&mut sender, &ToTarget::Sensors(sent));
    let Some(Ok(ToTarget::Sensors(got))) = receive(&mut receiver, &bytes).pop() else {
        panic!("no sensors arrived")
    };
    assert_eq!(bits(&got), bits(&sent));
}

/// The longest messages there can be, with numbers whose variable-length forms are longest.
#[test]
fn the_longest_messages_fit_a_frame() {
    let mut log =
        FaultLog { resets: u32::MAX, mode_at_reset: Some(Mode::Active), ..FaultLog::default() };
    let reason = StopReason::Frozen { leg: usize::MAX, joint: usize::MAX };
    while log.stops.push(LoggedFault { reset: u32::MAX, tick: u32::MAX, reason }).is_ok() {}
    let most = u32::MAX;
    let received = Tally {
        accepted: most,
        lost: most,
        truncated: most,
        too_long: most,
        corrupted: most,
        version: most,
        out_of_order: most,
        malformed: most,
    };
    let status = Status {
        mode: Mode::Stopping { left: u16::MAX },
        received,
        telemetry_dropped: most,
        measurements_dropped: most,
        overruns: most,
        cut_torques: most,
        stack_bytes: most,
        log,
    };
    let mut sender = Sender::new();
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
    let longest = longest.max(frame(&mut sender, &FromTarget::Torques(torques)).len());
    let longest = longest.max(frame(&mut sender, &ToTarget::Sensors(sensors(1.0))).len());
    println!("the longest frame has {longest} bytes of {FRAME}");
}

#[test]
fn repeated_and_reordered_frames_are_rejected_and_lost_ones_counted() {
    let mut sender = Sender::new();
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
    // A sender that has begun anew is believed.
    assert_eq!(receive(&mut receiver, &frames[0]), [Ok(ToTarget::Status)]);
    assert_eq!(receive(&mut receiver, &frames[1]), [Ok(ToTarget::Status)]);
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
    let bytes = frame(&mut Sender::new(), &torques);
    assert_eq!(receive(&mut receiver, &bytes), [Err(Rejected::Malformed)]);
    // And it is not put out for the next.
    let bytes = frame(&mut Sender::new(), &ToTarget::Hello);
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

    /// A frame with any change in it is rejected, and the next one gets through.
    #[test]
    fn damage_is_found(
        seed in any::<f32>(),
        at in any::<prop::sample::Index>(),
        flip in 1_u8..=255,
        cut in any::<bool>(),
    ) {
        let mut sender = Sender::new();
        let mut bytes = frame(&mut sender, &ToTarget::Sensors(sensors(seed)));
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
        let mut sender = Sender::new();
        // Number 0 would begin anew.
        frame(&mut sender, &ToTarget::Hello);
        let frames: Vec<_> = (0..12)
            .map(|i| frame(&mut sender, &ToTarget::Sensors(sensors(i as f32))))
            .collect();
        let mut receiver = Receiver::<ToTarget>::new();
        let mut last = None;
        for number in order {
            for result in receive(&mut receiver, &frames[number]) {
                match result {
                    Ok(ToTarget::Sensors(got)) => {
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

/// What docs/firmware.md says of the line's share of a simulated second.
#[test]
fn frames_of_a_tick_are_short() {
    let sent = frame(&mut Sender::new(), &ToTarget::Sensors(sensors(1.5))).len();
    let answer = Torques {
        tick: 30_000,
        joint_torques: [[1.5; 6]; 2],
        desired_wrench: [1.5; 6],
        mode: Mode::Active,
        reason: None,
        cost: 20_721,
        latency: 28,
    };
    let received = frame(&mut Sender::new(), &FromTarget::Torques(answer)).len();
    assert_eq!((sent, received), (157, 90));
}
