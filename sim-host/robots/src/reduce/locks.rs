//! Joints that the user locks, and those that follow them.

use super::checks::is_lockable;
use crate::description::{DescribedKind, Description};
use crate::error::{ImportError, Refusal};
use crate::feet::no_link;
use crate::robot::{RobotMotion, displacement};
use crate::{Options, nearest};
use std::collections::HashMap;

/// Turns joints into fixed ones: those of `--lock`, with `--legs-only` all that no foot hangs from, and all
/// that follow a locked one.
///
/// # Returns
/// Their names and coordinates.
pub(super) fn lock(
    description: &mut Description,
    root: usize,
    options: &Options,
) -> Result<Vec<(String, f64)>, ImportError> {
    let names: HashMap<String, usize> =
        description.joints.iter().enumerate().map(|(j, joint)| (joint.name.clone(), j)).collect();
    let mut angles: Vec<Option<f64>> = vec![None; description.joints.len()];
    for (name, angle) in &options.locks {
        let Some(&j) = names.get(name) else {
            let refusal = Refusal::NoSuch {
                what: "joint",
                nearest: nearest(name, names.keys().map(String::as_str)),
            };
            return Err(ImportError::refused(None, format!("--lock {name}"), refusal));
        };
        angles[j] = Some(*angle);
    }
    if options.legs_only {
        lock_all_but_legs(description, root, options, &mut angles)?;
    }
    follow(description, &names, &mut angles)?;
    let mut locked = Vec::new();
    for (joint, angle) in description.joints.iter_mut().zip(angles) {
        let Some(angle) = angle else { continue };
        if !is_lockable(joint.kind, angle) {
            let refusal = Refusal::Unsupported {
                what: "locking a joint without an axis at an angle".into(),
                advice: "lock it without one".into(),
            };
            return Err(ImportError::refused(
                Some(&joint.place),
                format!("--lock {}={angle}", joint.name),
                refusal,
            ));
        }
        if joint.kind == DescribedKind::Fixed {
            continue;
        }
        let motion = match joint.kind {
            DescribedKind::Prismatic => RobotMotion::Prismatic,
            _ => RobotMotion::Revolute,
        };
        joint.origin *= displacement(motion, &joint.axis, &joint.point, angle);
        joint.kind = DescribedKind::Fixed;
        joint.mimic = None;
        locked.push((joint.name.clone(), angle));
    }
    Ok(locked)
}

/// Locks every joint that is not between the root and a foot.
fn lock_all_but_legs(
    description: &Description,
    root: usize,
    options: &Options,
    angles: &mut [Option<f64>],
) -> Result<(), ImportError> {
    let mut carriers: Vec<Option<usize>> = vec![None; description.links.len()];
    for (j, joint) in description.joints.iter().enumerate() {
        carriers[joint.child] = Some(j);
    }
    let mut is_leg = vec![false; description.joints.len()];
    // Those that the file has, unless others are named.
    let of_file = description.feet.iter().filter(|_| options.feet.is_empty()).map(|foot| foot.link);
    let mut feet: Vec<usize> = of_file.collect();
    for foot in &options.feet {
        let link = description.links.iter().position(|link| link.name == *foot);
        feet.push(link.ok_or_else(|| no_link(description, "--feet", foot))?);
    }
    for mut at in feet {
        while let (true, Some(j)) = (at != root, carriers[at]) {
            is_leg[j] = true;
            at = description.joints[j].parent;
        }
    }
    for ((joint, is_leg), angle) in description.joints.iter().zip(is_leg).zip(angles) {
        if !is_leg && joint.kind != DescribedKind::Fixed && joint.kind != DescribedKind::Floating {
            // Those that follow a joint are asked when it is known whether that one is locked.
            let follows = joint.mimic.is_some() && !options.free_couplings;
            *angle = angle.or((!follows).then_some(0.0));
        }
    }
    Ok(())
}

/// Locks what follows a locked joint, along chains of followers; a follower of a follower is made one of
/// the first leader.
fn follow(
    description: &mut Description,
    names: &HashMap<String, usize>,
    angles: &mut [Option<f64>],
) -> Result<(), ImportError> {
    for j in 0..description.joints.len() {
        let Some(mut mimic) = description.joints[j].mimic.clone() else { continue };
        let joint = &description.joints[j];
        for hops in 0.. {
            let Some(&leader) = names.get(&mimic.leader) else {
                let near = nearest(&mimic.leader, names.keys().map(String::as_str));
                let refusal = Refusal::NoLeader { nearest: near };
                let subject = format!("joint {} follows {}", joint.name, mimic.leader);
                return Err(ImportError::refused(Some(&joint.place), subject, refusal));
            };
            if leader == j || hops > description.joints.len() {
                return Err(ImportError::Malformed {
                    place: joint.place.clone(),
                    element: format!("joint {}", joint.name),
                    expected: "a leader with a freedom of its own".into(),
                    found: "joints that follow each other in a loop".into(),
                });
            }
            if let Some(angle) = angles[leader] {
                angles[j] = angles[j].or(Some(mimic.multiplier * angle + mimic.offset));
                break;
            }
            let Some(next) = &description.joints[leader].mimic else { break };
            mimic.offset += mimic.multiplier * next.offset;
            mimic.multiplier *= next.multiplier;
            mimic.leader = next.leader.clone();
        }
        description.joints[j].mimic = Some(mimic);
    }
    Ok(())
}
