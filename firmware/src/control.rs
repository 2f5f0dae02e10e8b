//! The tick: what runs at the highest priority.

use crate::board::{Counter, Motors, TickTimer, Watchdog, now_us};
use crate::robot::{self, FEET, JOINTS, LIMITS, ROW, ROWS};
#[cfg(estimates)]
use crate::sensing::{Inertial, Sensing, Told};
use crate::{Balance, Limits};
use heapless::spsc::{Consumer, Producer, Queue};
use surefoot::balance::{
    Command, JointLimits, Mode, Reference, RobotState, StopReason, Supervisor,
};
use surefoot::spatial::Quaternion;
use surefoot_firmware::mailbox::{Mailbox, Reader, Writer};
#[cfg(estimates)]
use surefoot_link::Estimated;
#[cfg(walks)]
use surefoot_link::WalkOrder;
use surefoot_link::{Pacing, SetPoint, Settings, TickLimits};

/// Seconds between ticks until the host says otherwise.
pub const PERIOD: f32 = 1e-3;

/// What the application asks of the next tick.
#[cfg_attr(
    any(whole_body, estimates),
    expect(clippy::large_enum_variant, reason = "there is no heap for the largest")
)]
pub enum Order {
    /// New constants; in standby only.
    Configure(Settings<JOINTS>),
    /// Distribute within these limits; in standby only.
    Limit(Limits),
    /// What a robot that walks is to do.
    #[cfg(walks)]
    Walk(WalkOrder),
    /// A filter or an observer; in standby only.
    #[cfg(estimates)]
    Tell(Told),
    /// A pose to hold.
    SetPoint(SetPoint),
    /// Begin to balance.
    Arm,
    /// Zero torques.
    Disarm,
    /// Take this much longer, once.
    #[cfg(feature = "emulation")]
    Delay(u32),
}

/// What a tick leaves for the application.
pub struct Record {
    /// Whether it had a measurement.
    pub is_measured: bool,
    /// N·m
    pub joint_torques: [[f32; ROW]; ROWS],
    /// The tick's answer, where there was one.
    pub command: Option<Command<f32, ROWS>>,
    /// After the tick.
    pub mode: Mode,
    /// Why it stopped.
    pub reason: Option<StopReason>,
    /// What limits of ground and motors made of the tick, where there are any.
    pub limits: Option<TickLimits<f32>>,
    /// Steps so far.
    pub steps: u32,
    /// What the filter has made of the readings.
    #[cfg(estimates)]
    pub estimated: Option<Estimated>,
    /// Torques cut to their limits so far.
    pub cut_torques: u32,
    /// Ticks so far.
    pub tick: u32,
    /// Orders taken so far.
    pub orders: u32,
    /// Ticks so far that took longer than their period.
    pub overruns: u32,
    /// Records so far that found the queue full.
    pub dropped: u32,
    /// From the tick's beginning to its torques.
    pub cost: u32,
    /// From the tick's being due to its beginning.
    pub latency: u32,
}

/// Places in a queue, one of which stays empty. A tick takes at most as many orders as there can be.
const PLACES: usize = 4;
/// A queue to, or from, the tick.
pub type TickQueue<T> = Queue<T, PLACES>;
/// Its far end.
pub type Sending<T> = Producer<'static, T, PLACES>;
/// Its near end.
pub type Receiving<T> = Consumer<'static, T, PLACES>;

/// A measurement on its way to the tick.
pub struct Measurement {
    /// When it arrived, by [`now_us`].
    pub arrived_us: u32,
    /// What was measured.
    pub state: RobotState<f32, ROWS>,
    /// Which feet touch the ground.
    pub contacts: [bool; FEET],
    /// Normal forces on them, N.
    #[cfg(walks)]
    pub forces: [f32; FEET],
    /// For a filter: then the state has joints alone.
    #[cfg(estimates)]
    pub inertial: Option<Inertial>,
}

/// Holds the newest measurement.
pub type Measurements = Mailbox<Measurement>;
/// Where idle posts it.
pub type Posting = Writer<'static, Measurement>;
/// Where the tick finds it.
pub type Finding = Reader<'static, Measurement>;

/// Everything that the tick owns.
pub struct Control {
    counter: Counter,
    timer: TickTimer,
    motors: Motors,
    watchdog: Watchdog,
    orders: Receiving<Order>,
    measurements: Finding,
    /// Longest time, µs, for which a measurement may have waited.
    patience_us: u32,
    records: Sending<Record>,
    balance: Balance,
    #[cfg(estimates)]
    sensing: Sensing,
    reference: Reference<f32>,
    supervisor: Supervisor<f32, ROWS>,
    /// Cost that a tick may have.
    deadline: u32,
    overran: bool,
    /// With the period, in s and µs.
    next_pacing: Option<(Pacing, f32, u32)>,
    #[cfg(feature = "emulation")]
    delay: u32,
    tick: u32,
    taken: u32,
    overruns: u32,
    dropped: u32,
}

impl Control {
    /// In standby, with the gains of the robot's file, for ticks [`PERIOD`] apart.
    #[expect(
        clippy::too_many_arguments,
        reason = "each is handed over once, to be owned by the tick"
    )]
    pub fn new(
        supervisor: Supervisor<f32, ROWS>,
        counter: Counter,
        timer: TickTimer,
        motors: Motors,
        watchdog: Watchdog,
        orders: Receiving<Order>,
        measurements: Finding,
        records: Sending<Record>,
    ) -> Self {
        Self {
            counter,
            timer,
            motors,
            watchdog,
            orders,
            measurements,
            patience_us: u32::MAX,
            records,
            balance: Balance::new(),
            #[cfg(estimates)]
            sensing: Sensing::new(),
            reference: robot::reference(),
            supervisor,
            deadline: Counter::deadline(Pacing::LockStep, PERIOD),
            overran: false,
            next_pacing: None,
            #[cfg(feature = "emulation")]
            delay: 0,
            tick: 0,
            taken: 0,
            overruns: 0,
            dropped: 0,
        }
    }

    /// One tick.
    ///
    /// # Deadline
    /// The period of [`Settings`]; 1 ms by default.
    pub fn tick(&mut self) {
        let latency = self.timer.acknowledge();
        let begin = self.counter.now();
        for _ in 0..PLACES {
            let Some(order) = self.orders.dequeue() else { break };
            self.take(order);
        }
        let mut is_measured = false;
        let supervised = self.measurements.read(|newest| {
            let waited = |newest: &&Measurement| now_us().wrapping_sub(newest.arrived_us);
            let measured = newest.filter(|newest| waited(newest) <= self.patience_us);
            is_measured = measured.is_some();
            let Self { supervisor, balance, reference, .. } = self;
            #[cfg(not(estimates))]
            let state = measured.map(|measured| &measured.state);
            #[cfg(estimates)]
            let sensing = &mut self.sensing;
            #[cfg(estimates)]
            let seen = measured.and_then(|measured| sensing.read(measured));
            #[cfg(estimates)]
            let state = seen.as_ref();
            #[cfg(walks)]
            let reference = &balance.reference(reference, state);
            #[cfg(walks)]
            if balance.leaps() {
                supervisor.expect_leap();
            }
            #[cfg(estimates)]
            let reference = &match (state, measured) {
                (Some(state), Some(measured)) if supervisor.mode() != Mode::Standby => {
                    sensing.look(state, &measured.contacts, reference)
                }
                _ => *reference,
            };
            #[cfg(estimates)]
            balance.under(sensing.external());
            supervisor.step_with(state, reference, self.overran, |now| {
                balance.tick(now, reference, measured)
            })
        });
        #[cfg(estimates)]
        self.sensing.sent(&supervised.joint_torques);
        let limits = self.balance.take_limits();
        let mode = self.supervisor.mode();
        self.motors.set(&supervised.joint_torques, mode != Mode::Standby && mode != Mode::Stopped);
        self.watchdog.feed();
        #[cfg(feature = "emulation")]
        self.counter.wait(core::mem::take(&mut self.delay));

        let cost = self.counter.since(begin);
        self.overran = cost > self.deadline;
        self.overruns = self.overruns.saturating_add(u32::from(self.overran));
        self.tick = self.tick.wrapping_add(1);
        let record = Record {
            is_measured,
            joint_torques: supervised.joint_torques,
            command: supervised.command,
            mode,
            reason: self.supervisor.reason(),
            limits,
            #[cfg(walks)]
            steps: self.balance.steps(),
            #[cfg(not(walks))]
            steps: 0,
            #[cfg(estimates)]
            estimated: self.sensing.take_estimated(),
            cut_torques: self.supervisor.cut_torques(),
            tick: self.tick,
            orders: self.taken,
            overruns: self.overruns,
            dropped: self.dropped,
            cost,
            latency,
        };
        if self.records.enqueue(record).is_err() {
            self.dropped = self.dropped.saturating_add(1);
        }
        self.change_pacing();
    }

    fn take(&mut self, order: Order) {
        self.taken = self.taken.wrapping_add(1);
        match order {
            Order::Configure(settings) => {
                if self.supervisor.mode() == Mode::Standby {
                    self.configure(&settings);
                }
            }
            Order::Limit(limits) => {
                if self.supervisor.mode() == Mode::Standby {
                    self.balance.limit(limits);
                }
            }
            #[cfg(walks)]
            Order::Walk(order) => self.balance.walk(&order),
            #[cfg(estimates)]
            Order::Tell(told) => {
                if self.supervisor.mode() == Mode::Standby {
                    self.sensing.tell(told);
                }
            }
            Order::SetPoint(pose) => self.reference = reference(&pose),
            Order::Arm => self.supervisor.arm(),
            Order::Disarm => self.supervisor.disarm(),
            #[cfg(feature = "emulation")]
            Order::Delay(delay) => self.delay = delay,
        }
    }

    /// Apart, so that no tick has its stack.
    #[cold]
    #[inline(never)]
    fn configure(&mut self, settings: &Settings<JOINTS>) {
        // The application has refused others.
        let Settings { thresholds, period, .. } = settings;
        let joint_limits = joint_limits(settings);
        if self.supervisor.tighten(&LIMITS, &joint_limits, thresholds, *period).is_err() {
            return;
        }
        self.balance.configure(settings);
        #[cfg(estimates)]
        {
            self.sensing = Sensing::new();
        }
        self.deadline = Counter::deadline(settings.pacing, settings.period);
        self.next_pacing = Some((settings.pacing, settings.period, settings.period_us()));
    }

    /// Between ticks, as it may change the clock that costs are read from.
    fn change_pacing(&mut self) {
        match self.next_pacing.take() {
            None => {}
            Some((Pacing::LockStep, ..)) => {
                self.patience_us = u32::MAX;
                self.timer.halt();
            }
            Some((Pacing::FreeRunning, period, period_us)) => {
                // It comes between two ticks, of which the later may be late.
                self.patience_us = 2 * period_us;
                self.watchdog.start(period_us);
                self.timer.run(period);
            }
        }
    }
}

/// The supervisor's part of the settings, joint by joint.
pub fn joint_limits(settings: &Settings<JOINTS>) -> [[JointLimits<f32>; ROW]; ROWS] {
    let mut limits = LIMITS.joints;
    let joints = settings.joint_limits.iter();
    limits.as_flattened_mut().iter_mut().zip(joints).for_each(|(to, given)| *to = *given);
    limits
}

/// A pose to hold.
pub fn reference(pose: &SetPoint) -> Reference<f32> {
    Reference::at_rest(pose.position.into(), Quaternion::from_array(pose.orientation))
}
