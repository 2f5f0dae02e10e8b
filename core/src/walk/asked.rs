//! What a phase on the ground asks for, with height and trunk.

use super::orientation::level;
use super::{Planner, WalkMemory, height};
use crate::Real;
use crate::balance::{AngularTask, FootTask, LinearTask, MotionTask, ObservedMotion};
use nalgebra::{Vector2, Vector3};

/// What a phase asks for, before height and trunk.
pub(super) struct Asked<T, const FEET: usize> {
    pub horizontal: Horizontal<T>,
    pub feet: [FootTask<T>; FEET],
    /// Height of the ground that carries.
    pub ground: T,
    /// The step under way, less the step in place.
    pub step: Vector2<T>,
}

pub(super) enum Horizontal<T> {
    Acceleration(Vector2<T>),
    Pressure(Vector2<T>),
}

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    /// With height and trunk.
    pub(super) fn motion(
        &self,
        memory: &WalkMemory<T, FEET>,
        (observed, velocity, lowered): (&ObservedMotion<T, FEET>, Vector2<T>, T),
        asked: Asked<T, FEET>,
    ) -> MotionTask<T, FEET> {
        let gait = &self.gait;
        let carried = height::carried(gait, &self.stature, velocity, asked.step, lowered);
        let [stiffness, damping] = gait.height_gains;
        let error = observed.center_of_mass.z - asked.ground - carried;
        let vertical = -error * stiffness - observed.velocity.z * damping;
        let linear = match asked.horizontal {
            Horizontal::Acceleration(a) => {
                LinearTask::CenterOfMass(Vector3::new(a.x, a.y, vertical))
            }
            Horizontal::Pressure(point) => LinearTask::CenterOfPressure {
                point: point.into(),
                vertical,
                per_length: gait.omega * gait.omega,
            },
        };
        let angular = AngularTask::CentralBody(level(
            &observed.central_rotation,
            &observed.angular_velocity,
            (memory.heading, memory.commanded.turning_rate),
            gait.trunk_gains,
        ));
        MotionTask { linear, angular, feet: asked.feet }
    }
}

/// A foot that carries what comes.
pub(super) fn press<T: Real>() -> FootTask<T> {
    FootTask::Press { most_force: T::of(f64::INFINITY) }
}

pub(super) fn is_finite<T: Real, const FEET: usize>(task: &MotionTask<T, FEET>) -> bool {
    let linear = match task.linear {
        LinearTask::CenterOfMass(a) => a.sum(),
        LinearTask::CenterOfPressure { point: [x, y], vertical, .. } => x + y + vertical,
        LinearTask::Free => T::zero(),
    };
    let feet = task.feet.iter().fold(T::zero(), |sum, foot| match foot {
        FootTask::Press { .. } => sum,
        FootTask::Swing { linear, angular } => sum + linear.sum() + angular.sum(),
    });
    let angular = match task.angular {
        AngularTask::CentralBody(acceleration) => acceleration.sum(),
        AngularTask::Momentum { rate, inertia } => rate.sum() + inertia,
    };
    (linear + angular + feet).is_finite()
}
