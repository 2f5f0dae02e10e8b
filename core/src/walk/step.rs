//! Where and when the next step lands.
//!
//! ```text
//! a = e exp(ω t),   u = (E_d a − b)/κ                                                (1)  t seconds from now
//! J = 4 |b(u') − b|² + c_u |u' − u_0|² + c_t (t − t_0)²,   u' the nearest step in reach  (2)
//! ```
//! While the nominal time leaves a step in reach, it is taken as it is. Only where it misses is the time chosen
//! too (Khadiv, section III), by the least `J` among nine times. Always searching makes the step chase the
//! capture point, a bit later and longer at each tick, until the robot falls.

use super::bounded::bounded;
use super::{Gait, PeriodicStep, Side, periodic_step};
use crate::Real;
use nalgebra::Vector2;

/// Times that are tried.
const TIMES: u8 = 9;
/// Least time left in a search: from this to that, where the limits of the step time are past; 1/ω.
const LEAST_LEFT: [f64; 2] = [0.1, 0.14];
/// A swinging foot starts to move this late, 1/ω.
pub(super) const FOOT_LAG: f64 = 0.07;
/// The step's reach is about this share of the width beside the stance.
const NEUTRAL: f64 = 0.91;

/// What a step is chosen for; heading frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepQuery<T> {
    /// On which side the robot stands.
    pub side: Side,
    /// Capture point from the stance point, m.
    pub offset: Vector2<T>,
    /// Wanted, forward and left, m/s.
    pub velocity: Vector2<T>,
    /// Seconds since lift-off.
    pub elapsed: T,
    /// Mean point of the swinging feet from the stance point, m.
    pub swinging: Vector2<T>,
}

/// A step; heading frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedStep<T> {
    /// Seconds until touch-down.
    pub left: T,
    /// `u`: from the stance point, m.
    pub step: Vector2<T>,
    /// By how much it misses the offset `b`, m.
    pub miss: Vector2<T>,
}

/// The step that brings the robot nearest to the periodic gait.
pub fn next_step<T: Real>(gait: &Gait<T>, query: &StepQuery<T>) -> PlannedStep<T> {
    let periodic = periodic_step(gait, query.side, query.velocity);
    let [shortest, longest] = gait.times;
    let [least, most] = LEAST_LEFT.map(|x| T::of(x) / gait.omega);
    let first = (shortest - query.elapsed).max(least);
    let last = (longest - query.elapsed).max(most);
    let nominal = (gait.single - query.elapsed).max(first);

    let mut best = landing(gait, query, &periodic, nominal);
    if best.miss.norm() < gait.tolerance && query.elapsed < longest {
        return best;
    }
    let cost = |trial: &PlannedStep<T>| {
        let [of_step, of_time] = gait.costs;
        let late = trial.left - nominal;
        trial.miss.norm_squared() * T::of(4.0)
            + (trial.step - periodic.step).norm_squared() * of_step
            + late * late * of_time
    };
    let mut least_cost = cost(&best);
    for k in 0..TIMES {
        let share = T::of(f64::from(k) / f64::from(TIMES - 1));
        let trial = landing(gait, query, &periodic, first + (last - first) * share);
        let its_cost = cost(&trial);
        if its_cost < least_cost - T::of(1e-9) {
            (best, least_cost) = (trial, its_cost);
        }
    }
    best
}

/// (1), in reach.
fn landing<T: Real>(
    gait: &Gait<T>,
    query: &StepQuery<T>,
    periodic: &PeriodicStep<T>,
    left: T,
) -> PlannedStep<T> {
    let a = query.offset * (gait.omega * left).exp();
    let step = in_reach(gait, query, periodic.step_for(a), left);
    PlannedStep { left, step, miss: periodic.miss(a, step) }
}

/// The nearest step that the leg reaches and the foot can still get to.
fn in_reach<T: Real>(
    gait: &Gait<T>,
    query: &StepQuery<T>,
    step: Vector2<T>,
    left: T,
) -> Vector2<T> {
    let outside = -query.side.sign::<T>();
    let [backward, forward] = gait.reach;
    let [least, most] = gait.outwards;
    let clamped = Vector2::new(
        bounded(step.x, backward, forward),
        outside * bounded(outside * step.y, least, most),
    );
    let neutral = Vector2::new(T::zero(), outside * gait.width * T::of(NEUTRAL));
    let reached = neutral + shortened(clamped - neutral, gait.farthest);
    let way = reached - query.swinging;
    let most_way = gait.foot_speed * (left - T::of(FOOT_LAG) / gait.omega).max(T::zero());
    let within = query.swinging + shortened(way, most_way);
    if way.norm() > most_way {
        // Wherever the foot is, it lands on its own side.
        return Vector2::new(within.x, outside * (outside * within.y).max(least));
    }
    reached
}

/// The vector, no longer than that.
fn shortened<T: Real>(v: Vector2<T>, most: T) -> Vector2<T> {
    let length = v.norm();
    if length > most { v * (most / length) } else { v }
}
