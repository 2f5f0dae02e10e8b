//! The smaller system out of groups of links.

use super::super::closure::ConstraintFunction;
use super::super::joint::{Joint, JointConstraint, product, rotated};
use super::super::{
    Body, Closing, ClosingMotors, Closure, Gimbal, Link, Site, Striker, System, SystemError,
};
use super::composite::composite;
use super::frame::Frame;
use super::reduced::{Carrier, Reduced};
use nalgebra::Vector3;
use num_dual::Dual64;
use std::sync::Arc;
use surefoot::spatial::Quaternion;

/// What becomes of a link of the larger system.
#[derive(Clone, Copy, Debug)]
pub(super) enum Fate {
    /// It leads a group, on this joint to this link of the larger system, with these motors.
    Leads { inboard: Option<usize>, joint: Joint, gimbal: Option<Gimbal> },
    /// It is part of another's group, at this place in that link's frame.
    Joins { leader: usize, at: Frame },
    /// The same, but only its inertia is: nothing is told of where it is.
    Given { leader: usize, at: Frame },
    /// It is part of the world, at this place in it.
    Still { at: Frame },
}

impl Fate {
    /// That of a link that stays as it is.
    pub fn unchanged(system: &System, link: usize) -> Self {
        let Link { inboard, joint, .. } = system.links()[link];
        let own = system.gimbals().iter().find(|(k, _)| *k == link);
        Self::Leads { inboard, joint, gimbal: own.map(|(_, gimbal)| *gimbal) }
    }
}

/// Makes the smaller system.
///
/// # Errors
/// [`SystemError::Unsupported`] for a struck box that would be askew in its body's axes.
pub(super) fn rebuild(system: &System, fates: &[Fate]) -> Result<Reduced, SystemError> {
    let leaders = fates.iter().enumerate().filter(|(_, fate)| matches!(fate, Fate::Leads { .. }));
    let mut number = vec![0; fates.len()];
    let mut roots = Vec::new();
    let mut bodies = Vec::new();
    for (new, (old, _)) in leaders.enumerate() {
        number[old] = new;
        let (body, frame) = composite(&parts(system, fates, old));
        roots.push((old, frame));
        bodies.push(body);
    }
    let carried: Vec<Option<Carrier>> = fates
        .iter()
        .enumerate()
        .map(|(old, fate)| {
            let (leader, at) = match fate {
                Fate::Leads { .. } => (old, Frame::IDENTITY),
                Fate::Joins { leader, at } => (*leader, *at),
                Fate::Given { .. } => return None,
                Fate::Still { at } => return Some((None, *at)),
            };
            let new = number[leader];
            Some((Some(new), roots[new].1.inverse().then(&at)))
        })
        .collect();
    let unsupported = |link, what| SystemError::Unsupported { link, what };
    let carrier = |link: usize| {
        let what = "a link that moves with another, for what is fixed to it,";
        carried[link].ok_or(unsupported(link, what))
    };
    let moving = |link: usize| {
        let (body, frame) = carrier(link)?;
        let body = body.ok_or(unsupported(link, "a link that moves, for what acts on it,"))?;
        Ok::<_, SystemError>((body, frame))
    };

    let mut links = Vec::with_capacity(roots.len());
    let mut gimbals = Vec::new();
    for (new, ((old, _), body)) in roots.iter().zip(&bodies).enumerate() {
        let Fate::Leads { inboard, joint, gimbal } = fates[*old] else { continue };
        let (on, of_inboard) = match inboard {
            None => (None, Frame::IDENTITY),
            Some(link) => carrier(link)?,
        };
        let joint = seen(&joint, &carrier(*old)?.1, &of_inboard);
        links.push(Link { inboard: on, joint, body: *body });
        if let Some(gimbal) = gimbal {
            let turn = |axis: [f64; 3]| of_inboard.orientation.rotate(axis.into()).into();
            gimbals.push((new, Gimbal::new(gimbal.axes().map(turn))));
        }
    }
    let mut smaller = System::new(links, system.gravity())?;
    for (link, gimbal) in gimbals {
        smaller = smaller.with_gimbal(link, gimbal.ok_or(SystemError::Gimbal { link })?)?;
    }
    for (link, law) in system.laws() {
        smaller = smaller.with_law(moving(*link)?.0, *law)?;
    }
    if let Some((floor, switching)) = system.ground() {
        let moved = |site: &Site| {
            let (link, frame) = moving(site.link)?;
            Ok(Site { link, position: frame.point(site.position.into()).into() })
        };
        let sites: Result<Vec<Site>, SystemError> = system.sites().iter().map(moved).collect();
        smaller = smaller.on_floor(*floor, *switching, sites?)?;
        for (link, plane) in system.terrain() {
            smaller = smaller.on_plane(moving(*link)?.0, *plane)?;
        }
    }
    for (old, closure) in system.closures().iter().enumerate() {
        let outboard = carrier(closure.outboard)?;
        let inboard = closure.inboard.map_or(Ok((None, Frame::IDENTITY)), carrier)?;
        let motors = system.closing_motors().iter().find(|motors| motors.closure == old);
        let Some((moved, is_reversed)) = moved_closure(closure, outboard, inboard) else {
            // Both of its bodies stand still.
            continue;
        };
        let number = smaller.closures().len();
        smaller = smaller.with_closure(moved)?;
        if let Some(motors) = motors {
            if is_reversed {
                let what = "a link that moves, as the outboard one of a driven loop,";
                return Err(unsupported(closure.outboard, what));
            }
            let turn = |axis: [f64; 3]| inboard.1.orientation.rotate(axis.into()).into();
            let gimbal = motors.gimbal.and_then(|gimbal| Gimbal::new(gimbal.axes().map(turn)));
            smaller = smaller.with_closing_motors(ClosingMotors { closure: number, gimbal })?;
        }
    }
    for striker in system.strikers() {
        smaller = smaller.with_striker(moved_striker(
            striker,
            moving(striker.link)?,
            moving(striker.struck)?,
        )?)?;
    }
    Ok(Reduced { system: smaller, carried, roots, still: still_energy(system, fates) })
}

/// Potential energy of what is part of the world now, J.
fn still_energy(system: &System, fates: &[Fate]) -> f64 {
    let all = system.links().iter().zip(fates);
    let heights = all.filter_map(|(link, fate)| match fate {
        Fate::Still { at } => Some(link.body.mass * at.position.z),
        _ => None,
    });
    system.gravity() * heights.sum::<f64>()
}

/// All bodies of a leader's group, in its frame.
fn parts(system: &System, fates: &[Fate], of: usize) -> Vec<(Body, Frame)> {
    let place = |(old, fate): (usize, &Fate)| match fate {
        Fate::Leads { .. } => (old == of).then_some(Frame::IDENTITY),
        Fate::Joins { leader, at } | Fate::Given { leader, at } => (*leader == of).then_some(*at),
        Fate::Still { .. } => None,
    };
    let all = fates.iter().enumerate();
    all.filter_map(|one| place(one).map(|at| (system.links()[one.0].body, at))).collect()
}

/// A joint between bodies whose old frames are at these places in the new ones.
fn seen(joint: &Joint, outboard: &Frame, inboard: &Frame) -> Joint {
    let turn = |frame: &Frame, axis: [f64; 3]| frame.orientation.rotate(axis.into()).into();
    let home = Quaternion::from_array(joint.home);
    let constraint = match joint.constraint {
        JointConstraint::Revolute { axis } => {
            JointConstraint::Revolute { axis: turn(outboard, axis) }
        }
        JointConstraint::Prismatic { axis } => {
            JointConstraint::Prismatic { axis: turn(inboard, axis) }
        }
        JointConstraint::Universal { outboard_axis, inboard_axis } => JointConstraint::Universal {
            outboard_axis: turn(outboard, outboard_axis),
            inboard_axis: turn(inboard, inboard_axis),
        },
        same
        @ (JointConstraint::Floating | JointConstraint::Spherical | JointConstraint::Fixed) => same,
    };
    Joint {
        outboard: outboard.point(joint.outboard.into()).into(),
        inboard: inboard.point(joint.inboard.into()).into(),
        home: inboard
            .orientation
            .product(home)
            .product(outboard.orientation.conjugate())
            .to_array(),
        constraint,
    }
}

/// A closure between carriers, and whether its bodies have changed places, as only the inboard one can be the
/// world. None where both are.
fn moved_closure(
    closure: &Closure,
    outboard: Carrier,
    inboard: Carrier,
) -> Option<(Closure, bool)> {
    let is_reversed = outboard.0.is_none();
    let ends = if is_reversed { (inboard, outboard) } else { (outboard, inboard) };
    let closing = match &closure.closing {
        Closing::Joint(joint) => {
            let joint = if is_reversed { joint.reversed() } else { *joint };
            Closing::Joint(seen(&joint, &ends.0.1, &ends.1.1))
        }
        Closing::General(function) => Closing::General(Arc::new(Carried {
            function: Arc::clone(function),
            frames: [outboard.1, inboard.1],
            is_reversed,
        })),
    };
    Some((Closure { outboard: ends.0.0?, inboard: ends.1.0, closing }, is_reversed))
}

fn moved_striker(
    striker: &Striker,
    of: (usize, Frame),
    on: (usize, Frame),
) -> Result<Striker, SystemError> {
    if !on.1.is_parallel() {
        let what = "a struck box along the principal axes of its body and what is fixed to it";
        return Err(SystemError::Unsupported { link: striker.struck, what });
    }
    let mut moved = striker.clone();
    moved.link = of.0;
    moved.struck = on.0;
    moved.around.center = on.1.point(striker.around.center.into()).into();
    for point in &mut moved.points {
        *point = of.1.point(Vector3::from(*point)).into();
    }
    Ok(moved)
}

/// Constraints of a user's own, written for bodies that others carry now.
#[derive(Debug)]
struct Carried {
    function: Arc<dyn ConstraintFunction>,
    /// Of the outboard and the inboard body in their carriers.
    frames: [Frame; 2],
    /// Whether the carriers have changed places.
    is_reversed: bool,
}

impl ConstraintFunction for Carried {
    fn constraints(&self) -> usize {
        self.function.constraints()
    }

    fn evaluate(&self, outboard: &[Dual64; 7], inboard: &[Dual64; 7]) -> [Dual64; 6] {
        let state = |x: &[Dual64; 7], frame: &Frame| -> [Dual64; 7] {
            let [a, b, c, s, i, j, k] = *x;
            let arm = rotated(&[s, i, j, k], &frame.position.into());
            let q = product(&[s, i, j, k], &frame.orientation.to_array().map(Dual64::from));
            [a + arm[0], b + arm[1], c + arm[2], q[0], q[1], q[2], q[3]]
        };
        let [of_outboard, of_inboard] = &self.frames;
        let (outboard, inboard) =
            if self.is_reversed { (inboard, outboard) } else { (outboard, inboard) };
        self.function.evaluate(&state(outboard, of_outboard), &state(inboard, of_inboard))
    }
}
