//! All methods by name.

use serde::{Deserialize, Serialize};

/// A method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Discrete Euler–Lagrange equations with the midpoint rule (2.23)
    Variational,
    /// Discrete Euler–Lagrange equations with the endpoint rule (2.45)
    VariationalEndpoint,
    /// Composition of variational steps to fourth order (Yoshida)
    #[value(name = "yoshida-4")]
    #[serde(rename = "yoshida-4")]
    Yoshida4,
    /// Composition of variational steps to sixth order (Yoshida)
    #[value(name = "yoshida-6")]
    #[serde(rename = "yoshida-6")]
    Yoshida6,
    /// Discrete Euler–Poincaré equations on the group of rotations; free bodies
    LieGroup,
    /// Implicit midpoint rule
    ImplicitMidpoint,
    /// Verlet (2.31); natural systems without constraints
    Verlet,
    /// SHAKE in positions (2.32); natural systems
    Shake,
    /// SHAKE in velocities: leap-frog; natural systems
    VelocityShake,
    /// RATTLE (2.33) to (2.37); natural systems
    Rattle,
    /// Energy-momentum method of §2.4.2; natural systems
    EnergyMomentum,
    /// Semi-implicit Euler on the differential equations
    SemiImplicitEuler,
    /// Classical Runge–Kutta method of fourth order
    #[value(name = "runge-kutta-4")]
    #[serde(rename = "runge-kutta-4")]
    RungeKutta4,
    /// The same, projected onto the constraints after each step
    #[value(name = "runge-kutta-4-projected")]
    #[serde(rename = "runge-kutta-4-projected")]
    RungeKutta4Projected,
    /// Adaptive Runge–Kutta method of eighth order of Dormand and Prince, at a tolerance of 1e-12
    #[value(name = "dormand-prince-8")]
    #[serde(rename = "dormand-prince-8")]
    DormandPrince8,
}

impl Method {
    /// Every one.
    pub fn all() -> &'static [Self] {
        <Self as clap::ValueEnum>::value_variants()
    }

    /// Its name on the command line and in files.
    pub fn name(self) -> String {
        clap::ValueEnum::to_possible_value(&self).map_or_else(String::new, |v| v.get_name().into())
    }

    /// What it is, in a line.
    pub fn description(self) -> String {
        clap::ValueEnum::to_possible_value(&self)
            .and_then(|value| value.get_help().map(ToString::to_string))
            .unwrap_or_default()
    }

    /// Order of its trajectories' error in the step; none where the step is not its own.
    pub fn order(self) -> Option<u32> {
        match self {
            Self::SemiImplicitEuler => Some(1),
            Self::Yoshida4 | Self::RungeKutta4 | Self::RungeKutta4Projected => Some(4),
            Self::Yoshida6 => Some(6),
            Self::DormandPrince8 => None,
            _ => Some(2),
        }
    }
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(&self.name())
    }
}
