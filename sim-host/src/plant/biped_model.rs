//! How many bodies the biped is made of.

use crate::multibody::Side;
use serde::{Deserialize, Serialize};

/// Bodies of §4.1.
pub(super) const BODIES: usize = 13;

/// Links of the small bodies inside hips and ankles, and the neighbour that each is given to. A leg moves most about
/// the lateral axis: about that a hip's inner body turns with the central body, its outer one with the thigh, and
/// an ankle's with the shank. Their centres of mass lie where the joint's axes meet.
pub const SMALL_BODIES: [(usize, Side); 6] = [
    (1, Side::Inboard),
    (2, Side::Outboard),
    (5, Side::Inboard),
    (7, Side::Inboard),
    (8, Side::Outboard),
    (11, Side::Inboard),
];

/// Which bodies the biped has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum BipedModel {
    /// All 13 of §4.1, on hinges.
    #[default]
    Full,
    /// Seven, the small ones of hips and ankles being lumped into their neighbours: hips are spherical joints
    /// with motors, ankles universal ones. The same 18 velocities.
    Lumped,
}

impl BipedModel {
    /// How many bodies it has.
    pub fn bodies(self) -> usize {
        match self {
            Self::Full => BODIES,
            Self::Lumped => BODIES - SMALL_BODIES.len(),
        }
    }
}

impl std::fmt::Display for BipedModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Full => "full",
            Self::Lumped => "lumped",
        })
    }
}
