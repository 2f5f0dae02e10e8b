//! The differential equations, and the way back to the manifold of the constraints.

use super::super::body::BodyState;
use super::super::closure::Closing;
use super::super::joint_law::JointLaw;
use super::super::planar_loops::{InPlane, planar_loops};
use super::super::system::{System, WORLD};
use super::super::system_error::SystemError;
use super::joint;
use super::kinematics::Kinematics;
use super::mass::Mass;
use super::rows::{Row, rows};
use super::solve::{Constraints, independent};
use nalgebra::Vector3;
use surefoot::dynamics::DynamicsFault;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::newton::NewtonFailure;

/// Why there are no such equations.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum JointSpaceFault {
    /// The start is none.
    #[error(transparent)]
    System(#[from] SystemError),
    /// They are not made for this.
    #[error("the equations in joint coordinates take {0} only")]
    NotFor(&'static str),
}

/// A law, its coordinate and its velocity.
#[derive(Clone, Copy, Debug)]
struct Law {
    link: usize,
    at: (usize, usize),
    law: JointLaw,
}

/// Differential equations of a system in joint coordinates.
#[derive(Clone, Debug)]
pub struct JointSpace {
    system: System,
    /// Where the coordinates and velocities of each link begin.
    starts: Vec<(usize, usize)>,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    torques: Vec<f64>,
    laws: Vec<Law>,
    /// Constraints of this step: those that no others imply.
    chosen: Vec<usize>,
    /// Loops in which everything moves in a plane, by closure.
    planar: Vec<Option<InPlane>>,
    /// m
    length: f64,
}

/// Largest error of a constraint at the start, of its rate too, over the size of the system and its speed.
const AT_START: f64 = 1e-8;
/// Steps towards the manifold at most.
const MOST_PROJECTIONS: usize = 10;
/// Errors of positions that are none, over the system's size: rounding of coordinates that are sums along a loop.
const CLOSED: f64 = 4e-15;
/// Errors that are not closed after all steps, over the system's size.
const OPEN: f64 = 1e-9;

impl JointSpace {
    /// From states and rates of all bodies, with torques held in joints by link.
    ///
    /// # Errors
    /// A [`JointSpaceFault`].
    pub fn new(
        system: System,
        states: &[BodyState],
        rates: &[BodyState],
        torques: &[f64],
    ) -> Result<Self, JointSpaceFault> {
        system.check_start(states, rates)?;
        refused(&system).map_or(Ok(()), |takes| Err(JointSpaceFault::NotFor(takes)))?;
        let still: BodyState = [0.0; 7];
        let (mut positions, mut velocities) = (Vec::new(), Vec::new());
        let mut starts = Vec::with_capacity(states.len());
        for (k, link) in system.links().iter().enumerate() {
            starts.push((positions.len(), velocities.len()));
            let inboard = link.inboard.map_or((&WORLD, &still), |i| (&states[i], &rates[i]));
            let into = (&mut positions, &mut velocities);
            joint::start(&link.joint, (&states[k], &rates[k]), inboard, into);
        }
        let mut held = vec![0.0; velocities.len()];
        for (link, torque) in torques.iter().enumerate().filter(|(_, torque)| **torque != 0.0) {
            if let Some(held) = held.get_mut(starts[link].1) {
                *held = *torque;
            }
        }
        let laws = system.laws().iter();
        let laws = laws.map(|(link, law)| Law { link: *link, at: starts[*link], law: *law });
        let (laws, length) = (laws.collect(), system.length());
        let planar = planar_loops(&system, states);
        let mut all = Self {
            system,
            starts,
            positions,
            velocities,
            torques: held,
            laws,
            chosen: Vec::new(),
            planar,
            length,
        };
        all.check_rolling()?;
        let (mut q, mut u) = (all.positions.clone(), all.velocities.clone());
        all.settle(&mut q, &mut u)
            .map_err(|_| SystemError::OpenLoop { closure: 0, value: OPEN })?;
        (all.positions, all.velocities) = (q, u);
        Ok(all)
    }

    /// What rolls must begin on its plane, and roll.
    fn check_rolling(&self) -> Result<(), SystemError> {
        let now = self.at(&self.positions, &self.velocities);
        let all = rows(&self.system, &self.planar, &now);
        let fastest = now.bodies.iter().fold(0.0_f64, |m, b| m.max(b.velocity.norm()));
        let first = all.len() - 3 * self.system.rolling().len();
        for (k, row) in all[first..].iter().enumerate() {
            let value = (row.error.abs() / self.length)
                .max(row.rate(&self.velocities).abs() / (fastest + self.length));
            if !(value <= AT_START) {
                return Err(SystemError::Slips { rolling: k / 3, value });
            }
        }
        Ok(())
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Positions and velocities at the start.
    pub fn start(&self) -> (&[f64], &[f64]) {
        (&self.positions, &self.velocities)
    }

    fn at(&self, q: &[f64], u: &[f64]) -> Kinematics {
        Kinematics::of(&self.system, &self.starts, q, u)
    }

    fn mass(&self, now: &Kinematics) -> Result<Mass, DynamicsFault> {
        let rotors = self.laws.iter().map(|law| (law.at.1, law.law.rotor_inertia));
        Mass::factored(&self.system, now, rotors)
            .map_err(|joint| DynamicsFault::SingularInertia { joint })
    }

    /// `u̇` of (1).
    ///
    /// # Errors
    /// A [`DynamicsFault`].
    ///
    /// # Cost
    /// Linear in bodies and in loops, times the tree's depth and the loops' breadth.
    pub fn accelerations(&self, q: &[f64], u: &[f64]) -> Result<Vec<f64>, DynamicsFault> {
        let now = self.at(q, u);
        let mass = self.mass(&now)?;
        let mut z = self.forces(&now, q, u);
        mass.transposed(&mut z, (0..u.len()).rev());
        if !self.chosen.is_empty() {
            let all = rows(&self.system, &self.planar, &now);
            let constraints = Constraints::new(&all, &self.chosen, &mass, u.len());
            let rest: Vec<f64> = self.chosen.iter().map(|k| -all[*k].rest).collect();
            constraints.meet(&rest, &mut z);
        }
        mass.solve(&mut z);
        match z.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(DynamicsFault::ResultNotFinite { index }),
            None => Ok(z),
        }
    }

    /// Rates of positions.
    pub fn position_rates(&self, q: &[f64], u: &[f64], to: &mut [f64]) {
        for (k, (first_q, first_u)) in self.starts.iter().enumerate() {
            let next = self.starts.get(k + 1).copied().unwrap_or((q.len(), u.len()));
            let constraint = &self.system.links()[k].joint.constraint;
            let (q, u) = (&q[*first_q..next.0], &u[*first_u..next.1]);
            joint::rates(constraint, q, u, &mut to[*first_q..next.0]);
        }
    }

    /// `Q`, with what the bodies' accelerations where `u̇ = 0` take.
    fn forces(&self, now: &Kinematics, q: &[f64], u: &[f64]) -> Vec<f64> {
        let mut all = self.torques.clone();
        let weight = Vector3::new(0.0, 0.0, -self.system.gravity());
        for (k, (link, body)) in self.system.links().iter().zip(&now.bodies).enumerate() {
            let inertia = Vector3::from(link.body.inertia);
            let spun = |v: Vector3<f64>| {
                body.turn.rotate(inertia.component_mul(&body.turn.conjugate().rotate(v)))
            };
            let force = (weight - body.acceleration) * link.body.mass;
            let torque = -body.omega.cross(&spun(body.omega)) - spun(body.alpha);
            for i in now.path(Some(k)) {
                let dof = &now.dofs[i];
                all[i] += force.dot(&dof.velocity_of(&body.center)) + torque.dot(&dof.angular);
            }
        }
        for Law { at: (of_q, of_u), law, .. } in &self.laws {
            let (angle, rate) = (q[*of_q], u[*of_u]);
            let spring = law.stiffness * (angle - law.rest) + law.damping * rate;
            all[*of_u] -= spring + law.rubbed(rate).0;
        }
        for spring in self.system.springs() {
            let [a, b] = spring.ends.map(|end| {
                let body = now.body(end.link);
                let arm = body.turn.rotate(end.point.into());
                (body.center + arm, body.velocity_at(&arm))
            });
            let apart = b.0 - a.0;
            let length = apart.norm();
            // Points that meet have no line between them, and a force of no direction.
            if !(length > 0.0) {
                continue;
            }
            let along = apart / length;
            let force = along * spring.pull(length, along.dot(&(b.1 - a.1)));
            for (end, point, force) in [(spring.ends[0], a.0, force), (spring.ends[1], b.0, -force)]
            {
                for i in now.path(end.link) {
                    all[i] += force.dot(&now.dofs[i].velocity_of(&point));
                }
            }
        }
        all
    }

    /// Brings coordinates and velocities to the manifold, along the least kinetic energy, and finds the constraints
    /// that no others imply for the step that begins there.
    ///
    /// # Errors
    /// [`NewtonFailure::NoRootNearby`] where the loops cannot be closed, [`DynamicsFault`] without inertia.
    pub fn settle(&mut self, q: &mut [f64], u: &mut [f64]) -> Result<(), SettleFault> {
        self.normalize(q);
        if self.system.closures().is_empty() && self.system.rolling().is_empty() {
            return Ok(());
        }
        for tried in 0..=MOST_PROJECTIONS {
            let now = self.at(q, u);
            let mass = self.mass(&now)?;
            let all = rows(&self.system, &self.planar, &now);
            self.chosen = independent(&all, &mass, u.len());
            let constraints = Constraints::new(&all, &self.chosen, &mass, u.len());
            let right = |of: fn(&Row, &[f64]) -> f64| -> Vec<f64> {
                self.chosen.iter().map(|k| -of(&all[*k], u)).collect()
            };
            let size = |of: &[f64]| of.iter().fold(0.0_f64, |m, e| m.max(e.abs())) / self.length;
            let errors = right(|row, _| row.error);
            let worst = size(&errors);
            if worst <= CLOSED || (tried == MOST_PROJECTIONS && worst <= OPEN) {
                let mut z = vec![0.0; u.len()];
                constraints.meet(&right(Row::rate), &mut z);
                mass.solve(&mut z);
                u.iter_mut().zip(&z).for_each(|(u, z)| *u += z);
                return Ok(());
            }
            if !(worst.is_finite() && tried < MOST_PROJECTIONS) {
                return Err(NewtonFailure::NoRootNearby { residual: worst }.into());
            }
            let mut z = vec![0.0; u.len()];
            constraints.meet(&errors, &mut z);
            mass.solve(&mut z);
            let mut change = vec![0.0; q.len()];
            self.position_rates(q, &z, &mut change);
            q.iter_mut().zip(&change).for_each(|(q, change)| *q += change);
            self.normalize(q);
        }
        Ok(())
    }

    fn normalize(&self, q: &mut [f64]) {
        for (link, (first, _)) in self.system.links().iter().zip(&self.starts) {
            if let Some(at) = joint::quaternion(&link.joint.constraint) {
                let q = &mut q[first + at..first + at + 4];
                let norm = q.iter().map(|q| q * q).sum::<f64>().sqrt();
                q.iter_mut().for_each(|q| *q /= norm);
            }
        }
    }

    /// States and rates of all bodies.
    pub fn bodies(&self, q: &[f64], u: &[f64]) -> (Vec<BodyState>, Vec<BodyState>) {
        let now = self.at(q, u);
        let both = |x: Vector3<f64>, q: Quaternion<f64>| [x.x, x.y, x.z, q.s, q.v.x, q.v.y, q.v.z];
        let each = now.bodies.iter().map(|body| {
            let own = body.turn.conjugate().rotate(body.omega);
            (both(body.center, body.turn), both(body.velocity, body.turn.rate(own)))
        });
        each.unzip()
    }

    /// Where the joint of a link with a law is, rad or m.
    pub fn angle(&self, link: usize, q: &[f64]) -> f64 {
        let law = self.laws.iter().find(|law| law.link == link);
        law.map_or(0.0, |law| q[law.at.0])
    }
}

/// Why there is no way back to the manifold.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SettleFault {
    /// Loops stay open.
    #[error(transparent)]
    Newton(#[from] NewtonFailure),
    /// There is no inertia.
    #[error("{0}")]
    Dynamics(#[from] DynamicsFault),
}

/// What these equations take, where they do not take a system.
fn refused(system: &System) -> Option<&'static str> {
    if system.ground().is_some() || !system.strikers().is_empty() {
        return Some("bodies that touch nothing");
    }
    if system.laws().iter().any(|(_, law)| law.stops.is_some()) {
        return Some("joints without stops");
    }
    if !system.gimbals().is_empty() || !system.closing_motors().is_empty() {
        return Some("joints without motors of their own");
    }
    if system.closures().iter().any(|c| matches!(c.closing, Closing::General(_))) {
        return Some("loops that joints close");
    }
    let possible = |[a, b, c]: [f64; 3]| a + b >= c && b + c >= a && c + a >= b;
    if !system.links().iter().all(|link| possible(link.body.inertia)) {
        return Some("inertias that bodies can have");
    }
    None
}
