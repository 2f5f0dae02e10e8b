//! The host's controller under the core's supervisor: the same computation as on the target.

use super::controller::{
    Commanded, ControlFailure, Controller, HostController, commanded, measured,
};
use super::limiting::LimitTally;
use crate::plant::PlantState;
use crate::record::{self, MeasuredBefore};
use crate::scene::Scene;
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{Before, SafetyLimits, StopReason, Supervisor, SupervisorMemory};
use surefoot::spatial::Wrench;

/// A controller and its supervisor, armed.
pub struct SupervisedController<T: 'static> {
    inner: HostController<T>,
    supervisor: Supervisor<T, 2>,
}

impl<T: Real> SupervisedController<T> {
    /// For a scene's ticks.
    ///
    /// # Panics
    /// Where the robot's description has limits that are none, or the scene no control rate: the
    /// scene's check refuses the latter.
    pub fn new(inner: HostController<T>, limits: SafetyLimits<T, 2>, scene: &Scene) -> Self {
        let period = T::of(1.0 / scene.controller.rate_hz);
        let mut supervisor = Supervisor::new(limits, period)
            .expect("limits of the robot, period of a checked scene");
        supervisor.arm();
        Self { inner, supervisor }
    }
}

impl<T: Real> Controller for SupervisedController<T> {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let reference = self.inner.reference;
        let tick = |now: &_| self.inner.command(now);
        let answer = self.supervisor.step_with(Some(&measured(state)), &reference, false, tick);
        let wrench = answer.command.map_or_else(Wrench::zero, |command| command.desired_wrench);
        Ok(commanded(answer.joint_torques, wrench))
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        self.inner.touch(time_s, feet);
    }

    fn limits(&self) -> Option<LimitTally> {
        self.inner.limits()
    }

    fn limit_rows(&self) -> Vec<(u8, f64)> {
        self.inner.limit_rows()
    }

    fn resume_limits(&mut self, rows: &[(u8, f64)]) {
        self.inner.resume_limits(rows);
    }

    fn stopped(&self) -> Option<StopReason> {
        self.supervisor.reason()
    }

    fn memory(&self) -> Option<record::SupervisorMemory> {
        let memory = self.supervisor.memory();
        let flat = |legs: &[[T; 6]; 2]| std::array::from_fn(|i| legs[i / 6][i % 6].to_f64());
        Some(record::SupervisorMemory {
            mode: memory.mode,
            reason: memory.reason,
            torques: flat(&memory.torques),
            before: memory.before.as_ref().map(|before| {
                let (angles, rates): ([f64; 12], [f64; 12]) =
                    (flat(&before.state.joint_angles), flat(&before.state.joint_rates));
                let pose: [T; 4] = before.state.orientation.to_array();
                let twist: [T; 6] = before.state.velocity.to_array();
                MeasuredBefore {
                    positions: std::array::from_fn(|i| match i {
                        0..3 => before.state.position[i].to_f64(),
                        3..7 => pose[i - 3].to_f64(),
                        _ => angles[i - 7],
                    }),
                    velocities: std::array::from_fn(|i| match i {
                        0..6 => twist[i].to_f64(),
                        _ => rates[i - 6],
                    }),
                    velocity: std::array::from_fn(|i| before.velocity[i].to_f64()),
                    unexplained: before.unexplained,
                }
            }),
            missed: memory.missed,
            owed: memory.owed,
            doubtful: memory.doubtful,
            falling: memory.falling,
            saturated: memory.saturated,
            highest: memory.highest.map(Real::to_f64),
            cut: memory.cut,
        })
    }

    fn remember(&mut self, memory: &record::SupervisorMemory) -> bool {
        let legs = |flat: &[f64; 12]| {
            std::array::from_fn(|leg| std::array::from_fn(|joint| T::of(flat[6 * leg + joint])))
        };
        self.supervisor.remember(SupervisorMemory {
            mode: memory.mode,
            reason: memory.reason,
            torques: legs(&memory.torques),
            before: memory.before.as_ref().map(|before| Before {
                state: measured(&PlantState {
                    positions: before.positions,
                    velocities: before.velocities,
                }),
                velocity: Vector3::from(before.velocity.map(T::of)),
                unexplained: before.unexplained,
            }),
            missed: memory.missed,
            owed: memory.owed,
            doubtful: memory.doubtful,
            falling: memory.falling,
            saturated: memory.saturated,
            highest: memory.highest.map(T::of),
            cut: memory.cut,
        });
        true
    }
}
