//! How long steps may be, told beforehand.
//!
//! Two things limit a step of this method. A body that turns, against the world or its neighbour, by some
//! 0.9 rad in a step comes near the fold of (2.51), where the step's equations lose their root. And weight
//! enters a step like forces do in the method of Störmer and Verlet: beyond `Ω h = 2` its fastest swing
//! grows, `−Ω²` being the largest eigenvalue of
//! the accelerations' slope at rest. Springs, dampers and the floor are implicit and limit
//! nothing but accuracy.

use super::coordinates::Increment;
use super::node::{Node, Place};
use super::simulation::Simulation;
use super::step::project;
use super::stiffness::Pair;
use nalgebra::Vector3;
use surefoot_mechanics::integrators::StepError;

/// Longest steps, s; none where nothing limits them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepForecast {
    /// For bodies that turn as fast as they do now.
    pub turning_s: Option<f64>,
    /// For the fastest swing under gravity around where the system is now.
    pub swinging_s: Option<f64>,
    /// Longer ones do not resolve how the lightest body bounces on the floor: a matter of accuracy.
    pub contact_s: Option<f64>,
}

/// Turn in a step beyond which roots get lost, rad, and share of Verlet's limit. Measured 0.85 to 1 on
/// chains and a biped in flight; what whips about fails earlier, and these leave room for it.
const MOST_TURN: f64 = 0.7;
const SHARE: f64 = 0.7;
/// Iterations of the power method.
const ITERATIONS: usize = 60;

impl StepForecast {
    /// The longest step that is foretold to work.
    pub fn step_s(&self) -> Option<f64> {
        match (self.turning_s, self.swinging_s) {
            // What turns is drawn straight, and swings the faster for it: squares of rates add up.
            (Some(a), Some(b)) => Some(a * b / a.hypot(b)),
            (a, b) => a.or(b),
        }
    }

    /// The stricter of two, as for two moments of a motion.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let least = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Self {
            turning_s: least(self.turning_s, other.turning_s),
            swinging_s: least(self.swinging_s, other.swinging_s),
            contact_s: least(self.contact_s, other.contact_s),
        }
    }
}

impl Simulation {
    /// Longest steps for the motion as it is now.
    ///
    /// # Errors
    /// A [`StepError`] where the inertia is singular.
    ///
    /// # Cost
    /// That of some hundred steps.
    pub fn forecast(&mut self) -> Result<StepForecast, StepError> {
        let some = |x: f64, limit: f64| (x > 1e-9 * limit).then(|| limit / x);
        let turning = self.fastest_turning()?;
        let swinging = self.fastest_swing()?;
        let contact = self.system.ground().map(|(floor, _)| {
            let masses = self.system.sites().iter().map(|site| self.nodes[site.link].mass);
            (masses.fold(f64::INFINITY, f64::min) / floor.normal_stiffness).sqrt()
        });
        Ok(StepForecast {
            turning_s: some(turning, MOST_TURN),
            swinging_s: some(swinging, 2.0 * SHARE),
            contact_s: contact.filter(|s| s.is_finite()),
        })
    }

    /// Largest angular velocity of a body, against the world or its inboard body, rad/s.
    fn fastest_turning(&mut self) -> Result<f64, StepError> {
        self.column_rates()?;
        let mut fastest = 0.0_f64;
        let mut motions: Vec<Pair> = Vec::with_capacity(self.nodes.len());
        for (node, place) in self.nodes.iter().zip(&self.places) {
            let inboard = node.inboard.map_or(Pair::ZERO, |i| motions[i]);
            let mut motion = inboard;
            node.add_rates(place, &self.corrections[node.columns.clone()], &mut motion);
            let against = (motion.angular - inboard.angular).norm();
            fastest = fastest.max(motion.angular.norm()).max(against);
            motions.push(motion);
        }
        Ok(fastest)
    }

    /// `Ω`: root of the largest eigenvalue of the slope of accelerations at rest, by the power method, rad/s.
    pub fn fastest_swing(&mut self) -> Result<f64, StepError> {
        if self.system.gravity() == 0.0 {
            return Ok(0.0);
        }
        const EPSILON: f64 = 1e-5;
        // Neighbours in opposite directions, as in the fastest swing, and nothing symmetric about it.
        let sign = |c: usize| if c.is_multiple_of(2) { 1.0 } else { -1.0 };
        let columns = self.at.momenta.len();
        let mut v: Vec<f64> = (0..columns).map(|c| sign(c) + 0.1 * (c as f64).sin()).collect();
        let mut square = 0.0_f64;
        for _ in 0..ITERATIONS {
            let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            if !(size > 0.0 && size.is_finite()) {
                break;
            }
            v.iter_mut().for_each(|x| *x /= size);
            let up = self.acceleration_along(&v, EPSILON)?;
            let down = self.acceleration_along(&v, -EPSILON)?;
            for (x, (a, b)) in v.iter_mut().zip(up.iter().zip(&down)) {
                *x = (a - b) / (2.0 * EPSILON);
            }
            square = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        }
        Ok(square.sqrt())
    }

    /// Accelerations that weight causes at rest, after a motion along `v`.
    fn acceleration_along(&mut self, v: &[f64], by: f64) -> Result<Vec<f64>, StepError> {
        let world = Place::world();
        let mut places: Vec<Place> = Vec::with_capacity(self.nodes.len());
        for (k, node) in self.nodes.iter().enumerate() {
            let step = node.corrected(&Increment::NONE, &v[node.columns.clone()], by);
            let on = node.inboard.map_or(&world, |i| &self.places[i]);
            let moved = node.moved(&self.at.coordinates[k], &step, on);
            let inboard = node.inboard.map_or(&world, |i| &places[i]);
            places.push(node.place(&moved, inboard));
        }
        std::mem::swap(&mut self.places, &mut places);
        let weight = self.weight();
        let result = self.answer_to(&weight);
        std::mem::swap(&mut self.places, &mut places);
        result?;
        Ok(self.corrections.clone())
    }

    /// Weight along all columns.
    fn weight(&self) -> Vec<f64> {
        let gravity = self.system.gravity();
        let of = |node: &Node, place: &Place| {
            let linear = Vector3::new(0.0, 0.0, -node.mass * gravity);
            Pair { linear, angular: place.to_center.cross(&linear) }
        };
        let mut all: Vec<Pair> =
            self.nodes.iter().zip(&self.places).map(|(node, place)| of(node, place)).collect();
        let mut along = vec![0.0; self.at.momenta.len()];
        for k in (0..self.nodes.len()).rev() {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let (force, first) = (all[k], node.columns.start);
            project(node, place, &force, &mut |c, f| along[first + c] = f);
            if let Some(inboard) = node.inboard {
                all[inboard].add_shifted(&force, &place.from_inboard);
            }
        }
        along
    }
}
