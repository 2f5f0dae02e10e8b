//! The controllers whose torques are compared: precision, feet, and what is left out.

use crate::callgrind::word;
use clap::{Args, ValueEnum};
use serde::Serialize;
use surefoot_sim::closed_loop::{
    Approximation, Controller, Scalar, approximate_controller, bare_controller,
};
use surefoot_sim::scene::{Scene, Workspace};

/// A form of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Args)]
pub struct ControllerForm {
    /// Precision
    #[arg(long, value_enum)]
    pub scalar: Scalar,
    /// Times that a foot is as heavy as the central body; feet held exactly without it
    #[arg(long)]
    pub factor: Option<f64>,
    /// What is left out
    #[arg(long, value_enum, conflicts_with = "factor")]
    pub approximation: Option<Approximation>,
}

/// Powers of ten.
const FACTORS: std::ops::RangeInclusive<i32> = 2..=9;

impl ControllerForm {
    /// Feet held exactly in double precision, with nothing left out: what others are compared with.
    pub const EXACT: Self = Self { scalar: Scalar::F64, factor: None, approximation: None };

    /// All that are compared, each in f64 and f32.
    pub fn all() -> Vec<Self> {
        let big = FACTORS.map(|power| Self { factor: Some(10_f64.powi(power)), ..Self::EXACT });
        let less = Approximation::value_variants().iter();
        let less = less.map(|left_out| Self { approximation: Some(*left_out), ..Self::EXACT });
        let all = std::iter::once(Self::EXACT).chain(big).chain(less);
        all.flat_map(|form| [Scalar::F64, Scalar::F32].map(|scalar| Self { scalar, ..form }))
            .collect()
    }

    /// With the gains and the set point of a scene. Its torques are those of one state, so that it has no
    /// supervisor, which remembers the one before.
    pub fn controller(&self, scene: &Scene) -> Box<dyn Controller> {
        let mut scene = scene.clone();
        scene.controller.workspace = self.factor.map_or(Workspace::FixedFoot, Workspace::BigBase);
        match self.approximation {
            None => bare_controller(&scene, self.scalar),
            Some(approximation) => approximate_controller(&scene, self.scalar, approximation),
        }
    }

    /// As on the command line.
    pub(super) fn arguments(&self) -> Vec<String> {
        let mut all = vec!["--scalar".to_owned(), word(self.scalar)];
        all.extend(self.factor.iter().flat_map(|f| ["--factor".to_owned(), f.to_string()]));
        let left_out = self.approximation.iter();
        all.extend(left_out.flat_map(|a| ["--approximation".to_owned(), word(*a)]));
        all
    }
}

impl std::fmt::Display for ControllerForm {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.factor, self.approximation) {
            (Some(factor), _) => write!(f, "big base {factor:.0e}"),
            (None, Some(approximation)) => f.write_str(&word(approximation)),
            (None, None) => f.write_str("exact foot"),
        }
    }
}
