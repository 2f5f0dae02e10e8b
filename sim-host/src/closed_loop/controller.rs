//! Controllers on the host.

use super::approximate::{ApproximateController, Approximation};
use super::firmware::LinkError;
use crate::plant::PlantState;
use crate::scene::{Scene, Workspace};
use nalgebra::Vector3;
use serde::Serialize;
use surefoot::Real;
use surefoot::balance::{
    self, Fault, Gains, LeggedRobot, Reference, RobotState, StopReason, WorkspaceForm, tick,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, SymmetricMatrix3, Twist, Wrench};

static ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
static ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32();

/// Precision of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Scalar {
    /// As on the target.
    F32,
    /// Double precision.
    F64,
}

/// A tick's answer, in f64 whatever the controller computes in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Commanded {
    /// N·m, left leg then right, hip to foot.
    pub torques: [f64; 12],
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
    /// The target's supervisor has stopped the robot.
    #[error("the target has stopped: {0}")]
    Stopped(StopReason),
    /// The link to the target.
    #[error("{0}")]
    Link(#[from] LinkError),
}

impl ControlFailure {
    /// A word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Fault(_) => "controller-fault",
            Self::Stopped(_) => "target-stopped",
            Self::Link(_) => "link",
        }
    }

    /// What to try.
    pub fn advice(&self) -> &'static str {
        match self {
            Self::Fault(_) | Self::Stopped(StopReason::Tick(_)) => {
                "start with bent knees, and keep the set point within the legs' reach"
            }
            Self::Stopped(_) => "see the target's log; its limits are in its supervisor",
            Self::Link(_) => "check the cable and the firmware's version, or the emulator's output",
        }
    }
}

/// The core's controller, run on the host in precision `T`.
pub struct HostController<T: 'static> {
    pub(super) controller: balance::Controller<'static, T, 2>,
    pub(super) reference: Reference<T>,
}

/// The controller of a scene.
pub fn controller(scene: &Scene, scalar: Scalar) -> Box<dyn Controller> {
    match scalar {
        Scalar::F32 => Box::new(HostController::new(&ROBOT_F32, scene)),
        Scalar::F64 => Box::new(HostController::new(&ROBOT, scene)),
    }
}

/// The same with something left out; feet are held exactly, whatever the scene says.
pub fn approximate_controller(
    scene: &Scene,
    scalar: Scalar,
    approximation: Approximation,
) -> Box<dyn Controller> {
    match scalar {
        Scalar::F32 => Box::new(ApproximateController::new(
            HostController::new(&ROBOT_F32, scene),
            approximation,
        )),
        Scalar::F64 => {
            Box::new(ApproximateController::new(HostController::new(&ROBOT, scene), approximation))
        }
    }
}

impl<T: Real> HostController<T> {
    /// With a scene's gains, form and set point.
    pub fn new(robot: &'static LeggedRobot<T, 2>, scene: &Scene) -> Self {
        let diagonal =
            |[x, y, z]: [f64; 3]| SymmetricMatrix3::diagonal(T::of(x), T::of(y), T::of(z));
        let settings = &scene.controller;
        let mut controller = balance::Controller::new(robot);
        controller.gains = Gains {
            position: diagonal(settings.position_gain),
            velocity: diagonal(settings.velocity_gain),
            orientation: diagonal(settings.orientation_gain),
            angular_velocity: diagonal(settings.angular_velocity_gain),
        };
        controller.form = match settings.workspace {
            Workspace::FixedFoot => WorkspaceForm::FixedFoot,
            Workspace::BigBase(factor) => WorkspaceForm::BigBase { factor: T::of(factor) },
        };
        let reference = Reference::at_rest(
            Vector3::from(scene.set_point.position_m.map(T::of)),
            Quaternion::from_array(scene.set_point.orientation.map(T::of)),
        );
        Self { controller, reference }
    }
}

/// A measured state in precision `T`, as the core takes it.
pub fn measured<T: Real>(state: &PlantState) -> RobotState<T, 2> {
    let p: [T; 19] = state.positions.map(T::of);
    let v: [T; 18] = state.velocities.map(T::of);
    let leg = |all: &[T], leg: usize| std::array::from_fn(|i| all[6 * leg + i]);
    RobotState {
        position: Vector3::new(p[0], p[1], p[2]),
        orientation: Quaternion::from_array([p[3], p[4], p[5], p[6]]),
        velocity: Twist::from_array([v[0], v[1], v[2], v[3], v[4], v[5]]),
        joint_angles: [leg(&p[7..], 0), leg(&p[7..], 1)],
        joint_rates: [leg(&v[6..], 0), leg(&v[6..], 1)],
    }
}

impl<T: Real> Controller for HostController<T> {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let command = tick(&self.controller, &measured(state), &self.reference)
            .map_err(ControlFailure::Fault)?;
        Ok(commanded(command.joint_torques, command.desired_wrench))
    }
}

/// A tick's answer from precision `T`.
pub(super) fn commanded<T: Real>(
    [left, right]: [[T; 6]; 2],
    desired_wrench: Wrench<T>,
) -> Commanded {
    Commanded {
        torques: std::array::from_fn(
            |i| {
                if i < 6 { left[i].to_f64() } else { right[i - 6].to_f64() }
            },
        ),
        desired_wrench: desired_wrench.to_array().map(Real::to_f64),
    }
}
