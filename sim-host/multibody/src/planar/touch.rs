//! Points that can touch the floor, as a plane sees them: those of a body that lie behind one another are one.

use super::super::body::BodyState;
use super::super::system::System;
use super::algebra::{Pair, Stiffness, cross};
use super::plane::{Body, Plane};
use crate::contact::{ContactPoint, Floor, StepForce, Switching};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use std::ops::Range;

/// A point, or several behind one another, on the floor. The law is that of space, with no way across.
#[derive(Clone, Debug)]
pub(super) struct Touch {
    link: usize,
    /// In the body, in the plane's axes at the start of the motion.
    pub arm: Vector2<f64>,
    /// How many points there are.
    weight: f64,
    /// From the centre of mass at the beginning, and at the trial's end.
    pub begin: Vector2<f64>,
    end: Vector2<f64>,
    pub force: StepForce,
}

/// Points of all bodies, and the one that each contact site is part of.
pub(super) fn touches(
    system: &System,
    plane: &Plane,
    states: &[BodyState],
) -> (Vec<Touch>, Vec<usize>) {
    let (mut all, mut arms) = (Vec::<Touch>::new(), Vec::<Vector3<f64>>::new());
    let mut part_of = Vec::with_capacity(system.sites().len());
    for site in system.sites() {
        let body = Body::of(&states[site.link], &[0.0; 7]);
        let arm = body.orientation.rotate(site.position.into());
        let known =
            (0..all.len()).find(|k| all[*k].link == site.link && plane.is_one(&arms[*k], &arm));
        part_of.push(known.unwrap_or(all.len()));
        if let Some(known) = known {
            all[known].weight += 1.0;
            continue;
        }
        arms.push(arm);
        all.push(Touch {
            link: site.link,
            arm: plane.seen(&arm),
            weight: 1.0,
            begin: Vector2::zeros(),
            end: Vector2::zeros(),
            force: StepForce {
                force: Vector3::zeros(),
                slope: Matrix3::zeros(),
                point: ContactPoint::default(),
            },
        });
    }
    (all, part_of)
}

/// Those of a link, of which there are in the order of links.
pub(super) fn of_link(all: &[Touch], link: usize) -> Range<usize> {
    let first = all.partition_point(|touch| touch.link < link);
    first..first + all[first..].partition_point(|touch| touch.link == link)
}

/// A vector of the plane in the floor's axes: its second axis is the floor's normal.
pub(super) fn on_floor(v: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(v.x, 0.0, v.y)
}

impl Touch {
    /// The force over a step from where the point begins, by `way` of it; `moved` of it is against the centre.
    #[inline]
    pub fn meet(
        &mut self,
        (floor, switching): &(Floor, Switching),
        memory: &ContactPoint,
        center: &Vector2<f64>,
        (way_of_center, moved): (&Vector2<f64>, &Vector2<f64>),
        h: f64,
    ) {
        self.end = self.begin + moved;
        let (p, way) = (on_floor(&(center + self.begin)), on_floor(&(way_of_center + moved)));
        self.force = memory.over_step(floor, *switching, p, way, h);
    }

    fn impulse(&self, h: f64) -> Vector2<f64> {
        let force = &self.force.force;
        Vector2::new(force.x, force.z) * (0.5 * h * self.weight)
    }

    /// Half of the step's impulse, and its moment about the centre of mass: with the arm of the beginning.
    #[inline]
    pub fn at_begin(&self, h: f64) -> Pair {
        let linear = self.impulse(h);
        Pair { linear, angular: cross(&self.begin, &linear) }
    }

    /// The same with the arm of the end.
    pub fn at_end(&self, h: f64) -> Pair {
        let linear = self.impulse(h);
        Pair { linear, angular: cross(&self.end, &linear) }
    }

    /// Largest force over a step, with what its springs' numbers are made of, as an impulse, N·s.
    pub fn felt(&self, center: &Vector2<f64>, h: f64) -> f64 {
        let away = center.x.abs() + center.y.abs() + self.begin.x.abs() + self.begin.y.abs();
        0.5 * h * self.weight * self.force.terms(away)
    }

    /// Lets go of the floor.
    pub fn forget(&mut self) {
        self.force.slope = Matrix3::zeros();
    }

    /// Adds the floor's stiffness to a body's, whose centre of mass is at the end of these arms.
    #[inline]
    pub fn add_to(&self, part: &mut Stiffness, begin: &Vector2<f64>, end: &Vector2<f64>, h: f64) {
        let slope = &self.force.slope;
        if slope[(2, 2)] == 0.0 {
            return;
        }
        let k = Matrix2::new(slope[(0, 0)], slope[(0, 2)], slope[(2, 0)], slope[(2, 2)])
            * (-0.5 * h * self.weight);
        part.add_point(&k, &(begin + self.begin), &(end + self.end));
    }

    /// Energy that the floor's springs hold, J, with the point where it is at a step's beginning.
    pub fn spring_energy(&self, floor: &Floor, memory: &ContactPoint, p: &Vector2<f64>) -> f64 {
        self.weight * memory.spring_energy(floor, &on_floor(p))
    }
}
