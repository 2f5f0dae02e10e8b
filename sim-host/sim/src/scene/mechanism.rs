//! Scenes of chapter 2: a mechanism that nobody controls.

use super::multibody::Multibody;
use super::{Integrator, SceneError};
use crate::plant::StepFailure;
use serde::{Deserialize, Serialize};
use surefoot::model::robots::biped::TREE;
use surefoot_multibody::{ChainJoint, Simulation, SystemError, states_of_tree, system_of_tree};

/// A mechanism, its start, its method and its time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MechanismScene {
    /// Name: the built-in's, or the file's.
    #[serde(skip)]
    pub name: String,
    /// One line for people.
    pub description: String,
    /// Simulated time, s.
    pub duration_s: f64,
    /// Method and step.
    #[serde(default)]
    pub integrator: Integrator,
    /// Whether the file names no method and no step, so that `run` has to take advice.
    #[serde(skip)]
    pub is_unadvised: bool,
    /// What matters.
    #[serde(default, skip_serializing_if = "MotionMatters::is_default")]
    pub matters: MotionMatters,
    /// What moves.
    pub mechanism: Mechanism,
}

/// What matters in a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MotionMatters {
    /// Largest error of the trajectory, over how far the motion reaches: the method and the step of the scene are
    /// those that `surefoot advise` recommends for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<f64>,
}

impl MotionMatters {
    /// Whether nothing was said.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// What moves, and from where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Mechanism {
    /// A free rigid body in unit quaternions.
    RigidBody {
        /// Principal inertias, kg·m².
        inertia_kg_m2: [f64; 3],
        /// World from body, scalar first.
        orientation: [f64; 4],
        /// In the body's frame, rad/s.
        angular_velocity_rad_s: [f64; 3],
    },
    /// Point masses on massless rods, each below the one before.
    Pendulum {
        /// m/s²
        gravity_m_s2: f64,
        /// From the pivot on.
        links: Vec<Link>,
    },
    /// Bodies and joints of one's own.
    Multibody(Multibody),
    /// The biped of §4.1, without a controller or a floor.
    Biped(Box<Flight>),
    /// Equal rods on joints, by the multibody simulator.
    Chain {
        /// How many.
        links: usize,
        /// kg
        mass_kg: f64,
        /// m
        length_m: f64,
        /// m
        radius_m: f64,
        /// What joins them.
        joint: ChainJoint,
        /// Whether the first rod floats.
        floats: bool,
        /// Of each rod from the one before.
        bend_deg: f64,
        /// m/s²
        gravity_m_s2: f64,
    },
}

/// A state of the biped.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flight {
    /// m/s², against z.
    pub gravity_m_s2: f64,
    /// Centre of mass of the central body, m.
    pub position_m: [f64; 3],
    /// Of the central body, world from body, scalar first.
    pub orientation: [f64; 4],
    /// Of its centre of mass, in its own axes, m/s.
    pub velocity_m_s: [f64; 3],
    /// In its own axes, rad/s.
    pub angular_velocity_rad_s: [f64; 3],
    /// Joint angles, hip to foot.
    pub left_leg_deg: [f64; 6],
    /// Joint angles, hip to foot.
    pub right_leg_deg: [f64; 6],
    /// Their rates.
    pub left_leg_rates_deg_s: [f64; 6],
    /// Their rates.
    pub right_leg_rates_deg_s: [f64; 6],
}

/// A rod with a mass at its end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// kg
    pub mass_kg: f64,
    /// m
    pub length_m: f64,
    /// From straight down, and about the vertical.
    pub angles_deg: [f64; 2],
    /// Their rates.
    pub rates_deg_s: [f64; 2],
}

/// Links that a pendulum may have: its equations have a size known at compile time.
pub const MOST_LINKS: usize = 4;
/// Links that a chain may have: what its state files can be read with.
pub const MOST_CHAIN_LINKS: usize = 10_000;

impl MechanismScene {
    /// The same with another number of links, each new one like the last. It is another motion, for which nothing is
    /// recommended yet: it has the simulator's own method and step.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a mechanism without links, or more than there may be.
    pub fn with_links(mut self, number: usize) -> Result<Self, SceneError> {
        match &mut self.mechanism {
            Mechanism::Pendulum { .. } if !(1..=MOST_LINKS).contains(&number) => {
                return Err(self.wrong("--links", number, format!("1 to {MOST_LINKS} links")));
            }
            Mechanism::Pendulum { links, .. } => {
                if let Some(last) = links.last().copied() {
                    links.resize(number, last);
                }
            }
            Mechanism::Chain { links, .. } => *links = number,
            Mechanism::RigidBody { .. } | Mechanism::Multibody(_) | Mechanism::Biped(_) => {
                return Err(self.wrong("--links", number, "a scene with links".into()));
            }
        }
        (self.integrator, self.matters) = (Integrator::default(), MotionMatters::default());
        self.check()?;
        Ok(self)
    }

    pub(super) fn wrong(
        &self,
        field: &str,
        value: impl std::fmt::Debug,
        expected: String,
    ) -> SceneError {
        let (name, field) = (self.name.clone(), field.to_owned());
        SceneError::Value { name, line: None, field, value: format!("{value:?}"), expected }
    }
}

impl Mechanism {
    /// Held in joints, by link, N·m or N; empty where none can be.
    pub fn torques(&self) -> Vec<f64> {
        match self {
            Self::Multibody(bodies) => bodies.bodies.iter().map(|body| body.torque).collect(),
            _ => Vec::new(),
        }
    }

    /// The motion of a biped afloat, with steps of `h`.
    ///
    /// # Errors
    /// As for [`Flight::start`]; [`SystemError::Unsupported`] for another mechanism.
    pub fn flight(&self, h: f64) -> Result<Simulation, StepFailure> {
        match self {
            Self::Biped(flight) => flight.start(h),
            _ => Err(SystemError::Unsupported { link: 0, what: "a biped" }.into()),
        }
    }
}

impl Flight {
    /// The motion that begins here, with steps of `h`.
    ///
    /// # Errors
    /// [`StepFailure::Dynamics`] for no configuration, [`StepFailure::System`] for a step that cannot be.
    pub fn start(&self, h: f64) -> Result<Simulation, StepFailure> {
        let angles = self.left_leg_deg.iter().chain(&self.right_leg_deg);
        let rates = self.left_leg_rates_deg_s.iter().chain(&self.right_leg_rates_deg_s);
        let mut positions = [0.0; 19];
        positions[..3].copy_from_slice(&self.position_m);
        positions[3..7].copy_from_slice(&self.orientation);
        let mut velocities = [0.0; 18];
        velocities[..3].copy_from_slice(&self.velocity_m_s);
        velocities[3..6].copy_from_slice(&self.angular_velocity_rad_s);
        for (to, degrees) in positions[7..].iter_mut().zip(angles) {
            *to = degrees.to_radians();
        }
        for (to, degrees) in velocities[6..].iter_mut().zip(rates) {
            *to = degrees.to_radians();
        }
        let tree = TREE.with_gravity([0.0, 0.0, -self.gravity_m_s2]);
        let (states, rates) = states_of_tree(&tree, &positions, &velocities)?;
        Ok(Simulation::new(system_of_tree(&tree)?, h, &states, &rates)?)
    }
}
