//! From what a file says to the robot: joints locked, fixed links lumped into the moving ones that carry
//! them, couplings resolved, inertias checked.

mod checks;
mod locks;

use crate::description::{DescribedBase, DescribedJoint, DescribedKind, Description};
use crate::error::{ImportError, Refusal};
use crate::feet;
use crate::inertial::Inertial;
use crate::robot::{Coupling, NamedFrame, Robot, RobotJoint, RobotLink, RobotMotion};
use crate::{BaseChoice, Imported, Options, standing};
use nalgebra::{Isometry3, Vector3};
use std::collections::HashMap;

/// The joint of a floating root link, as Pinocchio names it.
const ROOT_JOINT: &str = "root_joint";

/// A link of the file in the moving link that it is part of.
pub(crate) struct Placement {
    /// Index of the moving link; `None` for the world.
    pub link: Option<usize>,
    /// In that link's frame.
    pub pose: Isometry3<f64>,
}

/// The robot of a description.
///
/// # Errors
/// [`ImportError::Refused`], with the link or joint and what can be done.
pub(crate) fn reduce(
    mut description: Description,
    options: &Options,
) -> Result<Imported, ImportError> {
    let root = checks::root(&description)?;
    if options.free_couplings {
        description.joints.iter_mut().for_each(|joint| joint.mimic = None);
    } else if let Some((place, what)) = description.constraints.first() {
        return Err(ImportError::refused(Some(place), what.clone(), Refusal::Constraint));
    }
    let mut notes = Vec::new();
    let found = found_feet(&description, root, options);
    if let Some(Options { feet, .. }) = &found {
        notes.push(format!("feet found: {} (--feet for others)", feet.join(", ")));
    }
    let options = found.as_ref().unwrap_or(options);
    let locked = locks::lock(&mut description, root, options)?;
    let floating = is_floating(&description, root, options.base, &mut notes)?;
    let mut lumped = Lumped::of(&description, root, floating);
    lumped.couple(&description)?;
    // By the link that carries them, as the robot's own file lists them.
    lumped.robot.frames.sort_by_key(|frame| frame.link.map_or(0, |link| link + 1));
    for (parts, link) in lumped.parts.iter().zip(&mut lumped.robot.links) {
        link.inertial = Inertial::sum(&parts.iter().map(|(_, part)| *part).collect::<Vec<_>>());
    }
    checks::inertias(&description, &lumped.parts, &lumped.robot, &mut notes)?;
    checks::moves_something(&description, &lumped.robot)?;
    if lumped.robot.links.is_empty() {
        let place = &description.links[root].place;
        let refusal = Refusal::NothingMoves;
        return Err(ImportError::refused(Some(place), "robot".into(), refusal));
    }
    let Lumped { mut robot, placements, .. } = lumped;
    robot.feet = feet::feet(&description, &placements, &robot, options)?;
    Ok(Imported { robot, notes, locked, unread: description.unread })
}

/// The options with feet that are found; `None` where some are named, or none are.
fn found_feet(description: &Description, root: usize, options: &Options) -> Option<Options> {
    let is_open = options.find_feet
        && options.feet.is_empty()
        && options.soles.is_empty()
        && description.feet.is_empty();
    let feet = if is_open { standing::feet(description, root) } else { Vec::new() };
    (!feet.is_empty()).then(|| Options { feet, ..options.clone() })
}

/// Whether the root link floats.
fn is_floating(
    description: &Description,
    root: usize,
    choice: BaseChoice,
    notes: &mut Vec<String>,
) -> Result<bool, ImportError> {
    let link = &description.links[root];
    if description.base == DescribedBase::World {
        if choice == BaseChoice::Auto {
            return Ok(false);
        }
        let refusal = Refusal::Unsupported {
            what: "another base than the file's".into(),
            advice: "this format says itself which links float".into(),
        };
        return Err(ImportError::refused(Some(&link.place), "--base".into(), refusal));
    }
    Ok(match choice {
        BaseChoice::Floating => true,
        BaseChoice::Fixed => false,
        BaseChoice::Auto => {
            let floating = link.name != "world";
            let (word, other) =
                if floating { ("floats", "fixed") } else { ("is fixed", "floating") };
            notes
                .push(format!("the root link {} {word} (--base {other} for the other)", link.name));
            floating
        }
    })
}

/// The robot while links are added to it.
struct Lumped {
    robot: Robot,
    /// By the description's links.
    placements: Vec<Placement>,
    /// By the robot's links: the description's links that are part of it, in its frame.
    parts: Vec<Vec<(usize, Inertial)>>,
    /// The robot's link that a joint of the file carries.
    carried: HashMap<String, usize>,
}

impl Lumped {
    /// Depth first, children as the file has them, without recursion: a chain may be long.
    fn of(description: &Description, root: usize, floating: bool) -> Self {
        let links = description.links.len();
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); links];
        for (j, joint) in description.joints.iter().enumerate().rev() {
            children[joint.parent].push(j);
        }
        let placements =
            (0..links).map(|_| Placement { link: None, pose: Isometry3::identity() }).collect();
        let robot = Robot {
            name: description.name.clone(),
            gravity: description.gravity,
            fixed_mass: description.fixed_mass,
            links: Vec::new(),
            frames: Vec::new(),
            feet: Vec::new(),
        };
        let mut all = Self { robot, placements, parts: Vec::new(), carried: HashMap::new() };
        if floating {
            all.add_moving(description, root, None, floating_root());
        } else if description.base == DescribedBase::Open {
            all.add_fixed(
                description,
                root,
                None,
                Isometry3::identity(),
                children[root].is_empty(),
            );
        }
        // On the stack in reverse order, so that the first child comes off first.
        let mut open = children[root].clone();
        while let Some(joint) = open.pop() {
            let joint = &description.joints[joint];
            all.hang(description, joint, children[joint.child].is_empty());
            open.extend(&children[joint.child]);
        }
        all
    }

    /// Adds a joint's child; its parent is there already.
    fn hang(&mut self, description: &Description, joint: &DescribedJoint, is_leaf: bool) {
        let Placement { link: carrier, pose } = &self.placements[joint.parent];
        let (carrier, origin) = (*carrier, pose * joint.origin);
        let Some(motion) = motion(joint) else {
            return self.add_fixed(description, joint.child, carrier, origin, is_leaf);
        };
        let moving = RobotJoint {
            name: joint.name.clone(),
            motion,
            origin,
            axis: if motion.has_axis() { joint.axis } else { Vector3::zeros() },
            point: joint.point,
            properties: joint.properties,
            follows: None,
        };
        self.add_moving(description, joint.child, carrier, moving);
    }

    fn add_moving(
        &mut self,
        description: &Description,
        link: usize,
        parent: Option<usize>,
        joint: RobotJoint,
    ) {
        let index = self.robot.links.len();
        self.carried.insert(joint.name.clone(), index);
        let described = &description.links[link];
        self.robot.links.push(RobotLink {
            name: described.name.clone(),
            parent,
            joint,
            inertial: Inertial::NONE,
        });
        self.parts.push(described.inertial.map(|inertial| (link, inertial)).into_iter().collect());
        self.placements[link] = Placement { link: Some(index), pose: Isometry3::identity() };
    }

    fn add_fixed(
        &mut self,
        description: &Description,
        link: usize,
        carrier: Option<usize>,
        pose: Isometry3<f64>,
        is_leaf: bool,
    ) {
        let described = &description.links[link];
        if let Some(inertial) = &described.inertial {
            match carrier {
                Some(carrier) => self.parts[carrier].push((link, inertial.moved(&pose))),
                None => self.robot.fixed_mass += inertial.mass,
            }
        }
        self.robot.frames.push(NamedFrame {
            name: described.name.clone(),
            link: carrier,
            pose,
            is_leaf: is_leaf && !described.is_inner,
        });
        self.placements[link] = Placement { link: carrier, pose };
    }

    /// Which joint each follower follows.
    fn couple(&mut self, description: &Description) -> Result<(), ImportError> {
        for joint in &description.joints {
            let Some(mimic) = &joint.mimic else { continue };
            let Some(&follower) = self.carried.get(&joint.name) else { continue };
            let leader = self.carried.get(&mimic.leader).copied();
            let leads = |link: &usize| self.robot.links[*link].joint.motion.has_axis();
            let Some(leader) = leader.filter(leads) else {
                return Err(ImportError::refused(
                    Some(&joint.place),
                    format!("joint {}: {}", joint.name, mimic.leader),
                    Refusal::NoSuch {
                        what: "moving joint with one coordinate",
                        nearest: String::new(),
                    },
                ));
            };
            self.robot.links[follower].joint.follows =
                Some(Coupling { leader, multiplier: mimic.multiplier, offset: mimic.offset });
        }
        Ok(())
    }
}

fn motion(joint: &DescribedJoint) -> Option<RobotMotion> {
    match joint.kind {
        DescribedKind::Fixed => None,
        DescribedKind::Revolute => Some(RobotMotion::Revolute),
        DescribedKind::Continuous => Some(RobotMotion::Continuous),
        DescribedKind::Prismatic => Some(RobotMotion::Prismatic),
        DescribedKind::Spherical => Some(RobotMotion::Spherical),
        DescribedKind::Floating => Some(RobotMotion::Floating),
    }
}

fn floating_root() -> RobotJoint {
    RobotJoint {
        name: ROOT_JOINT.into(),
        motion: RobotMotion::Floating,
        origin: Isometry3::identity(),
        axis: Vector3::zeros(),
        point: Vector3::zeros(),
        properties: Default::default(),
        follows: None,
    }
}
