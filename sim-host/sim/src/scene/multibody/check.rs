//! What the fields of bodies and joints must be, each by its name.

use super::{BodyEntry, JointEntry, Misdescribed, Multibody};
use crate::scene::inertia::{POSITIVE, impossible};
use nalgebra::Vector3;
use surefoot_multibody::JointLaw;

impl Multibody {
    /// Checks what can be said of fields before there is a system.
    ///
    /// # Errors
    /// A [`Misdescribed`] field.
    pub(super) fn check(&self) -> Result<(), Misdescribed> {
        if !self.gravity_m_s2.is_finite() {
            return Err(Misdescribed::new("mechanism.gravity_m_s2", "a finite number"));
        }
        for (k, body) in self.bodies.iter().enumerate() {
            let at = |wrong: Misdescribed| Misdescribed {
                field: format!("mechanism.bodies[{k}].{}", wrong.field),
                ..wrong
            };
            body.check().map_err(at)?;
        }
        for (k, entry) in self.loops.iter().enumerate() {
            JointEntry::from(entry.joint).check().map_err(|wrong| Misdescribed {
                field: format!("mechanism.loops[{k}].{}", wrong.field),
                ..wrong
            })?;
        }
        let touches = self.bodies.iter().any(|body| !body.contact_points_m.is_empty());
        match &self.floor {
            Some(floor) => {
                if let Some((parameter, _, expected)) = floor.invalid() {
                    let field = format!("mechanism.floor.{parameter}");
                    return Err(Misdescribed::new(field, expected));
                }
                let expected = "none, as no body has contact_points_m that could touch it";
                if touches { Ok(()) } else { Err(Misdescribed::new("mechanism.floor", expected)) }
            }
            None if touches => {
                Err(Misdescribed::new("mechanism.floor", "a floor for the contact points"))
            }
            None if self.switching != Default::default() => {
                Err(Misdescribed::new("mechanism.switching", "none, as there is no floor"))
            }
            None => Ok(()),
        }
    }
}

impl BodyEntry {
    fn check(&self) -> Result<(), Misdescribed> {
        if !(self.mass_kg.is_finite() && self.mass_kg > 0.0) {
            return Err(Misdescribed::new("mass_kg", POSITIVE));
        }
        if let Some(expected) = impossible(&self.inertia_kg_m2) {
            return Err(Misdescribed::new("inertia_kg_m2", expected));
        }
        let finite = |values: &[f64]| values.iter().all(|x| x.is_finite());
        if !finite(&self.center_m) {
            return Err(Misdescribed::new("center_m", "finite numbers"));
        }
        if let Some(k) = self.contact_points_m.iter().position(|point| !finite(point)) {
            return Err(Misdescribed::new(format!("contact_points_m[{k}]"), "finite numbers"));
        }
        self.joint.check()?;
        let one_axis =
            matches!(self.joint, JointEntry::Revolute { .. } | JointEntry::Prismatic { .. });
        if !self.torque.is_finite() {
            return Err(Misdescribed::new("torque", "a finite number"));
        }
        if self.torque != 0.0 && !one_axis {
            let expected = "none: a torque needs the one axis of a revolute or prismatic joint";
            return Err(Misdescribed::new("torque", expected));
        }
        match &self.law {
            None => Ok(()),
            Some(_) if !one_axis => {
                let expected = "none: a spring, a damper or stops need the one axis of a revolute or prismatic joint";
                Err(Misdescribed::new("law", expected))
            }
            Some(law) => check_law(law),
        }
    }
}

fn check_law(law: &JointLaw) -> Result<(), Misdescribed> {
    let fine = |x: f64| x.is_finite() && x >= 0.0;
    let sizes = [
        ("law.stiffness", law.stiffness),
        ("law.damping", law.damping),
        ("law.friction", law.friction),
        ("law.rotor_inertia", law.rotor_inertia),
    ];
    for (field, value) in sizes {
        if !fine(value) {
            return Err(Misdescribed::new(field, "a finite number, zero or more"));
        }
    }
    if !law.rest.is_finite() {
        return Err(Misdescribed::new("law.rest", "a finite number"));
    }
    if law.rest != 0.0 && law.stiffness == 0.0 {
        return Err(Misdescribed::new("law.rest", "none, as the spring has no stiffness"));
    }
    let Some(stops) = &law.stops else { return Ok(()) };
    if !(stops.stiffness.is_finite() && stops.stiffness > 0.0) {
        return Err(Misdescribed::new("law.stops.stiffness", "a finite number above zero"));
    }
    if !(stops.low.is_finite() && stops.high.is_finite() && stops.low < stops.high) {
        return Err(Misdescribed::new("law.stops.low", "two finite ends, low below high"));
    }
    Ok(())
}

impl JointEntry {
    /// Fields within `joint`.
    fn check(&self) -> Result<(), Misdescribed> {
        let finite = |field: &str, values: &[f64]| {
            let wrong = || Misdescribed::new(format!("joint.{field}"), "finite numbers");
            if values.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(wrong()) }
        };
        let axis = |field: &str, axis: &[f64; 3]| {
            let length = Vector3::from(*axis).norm();
            let wrong = || Misdescribed::new(format!("joint.{field}"), "an axis with a length");
            if length > 1e-9 && length.is_finite() { Ok(()) } else { Err(wrong()) }
        };
        match self {
            Self::Fixed {} => Ok(()),
            Self::Floating { velocity_m_s, angular_velocity_rad_s } => {
                finite("velocity_m_s", velocity_m_s)?;
                finite("angular_velocity_rad_s", angular_velocity_rad_s)
            }
            Self::Revolute { point_m, axis: a, rate_rad_s } => {
                finite("point_m", point_m)?;
                axis("axis", a)?;
                finite("rate_rad_s", &[*rate_rad_s])
            }
            Self::Prismatic { axis: a, rate_m_s } => {
                axis("axis", a)?;
                finite("rate_m_s", &[*rate_m_s])
            }
            Self::Universal { point_m, axes, rates_rad_s } => {
                finite("point_m", point_m)?;
                axis("axes[0]", &axes[0])?;
                axis("axes[1]", &axes[1])?;
                let [a, b] = axes.map(|axis| Vector3::from(axis).normalize());
                // What a start on the joint's constraints allows.
                if !(a.dot(&b).abs() <= 1e-8) {
                    return Err(Misdescribed::new("joint.axes", "two axes at a right angle"));
                }
                finite("rates_rad_s", rates_rad_s)
            }
            Self::Spherical { point_m, angular_velocity_rad_s } => {
                finite("point_m", point_m)?;
                finite("angular_velocity_rad_s", angular_velocity_rad_s)
            }
        }
    }
}
