//! Phases of a walk: standing, on one side, on both.

use super::asked::{Asked, Horizontal, press};
use super::seen::Seen;
use super::support::{self, Transfer};
use super::swing::Landing;
use super::{
    Phase, PlannedStep, Planner, Side, SwingFoot, WalkMemory, next_step, periodic_step, speed,
};
use crate::Real;
use crate::balance::FootTask;
use nalgebra::Vector2;

/// A step is chosen anew for at least this long after lift-off, 1/ω.
const ALWAYS_CHOSEN: f64 = 0.17;
/// In the last of a swing (1/ω), one foot of a pair that lands is enough.
const ONE_LANDS: f64 = 0.0346;
/// A leaving foot may carry this many weights at first.
const MOST_WEIGHTS: f64 = 1.5;

/// One side on the ground.
pub(super) struct SingleSupport<T, const FEET: usize> {
    pub stance: Side,
    pub elapsed: T,
    pub step: PlannedStep<T>,
    pub swing: [Option<SwingFoot<T>>; FEET],
}

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    pub(super) fn standing(
        &self,
        seen: &Seen<'_, T, FEET>,
        memory: &WalkMemory<T, FEET>,
        is_walk: bool,
    ) -> Asked<T, FEET> {
        let rest = if is_walk {
            let side = memory.first;
            let lift_off = periodic_step(&self.gait, side.other(), memory.velocity()).at_lift_off;
            seen.point(side) + seen.heading.to_world(Vector2::new(T::zero(), lift_off.y))
        } else {
            seen.center()
        };
        Asked {
            horizontal: Horizontal::Acceleration(support::rest(&self.gait, seen, rest)),
            feet: [press(); FEET],
            ground: seen.floor(),
            step: Vector2::zeros(),
        }
    }

    pub(super) fn single(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        now: SingleSupport<T, FEET>,
        forces: &[T; FEET],
        dt: T,
    ) -> Asked<T, FEET> {
        let SingleSupport { stance, elapsed, mut step, mut swing } = now;
        let gait = &self.gait;
        let unit = T::one() / gait.omega;
        if step.left > gait.freeze || elapsed < unit * T::of(ALWAYS_CHOSEN) {
            let (sum, count) = swing
                .iter()
                .flatten()
                .fold((Vector2::zeros(), 0), |(sum, n), foot| (sum + foot.position.xy(), n + 1));
            let swinging = sum / T::of(f64::from(count.max(1)));
            step = next_step(gait, &self.query(seen, stance, memory.velocity(), elapsed, swinging));
        } else {
            step.left = (step.left - dt).max(T::zero());
        }

        let target = seen.point(stance);
        let ground = seen.ground(stance);
        let mut feet = [press(); FEET];
        let own = self.stature.feet.iter().zip(&seen.observed.feet);
        for ((task, reference), (foot, observed)) in feet.iter_mut().zip(&mut swing).zip(own) {
            let (Some(reference), Some(foot)) = (reference, foot) else { continue };
            let to = Landing {
                point: target + seen.heading.to_world(step.step + foot.offset),
                ground,
                yaw: memory.heading + memory.commanded.turning_rate * step.left + foot.yaw,
                elapsed,
                left: step.left,
            };
            *task = reference.advance(gait, self.stature.robot.gravity, observed, &to, dt);
        }
        let mut landing = swing.iter().zip(forces).filter_map(|(foot, force)| foot.map(|_| *force));
        let presses = |force: T| force > gait.touch;
        let is_due = elapsed > (elapsed + step.left) * T::of(0.5);
        let is_late = step.left < unit * T::of(ONE_LANDS);
        let has_landed = if is_late { landing.any(presses) } else { landing.all(presses) };
        if is_due && has_landed {
            let old = seen.point(stance);
            let stance = stance.other();
            memory.steps = memory.steps.wrapping_add(1);
            memory.phase = Phase::Double { stance, elapsed: T::zero(), old };
            let asked = self.double(memory, seen, stance, T::zero(), old);
            // Of the next tick on.
            speed::corrected(
                memory,
                gait.speed_loop,
                seen.heading,
                seen.observed.center_of_mass.xy(),
            );
            return asked;
        }
        memory.phase = Phase::Single { stance, elapsed, step, swing };
        let periodic = periodic_step(gait, stance, memory.velocity());
        let in_place = Vector2::new(T::zero(), -stance.sign::<T>() * gait.width);
        Asked {
            horizontal: Horizontal::Pressure(support::single(gait, seen, stance, &periodic, &step)),
            feet,
            ground,
            step: step.step - in_place,
        }
    }

    pub(super) fn double(
        &self,
        memory: &WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        stance: Side,
        elapsed: T,
        old: Vector2<T>,
    ) -> Asked<T, FEET> {
        let gait = &self.gait;
        let new = seen.point(stance);
        let periodic = periodic_step(gait, stance.other(), memory.velocity());
        let weight = self.stature.robot.mass * self.stature.robot.gravity;
        let unloaded = T::one() - (elapsed / gait.double).min(T::one());
        let most_force = weight * T::of(MOST_WEIGHTS) * unloaded + gait.leaving;
        let mut feet = [press(); FEET];
        for (task, foot) in feet.iter_mut().zip(&self.stature.feet) {
            if foot.is_some_and(|foot| foot.side != stance) {
                *task = FootTask::Press { most_force };
            }
        }
        let in_place = Vector2::new(T::zero(), stance.sign::<T>() * gait.width);
        let transfer = Transfer { old, new, elapsed };
        Asked {
            horizontal: Horizontal::Pressure(support::double(gait, seen, &periodic, &transfer)),
            feet,
            ground: seen.floor(),
            step: seen.heading.of_world(new - old) - in_place,
        }
    }
}
