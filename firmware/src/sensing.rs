//! From what sensors read to the state that the controller sees, and to what acts on the robot that its model does not
//! know: the state estimator and the observer of disturbances, each if the host has asked for it.
//!
//! ```text
//! readings ─► filter ─► state ─► observer ─► set point, wrench from outside
//!               ▲                  │ ▲
//!               └─ force of feet ──┘ └─ torques that were sent
//! ```

use crate::control::Measurement;
use crate::robot::{COORDINATES, FEET, MODEL, NODES, ON_FEET, ROW, ROWS, VELOCITIES};
use nalgebra::Vector3;
use surefoot::balance::{Reference, RobotState, WholeBody, WholeBodyState};
use surefoot::disturbance::{DisturbanceObserver, DisturbanceSettings};
use surefoot::estimate::{
    EstimateReport, Estimator, EstimatorState, FootKind, FootReading, ImuReading, Readings,
    StartPose, foot_poses,
};
use surefoot::spatial::Wrench;
use surefoot_link::{Acknowledged, Estimated, FilterSettings, ObserverSettings};

const _: () = assert!(ON_FEET.len() == FEET, "a foot on each leg");

/// What only a filter reads of a measurement.
pub struct Inertial {
    pub imu: ImuReading<f32>,
    /// Which feet's switches are closed.
    pub switches: [bool; FEET],
}

/// What is told in standby.
#[expect(clippy::large_enum_variant, reason = "there is no heap for the larger one")]
pub enum Told {
    Filter(Estimator<f32, FEET>, StartPose<f32>),
    Observer(Observer),
}

/// Both, as far as they are there.
pub struct Sensing {
    filter: Option<Filter>,
    observer: Option<Observer>,
    /// Of the last tick.
    estimated: Option<Estimated>,
}

struct Filter {
    settings: Estimator<f32, FEET>,
    start: StartPose<f32>,
    state: Option<EstimatorState<f32, FEET>>,
}

/// The observer, and what it is told between ticks.
pub struct Observer {
    robot: WholeBody<f32, FEET, VELOCITIES>,
    observer: DisturbanceObserver<f32, NODES, COORDINATES, VELOCITIES>,
    /// Those sent at the last tick, by velocity.
    torques: [f32; VELOCITIES],
    /// Where the central body was seen last.
    position: Option<Vector3<f32>>,
    /// Force of the ground on all feet, central body's axes, while all of them stand and have settled.
    support: Option<Vector3<f32>>,
}

impl Sensing {
    /// Neither.
    pub fn new() -> Self {
        Self { filter: None, observer: None, estimated: None }
    }

    /// One more. Apart, so that no tick has its stack.
    #[cold]
    #[inline(never)]
    pub fn tell(&mut self, told: Told) {
        match told {
            Told::Filter(settings, start) => {
                self.filter = Some(Filter { settings, start, state: None });
            }
            Told::Observer(observer) => self.observer = Some(observer),
        }
    }

    /// The state that a measurement tells of; none where the filter has a fault.
    pub fn read(&mut self, measured: &Measurement) -> Option<RobotState<f32, ROWS>> {
        let Some(inertial) = &measured.inertial else { return Some(measured.state) };
        let support = self.observer.as_ref().and_then(|observer| observer.support);
        let report = self.filter.as_mut()?.step(&measured.state, inertial, support)?;
        let seen =
            report.estimate.robot_state(measured.state.joint_angles, measured.state.joint_rates);
        let made_anew = report.innovations.iter().flatten().filter(|found| found.is_reset).count();
        let pose = seen.position.iter().copied().chain(seen.orientation.to_array());
        let mut central = [0.0; 13];
        let numbers = pose.chain(seen.velocity.to_array());
        central.iter_mut().zip(numbers).for_each(|(to, x)| *to = x);
        let worst = report.health.worst;
        self.estimated = Some(Estimated { central, made_anew: made_anew as u8, worst });
        Some(seen)
    }

    /// What the filter has made of the last tick.
    pub fn take_estimated(&mut self) -> Option<Estimated> {
        self.estimated.take()
    }

    /// The observer's look at a state, and where the robot is to be held then.
    #[inline(never)]
    pub fn look(
        &mut self,
        state: &RobotState<f32, ROWS>,
        contacts: &[bool; FEET],
        wanted: &Reference<f32>,
    ) -> Reference<f32> {
        let Some(observer) = &mut self.observer else { return *wanted };
        observer.look(state, contacts);
        let Some(seen) = observer.position else { return *wanted };
        let position = observer.observer.balance.reference(seen, wanted.position);
        Reference { position, ..*wanted }
    }

    /// The wrench from outside on the central body, world axes; none without an observer.
    pub fn external(&self) -> Option<Wrench<f32>> {
        self.observer.as_ref().map(|observer| observer.observer.wrench.wrench)
    }

    /// The torques that are sent until the next tick.
    pub fn sent(&mut self, torques: &[[f32; ROW]; ROWS]) {
        if let Some(observer) = &mut self.observer {
            let places = observer.torques.iter_mut().skip(6);
            places.zip(torques.as_flattened()).for_each(|(to, torque)| *to = *torque);
        }
    }
}

impl Filter {
    #[inline(never)]
    fn step(
        &mut self,
        joints: &RobotState<f32, ROWS>,
        inertial: &Inertial,
        feet_force: Option<Vector3<f32>>,
    ) -> Option<EstimateReport<f32, FEET>> {
        let positions = WholeBodyState::<_, COORDINATES, VELOCITIES>::of_rows(joints).positions;
        let poses = foot_poses(&MODEL, &ON_FEET, &positions);
        let reading = |pose: surefoot::estimate::FootPose<f32>| FootReading {
            position: pose.position,
            orientation: pose.orientation,
            is_pressed: false,
            is_planned: true,
        };
        let mut feet = poses.map(reading);
        for (foot, is_closed) in feet.iter_mut().zip(&inertial.switches) {
            foot.is_pressed = *is_closed;
        }
        let readings = Readings { imu: inertial.imu, feet, feet_force };
        if self.state.is_none() {
            self.begin(&readings);
        }
        self.settings.step(self.state.as_mut()?, &readings).ok()
    }

    /// Apart, so that no tick but the first has its stack.
    #[cold]
    #[inline(never)]
    fn begin(&mut self, readings: &Readings<f32, FEET>) {
        self.state = EstimatorState::start(&self.settings, readings, &self.start).ok();
    }
}

impl Observer {
    fn look(&mut self, state: &RobotState<f32, ROWS>, contacts: &[bool; FEET]) {
        let Self { robot, observer, torques, position, support } = self;
        let state = WholeBodyState::of_rows(state);
        let seen = observer.update(&MODEL, robot, &state, torques, contacts);
        let [x, y, z, ..] = state.positions;
        *position = seen.is_ok().then(|| Vector3::new(x, y, z));
        let stands = contacts.iter().all(|touches| *touches) && observer.has_settled();
        *support = seen.ok().flatten().filter(|_| stands).map(|seen| seen.support);
    }
}

/// A filter as a message says it.
#[inline(never)]
pub fn filter(message: &FilterSettings) -> Result<Told, Acknowledged> {
    let kinds = ON_FEET.map(|foot| foot.as_ref().map(FootKind::of));
    let settings = message.estimator(kinds).ok_or(Acknowledged::Invalid)?;
    settings.check().map_err(|fault| {
        defmt::warn!("the filter is refused: {}", defmt::Display2Format(&fault));
        Acknowledged::Invalid
    })?;
    Ok(Told::Filter(settings, message.start()))
}

/// An observer of a robot with ticks so many seconds apart.
#[inline(never)]
pub fn observer(message: &ObserverSettings, period: f32) -> Result<Told, Acknowledged> {
    let ObserverSettings { mass, gravity, height, nominal } = *message;
    let refused = |fault| {
        defmt::warn!("the observer is refused: {}", defmt::Display2Format(&fault));
        Acknowledged::Invalid
    };
    let settings = DisturbanceSettings::scaled(mass, gravity, height, period, nominal);
    let observer = settings.and_then(DisturbanceObserver::new).map_err(refused)?;
    let robot = WholeBody::new(&MODEL, &ON_FEET).map_err(|_| Acknowledged::Unsupported)?;
    let torques = [0.0; VELOCITIES];
    Ok(Told::Observer(Observer { robot, observer, torques, position: None, support: None }))
}
