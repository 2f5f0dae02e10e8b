//! The biped on the symplectic simulator of chapter 5, with all its bodies or lumped: the default plant.

use super::biped_model::BipedModel;
use super::biped_system::{BipedSystem, Foot, Motors};
use super::joint_stops::with_stops;
use super::{BlockSample, NQ, NV, Observation, Plant, PlantState, StepFailure, ThrownBlock};
use crate::contact::{ContactState, Floor, Switching};
use crate::integrators::Progress;
use crate::multibody::{BodyState, Checkpoint, Frame, Seat, Simulation, Site, Stops, SystemError};
use nalgebra::Vector3;
use surefoot::model::robots::biped::SoleOutline;
use surefoot::spatial::{Quaternion, Wrench};

/// Corners of a sole.
const CORNERS: usize = 4;

/// Columns of the robot and a block, at most.
const MOST_COLUMNS: usize = NV + 6;

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
    motors: Vec<Motors>,
    feet: [Foot; 2],
    /// Link of body 1 of §4.1, and its frame in it.
    central: (usize, Frame),
    still_energy: f64,
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
        let mut biped = biped(state, additions)?;
        let corners = outline.corners();
        let of_feet = biped.feet.into_iter().flat_map(|foot| {
            let Foot::Free(link, frame) = foot else { return Vec::new() };
            corners.map(|corner| Site { link, position: frame.point(corner).into() }).to_vec()
        });
        let block = biped.system.links().len() - 1;
        let of_block = additions.block.iter().flat_map(ThrownBlock::corners);
        let sites =
            of_feet.chain(of_block.map(|position| Site { link: block, position })).collect();
        biped.system = biped.system.on_floor(floor, Switching::WithinTheStep, sites)?;
        Self::new(h, biped, additions)
    }

    /// With both feet held where they start: both legs hang from the world, and one joint closes the loop. A block
    /// falls without end, as there is no floor.
    ///
    /// # Errors
    /// As for [`Self::on_floor`].
    pub fn welded(state: &PlantState, h: f64, additions: &Additions) -> Result<Self, StepFailure> {
        Self::new(h, biped(state, additions)?.on_still_feet()?, additions)
    }

    fn new(h: f64, biped: BipedSystem, additions: &Additions) -> Result<Self, StepFailure> {
        let BipedSystem { system, states, rates, motors, feet, central, still_energy } = biped;
        let is_on_floor = system.ground().is_some();
        let block = additions.block.map(|_| states.len() - 1);
        let floats = system.links()[central.0].joint.constraints() == 0;
        let mut simulation = Simulation::new(system, h, &states, &rates)?;
        if !floats {
            simulation = simulation.watching(central.0)?;
        }
        Ok(Self { simulation, motors, feet, central, still_energy, is_on_floor, block })
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Velocity of the central body's link at its centre of mass and its angular velocity, world axes.
    fn twist(&mut self) -> Result<[Vector3<f64>; 2], StepFailure> {
        let found = self.simulation.observed_twist(self.central.0)?;
        // It floats or is watched.
        Ok(found.unwrap_or([Vector3::zeros(); 2]))
    }

    /// A load about the central body's centre, about its link's; with the arm half way through the step, so that
    /// the method keeps its order.
    fn on_link(&mut self, load: Wrench<f64>) -> Result<Wrench<f64>, StepFailure> {
        let (link, frame) = self.central;
        if frame.position == Vector3::zeros() {
            return Ok(load);
        }
        let half = 0.5 * self.simulation.progress().h;
        let [_, turning] = self.twist()?;
        let q = orientation(&self.simulation.state(link));
        let arm = Quaternion::from_rotation_vector(turning * half).rotate(q.rotate(frame.position));
        Ok(Wrench { force: load.force, torque: load.torque + arm.cross(&load.force) })
    }

    /// Vertical forces of the ground on the feet in the last step, N: the impulse at its beginning over its length.
    fn vertical(&self) -> [f64; 2] {
        if let Some(feet) = self.corner_forces() {
            return feet.map(|corners| corners.iter().map(|force| force[2]).sum());
        }
        let progress = self.simulation.progress();
        // A node of the discrete trajectory bears half the weight of the step before, and half that of the next.
        let share = match progress.steps {
            0 => 0.0,
            1 => 0.5,
            _ => 1.0,
        };
        self.feet.map(|foot| match foot {
            Foot::Still(link, weight) => {
                self.simulation.world_impulse(link)[2] / progress.h + share * weight
            }
            // Of a weld's constraints the third is the foot's height.
            Foot::Welded => self.simulation.loop_impulses()[2] / progress.h,
            Foot::Free(..) => 0.0,
        })
    }

    /// Forces of the floor on the corners in the last step, N.
    fn corner_forces(&self) -> Option<[[[f64; 3]; CORNERS]; 2]> {
        let forces = self.simulation.contact_forces();
        let of = |foot: usize| std::array::from_fn(|corner| forces[CORNERS * foot + corner]);
        self.is_on_floor.then(|| [of(0), of(1)])
    }
}

/// The robot with stops, and with a block as the last link.
fn biped(state: &PlantState, additions: &Additions) -> Result<BipedSystem, StepFailure> {
    let mut biped = BipedSystem::new(additions.model, state)?;
    if additions.stops.is_some() && additions.model != BipedModel::Full {
        let what = "the full model, whose hinges can have stops,";
        return Err(SystemError::Unsupported { link: 1, what }.into());
    }
    biped.system = with_stops(biped.system, additions.stops.as_ref())?;
    if let Some(block) = &additions.block {
        let link = biped.system.links().len();
        biped = biped.with_link(block.link(), block.start())?;
        biped.system = biped.system.with_striker(block.striker(link))?;
    }
    Ok(biped)
}

fn orientation(state: &BodyState) -> Quaternion<f64> {
    Quaternion::from_array([state[3], state[4], state[5], state[6]])
}

/// Motors of a joint from the one body's side, in the order of the other's.
fn in_order(mut all: [f64; 3], count: usize, is_reversed: bool) -> [f64; 3] {
    if is_reversed {
        all[..count].reverse();
    }
    all
}

impl Plant for Variational {
    fn state(&mut self) -> Result<PlantState, StepFailure> {
        let (mut positions, mut velocities) = ([0.0; NQ], [0.0; NV]);
        let (link, central) = self.central;
        let body = self.simulation.state(link);
        let q = orientation(&body);
        let arm = q.rotate(central.position);
        let at = Vector3::new(body[0], body[1], body[2]) + arm;
        let turned = q.product(central.orientation);
        // A body twist of the central body, where the simulator has its link's centre of mass and world axes.
        let [v, omega] = self.twist()?;
        let to_body = turned.conjugate();
        velocities[..3].copy_from_slice(to_body.rotate(v + omega.cross(&arm)).as_slice());
        velocities[3..6].copy_from_slice(to_body.rotate(omega).as_slice());
        positions[..3].copy_from_slice(at.as_slice());
        positions[3..7].copy_from_slice(&turned.to_array());
        let mut rates = [0.0; MOST_COLUMNS];
        let observed = self.simulation.observed_rates()?;
        rates.iter_mut().zip(observed).for_each(|(rate, observed)| *rate = *observed);
        let mut next = 0;
        for Motors { seat, count } in &self.motors {
            let (angles, rates) = match *seat {
                Seat::Tree { link, is_reversed } => {
                    let own = &rates[self.simulation.columns(link)];
                    let own = std::array::from_fn(|i| own.get(i).copied().unwrap_or(0.0));
                    let told = |all| in_order(all, *count, is_reversed);
                    (told(self.simulation.angles(link)), told(own))
                }
                Seat::Closure { closure } => {
                    let rates = self.simulation.closing_rates(closure);
                    (self.simulation.closing_angles(closure), rates)
                }
            };
            positions[7 + next..][..*count].copy_from_slice(&angles[..*count]);
            velocities[6 + next..][..*count].copy_from_slice(&rates[..*count]);
            next += count;
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
        for Motors { seat, count } in &self.motors {
            let own = &torques[next..next + count];
            match *seat {
                Seat::Tree { link, is_reversed: false } => self.simulation.set_torques(link, own),
                Seat::Tree { link, is_reversed: true } => {
                    let all = std::array::from_fn(|i| own.get(i).copied().unwrap_or(0.0));
                    let all = in_order(all, *count, true);
                    self.simulation.set_torques(link, &all[..*count]);
                }
                Seat::Closure { closure } => self.simulation.set_closing_torques(closure, own),
            }
            next += count;
        }
        let Wrench { force, torque } = match load {
            Some(load) => self.on_link(load)?,
            None => Wrench::zero(),
        };
        self.simulation.set_wrench(self.central.0, force.into(), torque.into());
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
            potential_energy: potential_energy + self.still_energy,
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
