//! Motors of joints that close loops, in a motion.
//!
//! Such a joint has no columns. Its motors' torque is taken, as [`super::motors`] does it, with the axes of either
//! end of a step, and acts on its two bodies as an impulse `±½h T` at each end.

use super::super::gimbal::{Gimbal, GimbalPose};
use super::super::{BodyState, Closing, Joint, JointConstraint, System};
use super::motors::Turned;
use super::node::{Node, Place};
use super::simulation::Simulation;
use super::stiffness::Pair;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// Motors of a joint that closes a loop.
#[derive(Clone, Debug)]
pub(super) struct DrivenLoop {
    /// Its number among the closures.
    pub closure: usize,
    /// Outboard and inboard.
    bodies: [Option<usize>; 2],
    joint: Joint,
    /// N·m
    pub torques: [f64; 3],
    pub angles: [f64; 3],
    axes: Axes,
}

/// Axes of motors now, in world axes.
#[derive(Clone, Copy, Debug)]
enum Axes {
    /// At right angles; as many as the joint has motors, then zeros.
    Square([Vector3<f64>; 3]),
    Gimbal(Gimbal, GimbalPose),
}

impl DrivenLoop {
    /// All that a system has.
    pub fn all(system: &System) -> Vec<Self> {
        let each = system.closing_motors().iter().filter_map(|motors| {
            let closure = system.closures().get(motors.closure)?;
            let Closing::Joint(joint) = closure.closing else { return None };
            let axes = match motors.gimbal {
                Some(gimbal) => Axes::Gimbal(gimbal, gimbal.pose(&Quaternion::identity())),
                None => Axes::Square([Vector3::zeros(); 3]),
            };
            Some(Self {
                closure: motors.closure,
                bodies: [Some(closure.outboard), closure.inboard],
                joint,
                torques: [0.0; 3],
                angles: [0.0; 3],
                axes,
            })
        });
        each.collect()
    }

    /// Finds axes and angles where the bodies are.
    pub fn find(&mut self, places: &[Place]) {
        let world = Place::world();
        let [outboard, inboard] = self.bodies.map(|body| body.map_or(&world, |k| &places[k]));
        if let Axes::Gimbal(gimbal, pose) = &mut self.axes {
            let home = Quaternion::from_array(self.joint.home).conjugate();
            let relative = inboard.orientation.conjugate().product(outboard.orientation);
            *pose = gimbal.pose(&relative.product(home)).seen(|axis| inboard.rotation * axis);
            self.angles = pose.angles;
            return;
        }
        let state = |place: &Place| -> BodyState {
            let ([s, i, j, k], p) = (place.orientation.to_array(), place.center);
            [p.x, p.y, p.z, s, i, j, k]
        };
        let at = Node::coordinates(&self.joint, &state(outboard), &state(inboard));
        self.angles = [at.angles[0], at.angles[1], 0.0];
        let nothing = Vector3::zeros();
        self.axes = Axes::Square(match self.joint.constraint {
            JointConstraint::Universal { outboard_axis, inboard_axis } => [
                inboard.rotation * Vector3::from(inboard_axis),
                outboard.rotation * Vector3::from(outboard_axis),
                nothing,
            ],
            JointConstraint::Revolute { axis } => {
                [outboard.rotation * Vector3::from(axis), nothing, nothing]
            }
            _ => [nothing; 3],
        });
    }

    /// The joint's link if the middle one of three motors is near a quarter turn.
    pub fn locked(&self) -> Option<usize> {
        let Axes::Gimbal(_, pose) = &self.axes else { return None };
        self.bodies[0].filter(|_| pose.is_locked())
    }

    /// The motors' impulses at one end of a step, with the axes of now.
    pub fn impulses(&self, h: f64) -> impl Iterator<Item = (usize, Pair)> + use<> {
        let torque = match &self.axes {
            Axes::Gimbal(_, pose) => pose.torque(self.torques),
            Axes::Square(axes) => {
                axes.iter().zip(self.torques).map(|(axis, torque)| axis * torque).sum()
            }
        };
        let half = torque * (0.5 * h);
        self.bodies.into_iter().zip([half, -half]).filter_map(|(body, angular)| {
            body.map(|k| (k, Pair { linear: Vector3::zeros(), angular }))
        })
    }

    /// What the motors turn by in a step of `h`, at these angular velocities of all bodies.
    pub fn start(&self, turning: &[Vector3<f64>], h: f64) -> Turned {
        let [outboard, inboard] =
            self.bodies.map(|body| body.map_or(Vector3::zeros(), |k| turning[k]));
        let omega = outboard - inboard;
        let rates = match &self.axes {
            Axes::Gimbal(_, pose) => pose.rates(&omega),
            Axes::Square(axes) => axes.map(|axis| axis.dot(&omega)),
        };
        Turned::start(self.angles, rates.map(|rate| rate * h))
    }
}

impl Simulation {
    /// Angles of the motors of a joint that closes a loop, by the closure's number: one, two or three; then zeros.
    pub fn closing_angles(&self, closure: usize) -> [f64; 3] {
        let found = self.driven.iter().find(|driven| driven.closure == closure);
        found.map_or([0.0; 3], |driven| driven.angles)
    }

    /// Their rates, as [`Self::observed_rates`] has those of other joints.
    pub fn closing_rates(&self, closure: usize) -> [f64; 3] {
        let turned = self.at.turned[self.motors.len()..].iter();
        let found = self.driven.iter().zip(turned).find(|(driven, _)| driven.closure == closure);
        found.map_or([0.0; 3], |(_, turned)| turned.observed(self.at.last_h))
    }

    /// Holds torques (N·m) in them until they are set again. A closure without motors takes none.
    pub fn set_closing_torques(&mut self, closure: usize, torques: &[f64]) {
        for driven in self.driven.iter_mut().filter(|driven| driven.closure == closure) {
            driven.torques.iter_mut().zip(torques).for_each(|(held, torque)| *held = *torque);
        }
    }
}
