//! What is refused of a description: no tree, inertias that no body has, joints that move nothing.

use crate::description::{DescribedKind, Description};
use crate::error::{ImportError, Place, Refusal};
use crate::inertial::{Inertial, violated_inequality};
use crate::robot::{Robot, RobotMotion};
use nalgebra::Matrix3;
use std::collections::HashMap;

/// What printed numbers are rounded to, as a part of the sum of the principal moments, and what shifting
/// leaves behind, as a part of mass and distance squared: core's margins.
const INERTIA_SLACK: f64 = 1e-9;
const SHIFT_SLACK: f64 = 1e-14;

/// Inertia of a joint beside that of what it carries, below which it is rounding and nothing else.
const NOTHING: f64 = 1e-12;

/// The root link of the tree that the joints make.
///
/// # Errors
/// A link hangs from two joints, there is more than one root, or a loop.
pub(super) fn root(description: &Description) -> Result<usize, ImportError> {
    let Description { links, joints, .. } = description;
    let mut carriers: Vec<Option<usize>> = vec![None; links.len()];
    for (j, joint) in joints.iter().enumerate() {
        if let Some(first) = carriers[joint.child].replace(j) {
            return Err(ImportError::Malformed {
                place: joint.place.clone(),
                element: format!("joint {}", joint.name),
                expected: format!("one joint that carries link {}", links[joint.child].name),
                found: format!("a second one beside {}", joints[first].name),
            });
        }
    }
    let mut roots = (0..links.len()).filter(|k| carriers[*k].is_none());
    let root = roots.next();
    if let (Some(first), Some(second)) = (root, roots.next()) {
        return Err(ImportError::Malformed {
            place: links[second].place.clone(),
            element: format!("link {}", links[second].name),
            expected: "a joint that carries it, as there is one root link".into(),
            found: format!("none, and the root link is {}", links[first].name),
        });
    }
    // With one root and one carrier for every other link, what the root does not reach is a loop.
    let mut reached = vec![false; links.len()];
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); links.len()];
    for joint in joints {
        children[joint.parent].push(joint.child);
    }
    let mut open: Vec<usize> = root.into_iter().collect();
    while let Some(link) = open.pop() {
        reached[link] = true;
        open.extend(&children[link]);
    }
    match (root, reached.iter().position(|reached| !reached)) {
        (Some(root), None) => Ok(root),
        (_, lost) => {
            let link = &links[lost.unwrap_or(0)];
            Err(ImportError::Malformed {
                place: link.place.clone(),
                element: format!("link {}", link.name),
                expected: "joints that make a tree".into(),
                found: "a loop that this link is part of".into(),
            })
        }
    }
}

/// Refuses inertias that no body has. What counts is the moving link with all that is fixed to it; a fixed
/// link whose own inertia is impossible is only noted.
pub(super) fn inertias(
    description: &Description,
    parts: &[Vec<(usize, Inertial)>],
    robot: &Robot,
    notes: &mut Vec<String>,
) -> Result<(), ImportError> {
    for (parts, link) in parts.iter().zip(&robot.links) {
        let violated = |part: &Inertial| {
            let reach = (part.center - link.joint.point).norm_squared()
                + link.joint.origin.translation.vector.norm_squared();
            violated_inequality(part, INERTIA_SLACK, SHIFT_SLACK * part.mass * reach)
        };
        let own = parts.iter().find_map(|(k, part)| Some((*k, violated(part)?)));
        if let Some(inequality) = violated(&link.inertial) {
            let culprit = own.as_ref().map(|(k, _)| *k).or(parts.first().map(|(k, _)| *k));
            let culprit = culprit.map(|k| &description.links[k]);
            let subject = match culprit {
                Some(culprit) if culprit.name != link.name => {
                    format!("link {} with {}, which is fixed to it", link.name, culprit.name)
                }
                _ => format!("link {}", link.name),
            };
            let refusal = Refusal::Inertia { inequality };
            return Err(ImportError::refused(culprit.map(|c| &c.place), subject, refusal));
        }
        if let Some((k, inequality)) = own {
            notes.push(format!(
                "link {}: no body has its inertia ({inequality}); with the others that make up {} it will do",
                description.links[k].name, link.name
            ));
        }
    }
    Ok(())
}

/// Refuses joints that move no mass, which have no acceleration, and floating joints on moving links.
pub(super) fn moves_something(description: &Description, robot: &Robot) -> Result<(), ImportError> {
    let places: HashMap<&str, &Place> =
        description.joints.iter().map(|joint| (joint.name.as_str(), &joint.place)).collect();
    let mut composite: Vec<Inertial> = robot.links.iter().map(|link| link.inertial).collect();
    for (k, link) in robot.links.iter().enumerate().rev() {
        let joint = &link.joint;
        let place = places.get(joint.name.as_str()).copied();
        if joint.motion == RobotMotion::Floating && link.parent.is_some() {
            let refusal = Refusal::Unsupported {
                what: "a floating joint on a link that moves".into(),
                advice: "let it hang from the world".into(),
            };
            return Err(ImportError::refused(place, format!("joint {}", joint.name), refusal));
        }
        let own = &composite[k];
        let about: Matrix3<f64> = own.about(&joint.point);
        let (inertia, scale) = match joint.motion {
            RobotMotion::Revolute | RobotMotion::Continuous => {
                ((joint.axis.transpose() * about * joint.axis).x, about.trace())
            }
            RobotMotion::Prismatic => (own.mass, 0.0),
            RobotMotion::Spherical => (about.symmetric_eigenvalues().min(), about.trace()),
            // A floating body needs both.
            RobotMotion::Floating if own.mass > 0.0 => {
                (own.inertia.symmetric_eigenvalues().min(), own.inertia.trace())
            }
            RobotMotion::Floating => (0.0, 0.0),
        };
        let inertia = inertia + joint.properties.armature;
        if !(inertia > NOTHING * scale && inertia > 0.0) {
            let refusal = Refusal::MovesNothing { joint: joint.name.clone(), inertia };
            let subject = format!("link {} on joint {}", link.name, joint.name);
            return Err(ImportError::refused(place, subject, refusal));
        }
        if let Some(parent) = link.parent {
            let moved = composite[k].moved(&joint.origin);
            composite[parent] = Inertial::sum(&[composite[parent], moved]);
        }
    }
    Ok(())
}

/// Whether a joint of the file can be locked: one without an axis only where it is.
pub(super) fn is_lockable(kind: DescribedKind, angle: f64) -> bool {
    match kind {
        DescribedKind::Revolute | DescribedKind::Continuous | DescribedKind::Prismatic => true,
        DescribedKind::Fixed | DescribedKind::Spherical | DescribedKind::Floating => angle == 0.0,
    }
}
