//! From bodies and joints to a tree of `core`, as it is at the start.

use super::equations::{Law, MOST_LINKS, Parts, TreeModel};
use crate::scene::PlacedBodies;
use nalgebra::Vector3;
use surefoot::model::Link;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{
    BodyState, JointConstraint, JointLaw, JointSpace, JointSpaceFault, Simulation, System,
};

/// The differential equations of a motion that has not begun, with torques held in its joints by link.
///
/// # Errors
/// What these methods take, where they do not take this.
pub(super) fn tree_model(
    placed: PlacedBodies,
    torques: &[f64],
) -> Result<Box<dyn TreeModel>, JointSpaceFault> {
    let PlacedBodies { system, states, rates } = placed;
    if !is_for_core(&system) {
        return Ok(Box::new(JointSpace::new(system, &states, &rates, torques)?));
    }
    // A step of any length: none is made.
    let simulation = &mut Simulation::new(system.clone(), 1e-3, &states, &rates)?;
    let is_afloat = system.links().first().is_some_and(|l| floats(&l.joint.constraint));
    let states = simulation.states();
    let not_regular = |_| JointSpaceFault::NotFor("starts whose inertia is regular");
    let column_rates = simulation.column_rates().map_err(not_regular)?.to_vec();
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
    match parts.sized(is_afloat) {
        Some(model) => Ok(model),
        None => Ok(Box::new(JointSpace::new(system, &states, &rates, torques)?)),
    }
}

fn floats(constraint: &JointConstraint) -> bool {
    matches!(constraint, JointConstraint::Floating)
}

/// Whether a tree of `core` takes it: others are for the equations of any size.
fn is_for_core(system: &System) -> bool {
    let of_one = |constraint: &JointConstraint| {
        matches!(constraint, JointConstraint::Revolute { .. } | JointConstraint::Prismatic { .. })
    };
    let joint = |(k, link): (usize, &surefoot_multibody::Link)| {
        of_one(&link.joint.constraint) || k == 0 && floats(&link.joint.constraint)
    };
    system.ground().is_none()
        && system.strikers().is_empty()
        && system.closures().is_empty()
        && system.springs().is_empty()
        && system.rolling().is_empty()
        && system.links().len() <= MOST_LINKS
        && system.laws().iter().all(|(_, law)| law.stops.is_none())
        && system.links().iter().enumerate().all(joint)
        && system.links().iter().all(|link| {
            let [a, b, c] = link.body.inertia;
            a + b >= c && b + c >= a && c + a >= b
        })
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
