//! How many bodies a robot is modelled with.

use serde::{Deserialize, Serialize};

/// Which bodies a robot has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum RobotModel {
    /// All of them, on hinges.
    #[default]
    Full,
    /// Small ones inside hips and ankles are lumped into their neighbours: hips are spherical joints with motors,
    /// ankles universal ones. The same velocities.
    Lumped,
}

impl std::fmt::Display for RobotModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Full => "full",
            Self::Lumped => "lumped",
        })
    }
}
