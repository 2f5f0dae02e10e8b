//! The whole-body controller on the host: of robots whose legs have not six joints each, or that move other limbs.

use super::controller::{Commanded, ControlFailure, Controller, measured};
use super::disturbance::{Observe, observer};
use super::friction::Friction;
use super::limiting::{
    FRICTION_SHARE, LimitTally, MOST_WEIGHTS, SOLE_SHARE, WorstLimit, friction, named,
};
use super::supervised::{of_state, recorded, remembered};
use crate::plant::PlantState;
use crate::record;
use crate::robot::{Contacts, LEG, SharedRobot, stance};
use crate::scene::{Feet, Scene};
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{
    Command, Fault, Gains, Reference, RobotState, SafetyLimits, StopReason, Supervisor, WholeBody,
    WholeBodyCommand, WholeBodyController, WholeBodyFoot, WholeBodyLimit, WholeBodyMemory,
    WholeBodySettings, WholeBodyState, whole_body_tick_under,
};
use surefoot::model::Tree;
use surefoot::qp::Status;
use surefoot::spatial::{Quaternion, SymmetricMatrix3, Wrench};

/// Feet that core has room for.
const FEET: usize = 4;
/// A foot that stands is pressed on with this share of the robot's weight.
const LEAST_SHARE: f64 = 0.007;

/// The controller in precision `T`.
pub(super) struct WholeBodyHost<T, const N: usize, const NQ: usize, const NV: usize> {
    robot: SharedRobot,
    tree: Tree<T, N, NQ, NV>,
    model: WholeBody<T, FEET, NV>,
    settings: WholeBodySettings<T, NV>,
    reference: Reference<T>,
    memory: WholeBodyMemory<T>,
    contacts: [bool; FEET],
    time_s: f64,
    tally: LimitTally,
    observer: Option<Box<dyn Observe<T>>>,
    friction: Option<Friction<T>>,
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
        let robot = scene.robot().clone();
        let start = scene.initial.state();
        let height =
            stance::on_floor(&robot, &start.positions[7..], Quaternion::identity()).positions[2];
        let gravity = robot.tree.gravity().norm();
        let mut settings = WholeBodySettings::<T, NV>::scaled(T::of(height), T::of(gravity), FEET);
        let diagonal =
            |[x, y, z]: [f64; 3]| SymmetricMatrix3::diagonal(T::of(x), T::of(y), T::of(z));
        let controller = &scene.controller;
        settings.gains = Gains {
            position: diagonal(controller.position_gain),
            velocity: diagonal(controller.velocity_gain),
            orientation: diagonal(controller.orientation_gain),
            angular_velocity: diagonal(controller.angular_velocity_gain),
        };
        for (joint, (angle, limits)) in
            start.positions[7..].iter().zip(&robot.limits.joints).enumerate()
        {
            settings.posture[6 + joint] = T::of(*angle);
            settings.torques[6 + joint] = T::of(limits.torque);
        }
        let contacts = Contacts::of(&robot).expect("a robot with feet on legs");
        let weight = robot.tree.mass() * gravity;
        let friction = match &scene.feet {
            Feet::Floor { floor, .. } => friction(floor),
            Feet::Welded {} => 1.0,
        };
        let feet = contacts.feet.map(|foot| foot.map(|foot| grounded(&foot, weight, friction)));
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
        let report = &command.limits;
        let is_unfinished = matches!(report.status, Status::BudgetSpent | Status::TooManyRows);
        self.tally.count(report.is_limited(), is_unfinished);
        if let Some((limit, relief)) = report.worst {
            let relief = relief.to_f64();
            let time_s = self.time_s;
            let (limit, leg, joint) = match limit {
                WholeBodyLimit::Foot { foot, limit } => {
                    let (limit, joint) = named(limit);
                    (limit, self.robot.legs.get(foot), joint)
                }
                WholeBodyLimit::Torque { velocity } => {
                    ("torque", self.robot.joints.get(velocity - 6), None)
                }
            };
            let leg = leg.cloned().unwrap_or_default();
            self.tally.bound(WorstLimit { limit, leg, joint, time_s, relief });
        }
        Ok(command)
    }

    /// Another tick's state, as the observer takes it.
    fn look(&mut self, state: &PlantState) {
        if let Some(observer) = &mut self.observer {
            observer.look(state);
        }
    }

    /// The torques that are sent.
    fn sent(&mut self, torques: &[T]) {
        if let Some(observer) = &mut self.observer {
            observer.sent(torques);
        }
    }

    /// Where the robot is held.
    fn reference(&self) -> Reference<T> {
        self.observer.as_ref().map_or(self.reference, |own| own.reference(&self.reference))
    }

    /// The torques of the robot's own joints.
    fn commanded(&self, torques: &[T], desired_wrench: Wrench<T>) -> Commanded {
        let own = torques.iter().take(self.robot.joint_count());
        Commanded {
            torques: own.map(|torque| torque.to_f64()).collect(),
            desired_wrench: desired_wrench.to_array().map(Real::to_f64),
        }
    }
}

/// A foot with what a scene's floor can be counted on to give it.
fn grounded<T: Real>(foot: &WholeBodyFoot<f64>, weight: f64, friction: f64) -> WholeBodyFoot<T> {
    let limits = &foot.limits;
    WholeBodyFoot {
        body: foot.body,
        reference: foot.reference.map(T::of),
        axes: Quaternion::from_array(foot.axes.to_array().map(T::of)),
        limits: surefoot::balance::ContactLimits {
            least_force: T::of(LEAST_SHARE * weight),
            greatest_force: T::of(MOST_WEIGHTS * weight),
            friction: T::of(FRICTION_SHARE * friction),
            patch: limits.patch.shrunk(SOLE_SHARE).rounded(),
            torques: [],
        },
    }
}

/// A plant's state in the tree's size.
fn padded<const M: usize, T: Real>(numbers: &[f64]) -> [T; M] {
    std::array::from_fn(|i| T::of(numbers.get(i).copied().unwrap_or(0.0)))
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Controller
    for WholeBodyHost<T, N, NQ, NV>
{
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

/// The tree's state of joints in rows of six.
fn of_rows<T: Real, const NQ: usize, const NV: usize, const ROWS: usize>(
    state: &RobotState<T, ROWS>,
) -> WholeBodyState<T, NQ, NV> {
    let pose = state.position.iter().copied().chain(state.orientation.to_array());
    let angles = state.joint_angles.as_flattened().iter().copied();
    let rates = state.joint_rates.as_flattened().iter().copied();
    let (mut positions, mut velocities) = ([T::zero(); NQ], [T::zero(); NV]);
    positions.iter_mut().zip(pose.chain(angles)).for_each(|(to, x)| *to = x);
    let twist = state.velocity.to_array().into_iter();
    velocities.iter_mut().zip(twist.chain(rates)).for_each(|(to, x)| *to = x);
    WholeBodyState { positions, velocities }
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize, const ROWS: usize> Controller
    for SupervisedWholeBody<T, N, NQ, NV, ROWS>
{
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let Self { inner, supervisor } = self;
        inner.look(state);
        let mut in_rows = state.clone();
        in_rows.positions.resize(7 + ROWS * LEG, 0.0);
        in_rows.velocities.resize(6 + ROWS * LEG, 0.0);
        let reference = inner.reference();
        let tick = |now: &RobotState<T, ROWS>| {
            let command = inner.command(&of_rows(now))?;
            let mut joint_torques = [[T::zero(); LEG]; ROWS];
            let all = joint_torques.as_flattened_mut().iter_mut();
            all.zip(&command.torques[6..]).for_each(|(to, torque)| *to = *torque);
            Ok(Command {
                joint_torques,
                desired_wrench: command.desired_wrench,
                foot_wrenches: [Wrench::zero(); ROWS],
                position_error: command.position_error,
                orientation_error: command.orientation_error,
            })
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
