//! Bodies whose motion is observed.

use super::node::Kind;
use super::rates::angular_velocity;
use super::simulation::Simulation;
use super::stiffness::Pair;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::StepError;

/// Way of a body's centre of mass, and its turn as a rotation vector, in the last step and in the one before.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Moved {
    last: Pair,
    before: Pair,
}

impl Moved {
    /// In steps that move it by so much.
    fn start(by: Pair) -> Self {
        Self { last: by, before: by }
    }

    /// Goes on by a step `ratio` times as long as the last one.
    pub fn go_on(&mut self, by: Pair, ratio: f64) {
        let Pair { linear, angular } = self.last;
        self.before = Pair { linear: linear * ratio, angular: angular * ratio };
        self.last = by;
    }

    /// The twist from the mean ones of the last two steps, carried on to now.
    fn observed(&self, h: f64) -> [Vector3<f64>; 2] {
        let carried = |last: Vector3<f64>, before: Vector3<f64>| (last * 1.5 - before * 0.5) / h;
        let Self { last, before } = self;
        [carried(last.linear, before.linear), carried(last.angular, before.angular)]
    }
}

impl Simulation {
    /// The same with a body's motion observed, for [`Self::observed_twist`]; to be said before the first step.
    ///
    /// # Errors
    /// A [`StepError`] where the inertia is singular.
    pub fn watching(mut self, link: usize) -> Result<Self, StepError> {
        let rates = self.rates()?;
        let h = self.at.progress.h;
        let rate = rates[link];
        let linear = Vector3::new(rate[0], rate[1], rate[2]) * h;
        let angular = angular_velocity(&rate, &self.places[link]) * h;
        self.watched.push(link);
        self.at.watched.push(Moved::start(Pair { linear, angular }));
        self.saved.watched.push(Moved::start(Pair::ZERO));
        Ok(self)
    }

    /// Velocity of a body's centre of mass and its angular velocity, world frame, as [`Self::observed_rates`] has
    /// those of joints. None for a body that neither floats nor is watched.
    ///
    /// # Errors
    /// A [`StepError`] where the inertia is singular, before the first step.
    pub fn observed_twist(&mut self, link: usize) -> Result<Option<[Vector3<f64>; 2]>, StepError> {
        let node = &self.nodes[link];
        if node.kind == Kind::Floating {
            let mut own = [0.0; 6];
            if self.at.progress.steps == 0 {
                let columns = node.columns.clone();
                own.copy_from_slice(&self.column_rates()?[columns]);
            } else {
                let (h, [last, before]) = (self.at.last_h, &self.at.last);
                node.add_mean_rates(&last[link], 1.5 / h, &mut own);
                node.add_mean_rates(&before[link], -0.5 / h, &mut own);
            }
            return Ok(Some([0, 3].map(|i| Vector3::new(own[i], own[i + 1], own[i + 2]))));
        }
        let mut watched = self.watched.iter().zip(&self.at.watched);
        let found = watched.find(|(k, _)| **k == link);
        Ok(found.map(|(_, moved)| moved.observed(self.at.last_h)))
    }
}
