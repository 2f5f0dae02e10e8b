//! Scenes of chapter 2: a mechanism that nobody controls.

use super::multibody::{BuildError, Misdescribed, Multibody};
use super::{Integrator, SceneError};
use crate::integrators::Method;
use crate::multibody::{ChainJoint, Simulation, SystemError, states_of_tree, system_of_tree};
use crate::plant::StepFailure;
use serde::{Deserialize, Serialize};
use surefoot::model::robots::biped::TREE;

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
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
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

/// Methods on bodies and joints.
const METHODS_FOR_BODIES: [Method; 6] = [
    Method::Variational,
    Method::Yoshida4,
    Method::Yoshida6,
    Method::SemiImplicitEuler,
    Method::RungeKutta4,
    Method::DormandPrince8,
];
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

    fn wrong(&self, field: &str, value: impl std::fmt::Debug, expected: String) -> SceneError {
        let (name, field) = (self.name.clone(), field.to_owned());
        SceneError::Value { name, field, value: format!("{value:?}"), expected }
    }

    /// Bodies and joints have these methods; some take not all of them, which their start says.
    fn check_method(&self) -> Result<(), SceneError> {
        let method = self.integrator.name;
        if METHODS_FOR_BODIES.contains(&method) {
            return Ok(());
        }
        let names = METHODS_FOR_BODIES.map(Method::name).join(", ");
        Err(self.wrong("integrator.name", method, format!("for bodies and joints one of {names}")))
    }

    /// Checks what a file may get wrong.
    ///
    /// # Errors
    /// [`SceneError::Value`].
    pub fn check(&self) -> Result<(), SceneError> {
        super::check::duration_and_step(&self.name, self.duration_s, self.integrator.step_s)?;
        if let Some(accuracy) = self.matters.accuracy
            && !(accuracy > 0.0 && accuracy < 1.0)
        {
            return Err(self.wrong(
                "matters.accuracy",
                accuracy,
                "a number between 0 and 1".into(),
            ));
        }
        match &self.mechanism {
            Mechanism::RigidBody { inertia_kg_m2, orientation, angular_velocity_rad_s } => {
                let [a, b, c] = *inertia_kg_m2;
                let possible = a > 0.0 && b > 0.0 && c > 0.0;
                if !(possible && a + b >= c && b + c >= a && c + a >= b && (a + b + c).is_finite())
                {
                    let expected = "three inertias above zero, none above the others' sum";
                    let field = "mechanism.inertia_kg_m2";
                    return Err(self.wrong(field, inertia_kg_m2, expected.into()));
                }
                let norm = orientation.iter().map(|q| q * q).sum::<f64>().sqrt();
                if !((norm - 1.0).abs() < 1e-3) {
                    let expected = format!("a unit quaternion, scalar first (its norm is {norm})");
                    return Err(self.wrong("mechanism.orientation", orientation, expected));
                }
                if !angular_velocity_rad_s.iter().all(|w| w.is_finite()) {
                    let field = "mechanism.angular_velocity_rad_s";
                    return Err(self.wrong(field, angular_velocity_rad_s, "finite numbers".into()));
                }
            }
            Mechanism::Chain {
                links, mass_kg, length_m, radius_m, bend_deg, gravity_m_s2, ..
            } => {
                if !(1..=MOST_CHAIN_LINKS).contains(links) {
                    let expected = format!("1 to {MOST_CHAIN_LINKS} links");
                    return Err(self.wrong("mechanism.links", links, expected));
                }
                let sizes = [mass_kg, length_m, radius_m];
                if !sizes.iter().all(|size| size.is_finite() && **size > 0.0) {
                    let expected = "a mass, a length and a radius above zero";
                    return Err(self.wrong("mechanism", sizes, expected.into()));
                }
                if !(bend_deg.is_finite() && gravity_m_s2.is_finite()) {
                    let field = "mechanism.bend_deg, gravity_m_s2";
                    return Err(self.wrong(
                        field,
                        (bend_deg, gravity_m_s2),
                        "finite numbers".into(),
                    ));
                }
                self.check_method()?;
            }
            Mechanism::Multibody(bodies) => {
                self.check_method()?;
                bodies.start(self.integrator.step_s).map_err(|error| match error {
                    BuildError::Field(Misdescribed { field, expected }) => {
                        self.wrong(&field, "what it is", expected)
                    }
                    BuildError::System(error) => {
                        self.wrong("mechanism", "what it is", format!("a system ({error})"))
                    }
                })?;
            }
            Mechanism::Biped(flight) => {
                self.check_method()?;
                flight.start(self.integrator.step_s).map_err(|error| {
                    self.wrong("mechanism", flight, format!("a state of the biped ({error})"))
                })?;
            }
            Mechanism::Pendulum { gravity_m_s2, links } => {
                if !gravity_m_s2.is_finite() {
                    let field = "mechanism.gravity_m_s2";
                    return Err(self.wrong(field, gravity_m_s2, "a finite number".into()));
                }
                if links.is_empty() || links.len() > MOST_LINKS {
                    let expected = format!("1 to {MOST_LINKS} links");
                    return Err(self.wrong("mechanism.links", links.len(), expected));
                }
                for (number, link) in links.iter().enumerate() {
                    let angles = link.angles_deg.iter().chain(&link.rates_deg_s);
                    let sizes = [link.mass_kg, link.length_m];
                    let sound = sizes.iter().all(|size| size.is_finite() && *size > 0.0);
                    if !(sound && angles.into_iter().all(|x| x.is_finite())) {
                        let expected = "a mass and a length above zero, finite angles and rates";
                        let field = format!("mechanism.links[{number}]");
                        return Err(self.wrong(&field, link, expected.into()));
                    }
                }
            }
        }
        Ok(())
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
        let mut positions = [0.0; crate::plant::NQ];
        positions[..3].copy_from_slice(&self.position_m);
        positions[3..7].copy_from_slice(&self.orientation);
        let mut velocities = [0.0; crate::plant::NV];
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
