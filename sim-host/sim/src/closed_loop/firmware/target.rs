//! Orders to a target, and its answers.

use super::Transport;
use std::collections::VecDeque;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use surefoot_link::{
    Acknowledged, Clock, FromTarget, Identity, Injection, MOST_FRAME, Receiver, Rejected, RobotId,
    Sender, Sensors, Stages, Status, ToTarget, Torques,
};

/// How long a target may take for an answer. An emulated one on a busy machine takes milliseconds.
const PATIENCE: Duration = Duration::from_secs(10);

/// How long it may take to say who it is before it is asked again: the question may have been lost.
const ASK_AGAIN: Duration = Duration::from_secs(1);

/// What is wrong with a link.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// Something could not be started or opened.
    #[error("{what}: {source}")]
    Io {
        /// What was tried.
        what: String,
        /// The system's reason.
        source: std::io::Error,
    },
    /// No answer.
    #[error("the target has not answered for {0:?}")]
    Silent(Duration),
    /// The emulator has ended, or the port's adapter is gone.
    #[error("the other end has ended: {0}")]
    Ended(String),
    /// A frame of the target's was no good.
    #[error("from the target: {0}")]
    Rejected(Rejected),
    /// The target does not do as told.
    #[error("the target refuses {order}: {answer}")]
    Refused {
        /// The order.
        order: &'static str,
        /// Its answer.
        answer: Acknowledged,
    },
    /// The target has been built for another robot.
    #[error(
        "the scene's robot, {name}, is {wanted}; the target has been built for {found}: `{command}` builds the right one"
    )]
    AnotherRobot {
        /// Name of the scene's robot.
        name: String,
        /// The scene's robot.
        wanted: RobotId,
        /// The target's.
        found: RobotId,
        /// What builds the images.
        command: String,
    },
    /// No firmware can be built for it.
    #[error(
        "the robot {robot} has not limits for each of its joints, which its firmware would hold"
    )]
    NoFirmware {
        /// The scene's robot.
        robot: String,
    },
    /// Nobody has built the firmware for the robot.
    #[error("no firmware for the robot {robot} at {}: `{command}` builds it", image.display())]
    NoImage {
        /// The scene's robot.
        robot: String,
        /// Where it would be.
        image: PathBuf,
        /// What builds it.
        command: String,
    },
    /// An answer to something else.
    #[error("the target has answered {order} with something else")]
    Unexpected {
        /// The order.
        order: &'static str,
    },
}

/// A target on a link, of a robot with so many joints.
pub struct Target<const JOINTS: usize> {
    transport: Box<dyn Transport>,
    sender: Sender,
    receiver: Receiver<FromTarget<JOINTS>, MOST_FRAME>,
    arrived: VecDeque<Result<FromTarget<JOINTS>, Rejected>>,
    identity: Identity,
    /// Where this side's clock began.
    begin: Instant,
}

impl<const JOINTS: usize> Target<JOINTS> {
    /// Says hello, and waits for the answer.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn connect(transport: impl Transport + 'static) -> Result<Self, LinkError> {
        let mut target = Self {
            transport: Box::new(transport),
            sender: sender(),
            receiver: Receiver::new(),
            arrived: VecDeque::new(),
            // Replaced by the first answer.
            identity: Identity {
                robot: RobotId { joints: 0, fingerprint: 0 },
                counter: surefoot_link::Counter::Cycles,
                per_second: 0,
                resets: 0,
                mode_at_reset: None,
                clock: Clock::Emulated,
            },
            begin: Instant::now(),
        };
        // An end of a frame first: whatever the target had heard half of is over.
        target.send_raw(&[0])?;
        // Where it has heard another session before this one, it believes the second frame.
        target.send(&ToTarget::Hello)?;
        target.send(&ToTarget::Hello)?;
        target.identity = target.await_identity()?;
        // A target that has just been reset says so by itself, and then answers too.
        target.settle()?;
        Ok(target)
    }

    /// Who it is.
    pub fn identity(&self) -> Identity {
        self.identity
    }

    /// Gives an order.
    ///
    /// # Errors
    /// [`LinkError::Refused`], or what is wrong with the link.
    pub fn order(&mut self, name: &'static str, order: &ToTarget<JOINTS>) -> Result<(), LinkError> {
        self.send(order)?;
        match self.answer()? {
            FromTarget::Acknowledged(Acknowledged::Done) => Ok(()),
            FromTarget::Acknowledged(answer) => Err(LinkError::Refused { order: name, answer }),
            _ => Err(LinkError::Unexpected { order: name }),
        }
    }

    /// One tick in lock step.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn tick(&mut self, sensors: &Sensors<JOINTS>) -> Result<Torques<JOINTS>, LinkError> {
        self.send(&self.measurement(sensors))?;
        self.torques()
    }

    /// The message of a measurement that is taken now.
    pub fn measurement(&self, sensors: &Sensors<JOINTS>) -> ToTarget<JOINTS> {
        // Goes round after 71 minutes.
        let taken_us = self.begin.elapsed().as_micros() as u32;
        ToTarget::Sensors { taken_us, sensors: *sensors }
    }

    /// One tick in lock step whose frame arrives as these bytes, the last of them 0.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn tick_raw(&mut self, bytes: &[u8]) -> Result<Torques<JOINTS>, LinkError> {
        self.send_raw(bytes)?;
        self.torques()
    }

    /// Counts and logs.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn status(&mut self) -> Result<Status, LinkError> {
        self.send(&ToTarget::Status)?;
        loop {
            match self.answer()? {
                FromTarget::Status(status) => return Ok(status),
                // A free-running target sends these by itself.
                FromTarget::Torques(_) => {}
                _ => return Err(LinkError::Unexpected { order: "status" }),
            }
        }
    }

    /// What the stages of a tick cost.
    ///
    /// # Errors
    /// A [`LinkError`]; the target refuses unless it is in standby.
    pub fn profile(&mut self, sensors: &Sensors<JOINTS>) -> Result<Stages, LinkError> {
        self.send(&ToTarget::Profile(*sensors))?;
        match self.answer()? {
            FromTarget::Stages(stages) => Ok(stages),
            _ => Err(LinkError::Unexpected { order: "profile" }),
        }
    }

    /// Resets an emulated target, and says hello again.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn reset(&mut self, injection: Injection) -> Result<Identity, LinkError> {
        self.send(&ToTarget::Inject(injection))?;
        self.receiver = Receiver::new();
        self.sender = sender();
        self.identity = self.await_identity()?;
        self.settle()?;
        Ok(self.identity)
    }

    /// The frame of a message, for those who want to spoil it.
    pub fn frame(&mut self, message: &ToTarget<JOINTS>) -> Vec<u8> {
        let mut wire = [0; MOST_FRAME];
        // A test of the link makes sure that every message fits.
        self.sender.encode(message, &mut wire).unwrap_or_default().to_vec()
    }

    fn torques(&mut self) -> Result<Torques<JOINTS>, LinkError> {
        match self.answer()? {
            FromTarget::Torques(torques) => Ok(torques),
            FromTarget::Acknowledged(answer) => Err(LinkError::Refused { order: "tick", answer }),
            _ => Err(LinkError::Unexpected { order: "tick" }),
        }
    }

    fn send(&mut self, message: &ToTarget<JOINTS>) -> Result<(), LinkError> {
        let frame = self.frame(message);
        self.send_raw(&frame)
    }

    /// Sends bytes, whatever they are.
    ///
    /// # Errors
    /// What is wrong with the link.
    pub fn send_raw(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.transport.send(bytes)
    }

    fn answer(&mut self) -> Result<FromTarget<JOINTS>, LinkError> {
        self.next(PATIENCE)?.map_err(LinkError::Rejected)
    }

    /// The next frame, good or bad.
    fn next(
        &mut self,
        patience: Duration,
    ) -> Result<Result<FromTarget<JOINTS>, Rejected>, LinkError> {
        let begin = Instant::now();
        loop {
            if let Some(frame) = self.arrived.pop_front() {
                return Ok(frame);
            }
            let left = patience.saturating_sub(begin.elapsed());
            if left.is_zero() {
                return Err(LinkError::Silent(patience));
            }
            for byte in self.transport.receive(left)? {
                self.arrived.extend(self.receiver.take(byte));
            }
        }
    }

    /// Asks until it has an answer. Whatever came before that was for someone else.
    fn await_identity(&mut self) -> Result<Identity, LinkError> {
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            match self.next(ASK_AGAIN) {
                Ok(Ok(FromTarget::Identity(identity))) => return Ok(identity),
                Ok(Err(Rejected::Version(theirs))) => {
                    return Err(LinkError::Rejected(Rejected::Version(theirs)));
                }
                Ok(_) => {}
                Err(LinkError::Silent(_)) => self.send(&ToTarget::Hello)?,
                Err(other) => return Err(other),
            }
        }
        Err(LinkError::Silent(PATIENCE))
    }

    /// Takes what is still on its way: a status has an answer of its own kind.
    fn settle(&mut self) -> Result<(), LinkError> {
        self.send(&ToTarget::Status)?;
        loop {
            if let Ok(FromTarget::Status(_)) = self.next(PATIENCE)? {
                return Ok(());
            }
        }
    }
}

/// In a session of its own.
fn sender() -> Sender {
    // Every one of these hashes by a random key.
    Sender::new(RandomState::new().build_hasher().finish() as u32)
}
