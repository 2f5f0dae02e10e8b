//! A tick of the plan: from phase to phase, and what each asks for.

use super::heading::wrapped;
use super::orientation::level;
use super::seen::Seen;
use super::support::{self, Transfer};
use super::swing::Landing;
use super::{
    Gait, Phase, PlaneMotion, PlannedStep, Side, Stature, StepQuery, SwingFoot, WalkCommand,
    WalkFault, WalkInput, WalkMemory, height, next_step, periodic_step, speed,
};
use crate::Real;
use crate::balance::{FootTask, LinearTask, MotionTask, ObservedMotion};
use nalgebra::{Vector2, Vector3};

/// A step is chosen anew for at least this long after lift-off, 1/ω.
const ALWAYS_CHOSEN: f64 = 0.17;
/// In the last of a swing (1/ω), one foot of a pair that lands is enough.
const ONE_LANDS: f64 = 0.0346;
/// Double support lasts at least this share of its time.
const LEAST_DOUBLE: f64 = 0.3;
/// A leaving foot may carry this many weights at first.
const MOST_WEIGHTS: f64 = 1.5;
/// Standing: how far the centre of pressure goes beyond the capture point, of its way to rest.
const STANDING_FEEDBACK: f64 = 2.0;

/// A robot's measures and its gait.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planner<T, const FEET: usize> {
    /// Measures.
    pub stature: Stature<T, FEET>,
    /// Constants.
    pub gait: Gait<T>,
}

/// What a tick asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkTask<T, const FEET: usize> {
    /// For [`whole_body_motion_tick`](crate::balance::whole_body_motion_tick).
    pub motion: MotionTask<T, FEET>,
    /// `ξ`, world, m.
    pub capture_point: Vector2<T>,
}

/// One side on the ground.
struct SingleSupport<T, const FEET: usize> {
    stance: Side,
    elapsed: T,
    step: PlannedStep<T>,
    swing: [Option<SwingFoot<T>>; FEET],
}

/// What a phase asks for, before height and trunk.
struct Asked<T, const FEET: usize> {
    horizontal: Horizontal<T>,
    feet: [FootTask<T>; FEET],
    /// Height of the ground that carries.
    ground: T,
    /// The step under way, less the step in place.
    step: Vector2<T>,
}

enum Horizontal<T> {
    Acceleration(Vector2<T>),
    Pressure(Vector2<T>),
}

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    /// With a gait scaled to the measures.
    pub fn new(stature: Stature<T, FEET>) -> Self {
        Self { stature, gait: Gait::scaled(&stature) }
    }

    /// The task of this tick, `dt` seconds after the last: from what is observed, the normal `forces` on the
    /// feet (N) and the `command`.
    ///
    /// # Errors
    /// [`WalkFault`]: an input is not finite, or too large. The memory is as it was then.
    pub fn plan(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        observed: &ObservedMotion<T, FEET>,
        forces: &[T; FEET],
        command: &WalkCommand<T>,
        dt: T,
    ) -> Result<WalkTask<T, FEET>, WalkFault> {
        self.check(observed, forces, dt)?;
        command.check()?;
        let gait = &self.gait;
        let mut next = *memory;
        let wanted = command.walk.unwrap_or_else(PlaneMotion::in_place);
        next.commanded = next.commanded.approached(&wanted, gait, dt);
        next.heading = wrapped(next.heading + next.commanded.turning_rate * dt);
        next.touch_downs.iter_mut().flatten().for_each(|touch_down| touch_down.age += dt);

        let seen = Seen::new(&self.stature, observed, next.heading, gait.omega);
        let is_walk = command.walk.is_some();
        let velocity = next.velocity();
        next.phase = match next.phase {
            Phase::Standing => self.leave_standing(&next, &seen, is_walk),
            Phase::Single { stance, elapsed, step, swing } => {
                Phase::Single { stance, elapsed: elapsed + dt, step, swing }
            }
            Phase::Double { stance, elapsed, old } => {
                self.leave_double(&mut next, &seen, (stance, elapsed + dt, old), is_walk)
            }
        };
        let asked = match next.phase {
            Phase::Standing => self.standing(&seen, &next, is_walk),
            Phase::Single { stance, elapsed, step, swing } => {
                let single = SingleSupport { stance, elapsed, step, swing };
                self.single(&mut next, &seen, single, forces, dt)
            }
            Phase::Double { stance, elapsed, old } => {
                self.double(&next, &seen, stance, elapsed, old)
            }
        };
        let motion = self.motion(&next, observed, (velocity, command.lowered), asked);
        if !is_finite(&motion) {
            return Err(WalkFault::Overflow);
        }
        *memory = next;
        Ok(WalkTask { motion, capture_point: seen.xi })
    }

    fn check(
        &self,
        observed: &ObservedMotion<T, FEET>,
        forces: &[T; FEET],
        dt: T,
    ) -> Result<(), WalkFault> {
        if !(dt > T::zero() && dt.is_finite()) {
            return Err(WalkFault::Period);
        }
        let whole = observed.center_of_mass + observed.velocity + observed.angular_momentum;
        if !whole.sum().is_finite() {
            return Err(WalkFault::NotFinite(WalkInput::CenterOfMass));
        }
        if !(observed.central_rotation.sum() + observed.angular_velocity.sum()).is_finite() {
            return Err(WalkFault::NotFinite(WalkInput::CentralBody));
        }
        let feet = self.stature.feet.iter().zip(&observed.feet).zip(forces).enumerate();
        for (number, ((_, foot), force)) in feet.filter(|(_, ((foot, _), _))| foot.is_some()) {
            let vectors = foot.position + foot.velocity + foot.angular_velocity + foot.leg;
            if !(vectors.sum() + foot.rotation.sum()).is_finite() {
                return Err(WalkFault::NotFinite(WalkInput::Foot(number)));
            }
            if !force.is_finite() {
                return Err(WalkFault::NotFinite(WalkInput::Force(number)));
            }
        }
        Ok(())
    }

    /// Starts to walk when the capture point is over the stance side, or at once where a push throws it off the
    /// feet.
    fn leave_standing(
        &self,
        memory: &WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        is_walk: bool,
    ) -> Phase<T, FEET> {
        if is_walk {
            let side = memory.first;
            let lift_off = periodic_step(&self.gait, side.other(), memory.velocity()).at_lift_off;
            let short = side.sign::<T>() * (seen.offset(side).y - lift_off.y);
            if short > -self.gait.shift {
                return self.lifted(seen, side);
            }
        } else if support::beyond(seen) > T::zero() {
            // The side whose landing misses least.
            let miss = |side: Side| {
                let query =
                    self.query(seen, side, Vector2::zeros(), T::zero(), seen.point(side.other()));
                next_step(&self.gait, &query).miss.norm()
            };
            let is_left = miss(Side::Left) <= miss(Side::Right);
            return self.lifted(seen, if is_left { Side::Left } else { Side::Right });
        }
        Phase::Standing
    }

    /// Stands where that is wanted and holds; otherwise lifts the trailing side in time.
    fn leave_double(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        (stance, elapsed, old): (Side, T, Vector2<T>),
        is_walk: bool,
    ) -> Phase<T, FEET> {
        let gait = &self.gait;
        let longest = self.stature.robot.leg_length * gait.strut;
        let is_stretched = || seen.of_side(stance.other()).any(|foot| foot.leg.norm() > longest);
        if elapsed < gait.double && !(elapsed > gait.double * T::of(LEAST_DOUBLE) && is_stretched())
        {
            return Phase::Double { stance, elapsed, old };
        }
        let apart = seen.heading.of_world(seen.point(Side::Left) - seen.point(Side::Right)).x.abs();
        let [abreast, inside] = gait.stopping;
        let holds = !is_walk
            && memory.commanded.velocity.norm() < gait.stopping_speed
            && apart < abreast
            && support::beyond(seen) < -inside;
        if holds {
            memory.first = stance;
            memory.correction = Vector2::zeros();
            memory.touch_downs = [None; 2];
            return Phase::Standing;
        }
        self.lifted(seen, stance)
    }

    /// One side lifts.
    fn lifted(&self, seen: &Seen<'_, T, FEET>, stance: Side) -> Phase<T, FEET> {
        let mut swing = [None; FEET];
        for (to, (foot, observed)) in
            swing.iter_mut().zip(self.stature.feet.iter().zip(&seen.observed.feet))
        {
            *to = foot.filter(|foot| foot.side != stance).map(|_| SwingFoot::lifted(observed));
        }
        let step = PlannedStep {
            left: self.gait.single,
            step: seen.heading.of_world(seen.point(stance.other()) - seen.point(stance)),
            miss: Vector2::zeros(),
        };
        Phase::Single { stance, elapsed: T::zero(), step, swing }
    }

    fn query(
        &self,
        seen: &Seen<'_, T, FEET>,
        side: Side,
        velocity: Vector2<T>,
        elapsed: T,
        swinging: Vector2<T>,
    ) -> StepQuery<T> {
        let swinging = seen.heading.of_world(swinging - seen.point(side));
        StepQuery { side, offset: seen.offset(side), velocity, elapsed, swinging }
    }

    fn standing(
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
        // The capture-point law: the centre of pressure twice as far beyond it as it is beyond its rest.
        let pressure = seen.xi + (seen.xi - rest) * T::of(STANDING_FEEDBACK);
        let squared = self.gait.omega * self.gait.omega;
        Asked {
            horizontal: Horizontal::Acceleration(
                (seen.observed.center_of_mass.xy() - pressure) * squared,
            ),
            feet: [press(); FEET],
            ground: seen.floor(),
            step: Vector2::zeros(),
        }
    }

    fn single(
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
            speed::corrected(memory, gait, seen.heading, seen.observed.center_of_mass.xy());
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

    fn double(
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

    /// With height and trunk.
    fn motion(
        &self,
        memory: &WalkMemory<T, FEET>,
        observed: &ObservedMotion<T, FEET>,
        (velocity, lowered): (Vector2<T>, T),
        asked: Asked<T, FEET>,
    ) -> MotionTask<T, FEET> {
        let gait = &self.gait;
        let carried = height::carried(gait, &self.stature, velocity, asked.step, lowered);
        let [stiffness, damping] = gait.height_gains;
        let error = observed.center_of_mass.z - asked.ground - carried;
        let vertical = -error * stiffness - observed.velocity.z * damping;
        let linear = match asked.horizontal {
            Horizontal::Acceleration(a) => {
                LinearTask::CenterOfMass(Vector3::new(a.x, a.y, vertical))
            }
            Horizontal::Pressure(point) => LinearTask::CenterOfPressure {
                point: point.into(),
                vertical,
                per_length: gait.omega * gait.omega,
            },
        };
        let angular = level(
            &observed.central_rotation,
            &observed.angular_velocity,
            (memory.heading, memory.commanded.turning_rate),
            gait.trunk_gains,
        );
        MotionTask { linear, angular, feet: asked.feet }
    }
}

/// A foot that carries what comes.
fn press<T: Real>() -> FootTask<T> {
    FootTask::Press { most_force: T::of(f64::INFINITY) }
}

fn is_finite<T: Real, const FEET: usize>(task: &MotionTask<T, FEET>) -> bool {
    let linear = match task.linear {
        LinearTask::CenterOfMass(a) => a.sum(),
        LinearTask::CenterOfPressure { point: [x, y], vertical, .. } => x + y + vertical,
        LinearTask::Free => T::zero(),
    };
    let feet = task.feet.iter().fold(T::zero(), |sum, foot| match foot {
        FootTask::Press { .. } => sum,
        FootTask::Swing { linear, angular } => sum + linear.sum() + angular.sum(),
    });
    (linear + task.angular.sum() + feet).is_finite()
}
