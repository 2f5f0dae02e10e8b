//! From bodies and joints to a tree of `core`, as it is at the start.

use super::equations::{Law, MOST_LINKS, Parts, TreeModel};
use nalgebra::Vector3;
use surefoot::model::Link;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{BodyState, JointConstraint, JointLaw, Simulation, System};

/// The differential equations of a motion that has not begun, with torques held in its joints by link.
///
/// # Errors
/// What these methods take, where they do not take this.
pub(super) fn tree_model(
    simulation: &mut Simulation,
    torques: &[f64],
) -> Result<Box<dyn TreeModel>, &'static str> {
    let system = simulation.system().clone();
    check(&system)?;
    let is_afloat = system.links().first().is_some_and(|l| floats(&l.joint.constraint));
    let states = simulation.states();
    let column_rates =
        simulation.column_rates().map_err(|_| "starts whose inertia is regular")?.to_vec();
    let base = if is_afloat { states[0] } else { [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0] };
    let links: Vec<Link> =
        (0..states.len()).map(|k| described(&system, &states, k, &base)).collect();
    let (mut positions, mut velocities) = (Vec::new(), column_rates);
    if is_afloat {
        positions.extend(base);
        let turn = Quaternion::from_array([base[3], base[4], base[5], base[6]]).conjugate();
        for part in [0, 3] {
            let in_world = Vector3::from_row_slice(&velocities[part..part + 3]);
            velocities[part..part + 3].copy_from_slice(turn.rotate(in_world).as_slice());
        }
    }
    positions.resize(velocities.len() + usize::from(is_afloat), 0.0);
    let first = usize::from(is_afloat);
    let column = |link: usize| link - first + 6 * first;
    let mut held = vec![0.0; velocities.len()];
    for (link, torque) in torques.iter().enumerate().skip(first) {
        held[column(link)] = *torque;
    }
    let law = |(link, law): &(usize, JointLaw)| Law {
        link: *link,
        column: column(*link),
        from: simulation.angle(*link),
        law: *law,
    };
    let parts = Parts {
        gravity: system.gravity(),
        positions,
        velocities,
        torques: held,
        laws: system.laws().iter().map(law).collect(),
        links,
    };
    parts.sized(is_afloat).ok_or(TOO_MANY)
}

const TOO_MANY: &str = "trees of at most thirteen bodies";

fn floats(constraint: &JointConstraint) -> bool {
    matches!(constraint, JointConstraint::Floating)
}

/// What a tree of `core` takes.
fn check(system: &System) -> Result<(), &'static str> {
    if system.ground().is_some() || !system.strikers().is_empty() {
        return Err("bodies that touch nothing");
    }
    if !system.closures().is_empty() {
        return Err("trees without closed loops");
    }
    if system.links().len() > MOST_LINKS {
        return Err(TOO_MANY);
    }
    if system.laws().iter().any(|(_, law)| law.stops.is_some()) {
        return Err("joints without stops");
    }
    for (k, link) in system.links().iter().enumerate() {
        let one = matches!(
            link.joint.constraint,
            JointConstraint::Revolute { .. } | JointConstraint::Prismatic { .. }
        );
        if !(one || k == 0 && floats(&link.joint.constraint)) {
            return Err("joints of one coordinate, and one floating body at most, the first,");
        }
        let [a, b, c] = link.body.inertia;
        if !(a + b >= c && b + c >= a && c + a >= b) {
            return Err("inertias that bodies can have");
        }
    }
    Ok(())
}

/// A link as it is at the start, seen from the floating base, if there is one.
fn described(system: &System, states: &[BodyState], k: usize, base: &BodyState) -> Link {
    let link = &system.links()[k];
    let (origin, base_turn) = placed(base);
    let back = base_turn.conjugate();
    let (centre, turn) = placed(&states[k]);
    let (centre, turn) = (back.rotate(centre - origin), back.product(turn));
    let inboard = link.inboard.map_or(0, |inboard| inboard + 1);
    let joined = match link.joint.constraint {
        JointConstraint::Revolute { axis } => {
            let point = centre + turn.rotate(link.joint.outboard.into());
            Link::revolute(inboard, turn.rotate(axis.into()).into(), point.into())
        }
        JointConstraint::Prismatic { axis } => {
            let of_inboard = link.inboard.map_or(Quaternion::identity(), |i| placed(&states[i]).1);
            let axis = back.product(of_inboard).rotate(axis.into());
            Link::prismatic(inboard, axis.into())
        }
        // `check` lets no other through.
        _ => Link::floating(inboard),
    };
    let q = turn.to_array();
    let norm = q.iter().map(|q| q * q).sum::<f64>().sqrt();
    let own = system.laws().iter().filter(|(link, _)| *link == k);
    let rotor = own.map(|(_, law)| law.rotor_inertia).sum();
    let body = joined.body(link.body.mass, link.body.inertia, centre.into());
    body.oriented(q.map(|q| q / norm)).rotor_inertia(rotor)
}

fn placed(&[x, y, z, ref q @ ..]: &BodyState) -> (Vector3<f64>, Quaternion<f64>) {
    (Vector3::new(x, y, z), Quaternion::from_array(*q))
}
