//! `<compiler>`: units and what is made of geoms.

use crate::description::DescribedLink;
use crate::error::{ImportError, Refusal};
use crate::xml::Element;
use nalgebra::Matrix3;

/// Its settings; later elements replace what earlier ones say.
#[derive(Debug)]
pub(super) struct Compiler {
    degrees: bool,
    pub euler_sequence: [char; 3],
    /// Whether a range makes a limit of itself.
    pub auto_limits: bool,
    pub inertia_from_geoms: InertiaFromGeoms,
    /// Groups of geoms that count for it.
    pub inertia_groups: [f64; 2],
    pub mesh_folder: String,
    /// Least mass and inertia of a moving body.
    bound_mass: f64,
    bound_inertia: f64,
    balance_inertia: bool,
    total_mass: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum InertiaFromGeoms {
    Never,
    Always,
    /// Where a body has no `<inertial>`.
    Auto,
}

impl Compiler {
    pub fn read(root: &Element) -> Result<Self, ImportError> {
        let mut own = Self {
            degrees: true,
            euler_sequence: ['x', 'y', 'z'],
            auto_limits: true,
            inertia_from_geoms: InertiaFromGeoms::Auto,
            inertia_groups: [0.0, 5.0],
            mesh_folder: String::new(),
            bound_mass: 0.0,
            bound_inertia: 0.0,
            balance_inertia: false,
            total_mass: None,
        };
        for element in root.all("compiler") {
            own.update(element)?;
        }
        Ok(own)
    }

    fn update(&mut self, element: &Element) -> Result<(), ImportError> {
        match element.attribute("angle") {
            Some("degree") => self.degrees = true,
            Some("radian") => self.degrees = false,
            Some(other) => return Err(element.malformed("angle radian or degree", other)),
            None => {}
        }
        if let Some(text) = element.attribute("eulerseq") {
            let letters: Vec<char> = text.chars().collect();
            let is_axis = |c: &char| "xyzXYZ".contains(*c);
            self.euler_sequence = match <[char; 3]>::try_from(letters) {
                Ok(sequence) if sequence.iter().all(is_axis) => sequence,
                _ => return Err(element.malformed("eulerseq of three of x, y, z, X, Y, Z", text)),
            };
        }
        self.auto_limits = flag(element, "autolimits")?.unwrap_or(self.auto_limits);
        self.balance_inertia = flag(element, "balanceinertia")?.unwrap_or(self.balance_inertia);
        match element.attribute("inertiafromgeom") {
            Some("true") => self.inertia_from_geoms = InertiaFromGeoms::Always,
            Some("false") => self.inertia_from_geoms = InertiaFromGeoms::Never,
            Some("auto") => self.inertia_from_geoms = InertiaFromGeoms::Auto,
            Some(other) => {
                return Err(element.malformed("inertiafromgeom true, false or auto", other));
            }
            None => {}
        }
        self.inertia_groups = element.numbers("inertiagrouprange")?.unwrap_or(self.inertia_groups);
        self.bound_mass = element.size("boundmass")?.unwrap_or(self.bound_mass);
        self.bound_inertia = element.size("boundinertia")?.unwrap_or(self.bound_inertia);
        self.total_mass = element.number("settotalmass")?.filter(|m| *m > 0.0).or(self.total_mass);
        for name in ["assetdir", "meshdir"] {
            if let Some(folder) = element.attribute(name) {
                self.mesh_folder = folder.to_owned();
            }
        }
        if element.attribute("coordinate").is_some_and(|c| c != "local") {
            return Err(unsupported(element, "coordinate=\"global\"", "MuJoCo has dropped it too"));
        }
        if flag(element, "alignfree")? == Some(true) {
            return Err(unsupported(element, "alignfree", "leave it out"));
        }
        Ok(())
    }

    /// rad
    pub fn angle(&self, angle: f64) -> f64 {
        if self.degrees { angle.to_radians() } else { angle }
    }

    /// What the compiler does to masses and inertias of all moving bodies, the world excepted.
    pub fn adjust(&self, links: &mut [DescribedLink]) {
        for inertial in links.iter_mut().skip(1).filter_map(|link| link.inertial.as_mut()) {
            inertial.mass = inertial.mass.max(self.bound_mass);
            if self.bound_inertia > 0.0 || self.balance_inertia {
                let eigen = inertial.inertia.symmetric_eigen();
                let mut moments = eigen.eigenvalues.map(|x| x.max(self.bound_inertia));
                let sum = moments.sum();
                if self.balance_inertia && moments.iter().any(|x| sum - x < *x) {
                    moments.fill(sum / 3.0);
                }
                let axes = eigen.eigenvectors;
                inertial.inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
            }
        }
        if let Some(total) = self.total_mass {
            let all = || links.iter().skip(1).filter_map(|link| link.inertial.as_ref());
            let factor = total / all().map(|inertial| inertial.mass).sum::<f64>();
            for inertial in links.iter_mut().skip(1).filter_map(|link| link.inertial.as_mut()) {
                inertial.mass *= factor;
                inertial.inertia *= factor;
            }
        }
    }
}

/// `true` or `false`.
pub(super) fn flag(element: &Element, name: &str) -> Result<Option<bool>, ImportError> {
    match element.attribute(name) {
        None => Ok(None),
        Some("true") => Ok(Some(true)),
        Some("false") => Ok(Some(false)),
        Some(other) => Err(element.malformed(format!("{name} true or false"), other)),
    }
}

/// A refusal by name.
pub(super) fn unsupported(element: &Element, what: &str, advice: &str) -> ImportError {
    let refusal = Refusal::Unsupported { what: what.into(), advice: advice.into() };
    ImportError::refused(Some(&element.place), element.describe(), refusal)
}
