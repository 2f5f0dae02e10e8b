//! A tree of bodies and joints.

use super::body::{Body, BodyState};
use super::closure::{ClosingMotors, Closure};
use super::gimbal::Gimbal;
use super::joint::{Joint, JointConstraint};
use super::joint_law::JointLaw;
use super::striker::Striker;
use super::system_error::SystemError;
use crate::contact::{Floor, GroundPlane, Switching};

/// A body with the joint that holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The inboard body's link; none for the world.
    pub inboard: Option<usize>,
    /// The joint to it.
    pub joint: Joint,
    /// The body.
    pub body: Body,
}

/// A point of a body that can touch the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// The body's link.
    pub link: usize,
    /// In the body's frame, m.
    pub position: [f64; 3],
}

/// A tree, inboard links first, and what acts on it. What it does not have costs nothing.
#[derive(Clone, Debug)]
pub struct System {
    links: Vec<Link>,
    /// m/s², against z.
    gravity: f64,
    laws: Vec<(usize, JointLaw)>,
    gimbals: Vec<(usize, Gimbal)>,
    ground: Option<(Floor, Switching)>,
    sites: Vec<Site>,
    terrain: Vec<(usize, GroundPlane)>,
    closures: Vec<Closure>,
    closing_motors: Vec<ClosingMotors>,
    strikers: Vec<Striker>,
}

/// What the world is to a joint: a body that stands still.
pub(super) const WORLD: BodyState = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

impl System {
    /// Checks links and makes a system of them.
    ///
    /// # Errors
    /// A [`SystemError`].
    pub fn new(links: Vec<Link>, gravity: f64) -> Result<Self, SystemError> {
        for (number, link) in links.iter().enumerate() {
            if let Some(inboard) = link.inboard.filter(|inboard| *inboard >= number) {
                return Err(SystemError::Order { link: number, inboard });
            }
            let sizes = [&[link.body.mass][..], &link.body.inertia].concat();
            if !sizes.iter().all(|size| size.is_finite() && *size > 0.0) {
                return Err(SystemError::Inertia { link: number });
            }
        }
        Ok(Self {
            links,
            gravity,
            laws: Vec::new(),
            gimbals: Vec::new(),
            ground: None,
            sites: Vec::new(),
            terrain: Vec::new(),
            closures: Vec::new(),
            closing_motors: Vec::new(),
            strikers: Vec::new(),
        })
    }

    /// With another link, after all others.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn with_link(mut self, link: Link) -> Result<Self, SystemError> {
        self.links.push(link);
        let Self { links, gravity, .. } = Self::new(std::mem::take(&mut self.links), self.gravity)?;
        Ok(Self { links, gravity, ..self })
    }

    /// With a spring, damping, stops or a rotor in the joint of a link.
    ///
    /// # Errors
    /// [`SystemError::Law`].
    pub fn with_law(mut self, link: usize, law: JointLaw) -> Result<Self, SystemError> {
        let has_one_coordinate = self.links.get(link).is_some_and(|l| {
            let constraint = l.joint.constraint;
            matches!(
                constraint,
                JointConstraint::Revolute { .. } | JointConstraint::Prismatic { .. }
            )
        });
        if !(has_one_coordinate && law.is_valid()) {
            return Err(SystemError::Law { link });
        }
        self.laws.push((link, law));
        Ok(self)
    }

    /// With motors in the spherical joint of a link.
    ///
    /// # Errors
    /// [`SystemError::Gimbal`].
    pub fn with_gimbal(mut self, link: usize, gimbal: Gimbal) -> Result<Self, SystemError> {
        let is_ball =
            self.links.get(link).is_some_and(|l| l.joint.constraint == JointConstraint::Spherical);
        if !is_ball || self.gimbals.iter().any(|(other, _)| *other == link) {
            return Err(SystemError::Gimbal { link });
        }
        self.gimbals.push((link, gimbal));
        Ok(self)
    }

    /// On a floor that these points can touch.
    ///
    /// # Errors
    /// [`SystemError::Floor`], [`SystemError::Site`].
    pub fn on_floor(
        mut self,
        floor: Floor,
        switching: Switching,
        mut sites: Vec<Site>,
    ) -> Result<Self, SystemError> {
        if let Some((parameter, value, expected)) = floor.invalid() {
            return Err(SystemError::Floor { parameter, value, expected });
        }
        let is_bad = |site: &Site| {
            site.link >= self.links.len() || !site.position.iter().all(|x| x.is_finite())
        };
        if let Some(site) = sites.iter().position(is_bad) {
            return Err(SystemError::Site { site });
        }
        // The order in which bodies are visited.
        sites.sort_by_key(|site| site.link);
        self.ground = Some((floor, switching));
        self.sites = sites;
        Ok(self)
    }

    /// With a plane of its own under the points of a link, in place of z = 0.
    ///
    /// # Errors
    /// [`SystemError::Terrain`] for a link without such points, or with a plane already.
    pub fn on_plane(mut self, link: usize, plane: GroundPlane) -> Result<Self, SystemError> {
        let touches = self.sites.iter().any(|site| site.link == link);
        if !touches || self.plane(link).is_some() {
            return Err(SystemError::Terrain { link });
        }
        self.terrain.push((link, plane));
        Ok(self)
    }

    /// With a joint that closes a loop.
    ///
    /// # Errors
    /// [`SystemError::Closure`].
    pub fn with_closure(mut self, closure: Closure) -> Result<Self, SystemError> {
        let exists = |link: usize| link < self.links.len();
        let (outboard, inboard) = (closure.outboard, closure.inboard);
        if !exists(outboard) || inboard.is_some_and(|i| !exists(i) || i == outboard) {
            return Err(SystemError::Closure { closure: self.closures.len() });
        }
        self.closures.push(closure);
        Ok(self)
    }

    /// With motors in a joint that closes a loop: one in a revolute joint, two in a universal one, three in a
    /// spherical one, which needs their gimbal.
    ///
    /// # Errors
    /// [`SystemError::ClosingMotors`].
    pub fn with_closing_motors(mut self, motors: ClosingMotors) -> Result<Self, SystemError> {
        let number = motors.closure;
        let fits = self.closures.get(number).is_some_and(|closure| motors.fit(closure));
        if !fits || self.closing_motors.iter().any(|other| other.closure == number) {
            return Err(SystemError::ClosingMotors { closure: number });
        }
        self.closing_motors.push(motors);
        Ok(self)
    }

    /// With a free body that strikes another. Each free body strikes one body at most; those that strike
    /// come after all other links, in their order.
    ///
    /// # Errors
    /// [`SystemError::Striker`], [`SystemError::Floor`] for its surface.
    pub fn with_striker(mut self, striker: Striker) -> Result<Self, SystemError> {
        let number = self.strikers.len();
        let Striker { link, struck, ref around, .. } = striker;
        if let Some((parameter, value, expected)) = around.surface.invalid() {
            return Err(SystemError::Floor { parameter, value, expected });
        }
        let floats =
            self.links.get(link).is_some_and(|l| l.joint.constraint == JointConstraint::Floating);
        let is_leaf = self.links.iter().all(|l| l.inboard != Some(link))
            && self.strikers.iter().all(|other| other.link != link && other.struck != link);
        if !(floats && is_leaf && struck < link && striker.is_valid()) {
            return Err(SystemError::Striker { striker: number });
        }
        self.strikers.push(striker);
        Ok(self)
    }

    /// Strikers are the last links, so that no other has to be asked whether it is one.
    pub(super) fn check_strikers(&self) -> Result<(), SystemError> {
        let first = self.links.len() - self.strikers.len();
        match self.strikers.iter().zip(first..).position(|(striker, link)| striker.link != link) {
            Some(striker) => Err(SystemError::Striker { striker }),
            None => Ok(()),
        }
    }

    /// Free bodies that strike others.
    pub fn strikers(&self) -> &[Striker] {
        &self.strikers
    }

    /// Laws of joints, by link.
    pub fn laws(&self) -> &[(usize, JointLaw)] {
        &self.laws
    }

    /// Motors of spherical joints, by link.
    pub fn gimbals(&self) -> &[(usize, Gimbal)] {
        &self.gimbals
    }

    /// The floor, and when points enter and leave it.
    pub fn ground(&self) -> Option<&(Floor, Switching)> {
        self.ground.as_ref()
    }

    /// Points that can touch the floor, by link.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// Links that stand on planes of their own.
    pub fn terrain(&self) -> &[(usize, GroundPlane)] {
        &self.terrain
    }

    /// The plane under the points of a link, where it is not z = 0.
    pub(super) fn plane(&self, link: usize) -> Option<GroundPlane> {
        self.terrain.iter().find(|(k, _)| *k == link).map(|(_, plane)| *plane)
    }

    /// Joints that close loops.
    pub fn closures(&self) -> &[Closure] {
        &self.closures
    }

    /// Motors of joints that close loops.
    pub fn closing_motors(&self) -> &[ClosingMotors] {
        &self.closing_motors
    }

    /// The links.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// m/s², against z.
    pub fn gravity(&self) -> f64 {
        self.gravity
    }
}
