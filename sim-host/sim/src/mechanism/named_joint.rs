//! A joint by name: its columns, and what drives it.

use super::joint_motion::JointMotion;
use surefoot_multibody::{Joint, JointConstraint, JointLaw};

/// A joint.
#[derive(Clone, Debug)]
pub struct NamedJoint {
    /// Name, for people.
    pub name: String,
    /// The same in columns of a record.
    pub column: String,
    /// Its body.
    pub outboard: usize,
    /// What that hangs from; none for the world.
    pub inboard: Option<usize>,
    /// What it is.
    pub kind: JointKind,
    /// What its motor holds, N·m or N.
    pub torque: f64,
    /// Its spring and damper.
    pub law: Option<JointLaw>,
}

/// What a joint's coordinates are.
#[derive(Clone, Copy, Debug)]
pub enum JointKind {
    /// Of bodies.
    Bodies(Joint),
    /// A rod's angle from straight down, and that about the vertical.
    Rod,
}

impl NamedJoint {
    /// Whether motor, spring or damper give it a torque, or force, of its own.
    pub fn is_driven(&self) -> bool {
        self.torque != 0.0 || self.law.is_some()
    }

    /// What motor, spring, damper and stops give it, N·m or N; not what holds it together.
    pub fn effort(&self, motion: &JointMotion) -> f64 {
        let (Some(x), Some(rate)) = (motion.positions.first(), motion.rates.first()) else {
            return self.torque;
        };
        let of_law = self.law.map_or(0.0, |law| {
            let beyond = law.stops.map_or(0.0, |stops| stops.stiffness * stops.beyond(*x));
            -law.stiffness * (x - law.rest) - law.damping * rate - beyond
        });
        self.torque + of_law
    }

    /// Whether its coordinates are angles that may grow beyond a turn. A rod's are those of a direction.
    pub(super) fn counts_turns(&self) -> bool {
        let JointKind::Bodies(joint) = &self.kind else { return false };
        matches!(
            joint.constraint,
            JointConstraint::Revolute { .. } | JointConstraint::Universal { .. }
        )
    }

    /// Names of its coordinates as columns, and of their rates.
    pub fn columns(&self) -> (Vec<String>, Vec<String>) {
        let named = |endings: &[&str]| -> Vec<String> {
            endings.iter().map(|ending| format!("{}_{ending}", self.column)).collect()
        };
        let of = |positions: &[&str], rates: &[&str]| (named(positions), named(rates));
        match &self.kind {
            JointKind::Rod => of(&["polar_rad", "azimuth_rad"], &["polar_radps", "azimuth_radps"]),
            JointKind::Bodies(joint) => match joint.constraint {
                JointConstraint::Floating | JointConstraint::Fixed => of(&[], &[]),
                JointConstraint::Revolute { .. } => of(&["rad"], &["radps"]),
                JointConstraint::Prismatic { .. } => of(&["m"], &["mps"]),
                JointConstraint::Universal { .. } => {
                    of(&["1_rad", "2_rad"], &["1_radps", "2_radps"])
                }
                JointConstraint::Spherical => {
                    of(&["q_s", "q_x", "q_y", "q_z"], &["w_x_radps", "w_y_radps", "w_z_radps"])
                }
            },
        }
    }

    /// How many numbers of what it bears there are.
    pub fn reaction_numbers(&self) -> usize {
        if matches!(self.kind, JointKind::Rod) { 3 } else { 6 }
    }

    /// Names of what it bears, as columns: a rod bears a force only.
    pub fn reaction_columns(&self) -> Vec<String> {
        let named = |what: &str, unit: &str| {
            ["x", "y", "z"].map(|axis| format!("{}_{what}_{axis}_{unit}", self.column))
        };
        match &self.kind {
            JointKind::Rod => named("f", "n").to_vec(),
            JointKind::Bodies(_) => [named("f", "n"), named("t", "nm")].concat(),
        }
    }

    /// Name of what [`Self::effort`] says, as a column.
    pub fn effort_column(&self) -> String {
        let slides = matches!(
            self.kind,
            JointKind::Bodies(Joint { constraint: JointConstraint::Prismatic { .. }, .. })
        );
        format!("{}_{}", self.column, if slides { "n" } else { "nm" })
    }
}
