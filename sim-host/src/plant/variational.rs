//! The biped on the symplectic simulator of chapter 5: the default plant.

use super::joint_stops::with_stops;
use super::{BlockSample, NV, Observation, Plant, PlantState, StepFailure, ThrownBlock};
use crate::contact::{ContactState, Floor, Switching};
use crate::integrators::Progress;
use crate::multibody::{
    Checkpoint, Closing, Closure, Joint, JointConstraint, Simulation, Site, Stops, System,
    states_of_tree, system_of_tree,
};
use nalgebra::Vector3;
use surefoot::model::robots::biped::{FEET, SoleOutline, TREE};
use surefoot::spatial::{Quaternion, Wrench};

/// Corners of a sole.
const CORNERS: usize = 4;
/// Constraints of a welded foot.
const WELD: usize = 6;
/// The block's link, after those of the robot.
const BLOCK: usize = 13;

/// What a scene adds to the robot; nothing unless said, and then nothing of it is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Additions {
    /// Ends of the joints' ways.
    pub stops: Option<[Stops; 12]>,
    /// A block that is thrown at it.
    pub block: Option<ThrownBlock>,
}

/// The biped on a floor, or welded to it. Its step is that of its start.
#[derive(Clone, Debug)]
pub struct Variational {
    simulation: Simulation,
    is_on_floor: bool,
    has_block: bool,
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
        let corners = outline.corners();
        let of_feet = FEET
            .into_iter()
            .flat_map(|foot| corners.map(|corner| Site { link: foot, position: corner.into() }));
        let of_block = additions.block.iter().flat_map(ThrownBlock::corners);
        let sites =
            of_feet.chain(of_block.map(|position| Site { link: BLOCK, position })).collect();
        let system = system(additions)?.on_floor(floor, Switching::WithinTheStep, sites)?;
        Self::new(state, h, system, additions, true)
    }

    /// With both feet held where they start: the loop through the floor is closed by constraints. A block
    /// falls without end, as there is no floor.
    ///
    /// # Errors
    /// As for [`Self::on_floor`].
    pub fn welded(state: &PlantState, h: f64, additions: &Additions) -> Result<Self, StepFailure> {
        let (states, _) = states_of_tree(&TREE, &state.positions, &state.velocities)?;
        let mut system = system(additions)?;
        for foot in FEET {
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
        Self::new(state, h, system, additions, false)
    }

    fn new(
        state: &PlantState,
        h: f64,
        system: System,
        additions: &Additions,
        is_on_floor: bool,
    ) -> Result<Self, StepFailure> {
        let (mut states, mut rates) = states_of_tree(&TREE, &state.positions, &state.velocities)?;
        if let Some((state, rate)) = additions.block.as_ref().map(ThrownBlock::start) {
            states.push(state);
            rates.push(rate);
        }
        let simulation = Simulation::new(system, h, &states, &rates)?;
        Ok(Self { simulation, is_on_floor, has_block: additions.block.is_some() })
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
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

/// The robot with what is added to it.
fn system(additions: &Additions) -> Result<System, StepFailure> {
    let robot = with_stops(system_of_tree(&TREE)?, additions.stops.as_ref())?;
    Ok(match &additions.block {
        Some(block) => robot.with_link(block.link())?.with_striker(block.striker(BLOCK))?,
        None => robot,
    })
}

impl Plant for Variational {
    fn state(&mut self) -> Result<PlantState, StepFailure> {
        let mut velocities: [f64; NV] = [0.0; NV];
        velocities.copy_from_slice(&self.simulation.observed_rates()?[..NV]);
        let base = self.simulation.state(0);
        let q = Quaternion::from_array([base[3], base[4], base[5], base[6]]).conjugate();
        // A body twist, where the simulator has world axes.
        for part in [0..3, 3..6] {
            let world = Vector3::from_row_slice(&velocities[part.clone()]);
            velocities[part].copy_from_slice(q.rotate(world).as_slice());
        }
        let mut positions = [0.0; super::NQ];
        positions[..7].copy_from_slice(&base);
        for (k, angle) in positions[7..].iter_mut().enumerate() {
            *angle = self.simulation.angle(k + 1);
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
        for (k, torque) in torques.iter().enumerate() {
            self.simulation.set_torque(k + 1, *torque);
        }
        let Wrench { force, torque } = load.unwrap_or(Wrench::zero());
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
            block: self.has_block.then(|| BlockSample {
                pose: self.simulation.state(BLOCK),
                force: self.simulation.strike_forces()[0],
            }),
            constraint: self.simulation.system().largest_constraint(&self.simulation.states()),
        })
    }

    fn step_limit(&self) -> Option<f64> {
        None
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
