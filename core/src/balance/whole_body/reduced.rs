//! The dynamics with the pressing legs' joints eliminated.
//!
//! # Notation
//! `N`: joint accelerations per acceleration X of the central body, of the contacts' (1); `θ̈₁` those at
//! X = 0. `M` mass matrix, `h₁` inverse dynamics at `θ̈₁`; `G_i w_i` the ground's wrench on foot i, about
//! frame 1's origin; `s_k` as of the contacts.
//! ```text
//! B = M N,   P = B_base:      P X + z = Σ G_i w_i,   z = h₁,base                  (1)
//! τ_k = B_k · X + h₁,k − Σ_{feet i outboard of k} s_k · G_i w_i                   (2)
//! ```
//! With the exact feet of legs of six joints, (1) less what the ground gives for the legs' own weight and
//! inertia is `F = P₁ X + z₁` (4.3).

use super::contact::Contact;
use super::robot::WholeBody;
use crate::Real;
use crate::balance::square::Square;
use crate::spatial::{Twist, Wrench};

/// (1) and (2).
pub(super) struct Reduced<T, const NV: usize> {
    /// `B` by velocity.
    pub rows: [Wrench<T>; NV],
    /// `h₁`
    pub bias: [T; NV],
    /// `P`, factored.
    base: Square<T>,
    /// `s_k`, of joints that move a foot.
    pub screws: [Twist<T>; NV],
    /// By velocity: which feet are outboard of the joint.
    pub feet: [u8; NV],
}

impl<T: Real, const NV: usize> Reduced<T, NV> {
    /// `None` where no acceleration of the central body follows from the feet's wrenches.
    #[inline(always)]
    pub fn new<const FEET: usize>(
        robot: &WholeBody<T, FEET, NV>,
        contacts: &[Option<Contact<T>>; FEET],
        mass_matrix: &[[T; NV]; NV],
        bias: [T; NV],
        screws: [Twist<T>; NV],
    ) -> Option<Self> {
        let mut rows = [Wrench::zero(); NV];
        let is_moved =
            |velocity: usize| velocity < 6 || matches!(robot.joints.get(velocity), Some(Some(_)));
        for (velocity, (row, masses)) in rows.iter_mut().zip(mass_matrix).enumerate() {
            let [a, b, c, d, e, f] = masses.first_chunk().copied()?;
            if !is_moved(velocity) {
                continue;
            }
            *row = Wrench::from_array([a, b, c, d, e, f]);
            for contact in contacts.iter().flatten() {
                let joints = contact.joints.iter().zip(&contact.per_base);
                for (joint, per_base) in joints.take(contact.count) {
                    let mass = masses.get(*joint).copied().unwrap_or(T::zero());
                    // Joints of different limbs have none in common.
                    if mass != T::zero() {
                        *row += *per_base * mass;
                    }
                }
            }
        }
        let mut base = [[T::zero(); 6]; 6];
        for (to, row) in base.iter_mut().zip(&rows) {
            *to = row.to_array();
        }
        let most = base.iter().flatten().fold(T::zero(), |most, x| most.max(x.abs()));
        let base = Square::new(base, most * T::default_epsilon() * T::of(4.0))?;
        let mut feet = [0; NV];
        for (feet, joint) in feet.iter_mut().zip(&robot.joints) {
            *feet = joint.map_or(0, |joint| joint.feet);
        }
        Some(Self { rows, bias, base, screws, feet })
    }

    /// `P X + z` of (1).
    #[inline(always)]
    pub fn wrench(&self, x: Twist<T>) -> Wrench<T> {
        let mut wrench = [T::zero(); 6];
        for (to, (row, bias)) in wrench.iter_mut().zip(self.rows.iter().zip(&self.bias)) {
            *to = x.power(*row) + *bias;
        }
        Wrench::from_array(wrench)
    }

    /// `X` of (1) for the sum of the feet's wrenches.
    #[inline(always)]
    pub fn acceleration(&self, sum: Wrench<T>) -> Twist<T> {
        let mut right = sum.to_array();
        for (right, bias) in right.iter_mut().zip(&self.bias) {
            *right -= *bias;
        }
        Twist::from_array(self.base.solve(&right))
    }

    /// (2), for the wrenches `G_i w_i`.
    #[inline(always)]
    pub fn torque<const FEET: usize>(
        &self,
        velocity: usize,
        x: Twist<T>,
        on_base: &[Wrench<T>; FEET],
    ) -> T {
        let (Some(row), Some(bias)) = (self.rows.get(velocity), self.bias.get(velocity)) else {
            return T::zero();
        };
        let own = x.power(*row) + *bias;
        match (self.screws.get(velocity), self.feet.get(velocity)) {
            (Some(screw), Some(feet)) if *feet != 0 => {
                let mut sum = Wrench::zero();
                for (foot, w) in on_base.iter().enumerate() {
                    if feet & (1 << (foot & 7)) != 0 {
                        sum += *w;
                    }
                }
                own - screw.power(sum)
            }
            _ => own,
        }
    }

    /// What (2) is per `G_i w_i`: of those of feet outboard of the joint, and of others.
    #[inline(always)]
    pub fn torque_per_wrench(&self, velocity: usize) -> Option<[Twist<T>; 2]> {
        let by_base = self.base.solve_transposed(&self.rows.get(velocity)?.to_array());
        let other = Twist::from_array(by_base);
        Some([other - *self.screws.get(velocity)?, other])
    }
}
