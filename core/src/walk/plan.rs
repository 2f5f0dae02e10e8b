//! A tick of the plan: from phase to phase, and what each asks for.

use super::asked::is_finite;
use super::heading::wrapped;
use super::jump::JumpStage;
use super::seen::Seen;
use super::stepping::SingleSupport;
use super::support;
use super::{
    Gait, JumpPhase, Phase, PlaneMotion, PlannedStep, RunPhase, Side, Stature, StepQuery,
    SwingFoot, WalkCommand, WalkFault, WalkMemory, next_step, periodic_step,
};
use crate::Real;
use crate::balance::{MotionTask, ObservedMotion};
use nalgebra::Vector2;

/// Double support lasts at least this share of its time.
const LEAST_DOUBLE: f64 = 0.3;

/// Of a run: how far the central body may be below its standing height (`z`), and how long a flight may last (1/ω).
const RUNS: [f64; 2] = [0.15, 1.04];

/// What a supervisor must allow for what is planned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leeway<T> {
    /// How far the central body may go below its standing height beyond what it may in any case, m.
    pub sinks: T,
    /// Whether the robot flies, takes off or lands now: never for longer than a leap lasts.
    pub leaps: bool,
}

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

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    /// With a gait scaled to the measures.
    pub fn new(stature: Stature<T, FEET>) -> Self {
        Self { stature, gait: Gait::scaled(&stature) }
    }

    /// What a supervisor must allow in the tick that plans from `memory`.
    pub fn leeway(&self, memory: &WalkMemory<T, FEET>) -> Leeway<T> {
        let gait = &self.gait;
        match &memory.phase {
            Phase::Jump(jump) => self.leeway_of_jump(jump),
            Phase::Run(run) => {
                let [sinks, longest] = RUNS.map(|x| T::of(x));
                let leaps = run.flies && run.elapsed * gait.omega < longest;
                Leeway { sinks: sinks * gait.height, leaps }
            }
            _ => Leeway { sinks: T::zero(), leaps: false },
        }
    }

    /// Which feet the plan has on the ground: those of the side that stands, none in a flight.
    pub fn planned(&self, memory: &WalkMemory<T, FEET>) -> [bool; FEET] {
        match &memory.phase {
            Phase::Single { swing, .. } => swing.each_ref().map(Option::is_none),
            Phase::Run(run) => self
                .stature
                .feet
                .map(|foot| foot.is_some_and(|foot| !run.flies && foot.side == run.side)),
            Phase::Jump(jump) => [!matches!(jump.stage, JumpStage::Flight { .. }); FEET],
            Phase::Standing | Phase::Double { .. } => [true; FEET],
        }
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
            Phase::Standing => self.leave_standing(&mut next, &seen, command),
            Phase::Single { stance, elapsed, step, swing } => {
                Phase::Single { stance, elapsed: elapsed + dt, step, swing }
            }
            Phase::Double { stance, elapsed, old } => {
                self.leave_double(&mut next, &seen, (stance, elapsed + dt, old), command)
            }
            Phase::Jump(jump) => self.jumped(&mut next, &seen, jump, forces, dt),
            Phase::Run(run) => {
                let runs = command.runs && is_walk;
                self.ran(&mut next, &seen, run, (forces, runs), dt)
            }
        };
        let around = (observed, velocity, command.lowered);
        let motion = match next.phase {
            Phase::Standing => {
                let asked = self.standing(&seen, &next, is_walk);
                self.motion(&next, around, asked)
            }
            Phase::Single { stance, elapsed, step, swing } => {
                let single = SingleSupport { stance, elapsed, step, swing };
                let asked = self.single(&mut next, &seen, single, forces, dt);
                self.motion(&next, around, asked)
            }
            Phase::Double { stance, elapsed, old } => {
                let asked = self.double(&next, &seen, stance, elapsed, old);
                self.motion(&next, around, asked)
            }
            Phase::Jump(jump) => self.jump(&next, &seen, &jump),
            Phase::Run(run) => self.run(&next, &seen, &run),
        };
        if !is_finite(&motion) {
            return Err(WalkFault::Overflow);
        }
        *memory = next;
        Ok(WalkTask { motion, capture_point: seen.xi })
    }

    /// Starts to walk when the capture point is over the stance side, or at once where a push throws it off the
    /// feet; otherwise it jumps, where that is wanted.
    fn leave_standing(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        command: &WalkCommand<T>,
    ) -> Phase<T, FEET> {
        if command.walk.is_some() {
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
        } else if let Some(order) = command.jump
            && memory.jumped != Some(order.number)
        {
            memory.jumped = Some(order.number);
            return Phase::Jump(JumpPhase::begun(order));
        }
        Phase::Standing
    }

    /// Stands where that is wanted and holds; otherwise lifts the trailing side in time.
    fn leave_double(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        (stance, elapsed, old): (Side, T, Vector2<T>),
        command: &WalkCommand<T>,
    ) -> Phase<T, FEET> {
        let gait = &self.gait;
        let is_walk = command.walk.is_some();
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
            memory.forget_speed();
            return Phase::Standing;
        }
        if is_walk && command.runs {
            memory.forget_speed();
            return Phase::Run(RunPhase::stance(stance, seen.ground(stance)));
        }
        self.lifted(seen, stance)
    }

    /// One side lifts.
    pub(super) fn lifted(&self, seen: &Seen<'_, T, FEET>, stance: Side) -> Phase<T, FEET> {
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

    pub(super) fn query(
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
}
