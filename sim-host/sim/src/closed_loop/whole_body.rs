//! The whole-body controller on the host: of robots whose legs have not six joints each, or that move other limbs.

use super::controller::{Commanded, ControlFailure, Controller, Scalar, measured};
use super::disturbance::{Observe, observer};
use super::filter::FilterPlace;
use super::friction::Friction;
use super::limiting::LimitTally;
use super::supervised::{of_state, recorded, remembered};
use super::whole_body_settings::{FEET, Standing};
use crate::plant::PlantState;
use crate::record;
use crate::robot::{LEG, SharedRobot};
use crate::scene::Scene;
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{
    Fault, Gains, Reference, RobotState, SafetyLimits, StopReason, Supervisor, WholeBody,
    WholeBodyCommand, WholeBodyController, WholeBodyMemory, WholeBodyReport, WholeBodySettings,
    WholeBodyState, whole_body_tick_under,
};
use surefoot::model::Tree;
use surefoot::spatial::{Quaternion, SymmetricMatrix3, Wrench};
use surefoot_link::TickLimits;

/// The controller in precision `T`.
pub(super) struct WholeBodyHost<T, const N: usize, const NQ: usize, const NV: usize> {
    pub(super) robot: SharedRobot,
    pub(super) tree: Tree<T, N, NQ, NV>,
    pub(super) model: WholeBody<T, FEET, NV>,
    pub(super) settings: WholeBodySettings<T, NV>,
    reference: Reference<T>,
    pub(super) memory: WholeBodyMemory<T>,
    contacts: [bool; FEET],
    pub(super) time_s: f64,
    pub(super) tally: LimitTally,
    pub(super) observer: Option<Box<dyn Observe<T>>>,
    pub(super) friction: Option<Friction<T>>,
}

/// The same with its supervisor, which takes joints in rows of six.
pub(super) struct SupervisedWholeBody<
    T,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const ROWS: usize,
> {
    inner: WholeBodyHost<T, N, NQ, NV>,
    supervisor: Supervisor<T, ROWS>,
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> WholeBodyHost<T, N, NQ, NV> {
    /// With a scene's gains and set point, its start as the posture, and what its floor and motors can give.
    ///
    /// # Panics
    /// For a scene that is not checked.
    pub fn new(tree: Tree<T, N, NQ, NV>, scene: &Scene) -> Self {
        let (robot, standing) = (scene.robot(), Standing::of(scene));
        let mut settings = standing.settings::<T, NV>();
        let diagonal =
            |[x, y, z]: [f64; 3]| SymmetricMatrix3::diagonal(T::of(x), T::of(y), T::of(z));
        let controller = &scene.controller;
        settings.gains = Gains {
            position: diagonal(controller.position_gain),
            velocity: diagonal(controller.velocity_gain),
            orientation: diagonal(controller.orientation_gain),
            angular_velocity: diagonal(controller.angular_velocity_gain),
        };
        let feet = standing.feet(&robot);
        let model = WholeBody::new(&tree, &feet).expect("a robot with feet on legs");
        Self {
            model,
            settings,
            reference: Reference::at_rest(
                Vector3::from(scene.set_point.position_m.map(T::of)),
                Quaternion::from_array(scene.set_point.orientation.map(T::of)),
            ),
            observer: observer(tree, scene),
            friction: Friction::of(scene),
            robot,
            tree,
            memory: WholeBodyMemory::new(),
            contacts: [true; FEET],
            time_s: 0.0,
            tally: LimitTally::default(),
        }
    }

    fn command(
        &mut self,
        state: &WholeBodyState<T, NQ, NV>,
    ) -> Result<WholeBodyCommand<T, FEET, NV>, Fault> {
        let reference = self.reference();
        let external = self.observer.as_ref().map(|observer| observer.wrench());
        let Self { tree, model, settings, memory, contacts, .. } = self;
        let controller = WholeBodyController { tree, robot: model, settings };
        let around = (&*contacts, external);
        let mut command = whole_body_tick_under(&controller, state, &reference, around, memory)?;
        if let Some(friction) = &self.friction {
            let wanted = Some(&command.accelerations[6..]);
            friction.add(&mut command.torques[6..], &state.velocities[6..], wanted);
        }
        self.count(&command.limits);
        Ok(command)
    }

    /// What limits did in a tick.
    pub(super) fn count(&mut self, report: &WholeBodyReport<T, FEET>) {
        self.tally.count_tick(&self.robot, self.time_s, &TickLimits::from(report));
        self.tally.last.work = Some(report.work);
    }

    /// Another tick's state, as the observer takes it.
    pub(super) fn look(&mut self, state: &PlantState) {
        if let Some(observer) = &mut self.observer {
            observer.look(state);
        }
    }

    /// The torques that are sent.
    pub(super) fn sent(&mut self, torques: &[T]) {
        if let Some(observer) = &mut self.observer {
            observer.sent(torques);
        }
    }

    /// Where the robot is held.
    fn reference(&self) -> Reference<T> {
        self.observer.as_ref().map_or(self.reference, |own| own.reference(&self.reference))
    }

    /// The torques of the robot's own joints.
    pub(super) fn commanded(&self, torques: &[T], desired_wrench: Wrench<T>) -> Commanded {
        let own = torques.iter().take(self.robot.joint_count());
        Commanded {
            torques: own.map(|torque| torque.to_f64()).collect(),
            desired_wrench: desired_wrench.to_array().map(Real::to_f64),
        }
    }
}

/// A plant's state in the tree's size.
pub(super) fn padded<const M: usize, T: Real>(numbers: &[f64]) -> [T; M] {
    std::array::from_fn(|i| T::of(numbers.get(i).copied().unwrap_or(0.0)))
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Controller
    for WholeBodyHost<T, N, NQ, NV>
{
    fn filter_place(&self) -> FilterPlace {
        FilterPlace::Host(Scalar::of::<T>())
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        self.look(state);
        let state = WholeBodyState {
            positions: padded(&state.positions),
            velocities: padded(&state.velocities),
        };
        let command = self.command(&state).map_err(ControlFailure::Fault)?;
        self.sent(&command.torques[6..]);
        Ok(self.commanded(&command.torques[6..], command.desired_wrench))
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        self.time_s = time_s;
        if let Some(observer) = &mut self.observer {
            observer.touch(feet);
        }
        for (to, touches) in self.contacts.iter_mut().zip(feet) {
            *to = *touches;
        }
    }

    fn limits(&self) -> Option<LimitTally> {
        Some(self.tally.clone())
    }

    fn limit_rows(&self) -> Vec<(u8, f64)> {
        self.memory.rows().map(|(row, multiplier)| (row, multiplier.to_f64())).collect()
    }

    fn resume_limits(&mut self, rows: &[(u8, f64)]) {
        let rows = rows.iter().map(|(row, multiplier)| (*row, T::of(*multiplier)));
        self.memory = WholeBodyMemory::of(rows);
    }

    fn support(&self) -> Option<[f64; 3]> {
        self.observer.as_ref()?.support()
    }

    fn observed(&self) -> Vec<f64> {
        self.observer.as_ref().map_or_else(Vec::new, |observer| observer.memory())
    }

    fn resume_observed(&mut self, memory: &[f64]) -> bool {
        memory.is_empty() || self.observer.as_mut().is_some_and(|own| own.resume(memory))
    }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize, const ROWS: usize>
    SupervisedWholeBody<T, N, NQ, NV, ROWS>
{
    /// Armed.
    ///
    /// # Panics
    /// For a scene that is not checked.
    pub fn new(
        inner: WholeBodyHost<T, N, NQ, NV>,
        limits: SafetyLimits<T, ROWS>,
        scene: &Scene,
    ) -> Self {
        let period = T::of(1.0 / scene.controller.rate_hz);
        let mut supervisor = Supervisor::new(of_state(limits, scene), period)
            .expect("limits of the robot, period of a checked scene");
        supervisor.arm();
        Self { inner, supervisor }
    }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize, const ROWS: usize> Controller
    for SupervisedWholeBody<T, N, NQ, NV, ROWS>
{
    fn filter_place(&self) -> FilterPlace {
        FilterPlace::Host(Scalar::of::<T>())
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let Self { inner, supervisor } = self;
        inner.look(state);
        let mut in_rows = state.clone();
        in_rows.positions.resize(7 + ROWS * LEG, 0.0);
        in_rows.velocities.resize(6 + ROWS * LEG, 0.0);
        let reference = inner.reference();
        let tick = |now: &RobotState<T, ROWS>| {
            let command = inner.command(&WholeBodyState::of_rows(now))?;
            Ok(command.in_rows())
        };
        let answer = supervisor.step_with(Some(&measured(&in_rows)), &reference, false, tick);
        self.inner.sent(answer.joint_torques.as_flattened());
        let wrench = answer.command.map_or_else(Wrench::zero, |command| command.desired_wrench);
        Ok(self.inner.commanded(answer.joint_torques.as_flattened(), wrench))
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        self.inner.touch(time_s, feet);
    }

    fn limits(&self) -> Option<LimitTally> {
        self.inner.limits()
    }

    fn limit_rows(&self) -> Vec<(u8, f64)> {
        self.inner.limit_rows()
    }

    fn resume_limits(&mut self, rows: &[(u8, f64)]) {
        self.inner.resume_limits(rows);
    }

    fn support(&self) -> Option<[f64; 3]> {
        self.inner.support()
    }

    fn observed(&self) -> Vec<f64> {
        self.inner.observed()
    }

    fn resume_observed(&mut self, memory: &[f64]) -> bool {
        self.inner.resume_observed(memory)
    }

    fn stop(&mut self, reason: StopReason) {
        self.supervisor.stop(reason);
    }

    fn stopped(&self) -> Option<StopReason> {
        self.supervisor.reason()
    }

    fn memory(&self) -> Option<record::SupervisorMemory> {
        Some(recorded(self.supervisor.memory()))
    }

    fn remember(&mut self, memory: &record::SupervisorMemory) -> bool {
        let memory = remembered(memory);
        memory.is_some_and(|memory| {
            self.supervisor.remember(memory);
            true
        })
    }
}
