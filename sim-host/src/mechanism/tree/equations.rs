//! Bodies and joints as a tree of `core`, for methods on the differential equations of joint coordinates.
//!
//! A tree's sizes are known when it is compiled. Here are those of serial and branching trees up to
//! [`MOST_LINKS`] bodies, all on joints of one coordinate, the first perhaps afloat.

use crate::multibody::{BodyState, JointLaw, states_of_tree};
use surefoot::dynamics::{DynamicsFault, forward_dynamics, joint_poses, position_rates};
use surefoot::model::{Link, Tree};

/// Bodies at most.
pub(super) const MOST_LINKS: usize = 13;

/// The differential equations of a tree, from its start on: angles are counted from there.
pub(super) trait TreeModel: Send + Sync {
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
pub(super) struct Rates<'a> {
    /// Of positions.
    pub positions: &'a mut [f64],
    /// Of velocities.
    pub velocities: &'a mut [f64],
}

/// A spring and damper of a joint, by velocity.
#[derive(Clone, Copy)]
pub(super) struct Law {
    pub column: usize,
    /// The joint's angle at the start.
    pub from: f64,
    pub law: JointLaw,
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

/// What a tree's equations are made of.
pub(super) struct Parts {
    pub links: Vec<Link>,
    pub gravity: f64,
    pub positions: Vec<f64>,
    pub velocities: Vec<f64>,
    pub torques: Vec<f64>,
    pub laws: Vec<Law>,
}

impl Parts {
    /// The equations, of their size; none for a size that is not compiled.
    pub fn sized(self, is_afloat: bool) -> Option<Box<dyn TreeModel>> {
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
        let tree = Tree::try_new(<[Link; N]>::try_from(self.links).ok()?).ok()?;
        Some(Box::new(Sized::<N, NQ, NV> {
            tree: tree.with_gravity([0.0, 0.0, -self.gravity]),
            positions: self.positions.try_into().ok()?,
            velocities: self.velocities.try_into().ok()?,
            torques: self.torques.try_into().ok()?,
            laws: self.laws,
        }))
    }
}
