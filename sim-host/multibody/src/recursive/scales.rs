//! What residuals in joint coordinates are measured by: see [`super::super::scale`].

use super::super::scale::{Composite, Scale, away, not_too_thin, rotor_inertia};
use super::super::system::System;
use super::coordinates::Coordinates;
use super::node::{Kind, Node};
use super::simulation::Simulation;
use super::step::Step;
use super::stiffness::Pair;
use super::trial::Trial;
use nalgebra::Vector3;

/// Constants by column, and this step's scale.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    /// `1/√J`, by its least.
    pub weights: Vec<f64>,
    /// `J`, by its largest, for what columns move by: tangents of half angles, or ways. Where a whole tree is moved by
    /// a column, it is in the second.
    moving: Vec<f64>,
    drifting: Vec<f64>,
    /// Of the whole system, kg.
    pub mass: f64,
    /// Twice the energy that the wrenches held on bodies would give them in a second, kg·m²/s⁴.
    wrenches: f64,
    /// Of the step that is being made, without what its trials touch.
    pub step: Scale,
}

impl Scales {
    /// At rest, from where a motion begins.
    pub fn new(
        system: &System,
        nodes: &[Node],
        coordinates: &[Coordinates],
        columns: usize,
    ) -> Self {
        let size = |arm: [f64; 3]| Vector3::from(arm).norm();
        let mut all = vec![Composite::default(); nodes.len()];
        let (mut weights, mut moving) = (vec![0.0; columns], vec![0.0; columns]);
        let mut drifting = vec![0.0; columns];
        for (k, node) in nodes.iter().enumerate().rev() {
            let joint = &system.links()[k].joint;
            let is_floating = node.kind == Kind::Floating;
            let arm = if is_floating { 0.0 } else { size(joint.outboard) };
            let (largest, least) = (node.inertia.max(), node.inertia.min());
            let own = Composite::of_body(node.mass, largest, arm);
            let outboard = all[k].moment;
            all[k].add(&own);
            for (i, c) in node.columns.clone().enumerate() {
                let about = |axis| own_moment(node, axis, joint.outboard.into());
                let rotor = rotor_inertia(system, k);
                // Least and largest.
                let (low, high) = match (node.kind, i) {
                    (Kind::Prismatic, _) | (Kind::Floating, 0..3) => (all[k].mass, all[k].mass),
                    (Kind::Revolute, _) => (outboard + about(0), outboard + about(0)),
                    (Kind::Universal, 1) => (outboard + about(1), outboard + about(1)),
                    _ => {
                        let least = not_too_thin(least, own.moment);
                        (outboard + node.mass * arm * arm + least, all[k].moment)
                    }
                };
                let (low, high) = (low + rotor, high + rotor);
                weights[c] = 1.0 / low.sqrt();
                match (node.kind, i) {
                    (Kind::Prismatic, _) => moving[c] = high,
                    (Kind::Floating, 0..3) => drifting[c] = high,
                    _ => moving[c] = 4.0 * high,
                }
            }
            if let Some(i) = node.inboard {
                let from = Vector3::from(system.links()[i].joint.outboard);
                let from = if nodes[i].kind == Kind::Floating { Vector3::zeros() } else { from };
                let mut by = (Vector3::from(joint.inboard) - from).norm();
                if node.kind == Kind::Prismatic {
                    by += coordinates[k].angles[0].abs();
                }
                let seen = all[k].seen_from(by);
                all[i].add(&seen);
            }
        }
        let mass = nodes.iter().map(|node| node.mass).sum();
        Self { weights, moving, drifting, mass, wrenches: 0.0, step: Scale::default() }
    }
}

/// Moment of inertia of a body about an axis of its joint, through the joint's point.
fn own_moment(node: &Node, axis: usize, arm: Vector3<f64>) -> f64 {
    let axis = node.axes_in_body()[axis];
    let own = axis.dot(&node.inertia.component_mul(&axis));
    let moment = own + node.mass * arm.cross(&axis).norm_squared();
    not_too_thin(moment, node.inertia.max() + node.mass * arm.norm_squared())
}

/// `f²/m + ℓ²/I` of an impulse on a body, about a point that is `arm` away from its centre of mass.
fn energy(node: &Node, impulse: &Pair, arm: &Vector3<f64>) -> f64 {
    let moment = node.inertia.max() + node.mass * arm.norm_squared();
    impulse.linear.norm_squared() / node.mass + impulse.angular.norm_squared() / moment
}

impl Simulation {
    /// To be called where wrenches are set.
    pub(super) fn measure_wrenches(&mut self) {
        let each = self.nodes.iter().zip(&self.loads.wrenches);
        self.scales.wrenches = each.map(|(node, w)| energy(node, w, &Vector3::zeros())).sum();
    }

    /// (2) and (3) where a step begins, with its first guess made.
    pub(super) fn measure_step(&mut self, h: f64) {
        let Self { scales, at, loads, nodes, places, .. } = self;
        let half = 0.5 * h;
        let (mut moving, mut drifting, mut driven) = (0.0, 0.0, 0.0);
        let constants = scales.moving.iter().zip(&scales.drifting).zip(&scales.weights);
        let each = constants.zip(at.guess.last()).zip(&loads.torques);
        for ((((inertia, drift), weight), way), torque) in each {
            let square = way * way;
            moving += inertia * square;
            drifting += drift * square;
            let torque = torque * weight;
            driven += torque * torque;
        }
        let gravity = self.system.gravity();
        let pulled = scales.mass * gravity * gravity + scales.wrenches;
        let per_step = 1.0 / (h * h);
        let mut motion = moving * per_step + (driven + pulled) * half * half;
        let mut terms = drifting * per_step;
        for law in &self.trial.laws {
            let (angle, way) =
                (at.coordinates[law.node].angles[0], self.trial.way(nodes, law.node));
            let (torque, _) = law.law.over_step(angle, way, h);
            let weight = scales.weights[law.column] * half;
            motion += (torque * weight).powi(2);
            terms += (law.law.terms(angle, way, h) * weight).powi(2);
        }
        for (body, impulse) in self.driven.iter().flat_map(|driven| driven.impulses(h)) {
            motion += energy(&nodes[body], &impulse, &places[body].to_center);
        }
        if !at.multipliers.is_empty() {
            for (body, impulse) in self.loops.impulses(&at.multipliers) {
                terms += energy(&nodes[body], &impulse, &places[body].to_center);
            }
        }
        scales.step = Scale { motion, terms };
    }
}

impl Trial {
    /// What floors and strikes add to (3) at a trial.
    pub fn felt(&self, step: &Step) -> f64 {
        let half = 0.5 * step.h;
        let mut sum = 0.0;
        if step.system.ground().is_some() {
            for (node, place) in step.nodes.iter().zip(step.places) {
                let center = away(&place.center);
                for touch in &self.touches[node.sites.clone()] {
                    let force = half * touch.force.terms(center + away(&touch.begin));
                    sum += force * force / node.mass;
                }
            }
        }
        for strike in &self.strikes {
            let lighter = step.nodes[strike.link].mass.min(step.nodes[strike.struck].mass);
            sum += strike.felt(step.h).powi(2) / lighter;
        }
        sum
    }
}
