//! How a run fails, told from its record.
//!
//! A run that does not work is *lost* at a moment, in a first manner; the first of these that holds:
//! 1. some joint's torque went beyond [`RUNAWAY`] times what the robot's motors are made for. So end most:
//!    the controller takes the feet for fixed, and where they are not, their rates enter its torques
//!    squared, which so square themselves from tick to tick. If all soles had left flat contact more than
//!    [`RUNAWAY_TICKS`] ticks before, the robot had tipped or lifted off, and the torques only followed:
//!    it tips; else the loop itself ran away;
//! 2. the run ended while the body leant by more than [`LEANING_DEG`]: it tips;
//! 3. it fell without leaning: its legs collapsed;
//! 4. the controller had a fault, or the simulator could not make a step;
//! 5. none of these, but it is not at the set point when it should be.
//!
//! A supervised loop is lost when its supervisor stops it, in the manner that the reason names: motors at
//! their limits are a runaway, or tip, as in 1; tilt and free fall tip, height collapses, and a measurement
//! that is not believed is a manner of its own. What comes of the robot afterwards is not looked at.
//!
//! That is what became of it; why may lie before. The loss is at the end, but for 1 (before that torque)
//! and 2; for these two it is no later than the last sample at which a sole was flat on the floor: what
//! feet do in the air or on an edge is no reason any more. Over the [`BEFORE_S`] before it,
//! - if at half of the samples or more some joint's torque was at its limit, it is the torque limit;
//! - else, if some corner of a sole has moved along the floor by more than [`SLIP_M`] while it was down,
//!   the foot slipped;
//! - else it is the first manner.
//!
//! Corners' ways are sums of displacements between samples at both of which the corner is down, and between
//! which its foot has not lifted off: one that rocks to and fro goes nowhere, and one that steps has not
//! slipped. A slide that ended well is no reason for a loss that comes later: robots live through slides of
//! several centimetres.

use super::criterion::{Criterion, last_seconds};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use surefoot::balance::{Fault, StopReason};
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::ContactState;
use surefoot_sim::closed_loop::{Run, Stop};
use surefoot_sim::record::{EventKind, Sample};
use surefoot_sim::robot::{Limits, Robot};
use surefoot_sim::scene::{Feet, Scene};

/// How a run fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Manner {
    /// A foot slips.
    Slip,
    /// The robot tips over the edges of its soles, or lifts off them.
    Tip,
    /// The legs give way under an upright body.
    Collapse,
    /// The torques run away while a sole is flat on the floor: the loop is unstable.
    Runaway,
    /// The motors' limits are too low.
    TorqueLimit,
    /// A leg becomes singular.
    SingularLeg,
    /// The controller has another fault.
    ControllerFault,
    /// The supervisor does not believe what is measured.
    Measurement,
    /// The simulator cannot make a step.
    StepFailure,
    /// It is upright at the end, but not at rest at the set point.
    DoesNotSettle,
    /// The legs do not reach the set point: there is nothing to run.
    NotReachable,
}

/// Torques of so many times its [`Limits`] are a runaway.
pub const RUNAWAY: f64 = 3.0;
/// Ticks that a runaway takes: soles that it tears off the floor are off it for no longer.
pub const RUNAWAY_TICKS: usize = 5;
/// A body leans that is tilted by more than this.
pub const LEANING_DEG: f64 = 30.0;
/// Time before the loss in which its reason is looked for, s.
pub const BEFORE_S: f64 = 1.0;
/// Way along the floor of a corner that slips, m.
pub const SLIP_M: f64 = 0.03;

impl Manner {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Slip => "slip",
            Self::Tip => "tip",
            Self::Collapse => "collapse",
            Self::Runaway => "runaway",
            Self::TorqueLimit => "torque limit",
            Self::SingularLeg => "singular leg",
            Self::ControllerFault => "controller fault",
            Self::Measurement => "measurement",
            Self::StepFailure => "simulator's step",
            Self::DoesNotSettle => "does not settle",
            Self::NotReachable => "not reachable",
        }
    }
}

/// What there is to judge a run by.
#[derive(Clone, Copy, Debug)]
pub struct Ending<'a> {
    /// What was run.
    pub scene: &'a Scene,
    /// Its record.
    pub run: &'a Run,
    /// The controller's fault, if that has ended it.
    pub fault: Option<Fault>,
}

impl Ending<'_> {
    /// How the run failed; `None` if it works.
    pub fn manner(&self, criterion: &Criterion) -> Option<Manner> {
        let (first, end) = self.loss(criterion)?;
        let before = last_seconds(&self.run.samples[..end], BEFORE_S);
        if 2 * before.iter().filter(|sample| self.is_cut(sample)).count() >= before.len().max(1) {
            return Some(Manner::TorqueLimit);
        }
        Some(if self.slide(before) > SLIP_M { Manner::Slip } else { first })
    }

    /// The first manner of the loss, and the number of samples before it; `None` if there is none.
    fn loss(&self, criterion: &Criterion) -> Option<(Manner, usize)> {
        let samples = &self.run.samples;
        let failure = self.run.failure.as_ref();
        if let Some(Stop { time_s, reason }) = self.run.stop {
            let end = samples.partition_point(|sample| sample.time_s < time_s);
            return Some(stopped(&samples[..end], reason));
        }
        if failure.is_none() && criterion.is_settled(samples, &self.scene.set_point) {
            return None;
        }
        let limits = &self.scene.robot().limits;
        if let Some(runaway) = samples.iter().position(|sample| runs_away(sample, limits)) {
            let flat = samples_to_last_flat_sole(&samples[..runaway]);
            let tipped = runaway - flat > RUNAWAY_TICKS;
            return Some((if tipped { Manner::Tip } else { Manner::Runaway }, flat));
        }
        if failure.is_some() && samples.last().is_some_and(leans) {
            return Some((Manner::Tip, samples_to_last_flat_sole(samples)));
        }
        let manner = match (failure, self.fault) {
            (None, _) => Manner::DoesNotSettle,
            (Some(failure), _) if failure.kind == "fell" => Manner::Collapse,
            (_, Some(Fault::SingularLeg { .. })) => Manner::SingularLeg,
            (_, Some(_)) => Manner::ControllerFault,
            (_, None) => Manner::StepFailure,
        };
        Some((manner, samples.len()))
    }

    /// Whether some joint's torque is as large as it may be.
    fn is_cut(&self, sample: &Sample) -> bool {
        let Some(limits) = self.scene.acting.torque_limits_nm else { return false };
        let legs = sample.torques.iter().zip(limits.iter().cycle());
        legs.into_iter().any(|(torque, limit)| torque.abs() >= limit * (1.0 - 1e-9))
    }

    /// The longest way of a corner along the floor, m; none where feet are welded.
    fn slide(&self, samples: &[Sample]) -> f64 {
        let Feet::Floor { .. } = &self.scene.feet else { return 0.0 };
        let robot = self.scene.robot();
        let mut ways: Vec<Vec<Vector2<f64>>> = robot
            .points_of_feet()
            .into_iter()
            .map(|points| vec![Vector2::zeros(); points])
            .collect();
        let down: Vec<_> = samples.iter().map(|sample| corners_down(sample, &robot)).collect();
        for (times, places) in samples.windows(2).zip(down.windows(2)) {
            for (foot, of) in robot.feet.iter().enumerate() {
                if self.lifts_off(&of.name, times[0].time_s, times[1].time_s) {
                    continue;
                }
                for (corner, way) in ways[foot].iter_mut().enumerate() {
                    if let [Some(from), Some(to)] = [0, 1].map(|end| places[end][foot][corner]) {
                        *way += to - from;
                    }
                }
            }
        }
        ways.iter().flatten().map(Vector2::norm).fold(0.0, f64::max)
    }

    /// Whether a foot has been off the floor between two samples.
    fn lifts_off(&self, foot: &str, after_s: f64, until_s: f64) -> bool {
        self.run.events.iter().any(|event| {
            event.kind == EventKind::LiftOff
                && event.place == foot
                && event.time_s > after_s
                && event.time_s <= until_s
        })
    }
}

/// The manner of a stop after these samples, and the number of those before the loss.
fn stopped(samples: &[Sample], reason: StopReason) -> (Manner, usize) {
    let flat = samples_to_last_flat_sole(samples);
    match reason {
        StopReason::Saturated { .. } if samples.len() - flat <= RUNAWAY_TICKS => {
            (Manner::Runaway, flat)
        }
        StopReason::Saturated { .. } | StopReason::Tilt | StopReason::FreeFall => {
            (Manner::Tip, flat)
        }
        StopReason::Height => (Manner::Collapse, samples.len()),
        StopReason::Tick(Fault::SingularLeg { .. }) => (Manner::SingularLeg, samples.len()),
        StopReason::Tick(_) => (Manner::ControllerFault, samples.len()),
        _ => (Manner::Measurement, samples.len()),
    }
}

/// Whether a torque is beyond all that a motor could give.
pub(in crate::stability) fn runs_away(sample: &Sample, limits: &Limits) -> bool {
    let legs = sample.torques.iter().zip(&limits.joints);
    legs.into_iter().any(|(torque, joint)| !(torque.abs() <= RUNAWAY * joint.torque))
}

fn leans(sample: &Sample) -> bool {
    let [s, x, y, z] = std::array::from_fn(|i| sample.positions[3 + i]);
    let up = Quaternion::from_array([s, x, y, z]).rotate(Vector3::z()).z;
    !(up >= LEANING_DEG.to_radians().cos())
}

/// How many samples there are up to the last with a flat sole; none if there is no such sample.
fn samples_to_last_flat_sole(samples: &[Sample]) -> usize {
    samples.iter().rposition(has_flat_sole).map_or(0, |last| last + 1)
}

/// Whether all corners of a sole are down.
pub(in crate::stability) fn has_flat_sole(sample: &Sample) -> bool {
    // Feet without contact points are welded.
    sample
        .contacts
        .as_ref()
        .is_none_or(|feet| feet.iter().any(|sole| sole.iter().all(|c| is_down(*c))))
}

fn is_down(state: ContactState) -> bool {
    !matches!(state, ContactState::Free | ContactState::NegativeNormalForce)
}

/// Where on the floor the points of feet are that are down, m, by foot and point.
fn corners_down(sample: &Sample, robot: &Robot) -> Vec<Vec<Option<Vector2<f64>>>> {
    let poses = robot.tree.body_poses(&sample.positions);
    let (Some(contacts), Ok(poses)) = (&sample.contacts, poses) else {
        return robot.points_of_feet().into_iter().map(|points| vec![None; points]).collect();
    };
    let of_feet = robot.feet.iter().zip(contacts).map(|(foot, states)| {
        let pose = &poses[foot.body];
        let place = |(point, state): (&surefoot_sim::robot::FootPoint, &ContactState)| {
            is_down(*state).then(|| pose.transform_point(point.at).xy())
        };
        foot.points.iter().zip(states).map(place).collect()
    });
    of_feet.collect()
}
