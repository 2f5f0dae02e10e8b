//! What a mechanism's scene may get wrong.

use super::SceneError;
use super::mechanism::{MOST_CHAIN_LINKS, MOST_LINKS, Mechanism, MechanismScene};
use super::multibody::{BuildError, Misdescribed};
use crate::integrators::Method;

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
                let [a, b, c] = *inertia_kg_m2;
                let possible = a > 0.0 && b > 0.0 && c > 0.0;
                if !(possible && a + b >= c && b + c >= a && c + a >= b && (a + b + c).is_finite())
                {
                    let expected = "three inertias above zero, none above the others' sum";
                    let field = "mechanism.inertia_kg_m2";
                    return Err(self.wrong(field, inertia_kg_m2, expected.into()));
                }
                let norm = orientation.iter().map(|q| q * q).sum::<f64>().sqrt();
                if !((norm - 1.0).abs() < 1e-3) {
                    let expected = format!("a unit quaternion, scalar first (its norm is {norm})");
                    return Err(self.wrong("mechanism.orientation", orientation, expected));
                }
                if !angular_velocity_rad_s.iter().all(|w| w.is_finite()) {
                    let field = "mechanism.angular_velocity_rad_s";
                    return Err(self.wrong(field, angular_velocity_rad_s, "finite numbers".into()));
                }
            }
            Mechanism::Chain {
                links, mass_kg, length_m, radius_m, bend_deg, gravity_m_s2, ..
            } => {
                if !(1..=MOST_CHAIN_LINKS).contains(links) {
                    let expected = format!("1 to {MOST_CHAIN_LINKS} links");
                    return Err(self.wrong("mechanism.links", links, expected));
                }
                let sizes = [mass_kg, length_m, radius_m];
                if !sizes.iter().all(|size| size.is_finite() && **size > 0.0) {
                    let expected = "a mass, a length and a radius above zero";
                    return Err(self.wrong("mechanism", sizes, expected.into()));
                }
                if !(bend_deg.is_finite() && gravity_m_s2.is_finite()) {
                    let field = "mechanism.bend_deg, gravity_m_s2";
                    return Err(self.wrong(
                        field,
                        (bend_deg, gravity_m_s2),
                        "finite numbers".into(),
                    ));
                }
                self.check_method()?;
            }
            Mechanism::Multibody(bodies) => {
                self.check_method()?;
                bodies.start(self.integrator.step_s).map_err(|error| match error {
                    BuildError::Field(Misdescribed { field, expected }) => {
                        self.wrong(&field, "what it is", expected)
                    }
                    BuildError::System(error) => {
                        self.wrong("mechanism", "what it is", format!("a system ({error})"))
                    }
                })?;
            }
            Mechanism::Biped(flight) => {
                self.check_method()?;
                flight.start(self.integrator.step_s).map_err(|error| {
                    self.wrong("mechanism", flight, format!("a state of the biped ({error})"))
                })?;
            }
            Mechanism::Pendulum { gravity_m_s2, links } => {
                if !gravity_m_s2.is_finite() {
                    let field = "mechanism.gravity_m_s2";
                    return Err(self.wrong(field, gravity_m_s2, "a finite number".into()));
                }
                if links.is_empty() || links.len() > MOST_LINKS {
                    let expected = format!("1 to {MOST_LINKS} links");
                    return Err(self.wrong("mechanism.links", links.len(), expected));
                }
                for (number, link) in links.iter().enumerate() {
                    let angles = link.angles_deg.iter().chain(&link.rates_deg_s);
                    let sizes = [link.mass_kg, link.length_m];
                    let sound = sizes.iter().all(|size| size.is_finite() && *size > 0.0);
                    if !(sound && angles.into_iter().all(|x| x.is_finite())) {
                        let expected = "a mass and a length above zero, finite angles and rates";
                        let field = format!("mechanism.links[{number}]");
                        return Err(self.wrong(&field, link, expected.into()));
                    }
                }
            }
        }
        Ok(())
    }
}
