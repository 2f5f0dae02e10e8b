//! What runs when no tick does: frames, orders, replies, logs.

use crate::board::{self, Counter, Link};
use crate::control::{Measurement, Order, Posting, Receiving, Record, Sending, joint_limits};
use crate::log::Log;
use crate::no_init::{self, stack_bytes};
use crate::robot::{self, FRAME, JOINTS, LIMITS};
use crate::{Limits, NEEDED, Profile, limits, standing, walker};
use surefoot::balance::Mode;
use surefoot_firmware::freshness::Freshness;
use surefoot_firmware::orders::Orders;
use surefoot_link::{
    Acknowledged, BAUD, Clock, Identity, Injection, Pacing, Receiver, Rejected, RobotId, Sender,
    SetPoint, Status, WalkOrder, by_joint, shortest_period_us,
};

type ToTarget = surefoot_link::ToTarget<JOINTS>;
type FromTarget = surefoot_link::FromTarget<JOINTS>;
type Sensors = surefoot_link::Sensors<JOINTS>;
type Settings = surefoot_link::Settings<JOINTS>;
type Torques = surefoot_link::Torques<JOINTS>;

/// Forces in a measurement.
const FORCES: usize = if cfg!(walks) { robot::FEET } else { 0 };

/// Everything that idle owns.
pub struct Application {
    link: Link,
    counter: Counter,
    clock: Clock,
    orders: Sending<Order>,
    on_their_way: Orders,
    measurements: Posting,
    /// Of the measurements of this session.
    freshness: Freshness,
    session: Option<u32>,
    records: Receiving<Record>,
    receiver: Receiver<ToTarget, FRAME>,
    sender: Sender,
    pacing: Pacing,
    /// s
    #[cfg(estimates)]
    period: f32,
    profile: Profile,
    /// Since the last settings the tick was told how the robot stands, and how it walks.
    told: [bool; 2],
    log: Log,
    /// As of the last record.
    overruns: u32,
    cut_torques: u32,
    records_dropped: u32,
    measurements_replaced: u32,
    measurements_stale: u32,
}

impl Application {
    /// Reads the log that has survived the reset, and notes what led to that.
    pub fn new(
        link: Link,
        counter: Counter,
        clock: Clock,
        orders: Sending<Order>,
        measurements: Posting,
        records: Receiving<Record>,
    ) -> Self {
        // Before the log is written.
        let session = no_init::fingerprint();
        Self {
            link,
            counter,
            clock,
            orders,
            on_their_way: Orders::new(),
            measurements,
            freshness: Freshness::new(0, 1),
            session: None,
            records,
            receiver: Receiver::new(),
            sender: Sender::new(session),
            pacing: Pacing::LockStep,
            #[cfg(estimates)]
            period: crate::control::PERIOD,
            profile: Profile::new(),
            told: [false; 2],
            log: Log::open(),
            overruns: 0,
            cut_torques: 0,
            records_dropped: 0,
            measurements_replaced: 0,
            measurements_stale: 0,
        }
    }

    /// Says who it is, and then does what is asked of it.
    pub fn run(&mut self) -> ! {
        defmt::info!(
            "reset {=u32}; a stop in the log: {=bool}",
            self.log.contents().resets,
            !self.log.contents().stops.is_empty()
        );
        if let Clock::Internal(reason) = self.clock {
            defmt::warn!("without a crystal: {}", defmt::Display2Format(&reason));
        }
        // The mode of the next reset is the one it will find here.
        let identity = self.identity();
        self.log.note_mode(Mode::Standby);
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
            let Self { link, records, .. } = self;
            board::sleep_unless(|| link.has_bytes() || records.ready());
        }
    }

    fn identity(&self) -> Identity {
        Identity {
            robot: robot::ID,
            counter: Counter::UNIT,
            per_second: Counter::PER_SECOND,
            resets: self.log.contents().resets,
            mode_at_reset: self.log.contents().mode_at_reset,
            clock: self.clock,
        }
    }

    fn frame(&mut self, frame: Result<ToTarget, Rejected>) {
        // A message is large: it is looked at where it is.
        if let Ok(message) = &frame
            && !message.is_of(JOINTS)
        {
            return self.reject(Rejected::Malformed);
        }
        let answer = match frame {
            Err(rejected) => return self.reject(rejected),
            Ok(ToTarget::Sensors { taken_us, sensors }) => {
                self.post(taken_us, &sensors);
                if self.pacing == Pacing::LockStep {
                    board::tick_now(self.counter);
                    self.take_records(true);
                }
                return;
            }
            #[cfg(estimates)]
            Ok(ToTarget::Readings { taken_us, readings }) => {
                self.post_readings(taken_us, &readings);
                if self.pacing == Pacing::LockStep {
                    board::tick_now(self.counter);
                    self.take_records(true);
                }
                return;
            }
            #[cfg(estimates)]
            Ok(ToTarget::Filter(settings)) => {
                FromTarget::Acknowledged(self.tell(|_| crate::sensing::filter(&settings)))
            }
            #[cfg(estimates)]
            Ok(ToTarget::Observe(settings)) => FromTarget::Acknowledged(
                self.tell(|period| crate::sensing::observer(&settings, period)),
            ),
            #[cfg(not(estimates))]
            Ok(ToTarget::Readings { .. } | ToTarget::Filter(_) | ToTarget::Observe(_)) => {
                FromTarget::Acknowledged(Acknowledged::Unsupported)
            }
            Ok(ToTarget::Hello) => FromTarget::Identity(self.identity()),
            Ok(ToTarget::Status) => FromTarget::Status(self.status()),
            Ok(ToTarget::Configure(settings)) => FromTarget::Acknowledged(self.configure(settings)),
            Ok(ToTarget::Limit(settings)) => {
                FromTarget::Acknowledged(self.limit(None, || limits(&settings)))
            }
            Ok(ToTarget::Stand(settings)) => {
                FromTarget::Acknowledged(self.limit(Some(0), || standing(&settings)))
            }
            Ok(ToTarget::Walker(settings)) => {
                FromTarget::Acknowledged(self.limit(Some(1), || walker(&settings)))
            }
            Ok(ToTarget::Walk(order)) => FromTarget::Acknowledged(self.walk(order)),
            Ok(ToTarget::SetPoint(pose)) => FromTarget::Acknowledged(self.set_point(pose)),
            Ok(ToTarget::Arm(robot)) => FromTarget::Acknowledged(self.arm(robot)),
            Ok(ToTarget::Disarm) => FromTarget::Acknowledged(self.order(Order::Disarm)),
            Ok(ToTarget::Profile(sensors)) => {
                if self.on_their_way.is_standby() {
                    self.profile.stages(self.counter, &sensors)
                } else {
                    FromTarget::Acknowledged(Acknowledged::Busy)
                }
            }
            Ok(ToTarget::Inject(injection)) => FromTarget::Acknowledged(self.inject(injection)),
        };
        self.send(&answer);
    }

    /// In lock step time goes on, measurement or not.
    fn reject(&mut self, rejected: Rejected) {
        defmt::warn!("frame rejected: {}", defmt::Display2Format(&rejected));
        if self.pacing == Pacing::LockStep {
            board::tick_now(self.counter);
            self.take_records(true);
        }
    }

    #[inline(never)]
    fn configure(&mut self, settings: Settings) -> Acknowledged {
        if !settings.is_valid() {
            return Acknowledged::Invalid;
        }
        if let Err(error) = LIMITS.allows(&joint_limits(&settings), &settings.thresholds) {
            defmt::warn!("limits are refused: {}", defmt::Display2Format(&error));
            return Acknowledged::Limit(error);
        }
        if !self.on_their_way.is_standby() {
            return Acknowledged::Busy;
        }
        let period_us = settings.period_us();
        if settings.pacing == Pacing::FreeRunning {
            let shortest_us = shortest_period_us::<JOINTS>(BAUD, FORCES);
            if period_us < shortest_us {
                return Acknowledged::TooFast(shortest_us);
            }
            if period_us > board::LONGEST_US {
                return Acknowledged::TooSlow(board::LONGEST_US);
            }
        } else if self.pacing == Pacing::FreeRunning {
            // The watchdog runs, and will not wait for a host.
            return Acknowledged::Unsupported;
        }
        let answer = self.order(Order::Configure(settings));
        if answer == Acknowledged::Done {
            self.profile.configure(&settings);
            self.told = [false; 2];
            self.pacing = settings.pacing;
            #[cfg(estimates)]
            {
                self.period = settings.period;
            }
            self.freshness = Freshness::new(period_us, drift(self.clock));
        }
        answer
    }

    /// What is told is large: it is made here, where no tick has it on its stack.
    #[inline(never)]
    fn limit(
        &mut self,
        what: Option<usize>,
        limits: impl FnOnce() -> Result<Limits, Acknowledged>,
    ) -> Acknowledged {
        if !self.on_their_way.is_standby() {
            return Acknowledged::Busy;
        }
        let answer = match limits() {
            Ok(limits) => self.order(Order::Limit(limits)),
            Err(answer) => answer,
        };
        let told = what.and_then(|what| self.told.get_mut(what));
        if let (Some(told), Acknowledged::Done) = (told, answer) {
            *told = true;
        }
        answer
    }

    /// A filter or an observer for ticks that are the last settings' period apart.
    #[cfg(estimates)]
    #[inline(never)]
    fn tell(
        &mut self,
        told: impl FnOnce(f32) -> Result<crate::sensing::Told, Acknowledged>,
    ) -> Acknowledged {
        if !self.on_their_way.is_standby() {
            return Acknowledged::Busy;
        }
        match told(self.period) {
            Ok(told) => self.order(Order::Tell(told)),
            Err(answer) => answer,
        }
    }

    #[cfg(walks)]
    fn walk(&mut self, order: WalkOrder) -> Acknowledged {
        let motion = order.motion.unwrap_or_default();
        if !(motion.iter().all(|x| x.is_finite()) && order.lowered.is_finite()) {
            return Acknowledged::Invalid;
        }
        self.order(Order::Walk(order))
    }

    #[cfg(not(walks))]
    fn walk(&mut self, _: WalkOrder) -> Acknowledged {
        Acknowledged::Unsupported
    }

    /// For a host that means this robot.
    fn arm(&mut self, robot: RobotId) -> Acknowledged {
        if robot != robot::ID {
            Acknowledged::Robot(robot::ID)
        } else if NEEDED.iter().zip(&self.told).any(|(needed, told)| *needed && !told) {
            Acknowledged::NoStance
        } else {
            self.order(Order::Arm)
        }
    }

    fn set_point(&mut self, pose: SetPoint) -> Acknowledged {
        if !pose.is_valid() {
            return Acknowledged::Invalid;
        }
        let answer = self.order(Order::SetPoint(pose));
        if answer == Acknowledged::Done {
            self.profile.set_point(&pose);
        }
        answer
    }

    /// Whether a measurement is one; another is counted.
    fn is_fresh(&mut self, taken_us: u32, arrived_us: u32) -> bool {
        // Another sender has another clock.
        if self.session != self.receiver.session() {
            self.session = self.receiver.session();
            self.freshness.forget();
        }
        if self.pacing == Pacing::FreeRunning
            && self.freshness.accept(taken_us, arrived_us).is_err()
        {
            self.measurements_stale = self.measurements_stale.saturating_add(1);
            return false;
        }
        true
    }

    /// A measurement for the next tick, in the place of one that no tick has taken yet.
    fn post(&mut self, taken_us: u32, sensors: &Sensors) {
        let arrived_us = board::now_us();
        if !self.is_fresh(taken_us, arrived_us) {
            return;
        }
        let measurement = Measurement {
            arrived_us,
            state: sensors.state(),
            contacts: sensors.contacts(),
            #[cfg(walks)]
            forces: forces(&sensors.forces),
            #[cfg(estimates)]
            inertial: None,
        };
        self.hand_over(measurement);
    }

    /// What sensors read, likewise.
    #[cfg(estimates)]
    fn post_readings(&mut self, taken_us: u32, readings: &surefoot_link::Readings<JOINTS>) {
        let arrived_us = board::now_us();
        if !self.is_fresh(taken_us, arrived_us) {
            return;
        }
        let measurement = Measurement {
            arrived_us,
            state: readings.joints(),
            contacts: surefoot_link::by_foot(readings.contacts),
            #[cfg(walks)]
            forces: forces(&readings.forces),
            inertial: Some(crate::sensing::Inertial {
                imu: readings.imu(),
                switches: surefoot_link::by_foot(readings.switches),
            }),
        };
        self.hand_over(measurement);
    }

    fn hand_over(&mut self, measurement: Measurement) {
        if self.measurements.post(measurement) {
            self.measurements_replaced = self.measurements_replaced.saturating_add(1);
        }
    }

    /// For the next tick. That is made at once to disarm, and in standby, so that orders do not wait
    /// for a measurement, or for each other.
    fn order(&mut self, order: Order) -> Acknowledged {
        let (is_arm, is_disarm) = (matches!(order, Order::Arm), matches!(order, Order::Disarm));
        if self.orders.enqueue(order).is_err() {
            return Acknowledged::Busy;
        }
        self.on_their_way.note_sent(is_arm);
        if is_disarm || self.on_their_way.is_standby() {
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
            Injection::Crash(crash) => crate::crash::crash(crash),
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
            let before = self.on_their_way.mode();
            if record.mode != before {
                self.log.note_mode(record.mode);
                let was_stopping = matches!(before, Mode::Stopping { .. });
                if let Some(reason) = record.reason.filter(|_| !was_stopping) {
                    self.log.note_stop(record.tick, reason);
                }
            }
            self.on_their_way.note_tick(record.orders, record.mode);
            self.overruns = record.overruns;
            self.cut_torques = record.cut_torques;
            self.records_dropped = record.dropped;
            defmt::debug!(
                "tick {=u32}: cost {=u32}, latency {=u32}, torques {}",
                record.tick,
                record.cost,
                record.latency,
                record.joint_torques,
            );
            if is_answered && (self.pacing == Pacing::LockStep || record.is_measured) {
                self.send(&FromTarget::Torques(torques(&record)));
            }
        }
    }

    fn status(&self) -> Status {
        Status {
            mode: self.on_their_way.mode(),
            received: self.receiver.tally(),
            telemetry_dropped: self.records_dropped,
            measurements_replaced: self.measurements_replaced,
            measurements_stale: self.measurements_stale,
            line: board::line_errors(),
            overruns: self.overruns,
            cut_torques: self.cut_torques,
            stack_bytes: stack_bytes(),
            log: self.log.contents().clone(),
        }
    }

    fn send(&mut self, message: &FromTarget) {
        let mut wire = [0; FRAME];
        if let Some(bytes) = self.sender.encode(message, &mut wire) {
            self.link.send(bytes);
        }
    }
}

/// The share by which this clock and the host's may differ is one in this: two crystals of 100 ppm with
/// room, or the internal oscillator's −8 to +4.5 %.
fn drift(clock: Clock) -> u32 {
    match clock {
        Clock::Internal(_) => 8,
        Clock::Crystal(_) | Clock::Emulated => 1024,
    }
}

/// Normal forces of a message, foot by foot.
#[cfg(walks)]
fn forces(all: &[f32]) -> [f32; robot::FEET] {
    core::array::from_fn(|foot| all.get(foot).copied().unwrap_or(0.0))
}

fn torques(record: &Record) -> Torques {
    Torques {
        tick: record.tick,
        joint_torques: by_joint(&record.joint_torques, 0.0),
        desired_wrench: record
            .command
            .map_or([0.0; 6], |command| command.desired_wrench.to_array()),
        mode: record.mode,
        reason: record.reason,
        limits: record.limits,
        steps: record.steps,
        #[cfg(estimates)]
        estimated: record.estimated,
        #[cfg(not(estimates))]
        estimated: None,
        cost: record.cost,
        latency: record.latency,
    }
}
