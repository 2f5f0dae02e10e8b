//! The controller's constants.

use super::{FootLimits, Gains, LeggedRobot};
use crate::Real;

/// How the workspace dynamics take the feet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkspaceForm<T> {
    /// Each foot held exactly: well conditioned in both precisions, and the cheaper form.
    FixedFoot,
    /// Alg. 4.3 as printed: each foot as heavy as `factor` times the central body (printed: 10⁶).
    /// In f32 it is off by 8 % at 10⁶ and best, at 5·10⁻⁵, near 10³.
    BigBase {
        /// Mass and inertia of a foot in units of the central body's.
        factor: T,
    },
}

/// All constants of one controller.
#[derive(Clone, Copy, Debug)]
pub struct Controller<'a, T, const LEGS: usize> {
    /// The model of the robot.
    pub robot: &'a LeggedRobot<T, LEGS>,
    /// Gains.
    pub gains: Gains<T>,
    /// Form of the workspace dynamics.
    pub form: WorkspaceForm<T>,
    /// Smallest pivot of a leg's dimensionless Jacobian that is not yet a singular leg. Torques grow
    /// as its inverse; a straight knee has 0.
    pub singularity: T,
    /// What the ground can give a foot, checked before torques go out; `None` leaves the check out, as
    /// the dissertation does.
    pub foot_limits: Option<FootLimits<T>>,
}

impl<'a, T: Real, const LEGS: usize> Controller<'a, T, LEGS> {
    /// With the gains of §4.3, exactly fixed feet, a singularity margin of 0.01 and no foot limits.
    pub fn new(robot: &'a LeggedRobot<T, LEGS>) -> Self {
        Self {
            robot,
            gains: Gains::experiments(),
            form: WorkspaceForm::FixedFoot,
            singularity: T::of(0.01),
            foot_limits: None,
        }
    }
}
