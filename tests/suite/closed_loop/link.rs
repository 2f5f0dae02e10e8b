//! The host's end of the link, against a target that is played here.

use std::collections::VecDeque;
use std::time::{Duration, Instant};
use surefoot::balance::Mode;
use surefoot_link::{
    Acknowledged, Clock, Counter, FaultLog, Identity, LineErrors, MOST_FRAME, Receiver, Rejected,
    RobotId, Sender, Status,
};
use surefoot_sim::closed_loop::firmware::{FirmwareController, LinkError, SerialPort, Transport};
use surefoot_sim::scene::load;

const JOINTS: usize = 12;
type ToTarget = surefoot_link::ToTarget<JOINTS>;
type FromTarget = surefoot_link::FromTarget<JOINTS>;
type Target = surefoot_sim::closed_loop::firmware::Target<JOINTS>;

/// A target in the middle of its life.
struct Played {
    receiver: Receiver<ToTarget, MOST_FRAME>,
    sender: Sender,
    /// Bytes that it does not hear.
    deaf_for: usize,
    to_host: VecDeque<Vec<u8>>,
}

impl Played {
    /// One that has heard this many frames of another host.
    fn after(frames: u32) -> Self {
        let mut played = Self {
            receiver: Receiver::new(),
            sender: Sender::new(1),
            deaf_for: 0,
            to_host: VecDeque::new(),
        };
        let mut host = Sender::new(2);
        for _ in 0..frames {
            let mut wire = [0; MOST_FRAME];
            let bytes = host.encode(&ToTarget::Disarm, &mut wire).expect("it fits");
            for byte in bytes {
                played.receiver.take(*byte);
            }
        }
        assert_eq!(played.receiver.tally().accepted, frames);
        played
    }

    fn answer(&mut self, message: &FromTarget) {
        let mut wire = [0; MOST_FRAME];
        self.to_host.push_back(self.sender.encode(message, &mut wire).expect("it fits").to_vec());
    }
}

const IDENTITY: Identity = Identity {
    robot: RobotId { joints: 18, fingerprint: 0x1234_5678 },
    counter: Counter::Cycles,
    per_second: 168_000_000,
    resets: 1,
    mode_at_reset: None,
    clock: Clock::Crystal(8),
};

impl Transport for Played {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        for byte in bytes {
            if self.deaf_for > 0 {
                self.deaf_for -= 1;
                continue;
            }
            match self.receiver.take(*byte) {
                Some(Ok(ToTarget::Hello)) => self.answer(&FromTarget::Identity(IDENTITY)),
                Some(Ok(ToTarget::Status)) => {
                    let status = FromTarget::Status(Status {
                        mode: Mode::Standby,
                        received: self.receiver.tally(),
                        telemetry_dropped: 0,
                        measurements_replaced: 0,
                        measurements_stale: 0,
                        line: LineErrors::default(),
                        overruns: 0,
                        cut_torques: 0,
                        stack_bytes: 0,
                        log: FaultLog::default(),
                    });
                    self.answer(&status);
                }
                Some(Ok(ToTarget::Arm(_))) => {
                    self.answer(&FromTarget::Acknowledged(Acknowledged::TooFast(713)));
                }
                // It is reset, and says so by itself.
                Some(Ok(ToTarget::Disarm)) => {
                    self.sender = Sender::new(3);
                    self.answer(&FromTarget::Identity(IDENTITY));
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, LinkError> {
        self.to_host.pop_front().ok_or(LinkError::Silent(patience))
    }
}

/// A host that begins anew is answered at once, however long the one before has talked.
#[test]
fn a_host_that_begins_anew_is_answered() {
    for frames in [0, 1, 60_000] {
        let mut target = Target::connect(Played::after(frames)).expect("an answer");
        assert_eq!(target.identity(), IDENTITY);
        let received = target.status().expect("an answer").received;
        assert_eq!(received.session, u32::from(frames > 0), "one frame is lost");
    }
}

/// A question that is lost is asked again.
#[test]
fn a_lost_question_is_asked_again() {
    for deaf_for in [5, 20, 40, 100] {
        let mut played = Played::after(10);
        played.deaf_for = deaf_for;
        let begin = Instant::now();
        Target::connect(played).expect("an answer");
        assert!(begin.elapsed() < Duration::from_secs(2), "the played target is never waited for");
    }
}

/// A refusal says what would do; a target that was reset is not taken for one that answers.
#[test]
fn what_a_target_says_is_what_the_host_reports() {
    let mut target = Target::connect(Played::after(0)).expect("an answer");
    let refused = target.order("arm", &ToTarget::Arm(IDENTITY.robot)).expect_err("it refuses");
    assert_eq!(
        refused.to_string(),
        "the target refuses arm: a measurement a tick needs periods of 713 µs or more on this line"
    );
    let reset = target.order("disarm", &ToTarget::Disarm).expect_err("it was reset");
    assert!(matches!(reset, LinkError::Rejected(Rejected::Session)), "{reset}");
}

/// Before anything is asked of a target of another robot, the host says which both are, and what to do.
#[test]
fn a_target_of_another_robot_is_refused() {
    let scene = load("experiment-1").expect("built in");
    let target = Target::connect(Played::after(0)).expect("an answer");
    let error = FirmwareController::new(target, &scene).err().expect("refused").to_string();
    let own = format!("{:08x}", scene.robot().id().expect("legs of six joints").fingerprint);
    for word in ["biped", "12 joints", &own, "18 joints", "12345678", "`cargo xtask firmware`"] {
        assert!(error.contains(word), "{error} has no {word}");
    }
}

/// Ports that are none: the message names the path.
#[test]
fn ports_that_cannot_be_opened() {
    for path in ["/dev/no-such-port", "/dev/null", concat!(env!("CARGO_MANIFEST_DIR"), "/lib.rs")] {
        let error = SerialPort::open(path).err().expect("no port");
        assert!(
            matches!(error, LinkError::Io { .. }) && error.to_string().contains(path),
            "{error}"
        );
    }
}

/// An adapter that is pulled out is known at once, not after the target's patience; and so is a port that
/// takes no bytes, of a far end that reads none.
#[test]
#[cfg(unix)]
fn ports_that_end_or_stand_still() {
    use serialport::{SerialPort as _, TTYPort};
    let pair = || {
        let (far, near) = TTYPort::pair().expect("a pseudo-terminal");
        let path = near.name().expect("a path");
        // Open, it would be taken.
        drop(near);
        (far, SerialPort::open(&path).expect("a port"))
    };
    let (far, mut port) = pair();
    port.send(b"hello").expect("sent");
    drop(far);
    let begin = Instant::now();
    let error = port.receive(Duration::from_secs(5)).expect_err("nothing there");
    assert!(matches!(error, LinkError::Ended(_)), "{error}");
    assert!(begin.elapsed() < Duration::from_secs(1));

    let (_far, mut port) = pair();
    let error = (0..1000).find_map(|_| port.send(&[1; 1000]).err()).expect("it fills up");
    assert!(error.to_string().contains("takes no bytes"), "{error}");
}
