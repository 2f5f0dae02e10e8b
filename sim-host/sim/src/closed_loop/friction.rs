//! Dry friction of joints that a controller makes up for.

use crate::scene::Scene;
use surefoot::Real;
use surefoot::disturbance::{friction_compensation, seen_friction};

/// What is known of it.
#[derive(Clone, Debug)]
pub(super) struct Friction<T> {
    /// As the robot's file states it, by joint, N·m.
    stated: Vec<T>,
    /// How much of it is made up for.
    share: T,
}

impl<T: Real> Friction<T> {
    /// Of a scene that has some of it made up for.
    pub fn of(scene: &Scene) -> Option<Self> {
        let share = scene.controller.friction_share;
        let stated = || scene.robot().passive.iter().map(|joint| T::of(joint.friction)).collect();
        (share > 0.0).then(|| Self { stated: stated(), share: T::of(share) })
    }

    /// Adds what joints need that move at these rates (rad/s) and are to be accelerated so (rad/s²), where that is
    /// known.
    pub fn add(&self, torques: &mut [T], rates: &[T], accelerations: Option<&[T]>) {
        for (k, (torque, stated)) in torques.iter_mut().zip(&self.stated).enumerate() {
            let rate = rates.get(k).copied().unwrap_or(T::zero());
            let acceleration = accelerations.and_then(|all| all.get(k)).copied();
            let acceleration = acceleration.unwrap_or(T::zero());
            *torque += friction_compensation(*stated, self.share, rate, acceleration);
        }
    }

    /// Takes off what friction leaves of torques at these rates.
    pub fn take(&self, torques: &mut [T], rates: &[T]) {
        for ((torque, stated), rate) in torques.iter_mut().zip(&self.stated).zip(rates) {
            *torque -= seen_friction(*stated, self.share, *rate);
        }
    }
}
