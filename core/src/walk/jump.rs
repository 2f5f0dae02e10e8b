//! Jumping on the spot: a crouch, a push, a flight with the feet under the centre of mass, a soft landing.
//!
//! # Notation
//! That of the module above; `z_t` height of the centre of mass at take-off, where the legs are nearly straight;
//! `h` wanted rise from there, `d` depth of the crouch below it; `v` speed at take-off.
//! ```text
//! v = √(2 g h),   a = (v² − ż²)/(2 (z_t − z))          push, replanned each tick                (1)
//! d = h g/a_n within limits                            so that a is the usual a_n where it can be (2)
//! L̇* = −k_L L − J k 2 q_e                              both momentum and tilt end at zero       (3)
//! f_i = c + o_i + ċ/ω − (z − δ sin(π t/T))             a foot in flight: tucked up by δ         (4)
//! ```
//! (3) instead of the trunk's own rotation: a body that takes off with angular momentum turns until it lands, however
//! level it was; legs that push make much of it. (1) is `ballistic`'s.
//!
//! # Sources
//! Ballistic flight; the centroidal angular momentum as a task: Orin, Goswami, Lee, *Auton. Robots* 35 (2013), section 5.
//! Constants were found by a program in Python on another simulator.

use super::asked::press;
use super::ballistic::{push, take_off_speed};
use super::bounded::bounded;
use super::orientation::level;
use super::seen::Seen;
use super::{Gait, JumpOrder, Leeway, Phase, Planner, WalkMemory, support};
use crate::Real;
use crate::balance::{AngularTask, FootTask, LinearTask, MotionTask};
use nalgebra::{Vector2, Vector3};

/// Share of its straight length to which a leg may stretch, and share of the way there from standing at which a robot
/// takes off: a leg that is nearly straight pushes no more.
const STRETCHED: [f64; 2] = [0.975, 0.27];
/// `a_n`, and the most that a push asks for, in units of gravity.
const PUSH: [f64; 2] = [1.6, 2.8];
/// Least and greatest depth of a crouch below take-off, in units of `z`.
const DEPTH: [f64; 2] = [0.12, 0.3];
/// Way left (in units of `z`) below which (1) keeps its denominator.
const LEAST_WAY: f64 = 0.0122;
/// Height gains of crouch and of landing, `ω²` and `ω`.
const CROUCH: [f64; 2] = [5.0, 4.34];
const LAND: [f64; 2] = [3.34, 3.47];
/// Height at which a landing ends, `z`; the next hop pushes off below the second, when the fall is slower than the third
/// (`√(g z)`) and the body is calm; where it is not, a crouch waits for that.
const LANDED: [f64; 3] = [0.951, 0.9024, 0.07];
/// Calm: upright to this cosine (6°), turning no faster than this, ω.
const CALM: [f64; 2] = [0.9945, 0.25];
/// A crouch that does not arrive, and a push that does not take off, end after this, 1/ω.
const LONGEST: [f64; 2] = [7.0, 1.7];
/// A landing lasts at least this, 1/ω.
const LEAST_LANDING: f64 = 1.38;
/// (3): k_L over ω, k over ω², and J over `m z²`.
const MOMENTUM: [f64; 3] = [4.34, 3.34, 0.2];
/// Of horizontal motion in the push, `ω²` and `ω`.
const CENTER: [f64; 2] = [5.0, 4.34];
/// Of feet in flight, `ω²` and `ω`; distance below the centre of mass and tuck, `z`.
const CARRIED: [f64; 2] = [40.0, 14.0];
const BELOW: [f64; 2] = [1.012, 0.085];
/// A foot is not felt before this share of the time to the apex.
const BLIND: f64 = 0.5;

/// How far the central body goes below its standing height, `z`; share of the time of a flight that one may last.
const LEEWAY: [f64; 2] = [0.3, 1.2];

/// A jump under way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JumpPhase<T, const FEET: usize> {
    /// What was asked for.
    pub order: JumpOrder<T>,
    /// Flights so far.
    pub made: u8,
    /// Since the stage began, s.
    pub elapsed: T,
    /// What of the jump.
    pub stage: JumpStage<T, FEET>,
}

/// What of a jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JumpStage<T, const FEET: usize> {
    /// Going down.
    Crouch,
    /// Pushing off.
    Push,
    /// In the air.
    Flight {
        /// Of the centre of mass upwards at take-off, m/s.
        speed: T,
        /// Feet from their middle at take-off, world, m.
        offsets: [Vector2<T>; FEET],
    },
    /// On the ground again.
    Landing,
}

/// Heights of the centre of mass above the feet, m.
struct Heights<T> {
    take_off: T,
    crouch: T,
}

impl<T: Real, const FEET: usize> JumpPhase<T, FEET> {
    pub(super) fn begun(order: JumpOrder<T>) -> Self {
        Self { order, made: 0, elapsed: T::zero(), stage: JumpStage::Crouch }
    }

    fn at(self, stage: JumpStage<T, FEET>) -> Self {
        Self { stage, elapsed: T::zero(), ..self }
    }
}

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    /// Where the centre of mass is at take-off, and (2) below it.
    fn heights(&self, rise: T) -> Heights<T> {
        let Self { stature, gait } = self;
        let [straight, share] = STRETCHED.map(|x| T::of(x));
        let longer = stature.robot.leg_length * straight - stature.hip_height;
        let take_off = stature.height + longer.max(T::zero()) * share;
        let [least, most] = DEPTH.map(|x| gait.height * T::of(x));
        let depth = bounded(rise / T::of(PUSH[0]), least, most);
        Heights { take_off, crouch: take_off - depth }
    }

    /// From stage to stage; standing again where it is over.
    pub(super) fn jumped(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        jump: JumpPhase<T, FEET>,
        forces: &[T; FEET],
        dt: T,
    ) -> Phase<T, FEET> {
        let gait = &self.gait;
        let jump = JumpPhase { elapsed: jump.elapsed + dt, ..jump };
        let Heights { take_off, crouch } = self.heights(jump.order.rise);
        let observed = seen.observed;
        let (height, rate) = (observed.center_of_mass.z - seen.floor(), observed.velocity.z);
        let unit = T::one() / gait.omega;
        let is_slow = rate.abs() < gait.stopping_speed;
        let [upright, turning] = CALM.map(|x| T::of(x));
        let is_calm = observed.central_rotation.m33 > upright
            && observed.angular_velocity.norm() < turning * gait.omega
            && support::beyond(seen) < T::zero();
        let next = match jump.stage {
            JumpStage::Crouch => {
                let is_down = (height - crouch).abs() < gait.tolerance && is_slow && is_calm;
                let is_late = jump.elapsed > unit * T::of(LONGEST[0]);
                if is_down || is_late { jump.at(JumpStage::Push) } else { jump }
            }
            JumpStage::Push => {
                let longest = self.stature.robot.leg_length * T::of(STRETCHED[0]);
                let is_long = seen.feet().any(|(_, _, foot)| foot.leg.norm() > longest);
                if height > take_off || is_long {
                    // From their middle, not from the centre of mass: what that is off would grow with each hop.
                    let middle = seen.center();
                    let offset = |k: usize| {
                        let foot = observed.feet.get(k);
                        foot.map_or(Vector2::zeros(), |foot| foot.position.xy() - middle)
                    };
                    memory.flights = memory.flights.wrapping_add(1);
                    let made = jump.made.saturating_add(1);
                    let offsets = core::array::from_fn(offset);
                    JumpPhase { made, ..jump.at(JumpStage::Flight { speed: rate, offsets }) }
                } else if jump.elapsed > unit * T::of(LONGEST[1]) {
                    // It does not get off the ground.
                    JumpPhase { made: u8::MAX, ..jump.at(JumpStage::Landing) }
                } else {
                    jump
                }
            }
            JumpStage::Flight { speed, .. } => {
                let is_due = jump.elapsed > speed / self.stature.robot.gravity * T::of(BLIND);
                let touches = seen
                    .feet()
                    .any(|(k, _, _)| forces.get(k).is_some_and(|force| *force > gait.touch));
                if is_due && touches { jump.at(JumpStage::Landing) } else { jump }
            }
            JumpStage::Landing => {
                let [_, lowest, slow] = LANDED.map(|x| T::of(x));
                let is_again = jump.made < jump.order.hops;
                let is_caught =
                    height < gait.height * lowest && rate > -slow * gait.height * gait.omega;
                let is_long = jump.elapsed > unit * T::of(LEAST_LANDING);
                match (is_again, is_long) {
                    (true, _) if is_caught && is_calm => jump.at(JumpStage::Push),
                    (true, true) => jump.at(JumpStage::Crouch),
                    (false, true) if is_slow => return Phase::Standing,
                    _ => jump,
                }
            }
        };
        Phase::Jump(next)
    }

    /// What a supervisor must allow: a flight may last this much longer than a ballistic one.
    pub(super) fn leeway_of_jump(&self, jump: &JumpPhase<T, FEET>) -> Leeway<T> {
        let [sinks, longer] = LEEWAY.map(|x| T::of(x));
        let unit = T::one() / self.gait.omega;
        let leaps = match jump.stage {
            JumpStage::Crouch => false,
            JumpStage::Push => jump.elapsed < unit * T::of(LONGEST[1]),
            JumpStage::Flight { speed, .. } => {
                let flight = speed / self.stature.robot.gravity * T::of(2.0);
                jump.elapsed < flight * longer + unit * T::of(BLIND)
            }
            JumpStage::Landing => jump.elapsed < unit * T::of(LEAST_LANDING),
        };
        Leeway { sinks: sinks * self.gait.height, leaps }
    }

    /// What a stage asks for.
    pub(super) fn jump(
        &self,
        memory: &WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        jump: &JumpPhase<T, FEET>,
    ) -> MotionTask<T, FEET> {
        let gait = &self.gait;
        let observed = seen.observed;
        let gravity = self.stature.robot.gravity;
        let (height, rate) = (observed.center_of_mass.z - seen.floor(), observed.velocity.z);
        let heights = self.heights(jump.order.rise);
        let toward = |to: T, gains: [f64; 2]| {
            let [k, d] = scaled(gait, gains);
            -(height - to) * k - rate * d
        };
        let trunk = AngularTask::CentralBody(level(
            &observed.central_rotation,
            &observed.angular_velocity,
            (memory.heading, T::zero()),
            gait.trunk_gains,
        ));
        let standing = |vertical: T| {
            let level = support::rest(gait, seen, seen.center());
            LinearTask::CenterOfMass(Vector3::new(level.x, level.y, vertical))
        };
        let mut feet = [press(); FEET];
        let (linear, angular) = match jump.stage {
            JumpStage::Crouch => (standing(toward(heights.crouch, CROUCH)), trunk),
            JumpStage::Landing => (standing(toward(gait.height * T::of(LANDED[0]), LAND)), trunk),
            JumpStage::Push => {
                let way = (heights.take_off - height).max(gait.height * T::of(LEAST_WAY));
                let vertical = push(rate, take_off_speed(jump.order.rise, gravity), way);
                let vertical = bounded(vertical, -gravity, gravity * T::of(PUSH[1]));
                let [k, d] = scaled(gait, CENTER);
                let off = observed.center_of_mass.xy() - seen.center();
                let level = -off * k - observed.velocity.xy() * d;
                let linear = LinearTask::CenterOfMass(Vector3::new(level.x, level.y, vertical));
                (linear, self.momentum(memory, seen))
            }
            JumpStage::Flight { speed, offsets } => {
                for (k, foot, own) in seen.feet() {
                    let offset = offsets.get(k).copied().unwrap_or(Vector2::zeros());
                    let ahead = offset + observed.velocity.xy() / gait.omega;
                    let aloft = (speed / gravity * T::of(2.0)).max(T::of(0.173) / gait.omega);
                    let share = (jump.elapsed / aloft).min(T::one()) * T::pi();
                    let [below, tuck] = BELOW.map(|x| gait.height * T::of(x));
                    let below = below - tuck * share.sine_cosine().0;
                    let target = observed.center_of_mass + Vector3::new(ahead.x, ahead.y, -below);
                    let [stiffness, damping] = scaled(gait, CARRIED);
                    let linear = (target - own.position) * stiffness
                        + (observed.velocity - own.velocity) * damping
                        - Vector3::new(T::zero(), T::zero(), gravity);
                    let yaw = (memory.heading + foot.yaw, T::zero());
                    let angular = level(&own.rotation, &own.angular_velocity, yaw, gait.foot_gains);
                    if let Some(task) = feet.get_mut(k) {
                        *task = FootTask::Swing { linear, angular };
                    }
                }
                (LinearTask::Free, trunk)
            }
        };
        MotionTask { linear, angular, feet }
    }

    /// (3)
    fn momentum(&self, memory: &WalkMemory<T, FEET>, seen: &Seen<'_, T, FEET>) -> AngularTask<T> {
        let gait = &self.gait;
        let [rate, stiffness, inertia] = MOMENTUM.map(|x| T::of(x));
        let inertia = self.stature.robot.mass * gait.height * gait.height * inertia;
        let upright = level(
            &seen.observed.central_rotation,
            &seen.observed.angular_velocity,
            (memory.heading, T::zero()),
            [stiffness * gait.omega * gait.omega, T::zero()],
        );
        AngularTask::Momentum {
            rate: upright * inertia - seen.observed.angular_momentum * (rate * gait.omega),
            inertia,
        }
    }
}

/// Gains in units of `ω²` and `ω`.
fn scaled<T: Real>(gait: &Gait<T>, [stiffness, damping]: [f64; 2]) -> [T; 2] {
    [T::of(stiffness) * gait.omega * gait.omega, T::of(damping) * gait.omega]
}
