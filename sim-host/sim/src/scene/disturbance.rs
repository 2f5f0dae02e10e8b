//! What disturbs a robot: pushes, and a block that is thrown at it.

use crate::plant::ThrownBlock;
use serde::{Deserialize, Serialize};
use surefoot_multibody::contact::{Floor, YieldingBox};

/// A force on the central body's centre of mass, for a while. In each step it acts with the share of the step that it
/// lasts, so that its impulse is exact, however short it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Push {
    /// When it begins, s; zero or more.
    pub at_s: f64,
    /// How long it lasts, s.
    pub duration_s: f64,
    /// World frame, N.
    pub force_n: [f64; 3],
}

/// A free, uniform block that is thrown at the central body: its eight corners, and the centres of its six
/// faces, strike a box around that body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// kg
    pub mass_kg: f64,
    /// Edges along x, y and z, m.
    pub size_m: [f64; 3],
    /// Centre of mass at t = 0, world frame, m. Its edges are along the world's axes there.
    pub position_m: [f64; 3],
    /// Velocity at t = 0, world frame, m/s. It does not turn.
    pub velocity_mps: [f64; 3],
    /// The box that it strikes.
    pub strikes: StruckBox,
}

impl Block {
    /// As plants take it.
    pub fn thrown(&self) -> ThrownBlock {
        let half = |size: [f64; 3]| size.map(|edge| 0.5 * edge);
        let StruckBox { size_m, offset_m, surface } = self.strikes;
        let around = YieldingBox { center: offset_m, half_size: half(size_m), surface };
        ThrownBlock {
            mass: self.mass_kg,
            size: self.size_m,
            position: self.position_m,
            velocity: self.velocity_mps,
            around,
        }
    }
}

/// A box around the central body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StruckBox {
    /// Edges along the body's axes, m.
    pub size_m: [f64; 3],
    /// Its centre from the body's centre of mass, in the body's axes, m.
    #[serde(default)]
    pub offset_m: [f64; 3],
    /// How its faces yield to each point: the law of §5.2, with the face as the floor.
    pub surface: Floor,
}
