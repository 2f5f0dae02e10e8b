//! Running: one side stands for a fixed time and throws the body up, then none does until the other lands.
//!
//! # Notation
//! That of the module above; `T` time of a stance, `z_l` and `v_l` height and rate of the centre of mass at its end.
//! ```text
//! z̈ = 6 (z_l − z)/t² − (4 ż + 2 v_l)/t         t before the end of a stance: the cubic to (z_l, v_l)   (1)
//! u = c + ċ t_l + v T/2 + k (v − v*) − e        where a foot lands in t_l (`ballistic`)                (2)
//! ```
//! with `v` the velocity by angular momentum as in `capture`, `e` from the speed loop; sideways the foot lands half a
//! narrow track beside. The centre of pressure rests in the stance point: speed and balance are (2)'s alone.
//!
//! # Source
//! M. Raibert, *Legged robots that balance* (1986), chapters 2 and 3: hopping height, foot placement and posture as
//! three laws that do not know of each other. Constants were found by a program in Python on another simulator.

use super::asked::press;
use super::ballistic::time_aloft;
use super::bounded::bounded;
use super::orientation::level;
use super::seen::Seen;
use super::swing::cubic;
use super::{Phase, Planner, Side, WalkMemory, speed};
use crate::Real;
use crate::balance::{AngularTask, FootTask, LinearTask, MotionTask, ObservedFoot};
use nalgebra::{Vector2, Vector3};

/// `T`, and the least time that (1) looks ahead, 1/ω.
const STANCE: [f64; 2] = [0.9, 0.104];
/// `z_l` as the share of the way from standing to a leg as long as it may be, `v_l` in units of `√(g z)`.
const LIFT_OFF: [f64; 2] = [0.15, 0.317];
/// A stance ends at once where its leg is longer than this share.
const STRETCHED: f64 = 0.975;
/// Least and most of (1) in units of gravity.
const VERTICAL: [f64; 2] = [-0.815, 2.55];
/// `k` of (2) forward and sideways, 1/ω.
const PLACE: [f64; 2] = [0.173, 0.415];
/// Half of the track in units of `W`, and how far a foot may land beyond the middle, `z`.
const TRACK: [f64; 2] = [0.32, 0.0244];
/// A foot that swings during a stance is this high above the ground, one that will not land in a flight this high and
/// this far behind the centre of mass, `z`.
const CARRIED: [f64; 3] = [0.146, 0.122, 0.061];
/// How far below the ground a landing foot goes, `z`.
const DEEP: f64 = 0.0122;
/// Least time in which a foot gets to its place: in a stance, landing, and of the other in a flight; 1/ω.
const REACH: [f64; 3] = [0.346, 0.138, 0.692];
/// Greatest acceleration of a foot along each axis, in units of gravity.
const FOOT: f64 = 7.14;
/// A flight is not over before this, 1/ω.
const LEAST_FLIGHT: f64 = 0.0692;
/// Speed loop: share of the error, most of it (`√(g z)`), and the time that makes it a distance, 1/ω.
const SPEED_LOOP: [f64; 3] = [0.1, 0.264, 0.692];

/// A run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunPhase<T> {
    /// The side that stands, or lands next.
    pub side: Side,
    /// Whether none is on the ground.
    pub flies: bool,
    /// Since touch-down or lift-off, s.
    pub elapsed: T,
    /// Height of the ground under the last stance, m.
    pub ground: T,
}

impl<T: Real> RunPhase<T> {
    pub(super) fn stance(side: Side, ground: T) -> Self {
        Self { side, flies: false, elapsed: T::zero(), ground }
    }
}

impl<T: Real, const FEET: usize> Planner<T, FEET> {
    /// From stance to flight to stance; a walk's swing at the touch-down after which it is not to run.
    pub(super) fn ran(
        &self,
        memory: &mut WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        run: RunPhase<T>,
        (forces, runs): (&[T; FEET], bool),
        dt: T,
    ) -> Phase<T, FEET> {
        let gait = &self.gait;
        let unit = T::one() / gait.omega;
        let run = RunPhase { elapsed: run.elapsed + dt, ..run };
        let RunPhase { side, flies, elapsed, .. } = run;
        if !flies {
            let longest = self.stature.robot.leg_length * T::of(STRETCHED);
            let is_long = || seen.of_side(side).any(|foot| foot.leg.norm() > longest);
            if elapsed >= unit * T::of(STANCE[0]) || is_long() {
                memory.flights = memory.flights.wrapping_add(1);
                let ground = seen.ground(side);
                let side = side.other();
                return Phase::Run(RunPhase { side, flies: true, elapsed: T::zero(), ground });
            }
            return Phase::Run(run);
        }
        let lands = |k: usize| forces.get(k).is_some_and(|force| *force > gait.touch);
        let touches = seen.feet().any(|(k, foot, _)| foot.side == side && lands(k));
        if !(touches && elapsed > unit * T::of(LEAST_FLIGHT)) {
            return Phase::Run(run);
        }
        memory.steps = memory.steps.wrapping_add(1);
        if !runs {
            memory.forget_speed();
            return self.lifted(seen, side);
        }
        let [share, most, _] = SPEED_LOOP.map(|x| T::of(x));
        let limits = [share, most * gait.height * gait.omega];
        speed::corrected(memory, limits, seen.heading, seen.observed.center_of_mass.xy());
        Phase::Run(RunPhase::stance(side, seen.ground(side)))
    }

    /// What it asks for.
    pub(super) fn run(
        &self,
        memory: &WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        run: &RunPhase<T>,
    ) -> MotionTask<T, FEET> {
        let gait = &self.gait;
        let gravity = self.stature.robot.gravity;
        let observed = seen.observed;
        let time = |x: f64| T::of(x) / gait.omega;
        let center = observed.center_of_mass;
        let longer = self.stature.robot.leg_length * T::of(STRETCHED) - self.stature.hip_height;
        let height = gait.height + longer.max(T::zero()) * T::of(LIFT_OFF[0]);
        let mut feet = [press(); FEET];
        let linear = if run.flies {
            let aloft = time_aloft(center.z - run.ground - height, observed.velocity.z, gravity);
            let aloft = aloft.max(time(0.104));
            let lands = center.xy() + observed.velocity.xy() * aloft;
            let [_, up, behind] = CARRIED.map(|x| gait.height * T::of(x));
            for (k, foot, own) in seen.feet() {
                let (point, z, within) = if foot.side == run.side {
                    let deep = run.ground - gait.height * T::of(DEEP);
                    (lands + self.place(memory, seen, run.side), deep, aloft.max(time(REACH[1])))
                } else {
                    let half = gait.width * T::of(0.5) * foot.side.sign();
                    let point = center.xy() + seen.heading.to_world(Vector2::new(-behind, half));
                    (point, run.ground + up, time(REACH[2]))
                };
                let point = point + seen.heading.to_world(foot.offset);
                let to = (Vector3::new(point.x, point.y, z), within);
                set(&mut feet, k, self.carried(memory, foot.yaw, own, to));
            }
            LinearTask::Free
        } else {
            let ground = seen.ground(run.side);
            let left = (time(STANCE[0]) - run.elapsed).max(time(STANCE[1]));
            let rate = gait.height * gait.omega * T::of(LIFT_OFF[1]);
            let vertical = cubic(center.z - ground, observed.velocity.z, height, rate, left);
            let [least, most] = VERTICAL.map(|x| gravity * T::of(x));
            let point = center.xy() + self.place(memory, seen, run.side.other());
            let within = (time(STANCE[0]) - run.elapsed).max(time(REACH[0]));
            for (k, foot, own) in seen.feet().filter(|(_, foot, _)| foot.side != run.side) {
                let point = point + seen.heading.to_world(foot.offset);
                let z = ground + gait.height * T::of(CARRIED[0]);
                let to = (Vector3::new(point.x, point.y, z), within);
                set(&mut feet, k, self.carried(memory, foot.yaw, own, to));
            }
            LinearTask::CenterOfPressure {
                point: seen.point(run.side).into(),
                vertical: bounded(vertical, least, most),
                per_length: gait.omega * gait.omega,
            }
        };
        let angular = AngularTask::CentralBody(level(
            &observed.central_rotation,
            &observed.angular_velocity,
            (memory.heading, memory.commanded.turning_rate),
            gait.trunk_gains,
        ));
        MotionTask { linear, angular, feet }
    }

    /// (2) less `c + ċ t_l`, world.
    fn place(
        &self,
        memory: &WalkMemory<T, FEET>,
        seen: &Seen<'_, T, FEET>,
        side: Side,
    ) -> Vector2<T> {
        let gait = &self.gait;
        let velocity =
            seen.heading.of_world((seen.xi - seen.observed.center_of_mass.xy()) * gait.omega);
        let [forward, sideways] = PLACE.map(|x| T::of(x) / gait.omega);
        let half = T::of(STANCE[0] * 0.5) / gait.omega;
        let late = velocity - memory.commanded.velocity;
        let corrected = memory.correction * (T::of(SPEED_LOOP[2]) / gait.omega);
        let [track, beyond] = TRACK.map(|x| T::of(x));
        let sign = side.sign::<T>();
        let y = velocity.y * half + late.y * sideways - corrected.y + sign * gait.width * track;
        let inside = -beyond * gait.height;
        seen.heading.to_world(Vector2::new(
            velocity.x * half + late.x * forward - corrected.x,
            if gait.width > T::zero() { sign * (sign * y).max(inside) } else { y },
        ))
    }

    /// A foot on its way to a point, there in so many seconds; its sole level.
    fn carried(
        &self,
        memory: &WalkMemory<T, FEET>,
        yaw: T,
        foot: &ObservedFoot<T>,
        (to, within): (Vector3<T>, T),
    ) -> FootTask<T> {
        let most = self.stature.robot.gravity * T::of(FOOT);
        let linear = foot.position.zip_zip_map(&foot.velocity, &to, |x, v, to| {
            bounded(cubic(x, v, to, T::zero(), within), -most, most)
        });
        let angular = level(
            &foot.rotation,
            &foot.angular_velocity,
            (memory.heading + yaw, T::zero()),
            self.gait.foot_gains,
        );
        FootTask::Swing { linear, angular }
    }
}

fn set<T, const FEET: usize>(feet: &mut [FootTask<T>; FEET], k: usize, task: FootTask<T>) {
    if let Some(to) = feet.get_mut(k) {
        *to = task;
    }
}
