//! The controller's constants.

use super::{FootLimits, LeggedRobot};
use crate::Real;
use crate::spatial::SymmetricMatrix3;

/// Gain matrices of §4.2.4, symmetric and positive definite. All are gains from an error to an
/// acceleration: they do not depend on the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains<T> {
    /// `K_c^p`, 1/s²
    pub position: SymmetricMatrix3<T>,
    /// `K_c^v`, 1/s
    pub velocity: SymmetricMatrix3<T>,
    /// `K_R^p`, 1/s², on `sin(θ_e/2)`
    pub orientation: SymmetricMatrix3<T>,
    /// `K_R^v`, 1/s
    pub angular_velocity: SymmetricMatrix3<T>,
}

impl<T: Real> Gains<T> {
    /// The gains of both experiments of §4.3.
    pub fn experiments() -> Self {
        let diagonal = |x, y, z| SymmetricMatrix3::diagonal(T::of(x), T::of(y), T::of(z));
        Self {
            position: diagonal(50.0, 50.0, 200.0),
            velocity: diagonal(7.07, 7.07, 14.142),
            orientation: diagonal(50.0, 50.0, 50.0),
            angular_velocity: diagonal(7.07, 7.07, 7.07),
        }
    }
}

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
