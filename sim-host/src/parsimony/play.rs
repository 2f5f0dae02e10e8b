//! One motion on one rung.

use serde::Serialize;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};
use surefoot::spatial::Wrench;
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::contact::ContactState;
use surefoot_multibody::{ConstrainedSimulation, Simulation, SystemError, lumped};
use surefoot_sim::closed_loop::{self, Scalar};
use surefoot_sim::mechanism::StartFailure;
use surefoot_sim::plant::{Observation, PerPoint, Plant, PlantState, RobotModel, StepFailure};
use surefoot_sim::robot::{SMALL_BODIES, biped};
use surefoot_sim::scene::{AnyScene, Feet, ModelChoice, Outline, Scene, SceneError, open};

/// A model of a motion. The first three are of the same limbs afloat, the others of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Rung {
    /// Afloat: coordinates of all bodies, with joints as constraints and their multipliers.
    FlightMultipliers,
    /// Afloat: all bodies in joint coordinates.
    FlightFull,
    /// Afloat: small bodies lumped.
    FlightLumped,
    /// On the scene's floor: all bodies.
    FloorFull,
    /// On the scene's floor: small bodies lumped.
    FloorLumped,
    /// Feet welded where they start: all bodies, no contact.
    WeldedFull,
    /// Feet welded: small bodies lumped.
    WeldedLumped,
}

/// A motion that was played.
#[derive(Clone, Debug)]
pub struct Played {
    /// Position and quaternion of the central body at ticks; afloat, at steps; of a mechanism, of all bodies.
    pub path: Vec<[f64; 7]>,
    /// Steps made by one copy.
    pub steps: u64,
    /// What Newton's method solves for.
    pub unknowns: usize,
    /// Spent in the steps of all copies.
    pub in_steps: Duration,
}

/// Why a rung cannot be played.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlayFailure {
    /// The scene does not bear it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The plant could not be made.
    #[error(transparent)]
    Plant(#[from] StepFailure),
    /// The system could not be made.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A step of the motion afloat could not be made.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The mechanism could not be started.
    #[error(transparent)]
    Start(#[from] StartFailure),
    /// The closed loop ended early.
    #[error("at {time_s} s: {place}")]
    Loop {
        /// When.
        time_s: f64,
        /// Where and why.
        place: String,
    },
}

/// Time of the motion afloat, s.
const AFLOAT_S: f64 = 0.5;

impl Rung {
    /// Those that a scene has, from the dearest to the cheapest of each kind.
    pub fn of(scene: &Scene) -> Vec<Self> {
        let mut all = vec![Self::FlightMultipliers, Self::FlightFull, Self::FlightLumped];
        if matches!(scene.feet, Feet::Floor { .. }) {
            all.extend([Self::FloorFull, Self::FloorLumped]);
        }
        all.extend([Self::WeldedFull, Self::WeldedLumped]);
        all
    }

    /// How many bodies the robot has.
    pub fn bodies(self) -> usize {
        biped(Outline::A).bodies_of(self.model())
    }

    /// The rung that it is compared with: the larger model of the same motion. What welding does is told by
    /// comparison with the floor.
    pub fn reference(self, scene: &Scene) -> Self {
        match (self, &scene.feet) {
            (Self::FlightMultipliers | Self::FlightFull | Self::FlightLumped, _) => {
                Self::FlightFull
            }
            (_, Feet::Floor { .. }) => Self::FloorFull,
            (_, Feet::Welded {}) => Self::WeldedFull,
        }
    }

    fn model(self) -> RobotModel {
        match self {
            Self::FlightLumped | Self::FloorLumped | Self::WeldedLumped => RobotModel::Lumped,
            _ => RobotModel::Full,
        }
    }

    /// Plays the motion with this many equal copies of the model side by side, which differ in nothing but what
    /// they cost.
    ///
    /// # Errors
    /// A [`PlayFailure`].
    pub fn play(self, scene: &Scene, copies: NonZeroUsize) -> Result<Played, PlayFailure> {
        let copies = copies.get();
        match self {
            Self::FlightMultipliers | Self::FlightFull | Self::FlightLumped => self.afloat(copies),
            _ => self.in_loop(scene, copies),
        }
    }

    fn afloat(self, copies: usize) -> Result<Played, PlayFailure> {
        let AnyScene::Mechanism(scene) = open("biped-flight")? else {
            return Err(SceneError::Unknown { name: "biped-flight".into(), nearest: None }.into());
        };
        let h = scene.integrator.step_s;
        let mut full = scene.mechanism.flight(h)?;
        let (states, rates) = (full.states(), full.rates()?);
        let steps = (AFLOAT_S / h) as u64;
        if self == Self::FlightMultipliers {
            let one = ConstrainedSimulation::new(full.system().clone(), h, states, rates)?;
            let unknowns = one.unknowns();
            return fly(vec![one; copies], steps, unknowns, ConstrainedSimulation::step, |one| {
                [one.states()[0]]
            });
        }
        if self == Self::FlightFull {
            let unknowns = full.unknowns();
            return fly(
                vec![full; copies],
                steps,
                unknowns,
                Simulation::step,
                |one| [one.state(0)],
            );
        }
        let reduced = lumped(full.system(), &SMALL_BODIES)?;
        let (states, rates) = reduced.start(&states, &rates);
        let one = Simulation::new(reduced.system.clone(), h, &states, &rates)?;
        let unknowns = one.unknowns();
        fly(vec![one; copies], steps, unknowns, Simulation::step, |one| {
            [reduced.state(0, &one.states()).unwrap_or_default()]
        })
    }

    fn in_loop(self, scene: &Scene, copies: usize) -> Result<Played, PlayFailure> {
        let mut scene = scene.clone();
        if matches!(self, Self::WeldedFull | Self::WeldedLumped) {
            scene.feet = Feet::Welded {};
        }
        scene.model = match self.model() {
            RobotModel::Full => ModelChoice::Full,
            RobotModel::Lumped => ModelChoice::Lumped,
        };
        scene.check()?;
        let plants: Result<Vec<_>, _> = (0..copies).map(|_| closed_loop::plant(&scene)).collect();
        let mut copied = Copies { plants: plants?, in_steps: Duration::ZERO };
        let mut controller = closed_loop::controller(&scene, Scalar::F64);
        let run =
            closed_loop::run_plant(&scene, &mut copied, controller.as_mut(), None, &mut |_| {});
        if let Some(failure) = run.failure {
            return Err(PlayFailure::Loop { time_s: failure.time_s, place: failure.place });
        }
        let path = run.samples.iter().map(|s| std::array::from_fn(|i| s.positions[i])).collect();
        let unknowns = copied.plants.first().map_or(0, |plant| plant.unknowns());
        Ok(Played { path, steps: run.steps, unknowns, in_steps: copied.in_steps })
    }
}

pub(super) fn fly<S, P: IntoIterator<Item = [f64; 7]>>(
    mut copies: Vec<S>,
    steps: u64,
    unknowns: usize,
    step: impl Fn(&mut S) -> Result<(), StepError>,
    look: impl Fn(&S) -> P,
) -> Result<Played, PlayFailure> {
    let mut played = Played { path: Vec::new(), steps, unknowns, in_steps: Duration::ZERO };
    for _ in 0..steps {
        let begun = Instant::now();
        copies.iter_mut().try_for_each(&step)?;
        played.in_steps += begun.elapsed();
        played.path.extend(copies.first().into_iter().flat_map(&look));
    }
    Ok(played)
}

/// Equal plants that all make every step; the first one is looked at.
struct Copies {
    plants: Vec<Box<dyn Plant>>,
    in_steps: Duration,
}

impl Plant for Copies {
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        self.plants[0].read_state(state)
    }

    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        let begun = Instant::now();
        let made = self.plants.iter_mut().try_for_each(|plant| plant.step(step_s, torques, load));
        self.in_steps += begun.elapsed();
        made
    }

    fn read_contacts(&self, contacts: &mut PerPoint<ContactState>) -> bool {
        self.plants[0].read_contacts(contacts)
    }

    fn unknowns(&self) -> usize {
        self.plants[0].unknowns()
    }

    fn is_struck(&self) -> bool {
        self.plants[0].is_struck()
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        self.plants[0].observe()
    }

    fn step_limit(&self) -> Option<f64> {
        self.plants[0].step_limit()
    }

    fn progress(&self) -> Option<&Progress> {
        self.plants[0].progress()
    }
}
