//! The baseline plant: joint-space forward dynamics (Alg. 3.3) and semi-implicit Euler, with contact
//! forces at the corners of the soles. It is what most simulators do, kept to compare with.

use super::energies::energies;
use super::explicit_state::{ExplicitState, generalized};
use super::joint_stops::{motors_and_stops, stop_energy};
use super::{
    Observation, PerPoint, Plant, PlantState, StepFailure, check_velocities, fill_contacts,
    in_body, retract,
};
use nalgebra::Vector3;
use surefoot::dynamics::{body_poses, body_velocities, forward_dynamics, joint_poses};
use surefoot::model::robots::biped::{FEET, SoleOutline, TREE};
use surefoot::spatial::{Pose, Twist, Wrench};
use surefoot_multibody::Stops;
use surefoot_multibody::contact::{ContactPoint, ContactState, Floor, PointForce};

/// Coordinates and velocities of the robot.
const NQ: usize = 19;
const NV: usize = 18;
/// Corners of a sole.
const CORNERS: usize = 4;

/// The biped on a floor.
#[derive(Clone, Debug)]
pub struct OnFloor {
    state: ExplicitState<NQ, NV>,
    stops: Option<Vec<Stops>>,
    floor: Floor,
    /// In the feet's body frames, m.
    corners: [[Vector3<f64>; CORNERS]; 2],
    points: [[ContactPoint; CORNERS]; 2],
}

/// Forces of the floor at one state.
struct Touch {
    wrenches: [Wrench<f64>; 13],
    points: [[ContactPoint; CORNERS]; 2],
    corners: [[[f64; 3]; CORNERS]; 2],
    spring_energy: f64,
}

impl OnFloor {
    /// A biped with these soles. Each foot is the mirror of the other, so that one outline serves
    /// both.
    pub fn new(state: &PlantState, floor: Floor, outline: &SoleOutline) -> Self {
        let corners = outline.corners();
        Self {
            state: ExplicitState::of(state),
            stops: None,
            floor,
            corners: [corners, corners],
            points: [[ContactPoint::default(); CORNERS]; 2],
        }
    }

    /// With stops in the joints, left leg then right, hip to foot.
    pub fn with_stops(self, stops: Option<Vec<Stops>>) -> Self {
        Self { stops, ..self }
    }

    fn touch(&self, poses: &[Pose<f64>; 13], velocities: &[Twist<f64>; 13]) -> Touch {
        let mut touch = Touch {
            wrenches: [Wrench::zero(); 13],
            points: self.points,
            corners: [[[0.0; 3]; CORNERS]; 2],
            spring_energy: 0.0,
        };
        for (foot, body) in FEET.into_iter().enumerate() {
            let (pose, twist) = (&poses[body], &velocities[body]);
            for (corner, arm) in self.corners[foot].iter().enumerate() {
                let position = pose.transform_point(*arm);
                let velocity = pose.rotation * (twist.linear + twist.angular.cross(arm));
                let PointForce { force, point, spring_energy } =
                    self.points[foot][corner].evaluate(&self.floor, position, velocity);
                let in_body = pose.rotation.tr_mul(&force);
                touch.wrenches[body] += Wrench { force: in_body, torque: arm.cross(&in_body) };
                touch.corners[foot][corner] = force.into();
                touch.points[foot][corner] = point;
                touch.spring_energy += spring_energy;
            }
        }
        touch
    }
}

impl Plant for OnFloor {
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        self.state.read(state);
        Ok(())
    }

    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        let ExplicitState { positions, velocities } = self.state;
        let relative = joint_poses(&TREE, &positions)?;
        let poses = body_poses(&TREE, &relative);
        let mut touch = self.touch(&poses, &body_velocities(&TREE, &relative, &velocities));
        if let Some(load) = load {
            touch.wrenches[0] += in_body(&load, &poses[0]);
        }
        let accelerations = forward_dynamics(
            &TREE,
            &relative,
            &velocities,
            &generalized(&motors_and_stops(torques, self.stops.as_deref(), &positions)),
            Some(&touch.wrenches),
        )?;
        let mut next = velocities;
        for (v, a) in next.iter_mut().zip(accelerations) {
            *v += step_s * a;
        }
        check_velocities(&next)?;
        self.state =
            ExplicitState { positions: retract(&positions, &next, step_s), velocities: next };
        self.points = touch.points;
        Ok(())
    }

    fn read_contacts(&self, contacts: &mut PerPoint<ContactState>) -> bool {
        fill_contacts(
            self.points.iter().map(|foot| foot.iter().map(|point| point.state)),
            contacts,
        );
        true
    }

    fn unknowns(&self) -> usize {
        NV
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let ExplicitState { positions, velocities } = &self.state;
        let relative = joint_poses(&TREE, positions)?;
        let poses = body_poses(&TREE, &relative);
        let touch = self.touch(&poses, &body_velocities(&TREE, &relative, velocities));
        let (kinetic_energy, potential) = energies(&TREE, &poses, &relative, velocities);
        Ok(Observation {
            kinetic_energy,
            potential_energy: potential
                + touch.spring_energy
                + stop_energy(self.stops.as_deref(), positions),
            foot_forces: touch.corners.map(|foot| foot.iter().map(|force| force[2]).sum()).to_vec(),
            contacts: self.contacts(),
            corner_forces: Some(touch.corners.map(|foot| foot.to_vec()).to_vec()),
            block: None,
            constraint: 0.0,
        })
    }

    /// Explicit damping `b` on an effective mass `m` is stable for `h < 2m/b`, a spring `k` for
    /// `h < 2√(m/k)`. The lightest answers to the floor are those of a foot alone: rolling about its
    /// long axis (1.89e-3 kg·m², against the corners' damping across and along the sole's normal),
    /// and heaving (1.455 kg).
    fn step_limit(&self) -> Option<f64> {
        let [rolling_inertia, mass] = [0.00189, 1.455];
        let damping: f64 = self.corners[0]
            .iter()
            .map(|c| {
                self.floor.normal_damping * c.y * c.y + self.floor.tangential_damping * c.z * c.z
            })
            .sum();
        let roll = 2.0 * rolling_inertia / damping;
        let heave = 2.0 * mass / (CORNERS as f64 * self.floor.normal_damping);
        let stiffness = 2.0 * (mass / (CORNERS as f64 * self.floor.normal_stiffness)).sqrt();
        // Stops of an ankle press against the same foot.
        let hardest = self.stops.iter().flatten().map(|s| s.stiffness).fold(0.0, f64::max);
        let stops = 2.0 * (rolling_inertia / hardest).sqrt();
        Some(roll.min(heave).min(stiffness).min(stops))
    }
}
