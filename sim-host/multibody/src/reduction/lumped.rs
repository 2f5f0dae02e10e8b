//! Hinges whose axes meet in a point as one joint, without the small bodies between them.

use super::super::joint::{Joint, JointConstraint};
use super::super::{Gimbal, Link, System, SystemError};
use super::frame::Frame;
use super::rebuild::{Fate, rebuild};
use super::reduced::Reduced;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// Which neighbour is given a small body's inertia.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The one that its chain of hinges hangs from.
    Inboard,
    /// The one at that chain's end.
    Outboard,
}

/// How far apart axes may pass that are said to meet, and how far from right angles they may be.
const MEETS: f64 = 1e-9;

/// The system without these small bodies, each with the neighbour that takes its mass and inertia, as it lies at
/// home. One small body between two hinges leaves a universal joint, two between three a spherical one with
/// motors; torques, angles and rates stay those of the hinges.
///
/// What is lost is how a small body turns against the neighbour that takes it. If its centre of mass lies where
/// the axes meet, only its rotational inertia is misplaced, and translation is exact.
///
/// # Errors
/// [`SystemError::Unsupported`] with the link and what it would take: hinges, axes that meet in a point at right
/// angles, no laws (springs, dampers, stops) in these joints, no branches, and nothing fixed to small bodies.
pub fn lumped(system: &System, small: &[(usize, Side)]) -> Result<Reduced, SystemError> {
    let links = system.links();
    let side_of = |link: usize| small.iter().find(|(k, _)| *k == link).map(|(_, side)| *side);
    let mut fates: Vec<Fate> = (0..links.len()).map(|k| Fate::unchanged(system, k)).collect();
    let mut taken = vec![false; links.len()];
    for end in (0..links.len()).filter(|k| side_of(*k).is_none()) {
        // Small bodies between this link and the next one inboard that stays, from outboard to inboard.
        let mut chain = Vec::new();
        let mut next = links[end].inboard;
        while let Some(link) = next.filter(|k| side_of(*k).is_some()) {
            chain.push(link);
            next = links[link].inboard;
        }
        if chain.is_empty() {
            continue;
        }
        let Some(start) = next else {
            return Err(missing(chain[0], "a body that its hinges hang from"));
        };
        if let Some(link) = chain.iter().find(|k| taken[**k]) {
            return Err(missing(*link, "a small body without branches"));
        }
        chain.reverse();
        let hinges = Hinges::of(system, &chain, end)?;
        fates[end] =
            Fate::Leads { inboard: Some(start), joint: hinges.joint, gimbal: hinges.gimbal };
        for (link, at) in chain.iter().zip(&hinges.places) {
            taken[*link] = true;
            fates[*link] = match side_of(*link) {
                Some(Side::Outboard) => {
                    Fate::Given { leader: end, at: hinges.end.inverse().then(at) }
                }
                _ => Fate::Given { leader: start, at: *at },
            };
        }
    }
    if let Some((link, _)) = small.iter().find(|(k, _)| !taken.get(*k).is_some_and(|t| *t)) {
        return Err(missing(*link, "a small body between two others"));
    }
    rebuild(system, &fates)
}

/// A chain of hinges as one joint.
struct Hinges {
    joint: Joint,
    gimbal: Option<Gimbal>,
    /// Of small bodies at home, in the frame of the body that the chain hangs from; and of the one at its end.
    places: Vec<Frame>,
    end: Frame,
}

impl Hinges {
    fn of(system: &System, chain: &[usize], end: usize) -> Result<Self, SystemError> {
        let links = system.links();
        let mut at = Frame::IDENTITY;
        let (mut places, mut axes) = (Vec::new(), Vec::<Vector3<f64>>::new());
        let point = Vector3::from(links[chain[0]].joint.inboard);
        for k in chain.iter().chain([&end]) {
            let Link { joint, .. } = links[*k];
            let JointConstraint::Revolute { axis } = joint.constraint else {
                return Err(missing(*k, "a hinge"));
            };
            if system.laws().iter().any(|(link, _)| link == k) {
                return Err(missing(*k, "a joint without springs, dampers and stops"));
            }
            if (at.point(joint.inboard.into()) - point).norm() > MEETS {
                return Err(missing(*k, "a hinge whose axis meets the others in its point"));
            }
            let home = Quaternion::from_array(joint.home);
            let arm = home.rotate(joint.outboard.into());
            let position = Vector3::from(joint.inboard) - arm;
            at = at.then(&Frame { position, orientation: home });
            places.push(at);
            axes.push(at.orientation.rotate(axis.into()));
        }
        places.pop();
        let square = || missing(end, "two or three hinges at right angles");
        let (constraint, gimbal) = match axes[..] {
            [first, last] if first.dot(&last).abs() < MEETS => {
                let outboard_axis = at.orientation.conjugate().rotate(last).into();
                let inboard_axis = first.into();
                (JointConstraint::Universal { outboard_axis, inboard_axis }, None)
            }
            [first, middle, last] => {
                let axes = [first, middle, last].map(Into::into);
                let gimbal = Gimbal::new(axes).ok_or_else(square)?;
                (JointConstraint::Spherical, Some(gimbal))
            }
            _ => return Err(square()),
        };
        let joint = Joint {
            outboard: links[end].joint.outboard,
            inboard: point.into(),
            home: at.orientation.to_array(),
            constraint,
        };
        Ok(Self { joint, gimbal, places, end: at })
    }
}

fn missing(link: usize, what: &'static str) -> SystemError {
    SystemError::Unsupported { link, what }
}
