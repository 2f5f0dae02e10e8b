//! Mass and inertia of a body: moved, summed, checked.

use nalgebra::{Isometry3, Matrix3, Vector3};

/// Mass, centre of mass, and inertia about it, in one frame's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// kg
    pub mass: f64,
    /// m
    pub center: Vector3<f64>,
    /// kg m²
    pub inertia: Matrix3<f64>,
}

impl Inertial {
    /// Nothing.
    pub const NONE: Self = Self {
        mass: 0.0,
        center: Vector3::new(0.0, 0.0, 0.0),
        inertia: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    /// The same body seen from a frame in which its own frame is at `pose`.
    pub fn moved(&self, pose: &Isometry3<f64>) -> Self {
        let rotation = pose.rotation.to_rotation_matrix();
        let r = rotation.matrix();
        // A body in its own frame keeps its digits.
        let inertia = if *r == Matrix3::identity() {
            self.inertia
        } else {
            let turned = r * self.inertia * r.transpose();
            // Rounding does not make it unsymmetric.
            0.5 * (turned + turned.transpose())
        };
        Self { mass: self.mass, center: pose.transform_point(&self.center.into()).coords, inertia }
    }

    /// All of these as one body: the parallel-axis theorem about the common centre of mass.
    pub fn sum(parts: &[Self]) -> Self {
        if let [one] = parts {
            return *one;
        }
        let mass: f64 = parts.iter().map(|p| p.mass).sum();
        let moment: Vector3<f64> = parts.iter().map(|p| p.center * p.mass).sum();
        let center = if mass > 0.0 { moment / mass } else { Vector3::zeros() };
        let inertia = parts.iter().map(|p| p.about(&center)).sum();
        Self { mass, center, inertia }
    }

    /// The inertia about another point.
    pub fn about(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let d = self.center - point;
        self.inertia + (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * self.mass
    }
}

/// What of a body's inertia no distribution of mass can have, if anything.
///
/// The principal moments `a ≤ b ≤ c` of a body obey `0 ≤ a` and `c ≤ a + b`; `slack`, a part of `a + b + c`,
/// is left for the rounding of printed numbers, `shift` (kg m²) for what shifting them leaves behind.
pub(crate) fn violated_inequality(body: &Inertial, slack: f64, shift: f64) -> Option<String> {
    if body.mass == 0.0 && body.inertia != Matrix3::zeros() {
        return Some("an inertia needs a mass, and the mass is 0".into());
    }
    let mut moments = body.inertia.symmetric_eigenvalues();
    moments.as_mut_slice().sort_by(f64::total_cmp);
    let [a, b, c] = moments.into();
    let slack = slack * body.inertia.diagonal().abs().sum() + shift;
    if !(a >= -slack) {
        Some(format!(
            "principal moments {a:.4e}, {b:.4e}, {c:.4e} kg m², and {a:.4e} ≥ 0 does not hold"
        ))
    } else if !(c <= a + b + slack) {
        Some(format!(
            "principal moments {a:.4e}, {b:.4e}, {c:.4e} kg m², and {c:.4e} ≤ {a:.4e} + {b:.4e} does not hold"
        ))
    } else {
        None
    }
}
