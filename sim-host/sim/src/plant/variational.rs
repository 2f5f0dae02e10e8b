//! A legged robot on the symplectic simulator of chapter 5, with all its bodies or lumped: the default plant.

use super::differences::Differences;
use super::joint_stops::with_stops;
use super::robot_model::RobotModel;
use super::robot_system::{Foot, Motors, RobotSystem};
use super::{
    BlockSample, Observation, PerPoint, Plant, PlantState, StepFailure, ThrownBlock, fill_contacts,
};
use crate::robot::Robot;
use nalgebra::Vector3;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_mechanics::integrators::Progress;
use surefoot_multibody::contact::{ContactState, Floor, GroundPlane, Switching};
use surefoot_multibody::{
    BodyState, Checkpoint, Frame, Seat, Simulation, Site, Stops, SystemError,
};

/// What a scene makes of the robot, and adds to it; nothing unless said, and then nothing of it is computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Additions {
    /// Which bodies the robot has.
    pub model: RobotModel,
    /// Ends of the joints' ways; they need the full model's hinges.
    pub stops: Option<Vec<Stops>>,
    /// A block that is thrown at it.
    pub block: Option<ThrownBlock>,
    /// The ground under each foot; z = 0 under all if there are none.
    pub planes: Vec<GroundPlane>,
    /// What the robot has otherwise than the model; in the full one only.
    pub differences: Differences,
}

/// A robot on a floor, or welded to it. Its step is that of its start.
#[derive(Clone, Debug)]
pub struct Variational {
    simulation: Simulation,
    motors: Vec<Motors>,
    feet: Vec<Foot>,
    /// How many contact points each foot has.
    points: Vec<usize>,
    /// Rates of all columns, when they were read last.
    rates: Vec<f64>,
    /// Link of the central body, and its frame in it.
    central: (usize, Frame),
    still_energy: f64,
    is_on_floor: bool,
    /// Its link.
    block: Option<usize>,
}

impl Variational {
    /// On a floor, with steps of `h` seconds; its feet have the robot's points.
    ///
    /// # Errors
    /// [`StepFailure::Dynamics`] for no configuration, [`StepFailure::System`] for a step or a floor that
    /// cannot be.
    pub fn on_floor(
        robot: &Robot,
        state: &PlantState,
        h: f64,
        floor: Floor,
        additions: &Additions,
    ) -> Result<Self, StepFailure> {
        let mut made = system(robot, state, additions)?;
        let of_feet = made.feet.iter().zip(&robot.feet).flat_map(|(foot, of)| {
            let Foot::Free(link, frame) = foot else { return Vec::new() };
            let site = |at| Site { link: *link, position: frame.point(at).into() };
            of.points.iter().map(|point| site(point.at)).collect()
        });
        let block = made.system.links().len() - 1;
        let of_block = additions.block.iter().flat_map(ThrownBlock::corners);
        let sites =
            of_feet.chain(of_block.map(|position| Site { link: block, position })).collect();
        made.system = made.system.on_floor(floor, Switching::WithinTheStep, sites)?;
        for (foot, plane) in made.feet.iter().zip(&additions.planes) {
            if let Foot::Free(link, _) = foot {
                made.system = made.system.on_plane(*link, *plane)?;
            }
        }
        Self::new(h, made, robot.points_of_feet(), additions)
    }

    /// With both feet held where they start: both legs hang from the world, and one joint closes the loop. A block
    /// falls without end, as there is no floor.
    ///
    /// # Errors
    /// As for [`Self::on_floor`].
    pub fn welded(
        robot: &Robot,
        state: &PlantState,
        h: f64,
        additions: &Additions,
    ) -> Result<Self, StepFailure> {
        Self::new(h, system(robot, state, additions)?.on_still_feet()?, Vec::new(), additions)
    }

    fn new(
        h: f64,
        made: RobotSystem,
        points: Vec<usize>,
        additions: &Additions,
    ) -> Result<Self, StepFailure> {
        let RobotSystem { system, states, rates, motors, feet, central, still_energy } = made;
        let is_on_floor = system.ground().is_some();
        let block = additions.block.map(|_| states.len() - 1);
        let floats = system.links()[central.0].joint.constraints() == 0;
        let mut simulation = Simulation::new(system, h, &states, &rates)?;
        if !floats {
            simulation = simulation.watching(central.0)?;
        }
        let rates = Vec::new();
        Ok(Self {
            simulation,
            motors,
            feet,
            points,
            rates,
            central,
            still_energy,
            is_on_floor,
            block,
        })
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Links of the joints in the order of torques, of those that are hinges of the tree.
    pub fn hinges(&self) -> Vec<usize> {
        let hinge = |motors: &Motors| match motors.seat {
            Seat::Tree { link, .. } if motors.count == 1 => Some(link),
            _ => None,
        };
        self.motors.iter().filter_map(hinge).collect()
    }

    /// Link of the central body, and its frame in it.
    pub fn central(&self) -> (usize, Frame) {
        self.central
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
    fn vertical(&self) -> Vec<f64> {
        if let Some(feet) = self.corner_forces() {
            let of_foot = |points: &Vec<[f64; 3]>| points.iter().map(|force| force[2]).sum();
            return feet.iter().map(of_foot).collect();
        }
        let progress = self.simulation.progress();
        // A node of the discrete trajectory bears half the weight of the step before, and half that of the next.
        let share = match progress.steps {
            0 => 0.0,
            1 => 0.5,
            _ => 1.0,
        };
        let of_foot = |foot: &Foot| match foot {
            Foot::Still(link, weight) => {
                self.simulation.world_impulse(*link)[2] / progress.h + share * weight
            }
            // Of a weld's constraints the third is the foot's height.
            Foot::Welded => self.simulation.loop_impulses()[2] / progress.h,
            Foot::Free(..) => 0.0,
        };
        self.feet.iter().map(of_foot).collect()
    }

    /// Forces of the floor on the points in the last step, N.
    fn corner_forces(&self) -> Option<PerPoint<[f64; 3]>> {
        let forces = self.simulation.contact_forces();
        self.is_on_floor.then(|| by_foot(forces, &self.points).map(<[_]>::to_vec).collect())
    }
}

/// What is of all feet's points, by foot; what comes after is of other bodies.
fn by_foot<'a, T>(
    all: &'a [T],
    points: &'a [usize],
) -> impl ExactSizeIterator<Item = &'a [T]> + use<'a, T> {
    let mut rest = all;
    points.iter().map(move |count| {
        let own;
        (own, rest) = rest.split_at(*count);
        own
    })
}

/// The robot with stops, and with a block as the last link.
fn system(
    robot: &Robot,
    state: &PlantState,
    additions: &Additions,
) -> Result<RobotSystem, StepFailure> {
    let Additions { model, differences, .. } = additions;
    let mut made = RobotSystem::new(robot, *model, state, differences)?;
    if additions.stops.is_some() && additions.model != RobotModel::Full {
        let what = "the full model, whose hinges can have stops,";
        return Err(SystemError::Unsupported { link: 1, what }.into());
    }
    made.system = with_stops(made.system, additions.stops.as_deref())?;
    if let Some(block) = &additions.block {
        let link = made.system.links().len();
        made = made.with_link(block.link(), block.start())?;
        made.system = made.system.with_striker(block.striker(link))?;
    }
    Ok(made)
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
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        let joints: usize = self.motors.iter().map(|motors| motors.count).sum();
        let PlantState { positions, velocities } = state;
        positions.resize(7 + joints, 0.0);
        velocities.resize(6 + joints, 0.0);
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
        self.rates.clear();
        self.rates.extend_from_slice(self.simulation.observed_rates()?);
        let mut next = 0;
        for Motors { seat, count } in &self.motors {
            let (angles, rates) = match *seat {
                Seat::Tree { link, is_reversed } => {
                    let own = &self.rates[self.simulation.columns(link)];
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
        Ok(())
    }

    /// Steps are of the length that the plant was made with; `step_s` must be that.
    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
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

    fn read_contacts(&self, contacts: &mut PerPoint<ContactState>) -> bool {
        if self.is_on_floor {
            let feet = by_foot(self.simulation.contacts(), &self.points);
            fill_contacts(feet.map(|points| points.iter().map(|point| point.state)), contacts);
        }
        self.is_on_floor
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
