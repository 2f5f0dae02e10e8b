//! The tick: what runs at the highest priority.

use crate::board::{Counter, Motors, TickTimer, Watchdog};
use heapless::spsc::{Consumer, Producer, Queue};
use nalgebra::Vector3;
use surefoot::balance::{
    Command, Controller, Gains, LeggedRobot, Mode, Reference, RobotState, SafetyLimits, StopReason,
    Supervisor, WorkspaceForm,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, SymmetricMatrix3};
use surefoot_link::{LEGS, Pacing, SetPoint, Settings};

/// The robot, in flash.
pub static ROBOT: LeggedRobot<f32, LEGS> = LeggedRobot::<f64, LEGS>::new(&biped::TREE).to_f32();

/// Seconds between ticks until the host says otherwise.
const PERIOD: f32 = 1e-3;

/// What the application asks of the next tick.
pub enum Order {
    /// New constants; in standby only.
    Configure(Settings),
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
    pub joint_torques: [[f32; 6]; LEGS],
    /// The tick's answer, where there was one.
    pub command: Option<Command<f32, LEGS>>,
    /// After the tick.
    pub mode: Mode,
    /// Why it stopped.
    pub reason: Option<StopReason>,
    /// Torques cut to their limits so far.
    pub cut_torques: u32,
    /// Ticks so far.
    pub tick: u32,
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

/// Everything that the tick owns.
pub struct Control {
    counter: Counter,
    timer: TickTimer,
    motors: Motors,
    watchdog: Watchdog,
    orders: Receiving<Order>,
    measurements: Receiving<RobotState<f32, LEGS>>,
    records: Sending<Record>,
    controller: Controller<'static, f32, LEGS>,
    reference: Reference<f32>,
    supervisor: Supervisor<f32, LEGS>,
    /// Cost that a tick may have.
    deadline: u32,
    overran: bool,
    next_pacing: Option<(Pacing, f32)>,
    #[cfg(feature = "emulation")]
    delay: u32,
    tick: u32,
    overruns: u32,
    dropped: u32,
}

impl Control {
    /// In standby, with the gains of the experiments and the limits of the biped.
    pub fn new(
        counter: Counter,
        timer: TickTimer,
        motors: Motors,
        watchdog: Watchdog,
        orders: Receiving<Order>,
        measurements: Receiving<RobotState<f32, LEGS>>,
        records: Sending<Record>,
    ) -> Self {
        Self {
            counter,
            timer,
            motors,
            watchdog,
            orders,
            measurements,
            records,
            controller: Controller::new(&ROBOT),
            reference: Reference::at_rest(Vector3::new(0.0, 0.0, 1.1), Quaternion::identity()),
            supervisor: Supervisor::new(SafetyLimits::biped(), PERIOD),
            deadline: Counter::cost_of(PERIOD),
            overran: false,
            next_pacing: None,
            #[cfg(feature = "emulation")]
            delay: 0,
            tick: 0,
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
        let measured = self.measurements.dequeue();
        let supervised = self.supervisor.step(
            &self.controller,
            measured.as_ref(),
            &self.reference,
            self.overran,
        );
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
            is_measured: measured.is_some(),
            joint_torques: supervised.joint_torques,
            command: supervised.command,
            mode,
            reason: self.supervisor.reason(),
            cut_torques: self.supervisor.cut_torques(),
            tick: self.tick,
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
        match order {
            Order::Configure(settings) => {
                if self.supervisor.mode() == Mode::Standby {
                    self.configure(&settings);
                }
            }
            Order::SetPoint(pose) => self.reference = reference(&pose),
            Order::Arm => self.supervisor.arm(),
            Order::Disarm => self.supervisor.disarm(),
            #[cfg(feature = "emulation")]
            Order::Delay(delay) => self.delay = delay,
        }
    }

    fn configure(&mut self, settings: &Settings) {
        configure(&mut self.controller, settings);
        self.supervisor = Supervisor::new(settings.limits, settings.period);
        self.deadline = Counter::cost_of(settings.period);
        self.next_pacing = Some((settings.pacing, settings.period));
    }

    /// Between ticks, as it may change the clock that costs are read from.
    fn change_pacing(&mut self) {
        match self.next_pacing.take() {
            None => {}
            Some((Pacing::LockStep, _)) => self.timer.halt(),
            Some((Pacing::FreeRunning, period)) => {
                self.watchdog.start();
                self.timer.run(period);
            }
        }
    }
}

/// The controller's part of the settings.
pub fn configure(controller: &mut Controller<'static, f32, LEGS>, settings: &Settings) {
    let [position, velocity, orientation, angular_velocity] =
        settings.gains.map(|[x, y, z]| SymmetricMatrix3::diagonal(x, y, z));
    controller.gains = Gains { position, velocity, orientation, angular_velocity };
    controller.form = match settings.big_base {
        None => WorkspaceForm::FixedFoot,
        Some(factor) => WorkspaceForm::BigBase { factor },
    };
}

/// A pose to hold.
pub fn reference(pose: &SetPoint) -> Reference<f32> {
    Reference::at_rest(pose.position.into(), Quaternion::from_array(pose.orientation))
}
