//! The biped on the symplectic simulator of chapter 5: the default plant.

use super::joint_stops::with_stops;
use super::{NV, Observation, Plant, PlantState, StepFailure};
use crate::contact::{ContactState, Floor, Switching};
use crate::integrators::Progress;
use crate::multibody::{
    Checkpoint, Closing, Closure, Joint, JointConstraint, Simulation, Site, Stops, states_of_tree,
    system_of_tree,
};
use nalgebra::Vector3;
use surefoot::model::robots::biped::{FEET, SoleOutline, TREE};
use surefoot::spatial::Quaternion;

/// Corners of a sole.
const CORNERS: usize = 4;
/// Constraints of a welded foot.
const WELD: usize = 6;

/// The biped on a floor, or welded to it. Its step is that of its start.
#[derive(Clone, Debug)]
pub struct Variational {
    simulation: Simulation,
    is_on_floor: bool,
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
        stops: Option<&[Stops; 12]>,
    ) -> Result<Self, StepFailure> {
        let corners = outline.corners();
        let sites = FEET
            .into_iter()
            .flat_map(|foot| corners.map(|corner| Site { link: foot, position: corner.into() }));
        let system = with_stops(system_of_tree(&TREE)?, stops)?;
        let system = system.on_floor(floor, Switching::WithinTheStep, sites.collect())?;
        let (states, rates) = states_of_tree(&TREE, &state.positions, &state.velocities)?;
        let simulation = Simulation::new(system, h, &states, &rates)?;
        Ok(Self { simulation, is_on_floor: true })
    }

    /// With both feet held where they start: the loop through the floor is closed by constraints.
    ///
    /// # Errors
    /// As for [`Self::on_floor`].
    pub fn welded(
        state: &PlantState,
        h: f64,
        stops: Option<&[Stops; 12]>,
    ) -> Result<Self, StepFailure> {
        let (states, rates) = states_of_tree(&TREE, &state.positions, &state.velocities)?;
        let mut system = with_stops(system_of_tree(&TREE)?, stops)?;
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
        let simulation = Simulation::new(system, h, &states, &rates)?;
        Ok(Self { simulation, is_on_floor: false })
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

impl Plant for Variational {
    fn state(&mut self) -> Result<PlantState, StepFailure> {
        let mut velocities: [f64; NV] = [0.0; NV];
        velocities.copy_from_slice(self.simulation.observed_rates()?);
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
        push: Option<Vector3<f64>>,
    ) -> Result<(), StepFailure> {
        debug_assert_eq!(step_s, self.simulation.progress().h);
        for (k, torque) in torques.iter().enumerate() {
            self.simulation.set_torque(k + 1, *torque);
        }
        self.simulation.set_wrench(0, push.unwrap_or(Vector3::zeros()).into(), [0.0; 3]);
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

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let (kinetic_energy, potential_energy) = self.simulation.energies()?;
        Ok(Observation {
            kinetic_energy,
            potential_energy,
            foot_forces: self.vertical(),
            contacts: self.contacts(),
            corner_forces: self.corner_forces(),
            block: None,
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
