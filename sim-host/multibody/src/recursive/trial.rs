//! A trial of a step's end: what is tried, and what is known of it.

use super::coordinates::Increment;
use super::end::End;
use super::node::Node;
use super::stiffness::Pair;
use super::strike::Strike;
use crate::contact::{ContactPoint, GroundPlane, StepForce};
use crate::{JointLaw, Site, System};
use nalgebra::{Matrix3, Vector3};

/// A point that can touch the floor.
#[derive(Clone, Debug)]
pub(super) struct Touch {
    /// In the body.
    pub arm: Vector3<f64>,
    /// From the centre of mass at the beginning, and at the trial's end.
    pub begin: Vector3<f64>,
    pub end: Vector3<f64>,
    pub force: StepForce,
    /// What it can touch, where that is not z = 0.
    pub plane: Option<GroundPlane>,
}

/// A joint's law and its column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Law {
    pub node: usize,
    pub column: usize,
    pub law: JointLaw,
}

/// What is held over a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loads {
    /// By column, N·m or N.
    pub torques: Vec<f64>,
    /// By link: on the centre of mass, world axes.
    pub wrenches: Vec<Pair>,
}

/// A trial of a step's end, and what is known of it.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub increments: Vec<Increment>,
    pub ends: Vec<End>,
    pub touches: Vec<Touch>,
    pub strikes: Vec<Strike>,
    pub laws: Vec<Law>,
    /// Torques of spherical joints' motors at the step's beginning, world axes, with their first columns.
    pub motor_torques: Vec<(usize, Vector3<f64>)>,
    /// By column: `½h τ`, less rotors' momenta, and its derivative.
    pub own_impulses: Vec<f64>,
    pub own_slopes: Vec<f64>,
    /// `r`
    pub residuals: Vec<f64>,
}

impl Trial {
    /// Of nothing yet.
    pub fn new(system: &System, nodes: &[Node], columns: usize) -> Self {
        let touch = |site: &Site| Touch {
            plane: system.plane(site.link),
            arm: site.position.into(),
            begin: Vector3::zeros(),
            end: Vector3::zeros(),
            force: StepForce {
                force: Vector3::zeros(),
                slope: Matrix3::zeros(),
                point: ContactPoint::default(),
            },
        };
        Self {
            increments: vec![Increment::NONE; nodes.len()],
            ends: vec![End::AT_REST; nodes.len()],
            touches: system.sites().iter().map(touch).collect(),
            strikes: Strike::all(system),
            laws: system
                .laws()
                .iter()
                .map(|(node, law)| Law {
                    node: *node,
                    column: nodes[*node].columns.start,
                    law: *law,
                })
                .collect(),
            motor_torques: system
                .gimbals()
                .iter()
                .map(|(link, _)| (nodes[*link].columns.start, Vector3::zeros()))
                .collect(),
            own_impulses: vec![0.0; columns],
            own_slopes: vec![0.0; columns],
            residuals: vec![0.0; columns],
        }
    }
}
