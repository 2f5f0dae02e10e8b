//! What a mechanism's scene may get wrong.

use super::SceneError;
use super::inertia::impossible;
use super::mechanism::{MOST_CHAIN_LINKS, MOST_LINKS, Mechanism, MechanismScene};
use super::multibody::{BuildError, Misdescribed};
use surefoot_mechanics::integrators::Method;

/// Methods on bodies and joints.
const METHODS_FOR_BODIES: [Method; 6] = [
    Method::Variational,
    Method::Yoshida4,
    Method::Yoshida6,
    Method::SemiImplicitEuler,
    Method::RungeKutta4,
    Method::DormandPrince8,
];

impl MechanismScene {
    /// Bodies and joints have these methods; some take not all of them, which their start says.
    fn check_method(&self) -> Result<(), SceneError> {
        let method = self.integrator.name;
        if METHODS_FOR_BODIES.contains(&method) {
            return Ok(());
        }
        let names = METHODS_FOR_BODIES.map(Method::name).join(", ");
        Err(self.wrong("integrator.name", method, format!("for bodies and joints one of {names}")))
    }

    fn finite(&self, field: &str, values: &[f64]) -> Result<(), SceneError> {
        let all_are = values.iter().all(|x| x.is_finite());
        if all_are { Ok(()) } else { Err(self.wrong(field, values, "finite numbers".into())) }
    }

    fn positive(&self, field: &str, value: f64) -> Result<(), SceneError> {
        let is = value.is_finite() && value > 0.0;
        if is { Ok(()) } else { Err(self.wrong(field, value, "a finite number above zero".into())) }
    }

    /// Checks what a file may get wrong.
    ///
    /// # Errors
    /// [`SceneError::Value`].
    pub fn check(&self) -> Result<(), SceneError> {
        super::check::duration_and_step(&self.name, self.duration_s, self.integrator.step_s)?;
        if let Some(accuracy) = self.matters.accuracy
            && !(accuracy > 0.0 && accuracy < 1.0)
        {
            return Err(self.wrong(
                "matters.accuracy",
                accuracy,
                "a number between 0 and 1".into(),
            ));
        }
        match &self.mechanism {
            Mechanism::RigidBody { inertia_kg_m2, orientation, angular_velocity_rad_s } => {
                if let Some(expected) = impossible(inertia_kg_m2) {
                    let field = "mechanism.inertia_kg_m2";
                    return Err(self.wrong(field, inertia_kg_m2, expected));
                }
                let norm = orientation.iter().map(|q| q * q).sum::<f64>().sqrt();
                if !((norm - 1.0).abs() < 1e-3) {
                    let expected = format!("a unit quaternion, scalar first (its norm is {norm})");
                    return Err(self.wrong("mechanism.orientation", orientation, expected));
                }
                self.finite("mechanism.angular_velocity_rad_s", angular_velocity_rad_s)?;
            }
            Mechanism::Chain {
                links, mass_kg, length_m, radius_m, bend_deg, gravity_m_s2, ..
            } => {
                if !(1..=MOST_CHAIN_LINKS).contains(links) {
                    let expected = format!("1 to {MOST_CHAIN_LINKS} links");
                    return Err(self.wrong("mechanism.links", links, expected));
                }
                self.positive("mechanism.mass_kg", *mass_kg)?;
                self.positive("mechanism.length_m", *length_m)?;
                self.positive("mechanism.radius_m", *radius_m)?;
                self.finite("mechanism.bend_deg", &[*bend_deg])?;
                self.finite("mechanism.gravity_m_s2", &[*gravity_m_s2])?;
                self.check_method()?;
            }
            Mechanism::Multibody(bodies) => {
                self.check_method()?;
                bodies.start(self.integrator.step_s).map_err(|error| {
                    let Misdescribed { field, expected } = match error {
                        BuildError::Field(wrong) => wrong,
                        BuildError::System(error) => Misdescribed::of_system(&error),
                    };
                    // A file says what it is.
                    let (name, value) = (self.name.clone(), String::new());
                    SceneError::Value { name, line: None, field, value, expected }
                })?;
            }
            Mechanism::Biped(flight) => {
                self.check_method()?;
                flight.start(self.integrator.step_s).map_err(|error| {
                    self.wrong("mechanism", flight, format!("a state of the biped ({error})"))
                })?;
            }
            Mechanism::Pendulum { gravity_m_s2, links } => {
                self.finite("mechanism.gravity_m_s2", &[*gravity_m_s2])?;
                if links.is_empty() || links.len() > MOST_LINKS {
                    let expected = format!("1 to {MOST_LINKS} links");
                    return Err(self.wrong("mechanism.links", links.len(), expected));
                }
                for (number, link) in links.iter().enumerate() {
                    let field = |what: &str| format!("mechanism.links[{number}].{what}");
                    self.positive(&field("mass_kg"), link.mass_kg)?;
                    self.positive(&field("length_m"), link.length_m)?;
                    self.finite(&field("angles_deg"), &link.angles_deg)?;
                    self.finite(&field("rates_deg_s"), &link.rates_deg_s)?;
                }
            }
        }
        Ok(())
    }
}
