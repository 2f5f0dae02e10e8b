//! Where all bodies are, how they move, and what each degree of freedom moves.

use super::super::system::System;
use super::joint;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// A body on its way, world axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    /// Centre of mass, m.
    pub center: Vector3<f64>,
    /// World from body.
    pub turn: Quaternion<f64>,
    pub velocity: Vector3<f64>,
    pub omega: Vector3<f64>,
    /// Acceleration of the centre of mass where `u̇ = 0`.
    pub acceleration: Vector3<f64>,
    /// Angular acceleration where `u̇ = 0`.
    pub alpha: Vector3<f64>,
    /// The last degree of freedom on the way to it.
    pub last: Option<usize>,
}

impl Body {
    pub const WORLD: Self = Self {
        center: Vector3::new(0.0, 0.0, 0.0),
        turn: Quaternion { s: 1.0, v: Vector3::new(0.0, 0.0, 0.0) },
        velocity: Vector3::new(0.0, 0.0, 0.0),
        omega: Vector3::new(0.0, 0.0, 0.0),
        acceleration: Vector3::new(0.0, 0.0, 0.0),
        alpha: Vector3::new(0.0, 0.0, 0.0),
        last: None,
    };

    /// Of the body's point with this arm from the centre of mass.
    pub fn velocity_at(&self, arm: &Vector3<f64>) -> Vector3<f64> {
        self.velocity + self.omega.cross(arm)
    }

    /// The same where `u̇ = 0`.
    pub fn acceleration_at(&self, arm: &Vector3<f64>) -> Vector3<f64> {
        self.acceleration + self.alpha.cross(arm) + self.omega.cross(&self.omega.cross(arm))
    }
}

/// A degree of freedom: what it moves all bodies outboard of it by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dof {
    /// They turn about this axis through this point, or move along `linear`.
    pub angular: Vector3<f64>,
    pub linear: Vector3<f64>,
    pub point: Vector3<f64>,
    /// The one before it on the way from the world.
    pub parent: Option<usize>,
}

impl Dof {
    /// Velocity of a point that it moves.
    pub fn velocity_of(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(&(point - self.point))
    }
}

/// All bodies and degrees of freedom.
#[derive(Clone, Debug, Default)]
pub(super) struct Kinematics {
    pub bodies: Vec<Body>,
    pub dofs: Vec<Dof>,
}

impl Kinematics {
    /// At coordinates and velocities; `starts` tells where those of each link begin.
    pub fn of(system: &System, starts: &[(usize, usize)], q: &[f64], u: &[f64]) -> Self {
        let mut all =
            Self { bodies: Vec::with_capacity(starts.len()), dofs: Vec::with_capacity(u.len()) };
        for (link, (first_q, first_u)) in system.links().iter().zip(starts) {
            let on = link.inboard.map_or(Body::WORLD, |i| all.bodies[i]);
            let body =
                joint::moved(&link.joint, &on, &q[*first_q..], &u[*first_u..], &mut all.dofs);
            all.bodies.push(body);
        }
        all
    }

    pub fn body(&self, link: Option<usize>) -> &Body {
        link.map_or(&Body::WORLD, |k| &self.bodies[k])
    }

    /// Degrees of freedom on the way from a body to the world, the nearest first.
    pub fn path(&self, link: Option<usize>) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(self.body(link).last, |k| self.dofs[*k].parent)
    }
}
