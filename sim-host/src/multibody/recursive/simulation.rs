//! A motion, step by step.

use super::super::body::BodyState;
use super::super::system::{System, SystemError, WORLD};
use super::elimination::Elimination;
use super::loops::{Loops, MOST};
use super::node::{Coordinates, Increment, Kind, Node, Place, nodes};
use super::stiffness::Pair;
use super::step::{Loads, Step, Trial, project};
use super::turn::Turn;
use crate::contact::ContactPoint;
use crate::integrators::{Progress, StepError, StepFailure};
use crate::newton::NewtonFailure;
use nalgebra::Vector3;

/// A motion of a system.
#[derive(Clone, Debug)]
pub struct Simulation {
    system: System,
    nodes: Vec<Node>,
    /// Where all joints are, their momenta by column, and the increments of the last two steps, from which
    /// Newton's method begins the next.
    coordinates: Vec<Coordinates>,
    momenta: Vec<f64>,
    last: [Vec<Increment>; 2],
    places: Vec<Place>,
    loads: Loads,
    /// What a unit of speed is in a column's momentum.
    weights: Vec<f64>,
    /// Largest speed so far, m/s.
    fastest: f64,
    trial: Trial,
    base: Vec<Increment>,
    base_multipliers: Vec<f64>,
    corrections: Vec<f64>,
    elimination: Elimination,
    loops: Loops,
    progress: Progress,
}

/// Newton steps at most.
const MOST_ITERATIONS: u32 = 40;
/// Halvings of a Newton step at most.
const MOST_HALVINGS: u32 = 12;
/// Residuals, relative to their terms, that count as a root once they fall no further.
const TOLERANCE: f64 = 1e-10;
/// Residuals that count as a root at once.
const ROUND_OFF: f64 = 2e-15;
/// While residuals fall by this in an iteration, the elimination is used again.
const FAST: f64 = 1e-2;
/// Cosine of half the angle by which a body may turn in a step: beyond a quarter turn (2.51) folds.
const LEAST_TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;

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
        let mut simulation = Self {
            weights: weights(&system, &nodes, columns),
            coordinates,
            momenta: vec![0.0; columns],
            last: [(); 2].map(|()| vec![Increment::NONE; nodes.len()]),
            places: vec![Place::world(); nodes.len()],
            loads: Loads { torques: vec![0.0; columns], wrenches: vec![Pair::ZERO; nodes.len()] },
            fastest: system.gravity().abs() * h,
            base: trial.increments.clone(),
            base_multipliers: vec![0.0; loops.len()],
            trial,
            corrections: vec![0.0; columns],
            elimination: Elimination::new(nodes.len(), columns),
            loops,
            progress: Progress::new(h),
            nodes,
            system,
        };
        simulation.find_places();
        simulation.set_rates(rates);
        Ok(simulation)
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Time and statistics.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// What Newton's method solves for: velocities and loops' constraints.
    pub fn unknowns(&self) -> usize {
        self.momenta.len() + self.loops.len()
    }

    /// A body's state.
    pub fn state(&self, link: usize) -> BodyState {
        let place = &self.places[link];
        let [s, x, y, z] = place.orientation.to_array();
        [place.center.x, place.center.y, place.center.z, s, x, y, z]
    }

    /// All bodies' states.
    pub fn states(&self) -> Vec<BodyState> {
        (0..self.nodes.len()).map(|k| self.state(k)).collect()
    }

    /// Angle of a joint, rad; the way of a prismatic one, m; the first of a universal one. Zero for others.
    pub fn angle(&self, link: usize) -> f64 {
        self.coordinates[link].angles[0]
    }

    /// Holds a torque (N·m) in a revolute joint, or a force (N) in a prismatic one, until it is set again.
    pub fn set_torque(&mut self, link: usize, torque: f64) {
        if let Some(column) = self.nodes[link].columns.clone().next()
            && matches!(self.nodes[link].kind, Kind::Revolute | Kind::Prismatic)
        {
            self.loads.torques[column] = torque;
        }
    }

    /// Holds a force (N) on a body's centre of mass and a torque (N·m), world frame, until set again.
    pub fn set_wrench(&mut self, link: usize, force: [f64; 3], torque: [f64; 3]) {
        self.loads.wrenches[link] = Pair { linear: force.into(), angular: torque.into() };
    }

    /// Memories of the contact sites, in the system's order.
    pub fn contacts(&self) -> impl Iterator<Item = &ContactPoint> {
        self.trial.touches.iter().map(|touch| &touch.memory)
    }

    /// Mean forces on the contact sites in the last step, N, world frame.
    pub fn contact_forces(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        self.trial.touches.iter().map(|touch| touch.force.force)
    }

    /// Velocities that belong to the momentum, by column: of joints, rad/s or m/s; of a floating body, of
    /// its centre of mass and its angular velocity, world frame.
    ///
    /// # Errors
    /// A [`StepError`] where the inertia is singular.
    pub fn column_rates(&mut self) -> Result<&[f64], StepError> {
        // For a step of no length impulses are momenta, and motions are velocities.
        let h = self.progress.h;
        self.trial.increments.fill(Increment::NONE);
        for k in 0..self.nodes.len() {
            let place = &self.places[k];
            let end = &mut self.trial.ends[k];
            end.turn = Turn::NONE;
            end.to_center = place.to_center;
            end.from_inboard = place.from_inboard;
            end.axes = place.axes;
            end.inertia_turn = Vector3::zeros();
        }
        for touch in &mut self.trial.touches {
            touch.force.slope = nalgebra::Matrix3::zeros();
        }
        self.trial.own_slopes.fill(0.0);
        let Self { elimination, nodes, places, trial, momenta, corrections, loops, .. } = self;
        elimination
            .factor(nodes, places, trial, h)
            .map_err(|joint| singular(&self.progress, joint))?;
        elimination.solve(nodes, |_| Pair::ZERO, |c| momenta[c], corrections);
        if !loops.is_empty() {
            loops.begin(self.system.closures(), places);
            loops.stand_still();
            loops.factor(nodes, elimination);
            elimination.solve(nodes, |_| Pair::ZERO, |c| momenta[c], corrections);
            loops.correct(elimination, corrections);
        }
        for x in corrections.iter_mut() {
            *x /= h;
        }
        Ok(corrections)
    }

    /// All bodies' rates that belong to the momentum.
    ///
    /// # Errors
    /// As for [`Self::column_rates`].
    pub fn rates(&mut self) -> Result<Vec<BodyState>, StepError> {
        self.column_rates()?;
        let mut motions: Vec<Pair> = Vec::with_capacity(self.nodes.len());
        let rates = self.nodes.iter().zip(&self.places).map(|(node, place)| {
            let mut motion = match node.inboard {
                None => Pair::ZERO,
                Some(i) => {
                    let Pair { linear, angular } = motions[i];
                    Pair { linear: linear + angular.cross(&place.from_inboard), angular }
                }
            };
            node.add_rates(place, &self.corrections[node.columns.clone()], &mut motion);
            motions.push(motion);
            let v = motion.linear + motion.angular.cross(&place.to_center);
            let q = place.orientation.to_array();
            let turning = Turn { c: 0.0, v: motion.angular * 0.5 }
                .after(&Turn { c: q[0], v: Vector3::new(q[1], q[2], q[3]) });
            [v.x, v.y, v.z, turning.c, turning.v.x, turning.v.y, turning.v.z]
        });
        Ok(rates.collect())
    }

    /// Kinetic energy, and potential energy of gravity and of all springs, J.
    ///
    /// # Errors
    /// As for [`Self::column_rates`].
    pub fn energies(&mut self) -> Result<(f64, f64), StepError> {
        let along: f64 = {
            let rates = self.column_rates()?.to_vec();
            rates.iter().zip(&self.momenta).map(|(v, p)| v * p).sum()
        };
        let gravity = self.system.gravity();
        let weight: f64 = self
            .nodes
            .iter()
            .zip(&self.places)
            .map(|(node, place)| node.mass * gravity * place.center.z)
            .sum();
        let in_joints: f64 =
            self.trial.laws.iter().map(|law| law.law.energy(self.angle(law.node))).sum();
        let mut in_floor = 0.0;
        if let Some((floor, _)) = self.system.ground() {
            for (node, place) in self.nodes.iter().zip(&self.places) {
                for touch in &self.trial.touches[node.sites.clone()] {
                    let p = place.center + place.rotation * touch.arm;
                    in_floor += touch.memory.spring_energy(floor, &p);
                }
            }
        }
        Ok((0.5 * along, weight + in_joints + in_floor))
    }

    /// One step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    ///
    /// # Cost
    /// Linear in the number of links for each Newton iteration; no allocation.
    pub fn step(&mut self) -> Result<(), StepError> {
        let [last, before] = &self.last;
        for (k, guess) in self.trial.increments.iter_mut().enumerate() {
            *guess = last[k].beyond(&before[k]);
        }
        self.trial.begin(&self.nodes, &self.places);
        if !self.loops.is_empty() {
            self.loops.begin(self.system.closures(), &self.places);
        }
        let mut error = self.evaluate();
        let mut iterations = 0;
        let mut is_fresh = false;
        'newton: loop {
            if !error.is_finite() {
                return Err(self.progress.error(NewtonFailure::NotFinite));
            }
            if error <= ROUND_OFF {
                break;
            }
            if iterations == MOST_ITERATIONS {
                let failure = NewtonFailure::TooManyIterations { iterations, residual: error };
                return Err(self.progress.error(failure));
            }
            let was_fresh = is_fresh;
            self.correct(!is_fresh)?;
            self.base.copy_from_slice(&self.trial.increments);
            self.base_multipliers.copy_from_slice(&self.loops.multipliers);
            let mut share = 1.0;
            for halvings in 0..=MOST_HALVINGS {
                self.take(share);
                let tried = self.evaluate();
                if tried <= (1.0 - 1e-4 * share) * error {
                    is_fresh = tried < FAST * error;
                    error = tried;
                    iterations += 1;
                    continue 'newton;
                }
                if error <= TOLERANCE {
                    // Round-off has the last word: back to the best iterate.
                    self.take(0.0);
                    self.evaluate();
                    break 'newton;
                }
                if was_fresh {
                    // An old elimination is no reason to give up.
                    self.take(0.0);
                    self.evaluate();
                    is_fresh = false;
                    continue 'newton;
                }
                if halvings == MOST_HALVINGS {
                    let failure = NewtonFailure::NoRootNearby { residual: error };
                    return Err(self.progress.error(failure));
                }
                share *= 0.5;
            }
        }
        if self.trial.ends.iter().any(|end| end.turn.c < LEAST_TURN) {
            return Err(self.progress.error(StepFailure::WrongBranch));
        }
        self.accept();
        self.progress.iterated(iterations, error);
        self.progress.advance();
        Ok(())
    }

    /// Newton's correction at the trial, with the elimination made anew or with the last one.
    fn correct(&mut self, anew: bool) -> Result<(), StepError> {
        let h = self.progress.h;
        let Self { elimination, nodes, places, trial, momenta, corrections, loops, .. } = self;
        if anew {
            elimination
                .factor(nodes, places, trial, h)
                .map_err(|joint| singular(&self.progress, joint))?;
            if !loops.is_empty() {
                loops.factor(nodes, elimination);
            }
        }
        let own = |c: usize| momenta[c] + trial.own_impulses[c];
        if loops.is_empty() {
            elimination.solve(nodes, |k| trial.ends[k].own, own, corrections);
        } else {
            let impulse = |k: usize| {
                let (own, held) = (trial.ends[k].own, loops.impulse(k));
                Pair { linear: own.linear - held.linear, angular: own.angular - held.angular }
            };
            elimination.solve(nodes, impulse, own, corrections);
            loops.correct(elimination, corrections);
        }
        Ok(())
    }

    /// A share of the corrections from the base.
    fn take(&mut self, share: f64) {
        for (k, node) in self.nodes.iter().enumerate() {
            let by = &self.corrections[node.columns.clone()];
            self.trial.increments[k] = node.corrected(&self.base[k], by, share);
        }
        let all = self.loops.multipliers.iter_mut().zip(&self.base_multipliers);
        for ((to, base), by) in all.zip(&self.loops.corrections) {
            *to = base + share * by;
        }
    }

    /// Largest residual at the trial, relative to its terms.
    fn evaluate(&mut self) -> f64 {
        let coordinates = &self.coordinates;
        let step = Step {
            system: &self.system,
            nodes: &self.nodes,
            places: &self.places,
            angles: &|k| coordinates[k].angles[0],
            momenta: &self.momenta,
            loads: &self.loads,
            h: self.progress.h,
        };
        self.trial.evaluate(&step);
        let mut loop_error = 0.0;
        if !self.loops.is_empty() {
            self.loops.end(self.system.closures(), &self.places, &self.trial);
            self.subtract_loops();
            loop_error = self.loops.largest_error();
        }
        for end in &self.trial.ends {
            let speed = end.velocity.abs().max();
            // NaN stays out, and is found in the residuals.
            self.fastest = self.fastest.max(speed.min(self.fastest.max(1.0) * 2.0));
        }
        let scale = self.fastest.max(f64::MIN_POSITIVE);
        let mut sum = 0.0;
        for (r, weight) in self.trial.residuals.iter().zip(&self.weights) {
            let relative = r / (weight * scale);
            sum += relative * relative;
        }
        sum.sqrt() + loop_error
    }

    /// Impulses of loops out of the residuals: those act on all columns inboard.
    fn subtract_loops(&mut self) {
        for (body, impulse) in self.loops.impulses() {
            let mut all = impulse;
            let mut at = Some(body);
            while let Some(k) = at {
                let (node, place) = (&self.nodes[k], &self.places[k]);
                let first = node.columns.start;
                let residuals = &mut self.trial.residuals;
                project(node, place, &all, &mut |c, along| residuals[first + c] -= along);
                all.angular += place.from_inboard.cross(&all.linear);
                at = node.inboard;
            }
        }
    }

    /// Goes on to the trial's end.
    fn accept(&mut self) {
        let inboard_places = &self.places;
        for (k, node) in self.nodes.iter().enumerate() {
            let world = Place::world();
            let inboard = node.inboard.map_or(&world, |i| &inboard_places[i]);
            self.coordinates[k] =
                node.moved(&self.coordinates[k], &self.trial.increments[k], inboard);
        }
        self.last.swap(0, 1);
        self.last[0].copy_from_slice(&self.trial.increments);
        self.find_places();
        let coordinates = &self.coordinates;
        let step = Step {
            system: &self.system,
            nodes: &self.nodes,
            places: &self.places,
            angles: &|k| coordinates[k].angles[0],
            momenta: &[],
            loads: &self.loads,
            h: self.progress.h,
        };
        for k in 0..self.nodes.len() {
            self.trial.ends[k].all = self.trial.end_momentum(&step, k, &self.places[k]);
        }
        for k in (0..self.nodes.len()).rev() {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let all = self.trial.ends[k].all;
            let (momenta, own) = (&mut self.momenta, &self.trial.own_impulses);
            let first = node.columns.start;
            project(node, place, &all, &mut |c, along| {
                momenta[first + c] = along + own[first + c];
            });
            if let Some(inboard) = node.inboard {
                self.trial.ends[inboard].all.add_shifted(&all, &place.from_inboard);
            }
        }
        for touch in &mut self.trial.touches {
            touch.memory = touch.force.point;
        }
    }

    fn find_places(&mut self) {
        let world = Place::world();
        for k in 0..self.nodes.len() {
            let node = &self.nodes[k];
            let inboard = node.inboard.map_or(&world, |i| &self.places[i]);
            self.places[k] = node.place(&self.coordinates[k], inboard);
        }
    }

    /// Momenta of these rates, and a first guess of the increments.
    fn set_rates(&mut self, rates: &[BodyState]) {
        for (k, rate) in rates.iter().enumerate() {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let q = place.orientation.to_array();
            // ω = 2 q̇ ⋆ q̄
            let omega = Turn { c: rate[3], v: Vector3::new(rate[4], rate[5], rate[6]) }
                .after(&Turn { c: q[0], v: -Vector3::new(q[1], q[2], q[3]) })
                .v
                * 2.0;
            let v = Vector3::new(rate[0], rate[1], rate[2]);
            self.fastest = self.fastest.max(v.abs().max());
            let linear = v * node.mass;
            let angular = place.inertia * omega + place.to_center.cross(&linear);
            self.trial.ends[k].all = Pair { linear, angular };
        }
        for k in (0..self.nodes.len()).rev() {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let all = self.trial.ends[k].all;
            let (momenta, first) = (&mut self.momenta, node.columns.start);
            project(node, place, &all, &mut |c, along| momenta[first + c] = along);
            if let Some(inboard) = node.inboard {
                self.trial.ends[inboard].all.add_shifted(&all, &place.from_inboard);
            }
        }
        let h = self.progress.h;
        // A singular inertia is the first step's to report.
        if self.column_rates().is_ok() {
            for (k, node) in self.nodes.iter().enumerate() {
                let by = &self.corrections[node.columns.clone()];
                self.last[0][k] = node.corrected(&Increment::NONE, by, h);
                self.last[1][k] = self.last[0][k];
            }
        }
    }
}

/// Weights of columns: what moves with a joint, and how far out it is.
fn weights(system: &System, nodes: &[Node], columns: usize) -> Vec<f64> {
    let n = nodes.len();
    let (mut mass, mut moment) = (vec![0.0; n], vec![0.0; n]);
    let mut weights = vec![0.0; columns];
    let size = |arm: &[f64; 3]| arm.iter().map(|x| x * x).sum::<f64>().sqrt();
    for k in (0..n).rev() {
        let Node { mass: own, inertia, .. } = &nodes[k];
        let joint = &system.links()[k].joint;
        let arm = if nodes[k].kind == Kind::Floating { 0.0 } else { size(&joint.outboard) };
        mass[k] += own;
        moment[k] += own * (arm + (inertia.max() / own).sqrt());
        for c in nodes[k].columns.clone() {
            let is_linear = match nodes[k].kind {
                Kind::Prismatic => true,
                Kind::Floating => c - nodes[k].columns.start < 3,
                _ => false,
            };
            weights[c] = if is_linear { mass[k] } else { moment[k] };
        }
        if let Some(i) = nodes[k].inboard {
            let inboard_arm = size(&system.links()[i].joint.outboard);
            mass[i] += mass[k];
            moment[i] += moment[k] + mass[k] * (size(&joint.inboard) + inboard_arm);
        }
    }
    weights
}

fn singular(progress: &Progress, joint: usize) -> StepError {
    progress.error(StepFailure::Newton(NewtonFailure::SingularJacobian { pivot: joint }))
}
