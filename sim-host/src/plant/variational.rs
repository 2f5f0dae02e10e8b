//! The biped on the symplectic simulator of chapter 5, with all its bodies or lumped: the default plant.

use super::biped_model::{BipedModel, BipedSystem};
use super::joint_stops::with_stops;
use super::{BlockSample, NV, Observation, Plant, PlantState, StepFailure, ThrownBlock};
use crate::contact::{ContactState, Floor, Switching};
use crate::integrators::Progress;
use crate::multibody::{
    BodyState, Checkpoint, Closing, Closure, Frame, Joint, JointConstraint, Simulation, Site,
    Stops, System, SystemError,
};
use nalgebra::Vector3;
use surefoot::model::robots::biped::SoleOutline;
use surefoot::spatial::{Quaternion, Wrench};

/// Corners of a sole.
const CORNERS: usize = 4;
/// Constraints of a welded foot.
const WELD: usize = 6;

/// What a scene makes of the robot, and adds to it; nothing unless said, and then nothing of it is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Additions {
    /// Which bodies the robot has.
    pub model: BipedModel,
    /// Ends of the joints' ways; they need the full model's hinges.
    pub stops: Option<[Stops; 12]>,
    /// A block that is thrown at it.
    pub block: Option<ThrownBlock>,
}

/// The biped on a floor, or welded to it. Its step is that of its start.
#[derive(Clone, Debug)]
pub struct Variational {
    simulation: Simulation,
    /// Links with motors, and how many.
    joints: Vec<(usize, usize)>,
    /// The frame of body 1 of §4.1 in link 0.
    central: Frame,
    is_on_floor: bool,
    /// Its link.
    block: Option<usize>,
}

impl Variational {
    /// On a floor, with steps of `h` seconds, and stops in the joints, left leg then right.
    ///
    /// # Errors
    /// [`StepFailure::Dynamics`] for no configuration, [`StepFailure::System`] for a step or a floor that
    /// cannot be.
    pub fn on_floor(
        state: &PlantState,
        h: f64,
        floor: Floor,
        outline: &SoleOutline,
        additions: &Additions,
    ) -> Result<Self, StepFailure> {
        let mut biped = biped(additions)?;
        let corners = outline.corners();
        let of_feet = biped.feet.into_iter().flat_map(|(link, foot)| {
            corners.map(|corner| Site { link, position: foot.point(corner).into() })
        });
        let block = biped.system.links().len();
        let of_block = additions.block.iter().flat_map(ThrownBlock::corners);
        let sites =
            of_feet.chain(of_block.map(|position| Site { link: block, position })).collect();
        biped.system = with_block(biped.system, additions)?.on_floor(
            floor,
            Switching::WithinTheStep,
            sites,
        )?;
        Self::new(state, h, biped, additions, true)
    }

    /// With both feet held where they start: the loop through the floor is closed by constraints. A block
    /// falls without end, as there is no floor.
    ///
    /// # Errors
    /// As for [`Self::on_floor`].
    pub fn welded(state: &PlantState, h: f64, additions: &Additions) -> Result<Self, StepFailure> {
        let mut biped = biped(additions)?;
        let (states, _) = biped.start(state)?;
        let mut system = with_block(biped.system.clone(), additions)?;
        for (foot, _) in biped.feet {
            let [x, y, z, s, i, j, k] = states[foot];
            let weld = Joint {
                outboard: [0.0; 3],
                inboard: [x, y, z],
                home: [s, i, j, k],
                constraint: JointConstraint::Fixed,
            };
            let closing = Closing::Joint(weld);
            system = system.with_closure(Closure { outboard: foot, inboard: None, closing })?;
        }
        biped.system = system;
        Self::new(state, h, biped, additions, false)
    }

    fn new(
        state: &PlantState,
        h: f64,
        biped: BipedSystem,
        additions: &Additions,
        is_on_floor: bool,
    ) -> Result<Self, StepFailure> {
        let (mut states, mut rates) = biped.start(state)?;
        let block = additions.block.as_ref().map(|block| {
            let (state, rate) = block.start();
            states.push(state);
            rates.push(rate);
            states.len() - 1
        });
        let BipedSystem { system, joints, central, .. } = biped;
        let simulation = Simulation::new(system, h, &states, &rates)?;
        Ok(Self { simulation, joints, central, is_on_floor, block })
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// A load about the central body's centre, about link 0's; with the arm half way through the step, so that
    /// the method keeps its order.
    fn on_link(&mut self, load: Wrench<f64>) -> Result<Wrench<f64>, StepFailure> {
        if self.central.position == Vector3::zeros() {
            return Ok(load);
        }
        let half = 0.5 * self.simulation.progress().h;
        let turning = Vector3::from_row_slice(&self.simulation.observed_rates()?[3..6]);
        let q = orientation(&self.simulation.state(0));
        let arm = Quaternion::from_rotation_vector(turning * half)
            .rotate(q.rotate(self.central.position));
        Ok(Wrench { force: load.force, torque: load.torque + arm.cross(&load.force) })
    }

    /// Vertical forces of the ground on the feet in the last step, N.
    fn vertical(&self) -> [f64; 2] {
        if let Some(feet) = self.corner_forces() {
            return feet.map(|corners| corners.iter().map(|force| force[2]).sum());
        }
        // Of a weld's constraints the third is the foot's height.
        let impulses = self.simulation.loop_impulses();
        [0, 1].map(|foot| impulses[WELD * foot + 2] / self.simulation.progress().h)
    }

    /// Forces of the floor on the corners in the last step, N.
    fn corner_forces(&self) -> Option<[[[f64; 3]; CORNERS]; 2]> {
        let forces = self.simulation.contact_forces();
        let of = |foot: usize| std::array::from_fn(|corner| forces[CORNERS * foot + corner]);
        self.is_on_floor.then(|| [of(0), of(1)])
    }
}

/// The robot with stops.
fn biped(additions: &Additions) -> Result<BipedSystem, StepFailure> {
    let mut biped = BipedSystem::new(additions.model)?;
    if additions.stops.is_some() && additions.model != BipedModel::Full {
        let what = "the full model, whose hinges can have stops,";
        return Err(SystemError::Unsupported { link: 1, what }.into());
    }
    biped.system = with_stops(biped.system, additions.stops.as_ref())?;
    Ok(biped)
}

fn orientation(state: &BodyState) -> Quaternion<f64> {
    Quaternion::from_array([state[3], state[4], state[5], state[6]])
}

/// With a block as the last link.
fn with_block(system: System, additions: &Additions) -> Result<System, SystemError> {
    let link = system.links().len();
    match &additions.block {
        Some(block) => system.with_link(block.link())?.with_striker(block.striker(link)),
        None => Ok(system),
    }
}

impl Plant for Variational {
    fn state(&mut self) -> Result<PlantState, StepFailure> {
        let mut velocities: [f64; NV] = [0.0; NV];
        velocities.copy_from_slice(&self.simulation.observed_rates()?[..NV]);
        let link = self.simulation.state(0);
        let q = orientation(&link);
        let arm = q.rotate(self.central.position);
        let at = Vector3::new(link[0], link[1], link[2]) + arm;
        let turned = q.product(self.central.orientation);
        // A body twist of the central body, where the simulator has link 0's centre of mass and world axes.
        let [v, omega] = [0, 3].map(|i| Vector3::from_row_slice(&velocities[i..i + 3]));
        let to_body = turned.conjugate();
        velocities[..3].copy_from_slice(to_body.rotate(v + omega.cross(&arm)).as_slice());
        velocities[3..6].copy_from_slice(to_body.rotate(omega).as_slice());
        let mut positions = [0.0; super::NQ];
        positions[..3].copy_from_slice(at.as_slice());
        positions[3..7].copy_from_slice(&turned.to_array());
        let mut next = 7;
        for (joint, motors) in &self.joints {
            let angles = self.simulation.angles(*joint);
            positions[next..next + motors].copy_from_slice(&angles[..*motors]);
            next += motors;
        }
        Ok(PlantState { positions, velocities })
    }

    /// Steps are of the length that the plant was made with; `step_s` must be that.
    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64; 12],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        debug_assert_eq!(step_s, self.simulation.progress().h);
        let mut next = 0;
        for (joint, motors) in &self.joints {
            self.simulation.set_torques(*joint, &torques[next..next + motors]);
            next += motors;
        }
        let Wrench { force, torque } = match load {
            Some(load) => self.on_link(load)?,
            None => Wrench::zero(),
        };
        self.simulation.set_wrench(0, force.into(), torque.into());
        Ok(self.simulation.step()?)
    }

    fn contacts(&self) -> Option<[[ContactState; CORNERS]; 2]> {
        if !self.is_on_floor {
            return None;
        }
        let memories = self.simulation.contacts();
        let state = |foot: usize, corner: usize| memories[CORNERS * foot + corner].state;
        Some(std::array::from_fn(|foot| std::array::from_fn(|corner| state(foot, corner))))
    }

    fn is_struck(&self) -> bool {
        self.simulation.strikes().iter().any(|point| point.face.is_some())
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let (kinetic_energy, potential_energy) = self.simulation.energies()?;
        Ok(Observation {
            kinetic_energy,
            potential_energy,
            foot_forces: self.vertical(),
            contacts: self.contacts(),
            corner_forces: self.corner_forces(),
            block: self.block.map(|link| BlockSample {
                pose: self.simulation.state(link),
                force: self.simulation.strike_forces()[0],
            }),
            constraint: self.simulation.system().largest_constraint(&self.simulation.states()),
        })
    }

    fn step_limit(&self) -> Option<f64> {
        None
    }

    fn unknowns(&self) -> usize {
        self.simulation.unknowns()
    }

    fn progress(&self) -> Option<&Progress> {
        Some(self.simulation.progress())
    }

    fn checkpoint(&self) -> Option<&Checkpoint> {
        Some(self.simulation.checkpoint())
    }

    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), StepFailure> {
        Ok(self.simulation.restore(checkpoint)?)
    }
}
