//! What nothing holds: its centre of mass flies as is known beforehand, and the motion about it is all that is left to
//! compute.
//!
//! # Notation
//! `c₀, v₀` position and velocity of the centre of mass at the start, `m` the mass of all, `g` gravity against z:
//! ```text
//! x(t) = x'(t) + c₀ + v₀ t − ½ g t² ẑ                                                              (1)
//! E = E' + ½ m v₀² + m g c₀·ẑ,   L = L' + m c₀ × v₀   (without gravity)                            (2)
//! ```
//! Primes are those of a frame that falls with the centre of mass, where nothing has weight. Attitudes are as accurate
//! at 10 km/s as at rest: residuals there know nothing of how fast the whole moves.

use super::moving::{Moving, is_free, kinetic};
use nalgebra::Vector3;
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::{BodyState, JointConstraint, System};

use crate::scene::PlacedBodies;

/// How the centre of mass flies.
pub(super) struct Drift {
    system: System,
    mass: f64,
    center: Vector3<f64>,
    velocity: Vector3<f64>,
}

/// A motion in the falling frame, told as it is seen from the world.
pub(super) struct Adrift {
    pub drift: Drift,
    pub moving: Box<dyn Moving>,
}

fn part(x: &BodyState) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

/// The bodies in the falling frame, and how that falls; none of bodies that something holds.
pub(super) fn afloat(placed: &PlacedBodies) -> Option<(Drift, PlacedBodies)> {
    let PlacedBodies { system, states, rates } = placed;
    let floats = |constraint: &JointConstraint| *constraint == JointConstraint::Floating;
    let is_afloat = system.ground().is_none()
        && system.strikers().is_empty()
        && system.beyond_variational().is_none()
        && system.closures().iter().all(|closure| closure.inboard.is_some())
        && system.links().iter().all(|l| l.inboard.is_some() || floats(&l.joint.constraint));
    if !is_afloat {
        return None;
    }
    let mass: f64 = system.links().iter().map(|link| link.body.mass).sum();
    let mean = |of: &[BodyState]| -> Vector3<f64> {
        let each = system.links().iter().zip(of).map(|(link, x)| part(x) * link.body.mass);
        each.sum::<Vector3<f64>>() / mass
    };
    let (center, velocity) = (mean(states), mean(rates));
    let less = |of: &[BodyState], by: &Vector3<f64>| {
        of.iter()
            .map(|[x, y, z, q @ ..]| {
                let [s, a, b, c] = *q;
                [x - by.x, y - by.y, z - by.z, s, a, b, c]
            })
            .collect()
    };
    let falling = PlacedBodies {
        system: system.clone().weightless(),
        states: less(states, &center),
        rates: less(rates, &velocity),
    };
    Some((Drift { system: system.clone(), mass, center, velocity }, falling))
}

impl Drift {
    /// Centre of mass and its velocity at a time.
    fn at(&self, t: f64) -> (Vector3<f64>, Vector3<f64>) {
        let g = Vector3::new(0.0, 0.0, -self.system.gravity());
        (self.center + self.velocity * t + g * (0.5 * t * t), self.velocity + g * t)
    }
}

impl Adrift {
    fn now(&self) -> (Vector3<f64>, Vector3<f64>) {
        self.drift.at(self.moving.progress().time_s)
    }
}

impl Moving for Adrift {
    fn step(&mut self) -> Result<(), StepError> {
        self.moving.step()
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        let (mut x, mut v) = self.moving.state()?;
        let (center, velocity) = self.now();
        for (of, by) in [(&mut x, center), (&mut v, velocity)] {
            for body in of.as_chunks_mut::<7>().0 {
                body[..3].iter_mut().zip(by.iter()).for_each(|(x, by)| *x += by);
            }
        }
        Ok((x, v))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        let (energy, momentum, constraint) = self.moving.conserved()?;
        let Drift { system, mass, center, velocity } = &self.drift;
        let of_whole = mass * (0.5 * velocity.norm_squared() + system.gravity() * center.z);
        let orbit = center.cross(velocity) * *mass;
        let seen = momentum.iter().zip(orbit.iter()).map(|(own, orbit)| own + orbit);
        let momentum = if is_free(system) { seen.collect() } else { Vec::new() };
        Ok((energy + of_whole, momentum, constraint))
    }

    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        kinetic(&self.drift.system, configuration, velocity)
    }

    fn keeps_energy(&self) -> bool {
        self.moving.keeps_energy()
    }

    fn in_steps_of(&self, h: f64) -> Option<Box<dyn Moving>> {
        let moving = self.moving.in_steps_of(h)?;
        let (center, velocity) = self.now();
        let Drift { system, mass, .. } = &self.drift;
        let drift = Drift { system: system.clone(), mass: *mass, center, velocity };
        Some(Box::new(Self { drift, moving }))
    }

    fn progress(&self) -> &Progress {
        self.moving.progress()
    }

    fn forecast_s(&mut self) -> Option<f64> {
        self.moving.forecast_s()
    }

    fn unknowns(&self) -> usize {
        self.moving.unknowns()
    }
}
