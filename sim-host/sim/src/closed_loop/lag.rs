//! Motors that follow their command late, as a first-order lag does, and lose a part of it.
//!
//! # Notation
//! `u`: command, held over a step of `h`; `y`: what is given; `T`: time constant
//! ```text
//! y' = (u − y)/T:   y⁺ = u + (y − u) e^(−h/T),   mean over the step = u + (y − u) (1 − e^(−h/T)) T/h
//! ```

/// What all motors give, and how it changes over a step.
#[derive(Clone, Debug)]
pub(super) struct Lag {
    /// `y`, N·m.
    pub given: Vec<f64>,
    decay: f64,
    /// `(1 − e^(−h/T)) T/h`
    mean: f64,
}

impl Lag {
    /// At rest.
    pub fn new(time_constant_s: f64, step_s: f64, joints: usize) -> Self {
        let x = step_s / time_constant_s;
        Self { given: vec![0.0; joints], decay: (-x).exp(), mean: -(-x).exp_m1() / x }
    }

    /// Turns commands into what is given on average over a step.
    pub fn over_step(&self, torques: &mut [f64]) {
        for (torque, given) in torques.iter_mut().zip(&self.given) {
            *torque += (given - *torque) * self.mean;
        }
    }

    /// Goes on over a step with these commands.
    pub fn advance(&mut self, commands: &[f64]) {
        for (given, command) in self.given.iter_mut().zip(commands) {
            *given = command + (*given - command) * self.decay;
        }
    }
}

/// What is left of a torque beyond a dead zone.
pub(super) fn beyond(torque: f64, dead: f64) -> f64 {
    (torque.abs() - dead).max(0.0).copysign(torque)
}
