//! Where a body is at the end of a trial of a step, and the impulse on it.

use super::stiffness::Pair;
use super::turn::Turn;
use nalgebra::Vector3;

/// Where a body is at the trial's end, and the impulse on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub turn: Turn,
    /// Of the reference point.
    pub displacement: Vector3<f64>,
    pub to_center: Vector3<f64>,
    /// `d`
    pub velocity: Vector3<f64>,
    /// `I v`
    pub inertia_turn: Vector3<f64>,
    /// `L`
    pub spin: Vector3<f64>,
    /// `w⁻` about the reference point: the body's own, then that of all outboard.
    pub own: Pair,
    pub all: Pair,
}

impl End {
    /// Of a body that has not moved.
    pub const AT_REST: Self = {
        let zero = Vector3::new(0.0, 0.0, 0.0);
        Self {
            turn: Turn::NONE,
            displacement: zero,
            to_center: zero,
            velocity: zero,
            inertia_turn: zero,
            spin: zero,
            own: Pair::ZERO,
            all: Pair::ZERO,
        }
    };
}
