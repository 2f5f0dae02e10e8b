//! A planar motion: what it is made of, and what can be asked of it.

use super::super::body::BodyState;
use super::super::joint_law::JointLaw;
use super::super::recursive::Simulation;
use super::super::stepping::make_step;
use super::super::system::System;
use super::super::system_error::SystemError;
use super::algebra::{Pair, Turn, cross};
use super::checkpoint::{PAST, PlanarCheckpoint};
use super::elimination::Elimination;
use super::node::{Coordinates, Kind, Node, Place, nodes};
use super::not_planar::PlanarError;
use super::plane::{Body, Plane};
use super::scales::Scales;
use super::step::{End, project};
use super::touch::{Touch, of_link, touches};
use crate::contact::ContactPoint;
use nalgebra::{Vector2, Vector3};
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::{Progress, StepError};

/// A joint's law.
#[derive(Clone, Copy, Debug)]
pub(super) struct Law {
    pub node: usize,
    pub column: usize,
    pub law: JointLaw,
    /// Whether its angle counts about the plane's normal, or against it.
    pub sign: f64,
}

/// What a body was at the start, and the plane does not know.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside {
    /// Of its centre of mass along the normal, m.
    pub along: f64,
    pub orientation: Quaternion<f64>,
}

/// A motion of a system in a plane.
#[derive(Clone, Debug)]
pub struct PlanarSimulation {
    pub(super) system: System,
    pub(super) plane: Plane,
    pub(super) nodes: Vec<Node>,
    pub(super) beside: Vec<Beside>,
    /// By column: whether it is a turn.
    pub(super) turns: Vec<bool>,
    /// What gravity does to the momentum of a kilogram in a second.
    pub(super) gravity: Vector2<f64>,
    pub(super) laws: Vec<Law>,
    /// Where it is, and where it was when the step began that is being made.
    pub(super) at: PlanarCheckpoint,
    pub(super) saved: PlanarCheckpoint,
    pub(super) places: Vec<Place>,
    /// By column, N·m or N, as the plane counts.
    pub(super) torques: Vec<f64>,
    pub(super) scales: Scales,
    pub(super) touches: Vec<Touch>,
    /// By contact site of the system: the touch that it is part of, and its memory.
    pub(super) part_of: Vec<usize>,
    pub(super) contacts: Vec<ContactPoint>,
    /// The trial: tangents of half the turns and ways, by column, and the base of Newton's step.
    pub(super) increments: Vec<f64>,
    pub(super) base: Vec<f64>,
    pub(super) corrections: Vec<f64>,
    pub(super) ends: Vec<End>,
    /// By column: `½h τ`, and its derivative.
    pub(super) own_impulses: Vec<f64>,
    pub(super) own_slopes: Vec<f64>,
    pub(super) elimination: Elimination,
}

impl PlanarSimulation {
    /// From states and rates on the manifold, as [`Simulation::new`] takes them.
    ///
    /// # Errors
    /// A [`PlanarError`]: also where the motion does not stay in a plane, with the reason.
    pub fn new(
        system: System,
        h: f64,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Result<Self, PlanarError> {
        // It checks the start, and knows joints' angles.
        let whole = Simulation::new(system, h, states, rates)?;
        let (states, system) = (whole.states(), whole.system().clone());
        let plane = Plane::of(&system, &states, rates)?;
        let (touches, part_of) = touches(&system, &plane, &states);
        let (nodes, columns) = nodes(&system, &plane, &states, |link| of_link(&touches, link));
        let law = |(link, law): &(usize, JointLaw)| {
            let Node { column, sense, .. } = nodes[*link];
            Law { node: *link, column, law: *law, sign: sense }
        };
        let laws: Vec<Law> = system.laws().iter().map(law).collect();
        let down = Vector3::new(0.0, 0.0, -system.gravity());
        let at = PlanarCheckpoint {
            coordinates: vec![Coordinates::START; nodes.len()],
            angles: laws.iter().map(|law| whole.angle(law.node)).collect(),
            momenta: vec![0.0; columns],
            last: [(); PAST].map(|()| vec![0.0; columns]),
            last_h: h,
            memories: vec![ContactPoint::default(); touches.len()],
            forces: vec![[0.0; 3]; touches.len()],
            progress: Progress::new(h),
        };
        let beside = states.iter().map(|x| {
            let body = Body::of(x, &[0.0; 7]);
            Beside { along: body.center.dot(&plane.normal), orientation: body.orientation }
        });
        let kinds =
            || nodes.iter().flat_map(|node| (0..node.kind.columns()).map(move |c| (node.kind, c)));
        let mut planar = Self {
            plane,
            beside: beside.collect(),
            turns: kinds().map(|(kind, c)| kind == Kind::Revolute || c == 2).collect(),
            gravity: plane.seen(&down),
            laws,
            saved: at.clone(),
            at,
            places: vec![Place::WORLD; nodes.len()],
            torques: vec![0.0; columns],
            scales: Scales::new(&system, &nodes, columns),
            contacts: vec![ContactPoint::default(); part_of.len()],
            touches,
            part_of,
            increments: vec![0.0; columns],
            base: vec![0.0; columns],
            corrections: vec![0.0; columns],
            ends: vec![End::AT_REST; nodes.len()],
            own_impulses: vec![0.0; columns],
            own_slopes: vec![0.0; columns],
            elimination: Elimination::new(nodes.len(), columns),
            nodes,
            system,
        };
        planar.find_places();
        planar.set_rates(&states, rates);
        Ok(planar)
    }

    /// One step. Where its equations have no solution nearby it is made in 2, 4, … 64 shorter ones.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    ///
    /// # Cost
    /// Linear in the number of links for each Newton iteration; no allocation.
    pub fn step(&mut self) -> Result<(), StepError> {
        make_step(self)
    }

    /// The same motion from here on, in steps of another length, as of time zero.
    #[must_use]
    pub fn in_steps_of(&self, h: f64) -> Self {
        let mut other = self.clone();
        other.at.progress = Progress::new(h);
        other
    }

    /// Whether motors are held.
    pub fn is_driven(&self) -> bool {
        self.torques.iter().any(|torque| *torque != 0.0)
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The plane.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Time and statistics.
    pub fn progress(&self) -> &Progress {
        &self.at.progress
    }

    /// What Newton's method solves for.
    pub fn unknowns(&self) -> usize {
        self.at.momenta.len()
    }

    /// All that is needed to go on from here.
    pub fn checkpoint(&self) -> &PlanarCheckpoint {
        &self.at
    }

    /// Goes on from a checkpoint of the same system, start and step. Torques stay as they are set.
    ///
    /// # Errors
    /// [`SystemError::OtherCheckpoint`].
    pub fn restore(&mut self, checkpoint: &PlanarCheckpoint) -> Result<(), SystemError> {
        if !checkpoint.fits(&self.at) {
            return Err(SystemError::OtherCheckpoint);
        }
        self.at.copy_from(checkpoint);
        self.find_places();
        self.tell_contacts();
        Ok(())
    }

    /// Holds a torque (N·m) in a revolute joint, or a force (N) in a prismatic one, until it is set again. Other
    /// joints have no motor.
    pub fn set_torque(&mut self, link: usize, torque: f64) {
        let Node { kind, column, sense, .. } = self.nodes[link];
        if matches!(kind, Kind::Revolute | Kind::Prismatic) {
            self.torques[column] = sense * torque;
        }
    }

    /// Memories of the contact sites, in the system's order; anchors in the plane's axes.
    pub fn contacts(&self) -> &[ContactPoint] {
        &self.contacts
    }

    /// Mean forces on the contact sites in the last step, N, world frame; allocates.
    pub fn contact_forces(&self) -> Vec<[f64; 3]> {
        self.part_of.iter().map(|part| self.at.forces[*part]).collect()
    }

    pub(super) fn tell_contacts(&mut self) {
        for (contact, part) in self.contacts.iter_mut().zip(&self.part_of) {
            *contact = self.at.memories[*part];
        }
    }

    pub(super) fn find_places(&mut self) {
        for k in 0..self.nodes.len() {
            let node = &self.nodes[k];
            let inboard = node.inboard.map_or(Place::WORLD, |i| self.places[i]);
            self.places[k] = node.place(&self.at.coordinates[k], &inboard);
        }
    }

    /// Momenta of these rates, and a first guess of the increments.
    fn set_rates(&mut self, states: &[BodyState], rates: &[BodyState]) {
        for (k, (x, v)) in states.iter().zip(rates).enumerate() {
            let (node, place, body) = (&self.nodes[k], &self.places[k], Body::of(x, v));
            let velocity = self.plane.seen(&body.velocity);
            let linear = velocity * node.mass;
            let spin = node.moment * body.omega.dot(&self.plane.normal);
            self.ends[k].all = Pair { linear, angular: spin + cross(&place.to_center, &linear) };
        }
        self.own_impulses.fill(0.0);
        for Law { node, column, law, sign } in &self.laws {
            if law.rotor_inertia != 0.0 {
                let rate = self.system.joint_rate(*node, states, rates);
                self.own_impulses[*column] += sign * law.rotor_inertia * rate;
            }
        }
        self.gather_momenta();
        let h = self.at.progress.h;
        // A singular inertia is the first step's to report.
        if self.column_rates().is_ok() {
            let each = self.corrections.iter().zip(&self.turns);
            for (c, (rate, is_turn)) in each.enumerate() {
                let way = if *is_turn { 0.5 * rate * h } else { rate * h };
                self.at.last.iter_mut().for_each(|last| last[c] = way);
            }
        }
    }

    /// Momenta of columns from those of bodies, which the trial's ends hold, and own impulses.
    pub(super) fn gather_momenta(&mut self) {
        for k in (0..self.nodes.len()).rev() {
            let (node, place, all) = (&self.nodes[k], &self.places[k], self.ends[k].all);
            let (momenta, own) = (&mut self.at.momenta, &self.own_impulses);
            project(node, place, &all, &mut |c, along| {
                momenta[c] = along + own[c];
            });
            if let Some(inboard) = node.inboard {
                self.ends[inboard].all.add_shifted(&all, &place.from_inboard);
            }
        }
    }

    /// Orientation since the start.
    pub(super) fn turn(&self, link: usize) -> Turn {
        self.places[link].turn
    }
}
