//! What residuals in a plane are measured by: see [`super::super::scale`].

use super::super::scale::{Composite, Scale, rotor_inertia};
use super::super::system::System;
use super::node::{Kind, Node};
use super::simulation::PlanarSimulation;

/// Constants by column, and this step's scale.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    /// `1/√J`
    pub weights: Vec<f64>,
    /// `J`, for what columns move by: tangents of half angles, or ways. Where a whole tree is moved by a column, it is in
    /// the second.
    moving: Vec<f64>,
    drifting: Vec<f64>,
    /// Of the whole system, kg.
    mass: f64,
    /// Of the step that is being made, without what its trials touch.
    pub step: Scale,
}

impl Scales {
    /// At rest.
    pub fn new(system: &System, nodes: &[Node], columns: usize) -> Self {
        let mut all = vec![Composite::default(); nodes.len()];
        let (mut weights, mut moving) = (vec![0.0; columns], vec![0.0; columns]);
        let mut drifting = vec![0.0; columns];
        for (k, node) in nodes.iter().enumerate().rev() {
            all[k].add(&Composite::of_body(node.mass, node.moment, node.arm.norm()));
            let Composite { mass, moment, .. } = all[k];
            let rotor = rotor_inertia(system, k);
            for i in 0..node.kind.columns() {
                let c = node.column + i;
                let inertia = match (node.kind, i) {
                    (Kind::Floating, 0..2) => {
                        drifting[c] = mass;
                        mass
                    }
                    (Kind::Prismatic, _) => {
                        moving[c] = mass + rotor;
                        mass + rotor
                    }
                    _ => {
                        moving[c] = 4.0 * (moment + rotor);
                        moment + rotor
                    }
                };
                weights[c] = 1.0 / inertia.sqrt();
            }
            if let Some(i) = node.inboard {
                let seen = all[k].seen_from(node.lever.norm());
                all[i].add(&seen);
            }
        }
        let mass = nodes.iter().map(|node| node.mass).sum();
        Self { weights, moving, drifting, mass, step: Scale::default() }
    }
}

impl PlanarSimulation {
    /// (2) and (3) of [`crate::scale`] where a step begins.
    pub(super) fn measure_step(&mut self, h: f64) {
        let scales = &self.scales;
        let half = 0.5 * h;
        let (mut moving, mut drifting, mut driven) = (0.0, 0.0, 0.0);
        let constants = scales.moving.iter().zip(&scales.drifting).zip(&scales.weights);
        let each = constants.zip(&self.at.last[0]).zip(&self.torques);
        for ((((inertia, drift), weight), way), torque) in each {
            let square = way * way;
            moving += inertia * square;
            drifting += drift * square;
            let torque = torque * weight;
            driven += torque * torque;
        }
        let pulled = scales.mass * self.gravity.norm_squared();
        let per_step = 1.0 / (self.at.last_h * self.at.last_h);
        let mut motion = moving * per_step + (driven + pulled) * half * half;
        let mut terms = drifting * per_step;
        for (law, angle) in self.laws.iter().zip(&self.at.angles) {
            let way = self.way(law.node, law.column) * law.sign;
            let (torque, _) = law.law.over_step(*angle, way, h);
            let weight = scales.weights[law.column] * half;
            motion += (torque * weight).powi(2);
            terms += (law.law.terms(*angle, way, h) * weight).powi(2);
        }
        self.scales.step = Scale { motion, terms };
    }

    /// What the floor adds to (3) at a trial.
    pub(super) fn felt(&self, h: f64) -> f64 {
        let mut sum = 0.0;
        for (node, place) in self.nodes.iter().zip(&self.places) {
            let center = place.reference + place.to_center;
            for touch in &self.touches[node.touches.clone()] {
                sum += touch.felt(&center, h).powi(2) / node.mass;
            }
        }
        sum
    }
}
