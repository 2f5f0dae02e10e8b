//! Controllers on the host.

use super::approximate::{ApproximateController, Approximation};
use super::disturbance::{Observe, observer};
use super::filter::{FilterPlace, Filtered, SensorReadings};
use super::firmware::LinkError;
use super::friction::Friction;
use super::gait::GaitTally;
use super::limiting::{LimitTally, Limiting};
use super::supervised::SupervisedController;
use super::walking::{WalkingHost, walking_limits};
use super::whole_body::{SupervisedWholeBody, WholeBodyHost};
use crate::plant::PlantState;
use crate::record::SupervisorMemory;
use crate::robot::{LEG, MOST_LEGS, SharedRobot, by_leg, with_tree};
use crate::scene::{Scene, Workspace};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use surefoot::Real;
use surefoot::balance::{
    self, Fault, Gains, LeggedRobot, Reference, RobotState, StopReason, WorkspaceForm, tick,
};
use surefoot::estimate::StartPose;
use surefoot::model::Tree;
use surefoot::spatial::{Quaternion, SymmetricMatrix3, Twist, Wrench};

/// Precision of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Scalar {
    /// As on the target.
    F32,
    /// Double precision.
    F64,
}

impl Scalar {
    /// Of numbers of this type.
    pub fn of<T: Real>() -> Self {
        if T::default_epsilon().to_f64() > 1e-10 { Self::F32 } else { Self::F64 }
    }
}

/// A tick's answer, in f64 whatever the controller computes in.
#[derive(Clone, Debug, PartialEq)]
pub struct Commanded {
    /// N·m, one a joint in the robot's order.
    pub torques: Vec<f64>,
    /// N, N·m, in the frame of the central body.
    pub desired_wrench: [f64; 6],
}

/// Anything that turns a measured state into torques.
pub trait Controller {
    /// One tick.
    ///
    /// # Errors
    /// Why there are no torques.
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure>;

    /// Where the state that it sees is estimated, if that is estimated.
    fn filter_place(&self) -> FilterPlace {
        FilterPlace::Host(Scalar::F64)
    }

    /// Tells it before a tick what sensors read, and where the robot was at the first, if it estimates the state itself.
    fn sense(&mut self, readings: &SensorReadings, start: &StartPose<f64>) {
        let _ = (readings, start);
    }

    /// A tick whose torques nobody wants yet.
    ///
    /// # Errors
    /// The link's.
    fn wait(&mut self, state: &PlantState) -> Result<(), ControlFailure> {
        let _ = state;
        Ok(())
    }

    /// What it has made of the last tick's readings, if it estimates the state itself.
    fn filtered(&self) -> Option<Filtered> {
        None
    }

    /// Why its supervisor has stopped the robot, if it has: its torques brake from then on.
    fn stopped(&self) -> Option<StopReason> {
        None
    }

    /// Has its supervisor, if it has one on this side, stop the robot.
    fn stop(&mut self, reason: StopReason) {
        let _ = reason;
    }

    /// What its supervisor remembers of earlier ticks, if it has one on this side.
    fn memory(&self) -> Option<SupervisorMemory> {
        None
    }

    /// Goes on with what a supervisor remembered; `false` if it has none.
    fn remember(&mut self, memory: &SupervisorMemory) -> bool {
        let _ = memory;
        false
    }

    /// Tells it before a tick which feet touch the ground, and the time, s.
    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        let _ = (time_s, feet);
    }

    /// Tells it before a tick the time (s) and how the ground presses on each foot, N.
    fn press(&mut self, time_s: f64, normal_forces: &[f64]) {
        let _ = (time_s, normal_forces);
    }

    /// Which feet its plan has on the ground until its next tick, if it has a plan.
    fn planned(&self) -> Option<[bool; MOST_LEGS]> {
        None
    }

    /// What it has walked so far, if it walks.
    fn gait(&self) -> Option<GaitTally> {
        None
    }

    /// What limits of ground and motors have done so far, if it knows any.
    fn limits(&self) -> Option<LimitTally> {
        None
    }

    /// The limits that bound at the last tick, by row and multiplier, from which the next begins.
    fn limit_rows(&self) -> Vec<(u8, f64)> {
        Vec::new()
    }

    /// Goes on with those of another one.
    fn resume_limits(&mut self, rows: &[(u8, f64)]) {
        let _ = rows;
    }

    /// Sum of the ground's forces on the feet as its observer of disturbances reads them, in the central body's axes,
    /// N: of a robot that stands on all of them, after the last tick.
    fn support(&self) -> Option<[f64; 3]> {
        None
    }

    /// What its observer of disturbances remembers of earlier ticks; nothing where it has none.
    fn observed(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Goes on with that; `false` if it is of another observer.
    fn resume_observed(&mut self, memory: &[f64]) -> bool {
        memory.is_empty()
    }

    /// What its ticks have cost so far, if it runs on a target that counts.
    fn costs(&self) -> Option<Costs> {
        None
    }
}

/// Costs of ticks on a target, from measurement to torques.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Costs {
    /// `instructions` or `cycles`.
    pub unit: &'static str,
    /// Cost of a second.
    pub per_second: u32,
    /// Of the quickest tick.
    pub min: u32,
    /// Of all ticks.
    pub mean: f64,
    /// Of the slowest tick.
    pub max: u32,
}

/// Why a controller gave no torques.
#[derive(Debug, thiserror::Error)]
pub enum ControlFailure {
    /// The tick's fault.
    #[error("{0}")]
    Fault(Fault),
    /// The link to the target.
    #[error("{0}")]
    Link(#[from] LinkError),
}

/// What to try where the controller has a fault.
pub(super) const FAULT_ADVICE: &str =
    "start with bent knees, and keep the set point within the legs' reach";

impl ControlFailure {
    /// A word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Fault(_) => "controller-fault",
            Self::Link(_) => "link",
        }
    }

    /// What to try.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::Fault(_) => FAULT_ADVICE,
            Self::Link(_) => "check the cable and the firmware's version, or the emulator's output",
        }
    }
}

/// The core's controller, run on the host in precision `T`.
pub struct HostController<T, const LEGS: usize> {
    robot: LeggedRobot<T, LEGS>,
    gains: Gains<T>,
    form: WorkspaceForm<T>,
    pub(super) reference: Reference<T>,
    limiting: Option<Limiting<T, LEGS>>,
    observer: Option<Box<dyn Observe<T>>>,
    friction: Option<Friction<T>>,
}

/// The controller of a scene, under its supervisor: what runs on the target.
pub fn controller(scene: &Scene, scalar: Scalar) -> Box<dyn Controller> {
    if !scene.walk.is_empty() {
        return walking(scene, scalar, true);
    }
    let robot = scene.robot();
    with_tree!(&robot.tree, tree, LEGS => {
        let (model, limits) = (legged::<_, _, _, LEGS>(tree), limits::<LEGS>(&robot));
        match scalar {
            Scalar::F32 => Box::new(SupervisedController::new(
                HostController::new(model.to_f32(), scene).under(observer(tree.to_f32(), scene)),
                limits.to_f32(),
                scene,
            )),
            Scalar::F64 => Box::new(SupervisedController::new(
                HostController::new(model, scene).under(observer(*tree, scene)),
                limits,
                scene,
            )),
        }
    }, tree, ROWS => {
        let limits = robot.limits.in_rows::<ROWS>().expect("a robot has limits for its joints");
        match scalar {
            Scalar::F32 => Box::new(SupervisedWholeBody::new(
                WholeBodyHost::new(tree.to_f32(), scene),
                limits.to_f32(),
                scene,
            )),
            Scalar::F64 => {
                Box::new(SupervisedWholeBody::new(WholeBodyHost::new(*tree, scene), limits, scene))
            }
        }
    })
}

/// The same without a supervisor.
pub fn bare_controller(scene: &Scene, scalar: Scalar) -> Box<dyn Controller> {
    if !scene.walk.is_empty() {
        return walking(scene, scalar, false);
    }
    let robot = scene.robot();
    with_tree!(&robot.tree, tree, LEGS => {
        let model = legged::<_, _, _, LEGS>(tree);
        match scalar {
            Scalar::F32 => Box::new(
                HostController::new(model.to_f32(), scene).under(observer(tree.to_f32(), scene)),
            ),
            Scalar::F64 => {
                Box::new(HostController::new(model, scene).under(observer(*tree, scene)))
            }
        }
    }, tree, _ROWS => match scalar {
        Scalar::F32 => Box::new(WholeBodyHost::new(tree.to_f32(), scene)),
        Scalar::F64 => Box::new(WholeBodyHost::new(*tree, scene)),
    })
}

/// The controller of a scene with commands to walk.
fn walking(scene: &Scene, scalar: Scalar, is_supervised: bool) -> Box<dyn Controller> {
    fn boxed<T: Real, const N: usize, const NQ: usize, const NV: usize, const ROWS: usize>(
        tree: Tree<T, N, NQ, NV>,
        limits: Option<balance::SafetyLimits<T, ROWS>>,
        scene: &Scene,
    ) -> Box<dyn Controller> {
        Box::new(WalkingHost::<T, N, NQ, NV, ROWS>::new(tree, limits, scene))
    }
    let robot = scene.robot();
    macro_rules! of_rows {
        ($tree:expr, $rows:ident) => {{
            let limits = walking_limits(&robot.limits).in_rows::<$rows>();
            let limits = limits.filter(|_| is_supervised);
            match scalar {
                Scalar::F32 => {
                    boxed::<f32, _, _, _, $rows>($tree.to_f32(), limits.map(|x| x.to_f32()), scene)
                }
                Scalar::F64 => boxed::<f64, _, _, _, $rows>(*$tree, limits, scene),
            }
        }};
    }
    with_tree!(&robot.tree, tree, ROWS => of_rows!(tree, ROWS), tree, ROWS => of_rows!(tree, ROWS))
}

/// The same with something left out; feet are held exactly, whatever the scene says.
///
/// # Panics
/// For a robot with other joints than those of legs of six.
pub fn approximate_controller(
    scene: &Scene,
    scalar: Scalar,
    approximation: Approximation,
) -> Box<dyn Controller> {
    let robot = scene.robot();
    with_tree!(&robot.tree, tree, LEGS => {
        let model = legged::<_, _, _, LEGS>(tree);
        match scalar {
            Scalar::F32 => Box::new(ApproximateController::new(
                HostController::new(model.to_f32(), scene),
                approximation,
            )),
            Scalar::F64 => Box::new(ApproximateController::new(
                HostController::new(model, scene),
                approximation,
            )),
        }
    }, _tree, _ROWS => panic!("{approximation:?} is of robots on legs of six joints"))
}

/// The controller's model of a scene's robot.
fn legged<const N: usize, const NQ: usize, const NV: usize, const LEGS: usize>(
    tree: &Tree<f64, N, NQ, NV>,
) -> LeggedRobot<f64, LEGS> {
    // A robot is made of such a tree only.
    LeggedRobot::new(tree)
}

fn limits<const LEGS: usize>(robot: &SharedRobot) -> balance::SafetyLimits<f64, LEGS> {
    robot.limits.sized().expect("a robot has limits for each of its joints")
}

impl<T: Real, const LEGS: usize> HostController<T, LEGS> {
    /// With a scene's gains, form and set point.
    pub fn new(robot: LeggedRobot<T, LEGS>, scene: &Scene) -> Self {
        let diagonal =
            |[x, y, z]: [f64; 3]| SymmetricMatrix3::diagonal(T::of(x), T::of(y), T::of(z));
        let settings = &scene.controller;
        let limiting = Limiting::of(scene, &robot);
        Self {
            robot,
            limiting,
            observer: None,
            friction: Friction::of(scene),
            gains: Gains {
                position: diagonal(settings.position_gain),
                velocity: diagonal(settings.velocity_gain),
                orientation: diagonal(settings.orientation_gain),
                angular_velocity: diagonal(settings.angular_velocity_gain),
            },
            form: match settings.workspace {
                Workspace::FixedFoot => WorkspaceForm::FixedFoot,
                Workspace::BigBase(factor) => WorkspaceForm::BigBase { factor: T::of(factor) },
            },
            reference: Reference::at_rest(
                Vector3::from(scene.set_point.position_m.map(T::of)),
                Quaternion::from_array(scene.set_point.orientation.map(T::of)),
            ),
        }
    }

    /// With an observer of disturbances.
    fn under(self, observer: Option<Box<dyn Observe<T>>>) -> Self {
        Self { observer, ..self }
    }

    /// Another tick's state, as the observer takes it.
    pub(super) fn look(&mut self, state: &PlantState) {
        if let Some(observer) = &mut self.observer {
            observer.look(state);
        }
    }

    /// The torques that are sent.
    pub(super) fn sent(&mut self, torques: &[[T; LEG]; LEGS]) {
        if let Some(observer) = &mut self.observer {
            observer.sent(torques.as_flattened());
        }
    }

    /// Where the robot is held.
    pub(super) fn reference(&self) -> Reference<T> {
        self.observer.as_ref().map_or(self.reference, |own| own.reference(&self.reference))
    }

    /// As the core takes it.
    pub(super) fn core(&self) -> balance::Controller<'_, T, LEGS> {
        core(&self.robot, self.gains, self.form)
    }

    /// One tick, within limits if the scene has them.
    pub(super) fn command(
        &mut self,
        state: &RobotState<T, LEGS>,
    ) -> Result<balance::Command<T, LEGS>, Fault> {
        let controller = core(&self.robot, self.gains, self.form);
        let reference = self.reference();
        let external = self.observer.as_ref().map(|observer| observer.wrench());
        let mut command = match &mut self.limiting {
            None => tick(&controller, state, &reference)?,
            Some(limiting) => limiting.tick(&controller, state, &reference, external)?,
        };
        if let Some(friction) = &self.friction {
            let rates = state.joint_rates.as_flattened();
            friction.add(command.joint_torques.as_flattened_mut(), rates, None);
        }
        Ok(command)
    }
}

fn core<T: Real, const LEGS: usize>(
    robot: &LeggedRobot<T, LEGS>,
    gains: Gains<T>,
    form: WorkspaceForm<T>,
) -> balance::Controller<'_, T, LEGS> {
    let mut controller = balance::Controller::new(robot);
    controller.gains = gains;
    controller.form = form;
    controller
}

/// A measured state in precision `T`, as the core takes it.
///
/// # Panics
/// For a state of fewer joints than the legs have.
pub fn measured<T: Real, const LEGS: usize>(state: &PlantState) -> RobotState<T, LEGS> {
    let p: [T; 7] = std::array::from_fn(|i| T::of(state.positions[i]));
    let v: [T; 6] = std::array::from_fn(|i| T::of(state.velocities[i]));
    RobotState {
        position: Vector3::new(p[0], p[1], p[2]),
        orientation: Quaternion::from_array([p[3], p[4], p[5], p[6]]),
        velocity: Twist::from_array(v),
        joint_angles: by_leg(&state.positions[7..]).map(|leg| leg.map(T::of)),
        joint_rates: by_leg(&state.velocities[6..]).map(|leg| leg.map(T::of)),
    }
}

impl<T: Real, const LEGS: usize> Controller for HostController<T, LEGS> {
    fn filter_place(&self) -> FilterPlace {
        FilterPlace::Host(Scalar::of::<T>())
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        self.look(state);
        let command = self.command(&measured(state)).map_err(ControlFailure::Fault)?;
        self.sent(&command.joint_torques);
        Ok(commanded(command.joint_torques, command.desired_wrench))
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        if let Some(observer) = &mut self.observer {
            observer.touch(feet);
        }
        if let Some(limiting) = &mut self.limiting {
            limiting.touch(time_s, feet);
        }
    }

    fn limits(&self) -> Option<LimitTally> {
        self.limiting.as_ref().map(Limiting::tally)
    }

    fn limit_rows(&self) -> Vec<(u8, f64)> {
        self.limiting.as_ref().map_or_else(Vec::new, Limiting::rows)
    }

    fn resume_limits(&mut self, rows: &[(u8, f64)]) {
        if let Some(limiting) = &mut self.limiting {
            limiting.resume(rows);
        }
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

/// A tick's answer from precision `T`.
pub(super) fn commanded<T: Real, const LEGS: usize>(
    torques: [[T; 6]; LEGS],
    desired_wrench: Wrench<T>,
) -> Commanded {
    Commanded {
        torques: torques.as_flattened().iter().map(|torque| torque.to_f64()).collect(),
        desired_wrench: desired_wrench.to_array().map(Real::to_f64),
    }
}
