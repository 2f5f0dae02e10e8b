//! The floor's parameters.

use serde::{Deserialize, Serialize};

/// A horizontal floor at z = 0 that yields like a stiff sheet of rubber (§5.3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Floor {
    /// `k_n`, N/m per contact point.
    pub normal_stiffness: f64,
    /// `b_n`, N·s/m.
    pub normal_damping: f64,
    /// `k_t`, N/m.
    pub tangential_stiffness: f64,
    /// `b_t`, N·s/m.
    pub tangential_damping: f64,
    /// `μ_s`, which ends sticking.
    pub static_friction: f64,
    /// `μ_d`, while sliding.
    pub dynamic_friction: f64,
    /// `zvt`, m/s: a point slower than this sticks.
    pub zero_velocity_threshold: f64,
}

impl Floor {
    /// §5.3's rubber with §4.3's friction of 0.3.
    pub const RUBBER: Self = Self {
        normal_stiffness: 75_000.0,
        normal_damping: 2_000.0,
        tangential_stiffness: 75_000.0,
        tangential_damping: 2_000.0,
        static_friction: 0.3,
        dynamic_friction: 0.3,
        zero_velocity_threshold: 1e-3,
    };

    /// The first parameter that is not a number this model can use, and what was expected of it.
    pub fn invalid(&self) -> Option<(&'static str, f64, &'static str)> {
        let at_least_zero = [
            ("normal_damping", self.normal_damping),
            ("tangential_damping", self.tangential_damping),
            ("static_friction", self.static_friction),
            ("dynamic_friction", self.dynamic_friction),
        ];
        let positive = [
            ("normal_stiffness", self.normal_stiffness),
            ("tangential_stiffness", self.tangential_stiffness),
            ("zero_velocity_threshold", self.zero_velocity_threshold),
        ];
        let negative = at_least_zero.into_iter().find(|(_, x)| !(x.is_finite() && *x >= 0.0));
        let not_positive = positive.into_iter().find(|(_, x)| !(x.is_finite() && *x > 0.0));
        negative
            .map(|(name, x)| (name, x, "a finite number, zero or more"))
            .or(not_positive.map(|(name, x)| (name, x, "a finite number above zero")))
    }
}
