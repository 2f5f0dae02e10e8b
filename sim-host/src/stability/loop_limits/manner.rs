//! How a run fails, told from its record.
//!
//! A run that does not work is *lost* at a moment, in a first manner:
//! 1. a torque beyond [`RUNAWAY`] times what the biped's motors are made for: the loop runs away, there;
//! 2. a fall, or any other end of a body that leans by more than [`LEANING_DEG`]: it tips, from the last
//!    sample on at which a sole was flat on the floor. A body that falls without leaning has collapsed;
//! 3. a fault of the controller, or a step that the simulator could not make: there;
//! 4. none of these, but it is not at the set point when it should be: at its end.
//!
//! That is what became of it; why may lie before. Over the [`BEFORE_S`] before the loss,
//! - if at half of the samples or more some joint's torque was at its limit, it is the torque limit;
//! - else, if some corner of a sole has moved along the floor by more than [`SLIP_M`] while it was down,
//!   the foot slipped;
//! - else it is the first manner.
//!
//! Corners' ways are sums of displacements between samples at both of which the corner is down: one that
//! rocks to and fro goes nowhere, and one that steps has not slipped. A single long slide that ended well
//! is no reason for a loss that comes later: robots live through slides of several centimetres.

use super::criterion::{Criterion, last_seconds};
use crate::closed_loop::Run;
use crate::contact::ContactState;
use crate::record::Sample;
use crate::scene::{Feet, Scene};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use surefoot::balance::{Fault, SafetyLimits};
use surefoot::dynamics::{body_poses, joint_poses};
use surefoot::model::robots::biped::{FEET, TREE};
use surefoot::spatial::Quaternion;

/// How a run fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Manner {
    /// A foot slips.
    Slip,
    /// The robot tips over the edges of its soles.
    Tip,
    /// The legs give way under an upright body.
    Collapse,
    /// The torques run away while the robot is up: the loop is unstable.
    Runaway,
    /// The motors' limits are too low.
    TorqueLimit,
    /// A leg becomes singular.
    SingularLeg,
    /// The controller has another fault.
    ControllerFault,
    /// The simulator cannot make a step.
    StepFailure,
    /// It is upright at the end, but not at rest at the set point.
    DoesNotSettle,
    /// The legs do not reach the set point: there is nothing to run.
    NotReachable,
}

/// Torques of so many times [`SafetyLimits::biped`] are a runaway.
pub const RUNAWAY: f64 = 10.0;
/// A body leans that is tilted by more than this.
pub const LEANING_DEG: f64 = 30.0;
/// Time before the loss in which its reason is looked for, s.
pub const BEFORE_S: f64 = 0.5;
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

    /// The first manner of the loss, and the number of samples before it.
    fn loss(&self, criterion: &Criterion) -> Option<(Manner, usize)> {
        let samples = &self.run.samples;
        if let Some(at) = samples.iter().position(runs_away) {
            return Some((Manner::Runaway, at));
        }
        let Some(failure) = &self.run.failure else {
            let settled = criterion.is_settled(samples, &self.scene.set_point);
            return (!settled).then_some((Manner::DoesNotSettle, samples.len()));
        };
        let leans = samples.last().is_some_and(leans);
        let manner = match self.fault {
            _ if leans => Manner::Tip,
            _ if failure.kind == "fell" => Manner::Collapse,
            Some(Fault::SingularLeg { .. }) => Manner::SingularLeg,
            Some(_) => Manner::ControllerFault,
            None => Manner::StepFailure,
        };
        let end = match manner {
            Manner::Tip => samples.iter().rposition(has_flat_sole).map_or(0, |last| last + 1),
            _ => samples.len(),
        };
        Some((manner, end))
    }

    /// Whether some joint's torque is as large as it may be.
    fn is_cut(&self, sample: &Sample) -> bool {
        let Some(limits) = self.scene.acting.torque_limits_nm else { return false };
        let legs = sample.torques.iter().zip(limits.iter().cycle());
        legs.into_iter().any(|(torque, limit)| torque.abs() >= limit * (1.0 - 1e-9))
    }

    /// The longest way of a corner along the floor, m; none where feet are welded.
    fn slide(&self, samples: &[Sample]) -> f64 {
        let Feet::Floor { outline, .. } = &self.scene.feet else { return 0.0 };
        let corners = outline.sole().corners();
        let mut ways = [[Vector2::<f64>::zeros(); 4]; 2];
        let mut before: Option<[[Option<Vector2<f64>>; 4]; 2]> = None;
        for sample in samples {
            let now = corners_down(sample, &corners);
            for (foot, corner) in (0..2).flat_map(|foot| (0..4).map(move |corner| (foot, corner))) {
                if let (Some(from), Some(to)) =
                    (before.and_then(|all| all[foot][corner]), now[foot][corner])
                {
                    ways[foot][corner] += to - from;
                }
            }
            before = Some(now);
        }
        ways.iter().flatten().map(Vector2::norm).fold(0.0, f64::max)
    }
}

fn runs_away(sample: &Sample) -> bool {
    let limits = SafetyLimits::<f64>::biped().joint_torque;
    let legs = sample.torques.iter().zip(limits.iter().cycle());
    legs.into_iter().any(|(torque, limit)| !(torque.abs() <= RUNAWAY * limit))
}

fn leans(sample: &Sample) -> bool {
    let [s, x, y, z] = std::array::from_fn(|i| sample.positions[3 + i]);
    let up = Quaternion::from_array([s, x, y, z]).rotate(Vector3::z()).z;
    !(up >= LEANING_DEG.to_radians().cos())
}

/// Whether all corners of a sole are down.
fn has_flat_sole(sample: &Sample) -> bool {
    // Feet without contact points are welded.
    sample.contacts.is_none_or(|feet| feet.iter().any(|sole| sole.iter().all(|c| is_down(*c))))
}

fn is_down(state: ContactState) -> bool {
    !matches!(state, ContactState::Free | ContactState::NegativeNormalForce)
}

/// Where on the floor the corners are that are down, m.
fn corners_down(sample: &Sample, corners: &[Vector3<f64>; 4]) -> [[Option<Vector2<f64>>; 4]; 2] {
    let (Some(contacts), Ok(joints)) = (sample.contacts, joint_poses(&TREE, &sample.positions))
    else {
        return [[None; 4]; 2];
    };
    let poses = body_poses(&TREE, &joints);
    std::array::from_fn(|foot| {
        let pose = &poses[FEET[foot]];
        std::array::from_fn(|corner| {
            is_down(contacts[foot][corner]).then(|| pose.transform_point(corners[corner]).xy())
        })
    })
}
