//! A thrown block beside an explicit plant: semi-implicit Euler for the block, and the forces between it and
//! the central body at the step's beginning.

use super::thrown_block::{BlockSample, ThrownBlock};
use super::{DIVERGED, Observation, PerPoint, Plant, PlantState, StepFailure};
use nalgebra::{Matrix3, Vector3};
use surefoot::model::robots::biped::TREE;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_multibody::contact::{BoxPoint, ContactPoint, ContactState, Floor};
use surefoot_multibody::{BOX_POINTS, CORNERS};

/// A plant, and a block that is thrown at its central body.
pub struct Struck {
    robot: Box<dyn Plant>,
    /// The robot's, when it was read last.
    state: PlantState,
    block: ThrownBlock,
    floor: Option<Floor>,
    points: [Vector3<f64>; BOX_POINTS],
    position: Vector3<f64>,
    orientation: Quaternion<f64>,
    velocity: Vector3<f64>,
    /// In the block's axes, rad/s.
    angular_velocity: Vector3<f64>,
    strikes: [BoxPoint; BOX_POINTS],
    touches: [ContactPoint; CORNERS],
}

/// Forces at one state: world axes, moments about the centres of mass.
struct Forces {
    on_block: Wrench<f64>,
    on_robot: Wrench<f64>,
    /// Of the robot on the block, N.
    strike: Vector3<f64>,
    spring_energy: f64,
    strikes: [BoxPoint; BOX_POINTS],
    touches: [ContactPoint; CORNERS],
}

impl Struck {
    /// A block beside a robot; it lands on the floor, if there is one.
    pub fn new(robot: Box<dyn Plant>, block: ThrownBlock, floor: Option<Floor>) -> Self {
        Self {
            robot,
            state: PlantState::default(),
            block,
            floor,
            strikes: [BoxPoint::default(); BOX_POINTS],
            touches: [ContactPoint::default(); CORNERS],
            points: block.points(),
            position: block.position.into(),
            orientation: Quaternion::identity(),
            velocity: block.velocity.into(),
            angular_velocity: Vector3::zeros(),
        }
    }

    fn forces(&mut self) -> Result<Forces, StepFailure> {
        self.robot.read_state(&mut self.state)?;
        let PlantState { positions: p, velocities: v } = &self.state;
        let on = Quaternion::from_array([p[3], p[4], p[5], p[6]]).to_matrix();
        let center = Vector3::new(p[0], p[1], p[2]);
        let linear = on * Vector3::new(v[0], v[1], v[2]);
        let angular = on * Vector3::new(v[3], v[4], v[5]);
        let of = self.orientation.to_matrix();
        let turning = of * self.angular_velocity;
        let mut forces = Forces {
            on_block: Wrench::zero(),
            on_robot: Wrench::zero(),
            strike: Vector3::zeros(),
            spring_energy: 0.0,
            strikes: self.strikes,
            touches: self.touches,
        };
        for (point, memory) in self.points.iter().zip(&mut forces.strikes) {
            let arm = of * point;
            let from_robot = self.position + arm - center;
            let velocity =
                self.velocity + turning.cross(&arm) - linear - angular.cross(&from_robot);
            let a = on.tr_mul(&from_robot);
            let (force, after) = memory.evaluate(&self.block.around, &a, &on.tr_mul(&velocity));
            *memory = after;
            forces.spring_energy += after.spring_energy(&self.block.around, &a);
            let force = on * force;
            forces.strike += force;
            forces.on_block += Wrench { force, torque: arm.cross(&force) };
            forces.on_robot += Wrench { force: -force, torque: -from_robot.cross(&force) };
        }
        if let Some(floor) = &self.floor {
            for (point, memory) in self.points.iter().zip(&mut forces.touches) {
                let arm = of * point;
                let found = memory.evaluate(
                    floor,
                    self.position + arm,
                    self.velocity + turning.cross(&arm),
                );
                *memory = found.point;
                forces.spring_energy += found.spring_energy;
                let force = found.force;
                forces.on_block += Wrench { force, torque: arm.cross(&force) };
            }
        }
        Ok(forces)
    }

    /// The block's energy, J.
    fn energy(&self) -> (f64, f64) {
        let inertia = Matrix3::from_diagonal(&self.block.inertia().into());
        let spin = self.angular_velocity.dot(&(inertia * self.angular_velocity));
        let kinetic = 0.5 * (self.block.mass * self.velocity.norm_squared() + spin);
        (kinetic, -self.block.mass * TREE.gravity().dot(&self.position))
    }
}

impl Plant for Struck {
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        self.robot.read_state(state)
    }

    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        let forces = self.forces()?;
        let mut on_robot = load.unwrap_or(Wrench::zero());
        on_robot += forces.on_robot;
        let inertia = Vector3::from(self.block.inertia());
        let omega = self.angular_velocity;
        let torque = self.orientation.conjugate().rotate(forces.on_block.torque)
            - omega.cross(&inertia.component_mul(&omega));
        let velocity =
            self.velocity + (forces.on_block.force / self.block.mass + TREE.gravity()) * step_s;
        let omega = omega + torque.component_div(&inertia) * step_s;
        let fastest = velocity.abs().max().max(omega.abs().max());
        if !(fastest <= DIVERGED) {
            return Err(StepFailure::BlockDiverged { value: fastest });
        }
        self.robot.step(step_s, torques, Some(on_robot))?;
        self.velocity = velocity;
        self.angular_velocity = omega;
        self.position += velocity * step_s;
        let turned = self.orientation.product(Quaternion::from_rotation_vector(omega * step_s));
        self.orientation = turned.normalized().unwrap_or(turned);
        self.strikes = forces.strikes;
        self.touches = forces.touches;
        Ok(())
    }

    fn read_contacts(&self, contacts: &mut PerPoint<ContactState>) -> bool {
        self.robot.read_contacts(contacts)
    }

    fn unknowns(&self) -> usize {
        self.robot.unknowns()
    }

    fn is_struck(&self) -> bool {
        self.strikes.iter().any(|point| point.face.is_some())
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let seen = self.robot.observe()?;
        let forces = self.forces()?;
        let (kinetic, potential) = self.energy();
        let [x, y, z] = self.position.into();
        let [s, i, j, k] = self.orientation.to_array();
        Ok(Observation {
            kinetic_energy: seen.kinetic_energy + kinetic,
            potential_energy: seen.potential_energy + potential + forces.spring_energy,
            block: Some(BlockSample { pose: [x, y, z, s, i, j, k], force: forces.strike.into() }),
            ..seen
        })
    }

    fn step_limit(&self) -> Option<f64> {
        self.robot.step_limit()
    }
}
