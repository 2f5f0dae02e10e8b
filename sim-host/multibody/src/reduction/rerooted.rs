//! A floating tree that the world holds at some of its links, rooted there.

use super::super::{
    BodyState, Closing, ClosingMotors, Closure, Joint, JointConstraint, Link, Site, System,
    SystemError,
};

/// A system rooted at other links: the same bodies, in another order.
#[derive(Clone, Debug)]
pub struct Rerooted {
    /// The system.
    pub system: System,
    /// By link of the system that it was: its number now.
    pub links: Vec<usize>,
    /// By link of the system that it was: where its joint is now. None for joints that are gone: those of roots.
    pub seats: Vec<Option<Seat>>,
}

/// Where a joint is in a system that was rooted at other links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seat {
    /// In the tree, as the joint of this link. Told from the other body it has its motors in the opposite order;
    /// angles keep their sign.
    Tree {
        /// The link.
        link: usize,
        /// Whether it is told from the other body.
        is_reversed: bool,
    },
    /// Beside the tree: it closes a loop.
    Closure {
        /// Its number.
        closure: usize,
    },
}

/// A floating tree that the world holds at these links, where they are in these states, in place of the joint
/// that its root floats on. Of several links that are held each needs a joint between it and the others that is
/// cut, which is told by the link whose joint it is: it becomes one that closes a loop, with its motors. The motion
/// is that of the tree with closures that weld these links to the world, to round-off.
///
/// # Errors
/// [`SystemError::Unsupported`] for trees that do not float, links that are held together with no cut between them,
/// parts that are cut off and not held, and laws (springs, dampers, stops) in joints that are cut;
/// [`SystemError::Gimbal`] and [`SystemError::ClosingMotors`] never for a system that exists.
pub fn rerooted(
    system: &System,
    held: &[(usize, BodyState)],
    cut: &[usize],
) -> Result<Rerooted, SystemError> {
    let order = Order::of(system, held, cut)?;
    let number = |link: usize| order.number[link];
    let mut links = Vec::with_capacity(order.links.len());
    let mut seats = vec![None; order.links.len()];
    for (new, place) in order.links.iter().enumerate() {
        let Link { inboard, joint, body } = system.links()[place.link];
        let (inboard, joint) = match place.from {
            Hangs::ByItself => {
                seats[place.link] = Some(Seat::Tree { link: new, is_reversed: false });
                (inboard.map(number), joint)
            }
            Hangs::ByOutboard(child) => {
                seats[child] = Some(Seat::Tree { link: new, is_reversed: true });
                (Some(number(child)), system.links()[child].joint.reversed())
            }
            Hangs::FromWorld(state) => (None, Joint::weld(&state)),
        };
        links.push(Link { inboard, joint, body });
    }

    let mut turned = System::new(links, system.gravity())?;
    for closure in system.closures() {
        let (outboard, inboard) = (number(closure.outboard), closure.inboard.map(number));
        turned = turned.with_closure(Closure { outboard, inboard, ..closure.clone() })?;
    }
    for motors in system.closing_motors() {
        turned = turned.with_closing_motors(*motors)?;
    }
    for link in cut {
        let Link { inboard, joint, .. } = system.links()[*link];
        let closure = turned.closures().len();
        let (outboard, inboard) = (number(*link), inboard.map(number));
        turned =
            turned.with_closure(Closure { outboard, inboard, closing: Closing::Joint(joint) })?;
        let own = system.gimbals().iter().find(|(k, _)| k == link);
        let motors = ClosingMotors { closure, gimbal: own.map(|(_, gimbal)| *gimbal) };
        if motors.fit(&turned.closures()[closure]) {
            turned = turned.with_closing_motors(motors)?;
        }
        seats[*link] = Some(Seat::Closure { closure });
    }
    for (link, law) in system.laws() {
        turned = match seats[*link] {
            Some(Seat::Tree { link, .. }) => turned.with_law(link, *law)?,
            _ => return Err(missing(*link, "a joint that is cut to be without a law")),
        };
    }
    for (link, gimbal) in system.gimbals() {
        let Some(Seat::Tree { link: new, is_reversed }) = seats[*link] else { continue };
        let home = system.links()[*link].joint.home;
        let gimbal = if is_reversed { gimbal.reversed(home) } else { Some(*gimbal) };
        turned = turned.with_gimbal(new, gimbal.ok_or(SystemError::Gimbal { link: *link })?)?;
    }
    if let Some((floor, switching)) = system.ground() {
        let sites = system.sites().iter().map(|site| Site { link: number(site.link), ..*site });
        turned = turned.on_floor(*floor, *switching, sites.collect())?;
        for (link, plane) in system.terrain() {
            turned = turned.on_plane(number(*link), *plane)?;
        }
    }
    for striker in system.strikers() {
        let mut moved = striker.clone();
        (moved.link, moved.struck) = (number(striker.link), number(striker.struck));
        turned = turned.with_striker(moved)?;
    }
    Ok(Rerooted { system: turned, links: order.number, seats })
}

/// What a link hangs from now.
#[derive(Clone, Copy)]
enum Hangs {
    /// The joint that was its own.
    ByItself,
    /// The joint of a link that hung from it.
    ByOutboard(usize),
    /// The world, in this state.
    FromWorld(BodyState),
}

struct Placed {
    link: usize,
    from: Hangs,
}

/// Links in their new order.
struct Order {
    links: Vec<Placed>,
    /// By old link.
    number: Vec<usize>,
}

impl Order {
    /// From every link that is held outwards; then all parts of which none is.
    fn of(
        system: &System,
        held: &[(usize, BodyState)],
        cut: &[usize],
    ) -> Result<Self, SystemError> {
        let count = system.links().len();
        if let Some(link) = held.iter().map(|(k, _)| k).chain(cut).find(|k| **k >= count) {
            return Err(missing(*link, "a link that exists"));
        }
        let is_cut = |link: usize| cut.contains(&link);
        let mut links = Vec::<Placed>::with_capacity(count);
        let mut is_placed = vec![false; count];
        for (root, state) in held {
            let mut waiting = vec![Placed { link: *root, from: Hangs::FromWorld(*state) }];
            while let Some(placed) = waiting.pop() {
                let Placed { link, from } = placed;
                if std::mem::replace(&mut is_placed[link], true) {
                    return Err(missing(link, "a cut between links that are held"));
                }
                links.push(placed);
                let came_from = match from {
                    Hangs::ByOutboard(child) => Some(child),
                    _ => None,
                };
                let outboard = (0..count)
                    .filter(|k| system.links()[*k].inboard == Some(link))
                    .filter(|k| !is_cut(*k) && Some(*k) != came_from);
                waiting.extend(outboard.map(|k| Placed { link: k, from: Hangs::ByItself }));
                if matches!(from, Hangs::ByItself) || is_cut(link) {
                    continue;
                }
                let Link { inboard, joint, .. } = &system.links()[link];
                match inboard {
                    Some(i) => waiting.push(Placed { link: *i, from: Hangs::ByOutboard(link) }),
                    None if joint.constraint == JointConstraint::Floating => {}
                    None => return Err(missing(link, "a root that floats")),
                }
            }
        }
        for link in 0..count {
            if !is_placed[link] {
                if is_cut(link) {
                    return Err(missing(link, "a part that is held beyond each cut"));
                }
                links.push(Placed { link, from: Hangs::ByItself });
            }
        }
        let mut number = vec![0; count];
        for (new, placed) in links.iter().enumerate() {
            number[placed.link] = new;
        }
        Ok(Self { links, number })
    }
}

fn missing(link: usize, what: &'static str) -> SystemError {
    SystemError::Unsupported { link, what }
}
