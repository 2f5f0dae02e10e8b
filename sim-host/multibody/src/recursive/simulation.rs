//! A motion: what it is made of, and what can be asked of it.

use super::super::body::BodyState;
use super::super::system::{System, WORLD};
use super::super::system_error::SystemError;
use super::checkpoint::Checkpoint;
use super::coordinates::{Coordinates, Increment};
use super::driven_loops::DrivenLoop;
use super::elimination::Elimination;
use super::guess::Guess;
use super::held::Hold;
use super::loops::{Loops, MOST};
use super::motors::{Motors, Turned};
use super::node::{Kind, Node, Place, nodes};
use super::rates::angular_velocity;
use super::scales::Scales;
use super::step::project;
use super::stiffness::Pair;
use super::trial::{Loads, Trial};
use crate::contact::{BoxPoint, ContactPoint};
use nalgebra::Vector3;
use surefoot_mechanics::integrators::Progress;

/// A motion of a system.
#[derive(Clone, Debug)]
pub struct Simulation {
    pub(super) system: System,
    pub(super) nodes: Vec<Node>,
    /// Where it is, and where it was when the step began that is being made.
    pub(super) at: Checkpoint,
    pub(super) saved: Checkpoint,
    pub(super) splits: bool,
    pub(super) places: Vec<Place>,
    pub(super) loads: Loads,
    pub(super) motors: Vec<Motors>,
    pub(super) driven: Vec<DrivenLoop>,
    /// Links whose motion is observed, and links that hang from the world.
    pub(super) watched: Vec<usize>,
    pub(super) hanging: Vec<usize>,
    pub(super) scales: Scales,
    pub(super) trial: Trial,
    pub(super) base: Vec<Increment>,
    pub(super) base_multipliers: Vec<f64>,
    pub(super) corrections: Vec<f64>,
    pub(super) elimination: Elimination,
    pub(super) loops: Loops,
}

impl Simulation {
    /// From states and rates on the manifold, without spoiling the order.
    ///
    /// # Errors
    /// A [`SystemError`].
    pub fn new(
        system: System,
        h: f64,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Result<Self, SystemError> {
        if !(h > 0.0 && h.is_finite()) {
            return Err(SystemError::Step { h });
        }
        system.check_strikers()?;
        system.check_start(states, rates)?;
        let (nodes, columns) = nodes(&system);
        let coordinates: Vec<Coordinates> = system
            .links()
            .iter()
            .zip(states)
            .map(|(link, state)| {
                let inboard = link.inboard.map_or(&WORLD, |i| &states[i]);
                Node::coordinates(&link.joint, state, inboard)
            })
            .collect();
        let loops = Loops::new(&system, columns);
        if loops.len() > MOST {
            return Err(SystemError::TooManyLoops { constraints: loops.len(), most: MOST });
        }
        let trial = Trial::new(&system, &nodes, columns);
        let motors = Motors::all(&system, &nodes);
        let driven = DrivenLoop::all(&system);
        let at = Checkpoint {
            coordinates,
            momenta: vec![0.0; columns],
            last: [(); 2].map(|()| trial.increments.clone()),
            last_h: h,
            multipliers: vec![0.0; loops.len()],
            memories: vec![ContactPoint::default(); system.sites().len()],
            forces: vec![[0.0; 3]; system.sites().len()],
            strikes: vec![BoxPoint::default(); trial.strikes.last().map_or(0, |s| s.points.end)],
            strike_forces: vec![[0.0; 3]; trial.strikes.len()],
            turned: vec![Turned::default(); motors.len() + driven.len()],
            watched: Vec::new(),
            holds: Vec::new(),
            fastest: system.gravity().abs() * h,
            guess: Guess::new(columns),
            progress: Progress::new(h),
        };
        let mut simulation = Self {
            scales: Scales::new(&system, &nodes, &at.coordinates, columns),
            saved: at.clone(),
            at,
            splits: true,
            places: vec![Place::world(); nodes.len()],
            motors,
            driven,
            watched: Vec::new(),
            hanging: Vec::new(),
            loads: Loads { torques: vec![0.0; columns], wrenches: vec![Pair::ZERO; nodes.len()] },
            base: trial.increments.clone(),
            base_multipliers: vec![0.0; loops.len()],
            trial,
            corrections: vec![0.0; columns],
            elimination: Elimination::new(nodes.len(), columns, system.strikers().len()),
            loops,
            nodes,
            system,
        };
        simulation.hanging = simulation.hanging();
        simulation.at.holds = vec![Hold::NOTHING; simulation.hanging.len()];
        simulation.saved.holds = simulation.at.holds.clone();
        simulation.find_places();
        if let Some(link) = simulation.locked() {
            return Err(SystemError::GimbalLock { link });
        }
        simulation.set_rates(rates);
        Ok(simulation)
    }

    /// The same with steps that fail at once, instead of being made in shorter ones.
    #[must_use]
    pub fn without_splitting(mut self) -> Self {
        self.splits = false;
        self
    }

    /// The same motion from here on, in steps of another length, as of time zero.
    #[must_use]
    pub fn in_steps_of(&self, h: f64) -> Self {
        let mut other = self.clone();
        other.at.progress = Progress::new(h);
        other
    }

    /// Whether motors or wrenches are held.
    pub fn is_driven(&self) -> bool {
        let in_loops = || self.driven.iter().any(|driven| driven.torques != [0.0; 3]);
        self.loads.torques.iter().any(|torque| *torque != 0.0)
            || self.loads.wrenches.iter().any(|wrench| *wrench != Pair::ZERO)
            || in_loops()
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Time and statistics.
    pub fn progress(&self) -> &Progress {
        &self.at.progress
    }

    /// What Newton's method solves for: velocities and loops' constraints.
    pub fn unknowns(&self) -> usize {
        self.at.momenta.len() + self.loops.len()
    }

    /// All that is needed to go on from here.
    pub fn checkpoint(&self) -> &Checkpoint {
        &self.at
    }

    /// Goes on from a checkpoint of the same system and step. Torques and wrenches stay as they are set.
    ///
    /// # Errors
    /// [`SystemError::OtherCheckpoint`].
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), SystemError> {
        if !checkpoint.fits(&self.at) {
            return Err(SystemError::OtherCheckpoint);
        }
        self.at.copy_from(checkpoint);
        self.find_places();
        Ok(())
    }

    /// Holds a torque (N·m) in a revolute joint, or a force (N) in a prismatic one, until it is set again.
    /// Other joints have no motor.
    pub fn set_torque(&mut self, link: usize, torque: f64) {
        if matches!(self.nodes[link].kind, Kind::Revolute | Kind::Prismatic) {
            self.loads.torques[self.nodes[link].columns.start] = torque;
        }
    }

    /// Holds a force (N) on a body's centre of mass and a torque (N·m), world frame, until set again.
    pub fn set_wrench(&mut self, link: usize, force: [f64; 3], torque: [f64; 3]) {
        self.loads.wrenches[link] = Pair { linear: force.into(), angular: torque.into() };
        self.measure_wrenches();
    }

    pub(super) fn find_places(&mut self) {
        let world = Place::world();
        for k in 0..self.nodes.len() {
            let node = &self.nodes[k];
            let inboard = node.inboard.map_or(&world, |i| &self.places[i]);
            self.places[k] = node.place(&self.at.coordinates[k], inboard);
        }
        for motors in &mut self.motors {
            let inboard = self.nodes[motors.link].inboard.map_or(&world, |i| &self.places[i]);
            motors.find(self.at.coordinates[motors.link].orientation, inboard);
        }
        for driven in &mut self.driven {
            driven.find(&self.places);
        }
    }

    /// A link whose motors are locked: the middle one of three is near a quarter turn.
    pub(super) fn locked(&self) -> Option<usize> {
        let in_tree = self.motors.iter().find(|motors| motors.is_locked());
        let in_loops = || self.driven.iter().find_map(DrivenLoop::locked);
        in_tree.map(|motors| motors.link).or_else(in_loops)
    }

    /// Momenta of these rates, and a first guess of the increments.
    fn set_rates(&mut self, rates: &[BodyState]) {
        for (k, rate) in rates.iter().enumerate() {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let omega = angular_velocity(rate, place);
            let v = Vector3::new(rate[0], rate[1], rate[2]);
            self.at.fastest = self.at.fastest.max(v.abs().max());
            let linear = v * node.mass;
            let angular = place.inertia * omega + place.to_center.cross(&linear);
            self.trial.ends[k].all = Pair { linear, angular };
        }
        let mut of_rotors = vec![0.0; self.at.momenta.len()];
        if self.trial.laws.iter().any(|law| law.law.rotor_inertia != 0.0) {
            let states = self.states();
            for law in &self.trial.laws {
                let rate = self.system.joint_rate(law.node, &states, rates);
                of_rotors[law.column] += law.law.rotor_inertia * rate;
            }
        }
        self.gather_momenta(|c| of_rotors[c]);
        self.note_momenta();
        let h = self.at.progress.h;
        let turning: Vec<Vector3<f64>> =
            rates.iter().zip(&self.places).map(|(v, x)| angular_velocity(v, x)).collect();
        let of_loops = &mut self.at.turned[self.motors.len()..];
        for (driven, turned) in self.driven.iter().zip(of_loops) {
            *turned = driven.start(&turning, h);
        }
        // A singular inertia is the first step's to report.
        if self.column_rates().is_ok() {
            for (k, node) in self.nodes.iter().enumerate() {
                let by = &self.corrections[node.columns.clone()];
                self.at.last[0][k] = node.corrected(&Increment::NONE, by, h);
                self.at.last[1][k] = self.at.last[0][k];
            }
            self.at.guess.start(&self.nodes, &self.at.last[0]);
            for (motors, turned) in self.motors.iter().zip(&mut self.at.turned) {
                motors.tell_rates(&mut self.corrections);
                let c = motors.column;
                let step = std::array::from_fn(|i| self.corrections[c + i] * h);
                *turned = Turned::start(motors.angles(), step);
            }
        }
    }

    /// Momenta of columns from those of bodies, which the trial's ends hold, and `own` of columns.
    pub(super) fn gather_momenta(&mut self, own: impl Fn(usize) -> f64) {
        for k in (0..self.nodes.len()).rev() {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let all = self.trial.ends[k].all;
            let (momenta, first) = (&mut self.at.momenta, node.columns.start);
            project(node, place, &all, &mut |c, along| {
                momenta[first + c] = along + own(first + c);
            });
            if let Some(inboard) = node.inboard {
                self.trial.ends[inboard].all.add_shifted(&all, &place.from_inboard);
            }
        }
    }
}
