//! What runs when no tick does: frames, orders, replies, logs.

use crate::board::{self, Counter, Link};
use crate::control::{LIMITS, Order, Receiving, Record, Sending};
use crate::no_init::{self, stack_bytes};
use crate::profile::{Profile, stages};
use surefoot::balance::{Mode, RobotState};
use surefoot_link::{
    Acknowledged, FRAME, FaultLog, FromTarget, Identity, Injection, LEGS, LoggedFault, Pacing,
    Receiver, Rejected, Sender, SetPoint, Settings, Status, ToTarget, Torques,
};

/// Everything that idle owns.
pub struct Application {
    link: Link,
    counter: Counter,
    orders: Sending<Order>,
    measurements: Sending<RobotState<f32, LEGS>>,
    records: Receiving<Record>,
    receiver: Receiver<ToTarget>,
    sender: Sender,
    pacing: Pacing,
    profile: Profile,
    log: FaultLog,
    /// As of the last record.
    mode: Mode,
    /// Armed, and no tick since.
    is_arming: bool,
    overruns: u32,
    cut_torques: u32,
    records_dropped: u32,
    measurements_dropped: u32,
}

impl Application {
    /// Reads the log that has survived the reset.
    pub fn new(
        link: Link,
        counter: Counter,
        orders: Sending<Order>,
        measurements: Sending<RobotState<f32, LEGS>>,
        records: Receiving<Record>,
    ) -> Self {
        let mut log = no_init::read();
        log.resets = log.resets.saturating_add(1);
        no_init::write(&log);
        Self {
            link,
            counter,
            orders,
            measurements,
            records,
            receiver: Receiver::new(),
            sender: Sender::new(),
            pacing: Pacing::LockStep,
            profile: Profile::new(),
            log,
            mode: Mode::Standby,
            is_arming: false,
            overruns: 0,
            cut_torques: 0,
            records_dropped: 0,
            measurements_dropped: 0,
        }
    }

    /// Says who it is, and then does what is asked of it.
    pub fn run(&mut self) -> ! {
        defmt::info!(
            "reset {=u32}; a stop in the log: {=bool}",
            self.log.resets,
            !self.log.stops.is_empty()
        );
        // The mode of the next reset is the one it will find here.
        let identity = self.identity();
        self.note_mode(Mode::Standby);
        self.send(&FromTarget::Identity(identity));
        loop {
            let mut bytes = [0; 64];
            let received = self.link.receive(&mut bytes);
            for byte in bytes.iter().take(received) {
                if let Some(frame) = self.receiver.take(*byte) {
                    self.frame(frame);
                }
            }
            self.take_records(true);
        }
    }

    fn identity(&self) -> Identity {
        Identity {
            counter: Counter::UNIT,
            per_second: Counter::PER_SECOND,
            resets: self.log.resets,
            mode_at_reset: self.log.mode_at_reset,
        }
    }

    fn frame(&mut self, frame: Result<ToTarget, Rejected>) {
        let answer = match frame {
            Err(rejected) => {
                defmt::warn!("frame rejected: {}", defmt::Display2Format(&rejected));
                // In lock step time goes on, measurement or not.
                if self.pacing == Pacing::LockStep {
                    board::tick_now(self.counter);
                    self.take_records(true);
                }
                return;
            }
            Ok(ToTarget::Sensors(sensors)) => {
                if self.measurements.enqueue(sensors.state()).is_err() {
                    self.measurements_dropped = self.measurements_dropped.saturating_add(1);
                }
                if self.pacing == Pacing::LockStep {
                    board::tick_now(self.counter);
                    self.take_records(true);
                }
                return;
            }
            Ok(ToTarget::Hello) => FromTarget::Identity(self.identity()),
            Ok(ToTarget::Status) => FromTarget::Status(self.status()),
            Ok(ToTarget::Configure(settings)) => FromTarget::Acknowledged(self.configure(settings)),
            Ok(ToTarget::SetPoint(pose)) => FromTarget::Acknowledged(self.set_point(pose)),
            Ok(ToTarget::Arm) => {
                // Before the order, which must wait for a measurement.
                let was_arming = core::mem::replace(&mut self.is_arming, true);
                let answer = self.order(Order::Arm);
                if answer != Acknowledged::Done {
                    self.is_arming = was_arming;
                }
                FromTarget::Acknowledged(answer)
            }
            Ok(ToTarget::Disarm) => {
                self.is_arming = false;
                FromTarget::Acknowledged(self.order(Order::Disarm))
            }
            Ok(ToTarget::Profile(sensors)) => {
                if self.mode == Mode::Standby {
                    FromTarget::Stages(stages(&self.profile, self.counter, &sensors.state()))
                } else {
                    FromTarget::Acknowledged(Acknowledged::Busy)
                }
            }
            Ok(ToTarget::Inject(injection)) => FromTarget::Acknowledged(self.inject(injection)),
        };
        self.send(&answer);
    }

    #[inline(never)]
    fn configure(&mut self, settings: Settings) -> Acknowledged {
        if !settings.is_valid() {
            return Acknowledged::Invalid;
        }
        if let Err(error) = LIMITS.allows(&settings.joint_limits, &settings.thresholds) {
            defmt::warn!("limits are refused: {}", defmt::Display2Format(&error));
            return Acknowledged::Limit(error);
        }
        if self.mode != Mode::Standby || self.is_arming {
            return Acknowledged::Busy;
        }
        if self.pacing == Pacing::FreeRunning && settings.pacing == Pacing::LockStep {
            // The watchdog runs, and will not wait for a host.
            return Acknowledged::Unsupported;
        }
        self.profile.configure(&settings);
        self.pacing = settings.pacing;
        self.order(Order::Configure(settings))
    }

    fn set_point(&mut self, pose: SetPoint) -> Acknowledged {
        if !pose.is_valid() {
            return Acknowledged::Invalid;
        }
        self.profile.set_point(&pose);
        self.order(Order::SetPoint(pose))
    }

    /// For the next tick. That is made at once to disarm, and in standby, so that orders do not wait
    /// for a measurement, or for each other.
    fn order(&mut self, order: Order) -> Acknowledged {
        let is_urgent = matches!(order, Order::Disarm);
        if self.orders.enqueue(order).is_err() {
            return Acknowledged::Busy;
        }
        if is_urgent || self.mode == Mode::Standby && !self.is_arming {
            board::tick_now(self.counter);
            self.take_records(false);
        }
        Acknowledged::Done
    }

    #[cfg(feature = "emulation")]
    fn inject(&mut self, injection: Injection) -> Acknowledged {
        match injection {
            Injection::Delay(cost) => self.order(Order::Delay(cost)),
            Injection::Reset => board::restart(),
            Injection::ResetAndForget => {
                no_init::forget();
                board::restart()
            }
            Injection::Exit => board::exit(),
        }
    }

    #[cfg(not(feature = "emulation"))]
    fn inject(&mut self, _: Injection) -> Acknowledged {
        Acknowledged::Unsupported
    }

    /// Notes, and as a rule answers, what ticks have left.
    fn take_records(&mut self, is_answered: bool) {
        while let Some(record) = self.records.dequeue() {
            if record.mode != self.mode {
                self.note_mode(record.mode);
                let was_stopping = matches!(self.mode, Mode::Stopping { .. });
                if let Some(reason) = record.reason.filter(|_| !was_stopping) {
                    let (reset, tick) = (self.log.resets, record.tick);
                    self.note_stop(LoggedFault { reset, tick, reason });
                }
                self.mode = record.mode;
            }
            self.is_arming = false;
            self.overruns = record.overruns;
            self.cut_torques = record.cut_torques;
            self.records_dropped = record.dropped;
            defmt::debug!(
                "tick {=u32}: cost {=u32}, latency {=u32}, torques {} {}",
                record.tick,
                record.cost,
                record.latency,
                record.joint_torques[0],
                record.joint_torques[1],
            );
            if is_answered && (self.pacing == Pacing::LockStep || record.is_measured) {
                self.send(&FromTarget::Torques(torques(&record)));
            }
        }
    }

    /// The log is for what the robot was doing; the ramp's ticks are one mode.
    fn note_mode(&mut self, mode: Mode) {
        let mode = match mode {
            Mode::Stopping { .. } => Mode::Stopping { left: 0 },
            other => other,
        };
        if self.log.mode_at_reset != Some(mode) {
            self.log.mode_at_reset = Some(mode);
            no_init::write(&self.log);
        }
    }

    fn note_stop(&mut self, stop: LoggedFault) {
        if self.log.stops.is_full() {
            self.log.stops.remove(0);
        }
        // There is room now.
        let _ = self.log.stops.push(stop);
        no_init::write(&self.log);
        defmt::error!("stopped at tick {=u32}: {}", stop.tick, defmt::Display2Format(&stop.reason));
    }

    fn status(&self) -> Status {
        Status {
            mode: self.mode,
            received: self.receiver.tally(),
            telemetry_dropped: self.records_dropped,
            measurements_dropped: self.measurements_dropped,
            overruns: self.overruns,
            cut_torques: self.cut_torques,
            stack_bytes: stack_bytes(),
            log: self.log.clone(),
        }
    }

    fn send(&mut self, message: &FromTarget) {
        let mut wire = [0; FRAME];
        if let Some(bytes) = self.sender.encode(message, &mut wire) {
            self.link.send(bytes);
        }
    }
}

fn torques(record: &Record) -> Torques {
    Torques {
        tick: record.tick,
        joint_torques: record.joint_torques,
        desired_wrench: record
            .command
            .map_or([0.0; 6], |command| command.desired_wrench.to_array()),
        mode: record.mode,
        reason: record.reason,
        cost: record.cost,
        latency: record.latency,
    }
}
