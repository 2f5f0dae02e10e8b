//! The host's controller under the core's supervisor: the same computation as on the target.

use super::controller::{
    Commanded, ControlFailure, Controller, HostController, Scalar, commanded, measured,
};
use super::filter::FilterPlace;
use super::limiting::LimitTally;
use crate::plant::PlantState;
use crate::record::{self, MeasuredBefore};
use crate::robot::{LEG, by_leg};
use crate::scene::{Scene, StateSource};
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{Before, SafetyLimits, StopReason, Supervisor, SupervisorMemory};
use surefoot::estimate::{ANGULAR_VELOCITY_STEPS, VELOCITY_STEPS};
use surefoot::spatial::Wrench;

/// A controller and its supervisor, armed.
pub struct SupervisedController<T, const LEGS: usize> {
    inner: HostController<T, LEGS>,
    supervisor: Supervisor<T, LEGS>,
}

impl<T: Real, const LEGS: usize> SupervisedController<T, LEGS> {
    /// For a scene's ticks.
    ///
    /// # Panics
    /// Where the robot's description has limits that are none, or the scene no control rate: the
    /// scene's check refuses the latter.
    pub fn new(
        inner: HostController<T, LEGS>,
        limits: SafetyLimits<T, LEGS>,
        scene: &Scene,
    ) -> Self {
        let period = T::of(1.0 / scene.controller.rate_hz);
        let limits = of_state(limits, scene);
        let mut supervisor = Supervisor::new(limits, period)
            .expect("limits of the robot, period of a checked scene");
        supervisor.arm();
        Self { inner, supervisor }
    }
}

impl<T: Real, const LEGS: usize> Controller for SupervisedController<T, LEGS> {
    fn filter_place(&self) -> FilterPlace {
        FilterPlace::Host(Scalar::of::<T>())
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        self.inner.look(state);
        let reference = self.inner.reference();
        let tick = |now: &_| self.inner.command(now);
        let answer = self.supervisor.step_with(Some(&measured(state)), &reference, false, tick);
        self.inner.sent(&answer.joint_torques);
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

    fn support(&self) -> Option<[f64; 3]> {
        self.inner.support()
    }

    fn observed(&self) -> Vec<f64> {
        self.inner.observed()
    }

    fn resume_observed(&mut self, memory: &[f64]) -> bool {
        self.inner.resume_observed(memory)
    }

    fn stop(&mut self, reason: StopReason) {
        self.supervisor.stop(reason);
    }

    fn stopped(&self) -> Option<StopReason> {
        self.supervisor.reason()
    }

    fn memory(&self) -> Option<record::SupervisorMemory> {
        Some(recorded(self.supervisor.memory()))
    }

    fn remember(&mut self, memory: &record::SupervisorMemory) -> bool {
        let memory = remembered(memory);
        memory.is_some_and(|memory| {
            self.supervisor.remember(memory);
            true
        })
    }
}

/// What a supervisor allows of the state that a scene's controller sees.
pub(super) fn of_state<T: Real, const LEGS: usize>(
    mut limits: SafetyLimits<T, LEGS>,
    scene: &Scene,
) -> SafetyLimits<T, LEGS> {
    if scene.sensing.state == StateSource::Estimate {
        let thresholds = &mut limits.thresholds;
        thresholds.velocity_step *= T::of(f64::from(VELOCITY_STEPS));
        thresholds.angular_velocity_step *= T::of(f64::from(ANGULAR_VELOCITY_STEPS));
    }
    limits
}

/// What a supervisor remembers, to be kept.
pub(super) fn recorded<T: Real, const LEGS: usize>(
    memory: &SupervisorMemory<T, LEGS>,
) -> record::SupervisorMemory {
    let flat = |legs: &[[T; 6]; LEGS]| -> Vec<f64> {
        legs.as_flattened().iter().map(|x| x.to_f64()).collect()
    };
    record::SupervisorMemory {
        mode: memory.mode,
        reason: memory.reason,
        torques: flat(&memory.torques),
        before: memory.before.as_ref().map(|before| {
            let measured = &before.state;
            let pose = measured.position.iter().copied().chain(measured.orientation.to_array());
            let twist: [T; 6] = measured.velocity.to_array();
            let mut positions: Vec<f64> = pose.map(Real::to_f64).collect();
            let mut velocities = twist.map(Real::to_f64).to_vec();
            positions.extend(flat(&measured.joint_angles));
            velocities.extend(flat(&measured.joint_rates));
            MeasuredBefore {
                positions,
                velocities,
                velocity: std::array::from_fn(|i| before.velocity[i].to_f64()),
                unexplained: before.unexplained.to_vec(),
            }
        }),
        missed: memory.missed,
        owed: memory.owed,
        doubtful: memory.doubtful,
        falling: memory.falling,
        saturated: memory.saturated,
        highest: memory.highest.map(Real::to_f64),
        cut: memory.cut,
    }
}

/// What was kept, if it is of a supervisor of this size.
pub(super) fn remembered<T: Real, const LEGS: usize>(
    memory: &record::SupervisorMemory,
) -> Option<SupervisorMemory<T, LEGS>> {
    let joints = LEGS * LEG;
    let fits = memory.torques.len() == joints
        && memory.before.as_ref().is_none_or(|before| {
            before.positions.len() == 7 + joints
                && before.velocities.len() == 6 + joints
                && before.unexplained.len() == LEGS
        });
    fits.then(|| SupervisorMemory {
        mode: memory.mode,
        reason: memory.reason,
        torques: by_leg(&memory.torques).map(|leg| leg.map(T::of)),
        before: memory.before.as_ref().map(|before| Before {
            state: measured(&PlantState {
                positions: before.positions.clone(),
                velocities: before.velocities.clone(),
            }),
            velocity: Vector3::from(before.velocity.map(T::of)),
            unexplained: std::array::from_fn(|leg| before.unexplained[leg]),
        }),
        missed: memory.missed,
        owed: memory.owed,
        doubtful: memory.doubtful,
        falling: memory.falling,
        saturated: memory.saturated,
        highest: memory.highest.map(T::of),
        cut: memory.cut,
    })
}
