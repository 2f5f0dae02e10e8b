//! Bodies and joints as a tree of `core`, for methods on the differential equations of joint coordinates.
//!
//! A tree's sizes are known when it is compiled. Here are those of serial and branching trees up to
//! [`MOST_LINKS`] bodies, all on joints of one coordinate, the first perhaps afloat.

use crate::multibody::{BodyState, JointConstraint, JointLaw, Simulation, System, states_of_tree};
use nalgebra::Vector3;
use surefoot::dynamics::{DynamicsFault, forward_dynamics, joint_poses, position_rates};
use surefoot::model::{Link, Tree};
use surefoot::spatial::Quaternion;

/// Bodies at most.
pub const MOST_LINKS: usize = 13;

/// The differential equations of a tree, from its start on: angles are counted from there.
pub trait TreeModel: Send + Sync {
    /// Positions and velocities at the start.
    fn start(&self) -> (Vec<f64>, Vec<f64>);

    /// Rates of positions, and accelerations.
    ///
    /// # Errors
    /// A [`DynamicsFault`].
    ///
    /// # Cost
    /// One forward dynamics: linear in the number of links.
    fn rates(
        &self,
        positions: &[f64],
        velocities: &[f64],
        rates: Rates<'_>,
    ) -> Result<(), DynamicsFault>;

    /// Rates of positions alone, without dynamics.
    fn position_rates(&self, positions: &[f64], velocities: &[f64]) -> Vec<f64>;

    /// States and rates of all bodies.
    ///
    /// # Errors
    /// A [`DynamicsFault`].
    fn bodies(
        &self,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<(Vec<BodyState>, Vec<BodyState>), DynamicsFault>;

    /// Where among the positions the unit quaternion of a floating body is.
    fn quaternion(&self) -> Option<usize>;
}

/// Where rates go.
#[derive(Debug)]
pub struct Rates<'a> {
    /// Of positions.
    pub positions: &'a mut [f64],
    /// Of velocities.
    pub velocities: &'a mut [f64],
}

/// A spring and damper of a joint, by velocity.
#[derive(Clone, Copy)]
struct Law {
    column: usize,
    /// The joint's angle at the start.
    from: f64,
    law: JointLaw,
}

struct Sized<const N: usize, const NQ: usize, const NV: usize> {
    tree: Tree<f64, N, NQ, NV>,
    positions: [f64; NQ],
    velocities: [f64; NV],
    torques: [f64; NV],
    laws: Vec<Law>,
}

impl<const N: usize, const NQ: usize, const NV: usize> Sized<N, NQ, NV> {
    fn is_afloat(&self) -> bool {
        NQ > NV
    }
}

impl<const N: usize, const NQ: usize, const NV: usize> TreeModel for Sized<N, NQ, NV> {
    fn start(&self) -> (Vec<f64>, Vec<f64>) {
        (self.positions.to_vec(), self.velocities.to_vec())
    }

    fn rates(
        &self,
        positions: &[f64],
        velocities: &[f64],
        rates: Rates<'_>,
    ) -> Result<(), DynamicsFault> {
        let q: [f64; NQ] = std::array::from_fn(|i| positions[i]);
        let v: [f64; NV] = std::array::from_fn(|i| velocities[i]);
        let mut torques = self.torques;
        for Law { column, from, law } in &self.laws {
            let angle = q[column + NQ - NV] + from;
            torques[*column] -= law.stiffness * (angle - law.rest) + law.damping * v[*column];
        }
        let poses = joint_poses(&self.tree, &q)?;
        let a = forward_dynamics(&self.tree, &poses, &v, &torques, None)?;
        rates.positions.copy_from_slice(&position_rates(&self.tree, &q, &v));
        rates.velocities.copy_from_slice(&a);
        Ok(())
    }

    fn position_rates(&self, positions: &[f64], velocities: &[f64]) -> Vec<f64> {
        let q: [f64; NQ] = std::array::from_fn(|i| positions[i]);
        let v: [f64; NV] = std::array::from_fn(|i| velocities[i]);
        position_rates(&self.tree, &q, &v).to_vec()
    }

    fn bodies(
        &self,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<(Vec<BodyState>, Vec<BodyState>), DynamicsFault> {
        let q: [f64; NQ] = std::array::from_fn(|i| positions[i]);
        let v: [f64; NV] = std::array::from_fn(|i| velocities[i]);
        states_of_tree(&self.tree, &q, &v)
    }

    fn quaternion(&self) -> Option<usize> {
        self.is_afloat().then_some(3)
    }
}

/// The differential equations of a motion that has not begun, with torques held in its joints by link.
///
/// # Errors
/// What about it is not to be had.
pub fn tree_model(
    simulation: &mut Simulation,
    torques: &[f64],
) -> Result<Box<dyn TreeModel>, &'static str> {
    let system = simulation.system().clone();
    check(&system)?;
    let is_afloat = system.links().first().is_some_and(|l| floats(&l.joint.constraint));
    let states = simulation.states();
    let column_rates =
        simulation.column_rates().map_err(|_| "a start whose inertia is singular")?.to_vec();
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
    parts.sized(is_afloat).ok_or("no more than thirteen bodies")
}

struct Parts {
    links: Vec<Link>,
    gravity: f64,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    torques: Vec<f64>,
    laws: Vec<Law>,
}

impl Parts {
    fn sized(self, is_afloat: bool) -> Option<Box<dyn TreeModel>> {
        macro_rules! choose {
            ($(($n:literal, $nq:literal, $nv:literal, $afloat:literal)),*) => {
                match (self.links.len(), is_afloat) {
                    $(($n, $afloat) => self.of_size::<$n, $nq, $nv>(),)*
                    _ => None,
                }
            };
        }
        choose!(
            (1, 1, 1, false),
            (2, 2, 2, false),
            (3, 3, 3, false),
            (4, 4, 4, false),
            (5, 5, 5, false),
            (6, 6, 6, false),
            (7, 7, 7, false),
            (8, 8, 8, false),
            (9, 9, 9, false),
            (10, 10, 10, false),
            (11, 11, 11, false),
            (12, 12, 12, false),
            (13, 13, 13, false),
            (1, 7, 6, true),
            (2, 8, 7, true),
            (3, 9, 8, true),
            (4, 10, 9, true),
            (5, 11, 10, true),
            (6, 12, 11, true),
            (7, 13, 12, true),
            (8, 14, 13, true),
            (9, 15, 14, true),
            (10, 16, 15, true),
            (11, 17, 16, true),
            (12, 18, 17, true),
            (13, 19, 18, true)
        )
    }

    fn of_size<const N: usize, const NQ: usize, const NV: usize>(
        self,
    ) -> Option<Box<dyn TreeModel>> {
        let tree = Tree::new(<[Link; N]>::try_from(self.links).ok()?);
        Some(Box::new(Sized::<N, NQ, NV> {
            tree: tree.with_gravity([0.0, 0.0, -self.gravity]),
            positions: self.positions.try_into().ok()?,
            velocities: self.velocities.try_into().ok()?,
            torques: self.torques.try_into().ok()?,
            laws: self.laws,
        }))
    }
}

fn floats(constraint: &JointConstraint) -> bool {
    matches!(constraint, JointConstraint::Floating)
}

/// What a tree of `core` takes.
fn check(system: &System) -> Result<(), &'static str> {
    if system.ground().is_some() || !system.strikers().is_empty() {
        return Err("nothing to touch");
    }
    if !system.closures().is_empty() {
        return Err("no closed loop");
    }
    if system.links().len() > MOST_LINKS {
        return Err("no more than thirteen bodies");
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
            return Err("joints of one coordinate, and one floating body at most, the first");
        }
        let [a, b, c] = link.body.inertia;
        if !(a + b >= c && b + c >= a && c + a >= b) {
            return Err("inertias that a body can have");
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
    joined.body(link.body.mass, link.body.inertia, centre.into()).oriented(q.map(|q| q / norm))
}

fn placed(&[x, y, z, ref q @ ..]: &BodyState) -> (Vector3<f64>, Quaternion<f64>) {
    (Vector3::new(x, y, z), Quaternion::from_array(*q))
}
