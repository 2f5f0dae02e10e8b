//! A tree of bodies and joints.

use super::body::{Body, BodyState};
use super::joint::Joint;

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

/// A tree, inboard links first.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    links: Vec<Link>,
    /// m/s², against z.
    gravity: f64,
}

/// Why there is no such system, or no such start.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// A link's inboard body does not come before it.
    #[error("link {link}: its inboard link {inboard} does not come before it")]
    Order {
        /// Which one.
        link: usize,
        /// What it names.
        inboard: usize,
    },
    /// A mass or an inertia is none.
    #[error("link {link}: a mass and three inertias above zero are needed")]
    Inertia {
        /// Which one.
        link: usize,
    },
    /// Not a state for each link.
    #[error("{given} states for {links} links")]
    Length {
        /// How many there are.
        given: usize,
        /// How many there should be.
        links: usize,
    },
    /// A number is not finite.
    #[error("link {link}: coordinate {coordinate} or its rate is not finite")]
    NotFinite {
        /// Which one.
        link: usize,
        /// Which one.
        coordinate: usize,
    },
    /// A start violates a constraint.
    #[error("link {link}: the start violates a constraint by {value:.1e}")]
    OffManifold {
        /// Which one.
        link: usize,
        /// By how much, itself or its rate.
        value: f64,
    },
    /// The step is no time.
    #[error("a step of {h} s: a positive number is needed")]
    Step {
        /// s
        h: f64,
    },
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
        Ok(Self { links, gravity })
    }

    /// The links.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// m/s², against z.
    pub fn gravity(&self) -> f64 {
        self.gravity
    }

    /// Kinetic and potential energy, J.
    pub fn energy(&self, states: &[BodyState], rates: &[BodyState]) -> f64 {
        let each = self.links.iter().zip(states).zip(rates);
        each.map(|((link, x), v)| link.body.energy(x, v, self.gravity)).sum()
    }

    /// Linear and angular momentum about the world's origin: N·s, N·m·s.
    pub fn momentum(&self, states: &[BodyState], rates: &[BodyState]) -> ([f64; 3], [f64; 3]) {
        let mut sum = ([0.0; 3], [0.0; 3]);
        for ((link, x), v) in self.links.iter().zip(states).zip(rates) {
            let (linear, angular) = link.body.momentum(x, v);
            for i in 0..3 {
                sum.0[i] += linear[i];
                sum.1[i] += angular[i];
            }
        }
        sum
    }

    /// Largest constraint, of joints and quaternions.
    pub fn largest_constraint(&self, states: &[BodyState]) -> f64 {
        let mut largest = 0.0_f64;
        for (link, x) in self.links.iter().zip(states) {
            let inboard = link.inboard.map_or(&WORLD, |inboard| &states[inboard]);
            for g in link.joint.evaluate(x, inboard) {
                largest = largest.max(g.abs());
            }
            largest = largest.max((x[3..].iter().map(|q| q * q).sum::<f64>() - 1.0).abs());
        }
        largest
    }

    /// Checks a start on its manifold.
    pub(super) fn check_start(
        &self,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Result<(), SystemError> {
        const CLOSE: f64 = 1e-8;
        let links = self.links.len();
        for given in [states.len(), rates.len()] {
            if given != links {
                return Err(SystemError::Length { given, links });
            }
        }
        let still: BodyState = [0.0; 7];
        for (link, (x, v)) in states.iter().zip(rates).enumerate() {
            if let Some(coordinate) = (0..7).find(|i| !(x[*i].is_finite() && v[*i].is_finite())) {
                return Err(SystemError::NotFinite { link, coordinate });
            }
            let speed = v.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
            let norm: f64 = x[3..].iter().map(|q| q * q).sum::<f64>() - 1.0;
            let norm_rate: f64 = (3..7).map(|i| 2.0 * x[i] * v[i]).sum();
            let Link { inboard, joint, .. } = &self.links[link];
            let (x_i, v_i) = inboard.map_or((&WORLD, &still), |k| (&states[k], &rates[k]));
            let rows = joint.rows(x, x_i);
            let rate = |c: usize| -> f64 {
                (0..7).map(|i| rows.outboard[c][i] * v[i] + rows.inboard[c][i] * v_i[i]).sum()
            };
            let constraints = joint.constraints();
            let worst = (0..constraints)
                .map(|c| rows.error[c].abs().max(rate(c).abs() / speed))
                .fold(norm.abs().max(norm_rate.abs() / speed), f64::max);
            if !(worst <= CLOSE * x.iter().fold(1.0_f64, |m, x| m.max(x.abs()))) {
                return Err(SystemError::OffManifold { link, value: worst });
            }
        }
        Ok(())
    }
}
