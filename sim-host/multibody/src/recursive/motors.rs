//! Motors of spherical joints in a motion: torques at either end of a step, angles and rates.
//!
//! A torque that is held about axes which move does at a step's two ends `½h T⁻` and `½h T⁺`, each with the
//! axes of that end: the virtual work is that of the motors' angles, exactly as of single joints in a row.

use super::super::gimbal::{Gimbal, GimbalPose};
use super::super::system::System;
use super::node::{Kind, Node, Place};
use super::simulation::Simulation;
use super::trial::{Loads, Trial};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use surefoot::spatial::Quaternion;

/// A spherical joint's motors.
#[derive(Clone, Debug)]
pub(super) struct Motors {
    pub link: usize,
    /// Its first column.
    pub column: usize,
    gimbal: Gimbal,
    to_home: Quaternion<f64>,
    /// World axes.
    pose: GimbalPose,
}

/// Angles now, and what they changed by in the last step and in the one before, rad.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Turned {
    pub angles: [f64; 3],
    last: [f64; 3],
    before: [f64; 3],
}

impl Motors {
    /// Of all spherical joints that have some.
    pub fn all(system: &System, nodes: &[Node]) -> Vec<Self> {
        let each = system.gimbals().iter().map(|(link, gimbal)| Self {
            link: *link,
            column: nodes[*link].columns.start,
            gimbal: *gimbal,
            to_home: Quaternion::from_array(system.links()[*link].joint.home).conjugate(),
            pose: gimbal.pose(&Quaternion::identity()),
        });
        each.collect()
    }

    /// Finds axes and angles where the joint is, `relative` being its orientation against its inboard body.
    pub fn find(&mut self, relative: [f64; 4], inboard: &Place) {
        let turned = Quaternion::from_array(relative).product(self.to_home);
        self.pose = self.gimbal.pose(&turned).seen(|axis| inboard.rotation * axis);
    }

    pub fn angles(&self) -> [f64; 3] {
        self.pose.angles
    }

    pub fn is_locked(&self) -> bool {
        self.pose.is_locked()
    }

    /// `T` of these torques by column, world axes.
    pub fn torque(&self, torques: &[f64]) -> Vector3<f64> {
        self.pose.torque(std::array::from_fn(|i| torques[self.column + i]))
    }

    /// Rates of the motors in place of the angular velocity, by column.
    pub fn tell_rates(&self, rates: &mut [f64]) {
        let own = &mut rates[self.column..self.column + 3];
        let found = self.pose.rates(&Vector3::new(own[0], own[1], own[2]));
        own.copy_from_slice(&found);
    }
}

impl Turned {
    /// At rest where it is, in steps that turn it by so much.
    pub fn start(angles: [f64; 3], step: [f64; 3]) -> Self {
        Self { angles, last: step, before: step }
    }

    /// Goes on to these angles by a step `ratio` times as long as the last one.
    pub fn go_on(&mut self, angles: [f64; 3], ratio: f64) {
        self.before = self.last.map(|way| way * ratio);
        // An angle may pass from half a turn to minus half a turn.
        let way = |to: f64, from: f64| (to - from + PI).rem_euclid(TAU) - PI;
        self.last = std::array::from_fn(|i| way(angles[i], self.angles[i]));
        self.angles = angles;
    }

    /// Rates from the mean ones of the last two steps, carried on to now.
    pub fn observed(&self, h: f64) -> [f64; 3] {
        std::array::from_fn(|i| (1.5 * self.last[i] - 0.5 * self.before[i]) / h)
    }
}

impl Trial {
    /// Torques of spherical joints' motors, with their axes where a step begins.
    pub fn begin_motors(&mut self, motors: &[Motors], loads: &Loads) {
        for (at_begin, motors) in self.motor_torques.iter_mut().zip(motors) {
            at_begin.1 = motors.torque(&loads.torques);
        }
    }

    /// The same as own impulses of a step's end.
    pub fn end_motors(&mut self, motors: &[Motors], loads: &Loads, h: f64) {
        for motors in motors {
            let torque = motors.torque(&loads.torques);
            let c = motors.column;
            for (impulse, torque) in self.own_impulses[c..c + 3].iter_mut().zip(torque.iter()) {
                *impulse = 0.5 * h * torque;
            }
        }
    }
}

impl Simulation {
    /// Angles of a joint's motors: two of a universal joint, three of a spherical one with motors, one as for
    /// [`Self::angle`]; then zeros.
    pub fn angles(&self, link: usize) -> [f64; 3] {
        match self.motors.iter().find(|motors| motors.link == link) {
            Some(motors) => motors.angles(),
            None => {
                let [first, second] = self.at.coordinates[link].angles;
                [first, second, 0.0]
            }
        }
    }

    /// Holds torques (N·m; forces, N, of a prismatic joint) in as many motors as a joint has, in the order of
    /// [`Self::angles`], until they are set again. A spherical joint without motors and a floating one take none.
    pub fn set_torques(&mut self, link: usize, torques: &[f64]) {
        let node = &self.nodes[link];
        let has_motors = match node.kind {
            Kind::Spherical => self.motors.iter().any(|motors| motors.link == link),
            Kind::Floating => false,
            _ => true,
        };
        if has_motors {
            let held = &mut self.loads.torques[node.columns.clone()];
            held.iter_mut().zip(torques).for_each(|(held, torque)| *held = *torque);
        }
    }
}
