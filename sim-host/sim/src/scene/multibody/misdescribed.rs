//! What is wrong with a description of bodies and joints, and in which field.

use surefoot_multibody::SystemError;

/// What is wrong with a description: a field and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field}: expected {expected}")]
pub struct Misdescribed {
    /// Which one.
    pub field: String,
    /// What it should be.
    pub expected: String,
}

/// Why a description gives no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A field is wrong.
    #[error(transparent)]
    Field(#[from] Misdescribed),
    /// The whole is no system.
    #[error(transparent)]
    System(#[from] SystemError),
}

impl Misdescribed {
    /// A field, and what it should be.
    pub(super) fn new(field: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { field: field.into(), expected: expected.into() }
    }

    /// The field behind a system's error.
    pub(crate) fn of_system(error: &SystemError) -> Self {
        let body = |k: usize, what: &str| format!("mechanism.bodies[{k}]{what}");
        let field = match *error {
            SystemError::Inertia { link } => body(link, ".inertia_kg_m2"),
            SystemError::Law { link } => body(link, ".law"),
            SystemError::Terrain { link } => body(link, ".contact_points_m"),
            SystemError::Order { link, .. } => body(link, ".inboard"),
            SystemError::OffManifold { link, .. }
            | SystemError::Gimbal { link }
            | SystemError::GimbalLock { link }
            | SystemError::Unsupported { link, .. } => body(link, ".joint"),
            SystemError::NotFinite { link, .. } => body(link, ""),
            SystemError::Closure { closure } => format!("mechanism.loops[{closure}].between"),
            SystemError::OpenLoop { closure, .. } | SystemError::ClosingMotors { closure } => {
                format!("mechanism.loops[{closure}]")
            }
            SystemError::TooManyLoops { .. } => "mechanism.loops".to_owned(),
            SystemError::Floor { parameter, .. } => format!("mechanism.floor.{parameter}"),
            SystemError::Step { .. } => "integrator.step_s".to_owned(),
            SystemError::Site { .. } | SystemError::Length { .. } | SystemError::Striker { .. } => {
                "mechanism.bodies".to_owned()
            }
            SystemError::OtherCheckpoint => "mechanism".to_owned(),
        };
        Self::new(field, format!("bodies and joints that can move ({error})"))
    }
}
