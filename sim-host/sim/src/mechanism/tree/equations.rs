//! Bodies and joints as a tree of `core`, for methods on the differential equations of joint coordinates.
//!
//! A tree's sizes are known when it is compiled, and each takes seconds to compile. Here are those of the
//! scenes as shipped and a few between, up to [`MOST_LINKS`] bodies, all on joints of one coordinate, the
//! first perhaps afloat. Another tree takes the next larger size: the rest of it are bodies that slide on
//! the world, at rest, and share no number with the tree's own.

use surefoot::dynamics::{DynamicsFault, forward_dynamics, joint_poses, position_rates};
use surefoot::model::{Link, Tree};
use surefoot_multibody::{BodyState, JointLaw, states_of_tree};

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

    /// Where the joint of a link with a law is, rad or m.
    fn angle(&self, link: usize, positions: &[f64]) -> f64;

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

/// A spring and damper of a joint.
#[derive(Clone, Copy)]
pub(super) struct Law {
    pub link: usize,
    /// Its velocity.
    pub column: usize,
    /// The joint's angle at the start.
    pub from: f64,
    pub law: JointLaw,
}

struct Sized<const N: usize, const NQ: usize, const NV: usize> {
    tree: Tree<f64, N, NQ, NV>,
    /// Bodies that are the tree's own.
    bodies: usize,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    torques: [f64; NV],
    laws: Vec<Law>,
}

/// Its own coordinates, and those of the bodies that fill the tree.
fn filled<const M: usize>(own: &[f64]) -> [f64; M] {
    std::array::from_fn(|i| own.get(i).copied().unwrap_or_default())
}

impl<const N: usize, const NQ: usize, const NV: usize> Sized<N, NQ, NV> {
    fn is_afloat(&self) -> bool {
        NQ > NV
    }

    fn angle(law: &Law, positions: &[f64]) -> f64 {
        positions[law.column + NQ - NV] + law.from
    }
}

impl<const N: usize, const NQ: usize, const NV: usize> TreeModel for Sized<N, NQ, NV> {
    fn start(&self) -> (Vec<f64>, Vec<f64>) {
        (self.positions.clone(), self.velocities.clone())
    }

    fn rates(
        &self,
        positions: &[f64],
        velocities: &[f64],
        rates: Rates<'_>,
    ) -> Result<(), DynamicsFault> {
        let (q, v) = (filled::<NQ>(positions), filled::<NV>(velocities));
        let mut torques = self.torques;
        for held in &self.laws {
            let Law { column, law, .. } = held;
            let angle = Self::angle(held, positions);
            let rate = v[*column];
            let rubbed = law.rubbed(rate).0;
            torques[*column] -= law.stiffness * (angle - law.rest) + law.damping * rate + rubbed;
        }
        let poses = joint_poses(&self.tree, &q)?;
        let a = forward_dynamics(&self.tree, &poses, &v, &torques, None)?;
        for (to, from) in
            [(rates.positions, &position_rates(&self.tree, &q, &v)[..]), (rates.velocities, &a[..])]
        {
            to.copy_from_slice(&from[..to.len()]);
        }
        Ok(())
    }

    fn position_rates(&self, positions: &[f64], velocities: &[f64]) -> Vec<f64> {
        let (q, v) = (filled::<NQ>(positions), filled::<NV>(velocities));
        position_rates(&self.tree, &q, &v)[..positions.len()].to_vec()
    }

    fn bodies(
        &self,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<(Vec<BodyState>, Vec<BodyState>), DynamicsFault> {
        let (q, v) = (filled::<NQ>(positions), filled::<NV>(velocities));
        let (mut states, mut rates) = states_of_tree(&self.tree, &q, &v)?;
        states.truncate(self.bodies);
        rates.truncate(self.bodies);
        Ok((states, rates))
    }

    fn angle(&self, link: usize, positions: &[f64]) -> f64 {
        let law = self.laws.iter().find(|law| law.link == link);
        law.map_or(0.0, |law| Self::angle(law, positions))
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
    /// The equations, of the least size that holds them; none for a tree that is larger than all.
    pub fn sized(self, is_afloat: bool) -> Option<Box<dyn TreeModel>> {
        macro_rules! smallest {
            ($(($n:literal, $nq:literal, $nv:literal, $afloat:literal)),* $(,)?) => {
                match (self.links.len(), is_afloat) {
                    $((..=$n, $afloat) => self.of_size::<$n, $nq, $nv>(),)*
                    _ => None,
                }
            };
        }
        smallest!(
            (1, 1, 1, false),
            (2, 2, 2, false),
            (3, 3, 3, false),
            (5, 5, 5, false),
            (10, 10, 10, false),
            (13, 13, 13, false),
            (1, 7, 6, true),
            (4, 10, 9, true),
            (13, 19, 18, true),
        )
    }

    fn of_size<const N: usize, const NQ: usize, const NV: usize>(
        self,
    ) -> Option<Box<dyn TreeModel>> {
        let fill = Link::prismatic(0, [1.0, 0.0, 0.0]).body(1.0, [1.0; 3], [0.0; 3]);
        let links = std::array::from_fn(|k| self.links.get(k).copied().unwrap_or(fill));
        let tree = Tree::try_new(links).ok()?;
        Some(Box::new(Sized::<N, NQ, NV> {
            tree: tree.with_gravity([0.0, 0.0, -self.gravity]),
            bodies: self.links.len(),
            positions: self.positions,
            velocities: self.velocities,
            torques: filled(&self.torques),
            laws: self.laws,
        }))
    }
}
