//! Whether a motion stays in a plane, and in which.
//!
//! What is held by hinges to the world needs only hinges that are parallel and slides across them: what pulls it
//! out of the plane its joints bear. A tree that floats bears nothing: its start, its weight, its contact points
//! and its inertia have to be in the plane too, or symmetric to it. A loop's or a striker's forces are not looked
//! at.

use super::super::body::BodyState;
use super::super::joint::JointConstraint;
use super::super::system::System;
use super::not_planar::NotPlanar;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use surefoot::spatial::Quaternion;

/// Sines of angles, and shares of lengths and speeds, that are round-off of a description.
const EXACT: f64 = 1e-10;

/// A plane: its axes in the world. `across × up = normal`, and up is the world's where it is in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// First axis.
    pub across: Vector3<f64>,
    /// Second axis.
    pub up: Vector3<f64>,
    /// What turns are about.
    pub normal: Vector3<f64>,
}

/// A body at the start: orientation, velocity and angular velocity, world axes.
pub(super) struct Body {
    pub center: Vector3<f64>,
    pub orientation: Quaternion<f64>,
    pub velocity: Vector3<f64>,
    pub omega: Vector3<f64>,
}

impl Body {
    pub fn of(x: &BodyState, v: &BodyState) -> Self {
        let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let rate = Quaternion::from_array([v[3], v[4], v[5], v[6]]);
        Self {
            center: Vector3::new(x[0], x[1], x[2]),
            orientation: q,
            velocity: Vector3::new(v[0], v[1], v[2]),
            // ω = 2 q̇ ⋆ q̄
            omega: rate.product(q.conjugate()).v * 2.0,
        }
    }
}

impl Plane {
    /// The plane that a motion stays in.
    ///
    /// # Errors
    /// [`NotPlanar`]: the reason why there is none.
    pub(super) fn of(
        system: &System,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Result<Self, NotPlanar> {
        if !system.closures().is_empty() {
            return Err(NotPlanar::Loops);
        }
        if !system.strikers().is_empty() {
            return Err(NotPlanar::Strikers);
        }
        if !system.terrain().is_empty() {
            return Err(NotPlanar::Terrain);
        }
        let bodies: Vec<Body> = states.iter().zip(rates).map(|(x, v)| Body::of(x, v)).collect();
        let mut first = None;
        for normal in normals(system, &bodies) {
            let plane = Self::across(normal);
            match plane.check(system, &bodies) {
                Ok(()) => return Ok(plane),
                Err(reason) => first = first.or(Some(reason)),
            }
        }
        // There is always a normal to try.
        Err(first.unwrap_or(NotPlanar::Floor))
    }

    fn across(normal: Vector3<f64>) -> Self {
        let z = Vector3::z();
        let up = if normal.z.abs() < EXACT { z } else { any_across(&normal) };
        let across = up.cross(&normal).normalize();
        Self { across, up: normal.cross(&across), normal }
    }

    /// A vector's part in the plane.
    pub fn seen(&self, v: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(self.across.dot(v), self.up.dot(v))
    }

    /// A vector in the plane, in the world.
    pub fn told(&self, v: &Vector2<f64>) -> Vector3<f64> {
        self.across * v.x + self.up * v.y
    }

    fn check(&self, system: &System, bodies: &[Body]) -> Result<(), NotPlanar> {
        let n = &self.normal;
        let links = system.links();
        // By link: the first of its tree, if that floats.
        let mut floats: Vec<Option<usize>> = Vec::with_capacity(links.len());
        for (link, (l, body)) in links.iter().zip(bodies).enumerate() {
            let along = |axis: [f64; 3], frame: Option<usize>| {
                let axis = Vector3::from(axis);
                frame.map_or(axis, |k| bodies[k].orientation.rotate(axis))
            };
            match l.joint.constraint {
                JointConstraint::Revolute { axis } if !is_parallel(&along(axis, Some(link)), n) => {
                    return Err(NotPlanar::Axis { link });
                }
                JointConstraint::Prismatic { axis }
                    if !(along(axis, l.inboard).dot(n).abs() <= EXACT) =>
                {
                    return Err(NotPlanar::Slide { link });
                }
                JointConstraint::Universal { .. } | JointConstraint::Spherical => {
                    return Err(NotPlanar::Joint { link });
                }
                JointConstraint::Floating => {
                    let speed = body.velocity.norm() + 1.0;
                    let spin = body.omega.norm() + 1.0;
                    let stays = body.velocity.dot(n).abs() <= EXACT * speed
                        && body.omega.cross(n).norm() <= EXACT * spin;
                    if !stays {
                        return Err(NotPlanar::Start { link });
                    }
                    if system.gravity() != 0.0 && !(n.z.abs() <= EXACT) {
                        return Err(NotPlanar::Weight { link });
                    }
                }
                _ => {}
            }
            let root = match (l.joint.constraint, l.inboard) {
                (JointConstraint::Floating, _) => Some(link),
                (_, inboard) => inboard.and_then(|k| floats[k]),
            };
            if let Some(root) = root {
                let turning = self.inertia(system, bodies, link);
                let off = Vector2::new(turning[(0, 2)], turning[(1, 2)]).norm();
                if !(off <= EXACT * turning[(2, 2)]) {
                    return Err(NotPlanar::Inertia { link });
                }
                let arm = body.center - bodies[root].center;
                if !(arm.dot(n).abs() <= EXACT * (1.0 + arm.norm())) {
                    return Err(NotPlanar::Beside { link });
                }
            }
            floats.push(root);
        }
        self.check_tips(system, bodies, &floats)?;
        if !system.sites().is_empty() && !(n.z.abs() <= EXACT) {
            return Err(NotPlanar::Floor);
        }
        self.check_sites(system, bodies, &floats)
    }

    /// A body's inertia about its centre of mass, in the plane's axes.
    fn inertia(&self, system: &System, bodies: &[Body], link: usize) -> Matrix3<f64> {
        let seen = bodies[link].orientation.conjugate();
        let axes = [self.across, self.up, self.normal].map(|axis| seen.rotate(axis));
        let inertia = Vector3::from(system.links()[link].body.inertia);
        Matrix3::from_fn(|i, j| axes[i].dot(&inertia.component_mul(&axes[j])))
    }

    /// That trees which float do not turn about the middle one of their axes, where they start.
    fn check_tips(
        &self,
        system: &System,
        bodies: &[Body],
        floats: &[Option<usize>],
    ) -> Result<(), NotPlanar> {
        for root in (0..bodies.len()).filter(|k| floats[*k] == Some(*k)) {
            let of_tree = || (0..bodies.len()).filter(|k| floats[*k] == Some(root));
            let mass = |k: usize| system.links()[k].body.mass;
            let all: f64 = of_tree().map(mass).sum();
            let center = of_tree().map(|k| bodies[k].center * mass(k)).sum::<Vector3<f64>>() / all;
            let (mut across, mut about) = (Matrix2::zeros(), 0.0);
            for k in of_tree() {
                let inertia = self.inertia(system, bodies, k);
                let arm = self.seen(&(bodies[k].center - center));
                let square = Matrix2::identity() * arm.norm_squared() - arm * arm.transpose();
                across += inertia.fixed_view::<2, 2>(0, 0) + square * mass(k);
                about += inertia[(2, 2)] + mass(k) * arm.norm_squared();
            }
            let moments = across.symmetric_eigenvalues();
            let (low, high) = (moments.min(), moments.max());
            if low < about * (1.0 - EXACT) && about * (1.0 + EXACT) < high {
                return Err(NotPlanar::Tips { link: root });
            }
        }
        Ok(())
    }

    /// That points on trees which float are in the plane, or as far beyond it as before it.
    fn check_sites(
        &self,
        system: &System,
        bodies: &[Body],
        floats: &[Option<usize>],
    ) -> Result<(), NotPlanar> {
        let points: Vec<(usize, Vector3<f64>)> = system
            .sites()
            .iter()
            .map(|site| (site.link, bodies[site.link].orientation.rotate(site.position.into())))
            .collect();
        for (site, (link, arm)) in points.iter().enumerate() {
            let Some(root) = floats[*link] else { continue };
            let here = arm + bodies[*link].center - bodies[root].center;
            let same =
                |other: &&(usize, Vector3<f64>)| other.0 == *link && self.is_one(arm, &other.1);
            let beside: f64 =
                points.iter().filter(same).map(|(_, p)| (here + p - arm).dot(&self.normal)).sum();
            if !(beside.abs() <= EXACT * (1.0 + here.norm())) {
                return Err(NotPlanar::Site { site });
            }
        }
        Ok(())
    }

    /// Whether two points of a body are one in the plane.
    pub(super) fn is_one(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
        self.seen(&(a - b)).norm() <= EXACT * (1.0 + a.norm())
    }
}

/// Normals worth a try: a hinge's axis; else the axis that a free body turns about; else what is across two
/// directions of motion.
fn normals(system: &System, bodies: &[Body]) -> Vec<Vector3<f64>> {
    let links = || system.links().iter().zip(bodies);
    let hinge = links().find_map(|(l, body)| match l.joint.constraint {
        JointConstraint::Revolute { axis } => Some(body.orientation.rotate(axis.into())),
        _ => None,
    });
    let spins = |l: &JointConstraint, body: &Body| {
        *l == JointConstraint::Floating && body.omega.norm() > EXACT
    };
    let spin =
        links().find(|(l, body)| spins(&l.joint.constraint, body)).map(|(_, body)| body.omega);
    if let Some(axis) = hinge.or(spin) {
        return vec![axis.normalize()];
    }
    let mut ways = vec![Vector3::z()];
    for (l, body) in links() {
        match l.joint.constraint {
            JointConstraint::Prismatic { axis } => {
                let frame = l.inboard.map(|k| bodies[k].orientation);
                ways.push(frame.map_or(axis.into(), |q| q.rotate(axis.into())));
            }
            JointConstraint::Floating if body.velocity.norm() > EXACT => {
                ways.push(body.velocity.normalize());
            }
            _ => {}
        }
    }
    let across = |i: usize| ways.iter().map(move |way| (i, way));
    let mut found: Vec<Vector3<f64>> = (0..ways.len())
        .flat_map(across)
        .map(|(i, way)| ways[i].cross(way))
        .filter(|n| n.norm() > 1e-6)
        .map(|n| n.normalize())
        .take(1)
        .collect();
    if found.is_empty() {
        found = vec![Vector3::y(), Vector3::x()];
    }
    found
}

/// Whether an axis, which may have been given no length, is parallel to the normal.
fn is_parallel(axis: &Vector3<f64>, n: &Vector3<f64>) -> bool {
    axis.cross(n).norm() < EXACT * axis.norm()
}

/// A unit vector across another.
fn any_across(n: &Vector3<f64>) -> Vector3<f64> {
    let axis = if n.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    (axis - n * n.dot(&axis)).normalize()
}
