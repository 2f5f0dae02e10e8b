//! A robot's links as core has them: one frame for the whole robot, in its home configuration.

use crate::robot::{Robot, RobotMotion};
use nalgebra::Vector3;
use surefoot::model::Link;

/// A link with its joint at 0, in the world's axes where nothing else is said.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HomeLink {
    /// 0 for the world, else one more than the index.
    pub inboard: usize,
    pub motion: RobotMotion,
    /// kg m², or kg.
    pub rotor_inertia: f64,
    pub axis: [f64; 3],
    /// A point of the axis, m.
    pub point: [f64; 3],
    /// kg
    pub mass: f64,
    /// xx, yy, zz, yz, zx, xy about the centre of mass in the link's axes, kg m².
    pub inertia: [f64; 6],
    /// Centre of mass, m.
    pub center: [f64; 3],
    /// Of the link's axes: w, x, y, z.
    pub orientation: [f64; 4],
}

/// Links in the robot's order.
pub(crate) fn home_links(robot: &Robot) -> Vec<HomeLink> {
    let home = robot.home_poses();
    let all = robot.links.iter().zip(&home);
    all.map(|(link, pose)| {
        let joint = &link.joint;
        let placed =
            |point: &Vector3<f64>| components(&pose.transform_point(&(*point).into()).coords);
        let i = &link.inertial.inertia;
        let q = pose.rotation;
        HomeLink {
            inboard: link.parent.map_or(0, |parent| parent + 1),
            motion: joint.motion,
            rotor_inertia: joint.properties.armature,
            axis: components(&(q * joint.axis)),
            point: placed(&joint.point),
            mass: link.inertial.mass,
            inertia: [i.m11, i.m22, i.m33, i.m23, i.m13, i.m12],
            center: placed(&link.inertial.center),
            orientation: [q.w, q.i, q.j, q.k],
        }
    })
    .collect()
}

/// The robot's links as a [`surefoot::model::Tree`] takes them, in its order: each body's frame has its link's axes.
/// What follows another joint is free.
pub fn core_links(robot: &Robot) -> Vec<Link> {
    home_links(robot).into_iter().map(HomeLink::to_core).collect()
}

impl HomeLink {
    /// As a [`surefoot::model::Tree`] takes it.
    pub fn to_core(self) -> Link {
        let Self { inboard, axis, point, .. } = self;
        let connected = match self.motion {
            RobotMotion::Revolute | RobotMotion::Continuous => Link::revolute(inboard, axis, point),
            RobotMotion::Prismatic => Link::prismatic(inboard, axis),
            RobotMotion::Spherical => Link::spherical(inboard, point),
            RobotMotion::Floating => Link::floating(inboard),
        };
        connected
            .body_with_products(self.mass, self.inertia, self.center)
            .oriented(self.orientation)
            .rotor_inertia(self.rotor_inertia)
    }

    /// The same as source text.
    pub fn to_source(self) -> String {
        let Self {
            inboard, axis, point, mass, inertia, center, orientation, rotor_inertia, ..
        } = self;
        let connected = match self.motion {
            RobotMotion::Revolute | RobotMotion::Continuous => {
                format!("Link::revolute({inboard}, {axis:?}, {point:?})")
            }
            RobotMotion::Prismatic => format!("Link::prismatic({inboard}, {axis:?})"),
            RobotMotion::Spherical => format!("Link::spherical({inboard}, {point:?})"),
            RobotMotion::Floating => format!("Link::floating({inboard})"),
        };
        // Most have none.
        let rotor = match rotor_inertia {
            0.0 => String::new(),
            rotor => format!(".rotor_inertia({rotor:?})"),
        };
        format!(
            "{connected}.body_with_products({mass:?}, {inertia:?}, {center:?}).oriented({orientation:?}){rotor}"
        )
    }
}

pub(crate) fn components(v: &Vector3<f64>) -> [f64; 3] {
    (*v).into()
}
