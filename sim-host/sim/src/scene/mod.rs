//! Scenes: what is simulated, from which state, under which controller.
//!
//! A scene is a TOML file. The built-in ones are such files too, read by the same code.

mod builtin;
mod check;
mod check_hardware;
mod check_mechanism;
mod check_robot;
mod differences;
mod disturbance;
mod hardware;
mod inertia;
mod load;
mod mechanism;
mod multibody;
mod robot_entry;
mod rung;
mod source;
mod terrain;
mod walk;
mod warnings;

pub use builtin::{BUILT_IN, BuiltIn, built_in};
pub use differences::{BodyTable, JointTable, PlantTable};
pub use disturbance::{Block, Push, StruckBox};
pub use hardware::{Acting, JointStops, Sensing, StateSource};
pub use load::{AnyScene, SceneError, load, nearest_built_in, open, parse};
pub use mechanism::{Flight, Link, MOST_LINKS, Mechanism, MechanismScene, MotionMatters};
pub use multibody::{
    BodyEntry, BuildError, JointEntry, LoopEntry, LoopJoint, Misdescribed, Multibody,
};
pub use robot_entry::RobotEntry;
pub use rung::{LUMPED_DEVIATION_M, Matters, ModelChoice, Rung};
pub use terrain::{Patch, Terrain};
pub use walk::WalkCommand;

use crate::plant::PlantState;
use crate::robot::{SharedRobot, biped};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use surefoot::model::robots::biped::SoleOutline;
use surefoot::spatial::Wrench;
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::contact::Floor;

/// Everything a run needs to know. Angles in degrees where a name says so, all else in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name: the built-in's, or the file's.
    #[serde(skip)]
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Simulated time, s.
    pub duration_s: f64,
    /// The robot, from a file; the biped of the text unless said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<RobotEntry>,
    /// How much of the robot is modelled; as little as what matters allows, unless said.
    #[serde(default, skip_serializing_if = "ModelChoice::is_auto")]
    pub model: ModelChoice,
    /// What matters.
    #[serde(default, skip_serializing_if = "Matters::is_default")]
    pub matters: Matters,
    /// Method and step.
    pub integrator: Integrator,
    /// Where the robot starts, at rest.
    pub initial: Initial,
    /// Where the controller holds it; a robot from a file where it starts, unless said.
    #[serde(default = "SetPoint::unsaid")]
    pub set_point: SetPoint,
    /// The controller's settings.
    pub controller: ControllerSettings,
    /// What the feet stand on.
    pub feet: Feet,
    /// What the robot has otherwise than the controller's model of it; nothing unless said.
    #[serde(default, skip_serializing_if = "PlantTable::is_model")]
    pub plant: PlantTable,
    /// Ground that is not level; the plane z = 0 unless said.
    #[serde(default, skip_serializing_if = "Terrain::is_level")]
    pub terrain: Terrain,
    /// Pushes against the central body; none unless said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pushes: Vec<Push>,
    /// Commands to walk, in order of their times; with any, the robot walks and steps, and `set_point` and the
    /// controller's gains are not read. None unless said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub walk: Vec<WalkCommand>,
    /// A block thrown at the central body; none unless said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block: Option<Block>,
    /// What the sensors get wrong; nothing unless said.
    #[serde(default, skip_serializing_if = "Sensing::is_ideal")]
    pub sensing: Sensing,
    /// What the motors and joints cannot do; nothing unless said.
    #[serde(default, skip_serializing_if = "Acting::is_ideal")]
    pub acting: Acting,
}

impl Scene {
    /// What moves in it.
    pub fn robot(&self) -> SharedRobot {
        match (self.robot.as_ref().and_then(RobotEntry::robot), self.feet) {
            (Some(robot), _) => robot,
            (None, Feet::Floor { outline: Some(outline), .. }) => biped(outline),
            (None, _) => biped(Outline::A),
        }
    }

    /// Where it starts: on ground that is not level so much higher that none of its points is deeper in it than in the
    /// floor z = 0.
    pub fn start(&self) -> PlantState {
        let mut start = self.initial.state();
        if matches!(self.initial, Initial::Legs(_)) && !self.terrain.is_level() {
            let robot = self.robot();
            let level = robot.foot_points(&start).into_iter().flatten().map(|point| point.z);
            let lowest = level.fold(f64::INFINITY, f64::min);
            start.positions[2] += lowest + self.terrain.raise(&robot, &start);
        }
        start
    }

    /// What all pushes do to the central body on average from one time to a later one, world frame; `None` where there
    /// is none. Each counts by the share of that time in which it acts, so that its impulse is exact.
    pub fn push(&self, from_s: f64, to_s: f64) -> Option<Wrench<f64>> {
        self.pushes
            .iter()
            .map(|push| {
                let acts = (push.at_s + push.duration_s).min(to_s) - push.at_s.max(from_s);
                (acts / (to_s - from_s), Vector3::from(push.force_n))
            })
            .filter(|(share, _)| *share > 0.0)
            .map(|(share, force)| Wrench { force: force * share, torque: Vector3::zeros() })
            .reduce(|a, b| a + b)
    }
}

/// Method and step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Integrator {
    /// Which method.
    pub name: Method,
    /// Step, s.
    pub step_s: f64,
}

impl Default for Integrator {
    /// The multibody simulator's own, in steps of a millisecond.
    fn default() -> Self {
        Self { name: Method::Variational, step_s: 1e-3 }
    }
}

/// The robot's start, at rest. In a file its kind follows from whether the scene names a robot.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Initial {
    /// Of the biped, leg by leg.
    Legs(LegsStart),
    /// Of a robot from a file, by names of joints.
    Joints(JointsStart),
}

impl Serialize for Initial {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Legs(start) => start.serialize(serializer),
            Self::Joints(start) => start.serialize(serializer),
        }
    }
}

/// The start of a robot from a file: at rest, its lowest point on the floor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JointsStart {
    /// Angles by names of joints; 0 unless said.
    pub joints_deg: BTreeMap<String, f64>,
    /// Axis about which its central body is turned.
    pub turn_axis: [f64; 3],
    /// Angle of that turn.
    pub turn_deg: f64,
    /// How far above the floor its lowest point is, m.
    pub above_floor_m: f64,
    /// What comes of these.
    #[serde(skip)]
    pub(crate) state: PlantState,
}

impl Default for JointsStart {
    fn default() -> Self {
        Self {
            joints_deg: BTreeMap::new(),
            turn_axis: [0.0, 0.0, 1.0],
            turn_deg: 0.0,
            above_floor_m: 0.0,
            state: PlantState::default(),
        }
    }
}

/// The biped's start, at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegsStart {
    /// Centre of mass of the central body, m.
    pub position_m: [f64; 3],
    /// Axis about which it is turned.
    pub turn_axis: [f64; 3],
    /// Angle of that turn.
    pub turn_deg: f64,
    /// Joint angles, hip to foot.
    pub left_leg_deg: [f64; 6],
    /// Joint angles, hip to foot.
    pub right_leg_deg: [f64; 6],
}

/// A pose to hold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetPoint {
    /// Centre of mass of the central body, m.
    pub position_m: [f64; 3],
    /// Unit quaternion, scalar first.
    pub orientation: [f64; 4],
}

impl SetPoint {
    /// Of no number: the reader puts the start of a robot from a file in its place.
    fn unsaid() -> Self {
        Self { position_m: [f64::NAN; 3], orientation: [f64::NAN; 4] }
    }
}

/// The controller's settings. Gain matrices are diagonal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControllerSettings {
    /// Ticks per second; torques are held between them.
    pub rate_hz: f64,
    /// `K_c^p`, 1/s².
    pub position_gain: [f64; 3],
    /// `K_c^v`, 1/s.
    pub velocity_gain: [f64; 3],
    /// `K_R^p`, 1/s².
    pub orientation_gain: [f64; 3],
    /// `K_R^v`, 1/s.
    pub angular_velocity_gain: [f64; 3],
    /// Form of the workspace dynamics.
    pub workspace: Workspace,
    /// How the wanted wrench is given to the feet.
    #[serde(default, skip_serializing_if = "Distribution::is_default")]
    pub distribution: Distribution,
    /// What is made of wrenches that the model does not know.
    #[serde(default, skip_serializing_if = "Disturbance::is_default")]
    pub disturbance: Disturbance,
    /// The share of the joints' dry friction, as the robot's file states it, that torques make up for.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub friction_share: f64,
    /// When torques set in.
    pub torques_from: TorquesFrom,
}

fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

/// What is made of wrenches that the model does not know: loads, a centre of mass that is elsewhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Disturbance {
    /// Nothing.
    #[default]
    Ignored,
    /// They are observed, carried, and the set point is moved so that the robot stands over its feet.
    Observed,
}

impl Disturbance {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// How the wanted wrench is given to the feet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Distribution {
    /// As printed: least norm, whatever floor and motors can give.
    #[default]
    LeastNorm,
    /// The same within what floor and motors can give.
    Limited,
}

impl Distribution {
    fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Form of the workspace dynamics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Workspace {
    /// Feet held exactly.
    FixedFoot,
    /// Feet this many times as heavy as the central body (printed: 1e6).
    BigBase(f64),
}

/// When torques set in: the text leaves open what the robot does before its feet touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum TorquesFrom {
    /// At t = 0.
    Start,
    /// At the first tick at which a foot touches the floor; zero before.
    TouchDown,
}

/// What the feet stand on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Feet {
    /// A floor that they can leave and slide on.
    Floor {
        /// Outline of the biped's soles; robots from files have points of their own.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        outline: Option<Outline>,
        /// The floor.
        floor: Floor,
    },
    /// Held where they start.
    Welded {},
}

/// Outlines of the sole that fit the printed foot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outline {
    /// Heel 5.03 cm behind the ankle, toe 20.15 cm ahead.
    A,
    /// 4.0 and 15.5 cm.
    M,
    /// 4.4 and 15.9 cm.
    R,
}

impl Outline {
    /// Its corners.
    pub fn sole(self) -> SoleOutline {
        match self {
            Self::A => SoleOutline::A,
            Self::M => SoleOutline::M,
            Self::R => SoleOutline::R,
        }
    }
}
