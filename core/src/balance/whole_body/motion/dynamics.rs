//! (1), (2) and (3) of the module above.

use super::super::contact::Contact;
use super::super::leg_inverse::DIRECTIONS;
use super::super::observed::center_of_mass;
use super::super::robot::{MOST_LEG_JOINTS, WholeBody};
use crate::Real;
use crate::balance::ContactLimits;
use crate::balance::square::Square;
use crate::spatial::{Twist, Wrench};
use nalgebra::Vector3;

/// One number for each direction of a foot, sole axes: a wrench, or an acceleration.
pub(super) type Unknowns<T> = [T; DIRECTIONS];

/// A foot in this tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct MotionFoot<T> {
    pub contact: Contact<T>,
    /// What the ground can give it; `None` where it swings.
    pub limits: Option<ContactLimits<T, 0>>,
}

/// What follows from the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved<T, const FEET: usize> {
    /// `X`
    pub base: Twist<T>,
    /// `G_i w_i`; zero for those that swing.
    pub on_base: [Wrench<T>; FEET],
    /// `J_i⁺ d_i`, by the leg's joints; zero for those that press.
    pub legs: [[T; MOST_LEG_JOINTS]; FEET],
}

/// `B` and `P`, and what (1) to (3) read.
pub(super) struct MotionDynamics<'a, T, const FEET: usize, const NV: usize> {
    pub robot: &'a WholeBody<T, FEET, NV>,
    pub feet: &'a [Option<MotionFoot<T>>; FEET],
    masses: &'a [[T; NV]; NV],
    screws: &'a [Twist<T>; NV],
    bias: [T; NV],
    /// `B_k`, by velocity.
    rows: [Wrench<T>; NV],
    base: Square<T>,
}

/// The central body's entries of a joint's row.
#[inline(always)]
fn base_entries<T: Real, const NV: usize>(row: &[T; NV]) -> [T; 6] {
    row.first_chunk().copied().unwrap_or([T::zero(); 6])
}

#[inline(always)]
fn has(feet: u8, foot: usize) -> bool {
    feet & (1 << (foot & 7)) != 0
}

impl<'a, T: Real, const FEET: usize, const NV: usize> MotionDynamics<'a, T, FEET, NV> {
    /// `bias` is `h`. `None` where no acceleration of the central body follows from the unknowns.
    #[inline(always)]
    pub fn new(
        robot: &'a WholeBody<T, FEET, NV>,
        feet: &'a [Option<MotionFoot<T>>; FEET],
        masses: &'a [[T; NV]; NV],
        screws: &'a [Twist<T>; NV],
        bias: [T; NV],
    ) -> Option<Self> {
        let mut rows = [Wrench::zero(); NV];
        for (velocity, (row, masses)) in rows.iter_mut().zip(masses).enumerate() {
            let coupled = match robot.joints.get(velocity) {
                Some(Some(joint)) => joint.coupled,
                _ if velocity < 6 => u8::MAX,
                _ => continue,
            };
            *row = Wrench::from_array(base_entries(masses));
            for (number, foot) in feet.iter().enumerate() {
                let Some(foot) = foot.as_ref().filter(|_| has(coupled, number)) else { continue };
                let Contact { joints, per_base, count, .. } = &foot.contact;
                for (joint, per_base) in joints.iter().zip(per_base).take(*count) {
                    *row += *per_base * masses.get(*joint).copied().unwrap_or(T::zero());
                }
            }
        }
        let mut base = [[T::zero(); 6]; 6];
        for (to, row) in base.iter_mut().zip(&rows) {
            *to = row.to_array();
        }
        let most = base.iter().flatten().fold(T::zero(), |most, x| most.max(x.abs()));
        let base = Square::new(base, most * T::default_epsilon() * T::of(4.0))?;
        Some(Self { robot, feet, masses, screws, bias, rows, base })
    }

    /// Of all that hangs from the central body and weighs `mass` (kg), from frame 1's origin, m.
    pub fn center_of_mass(&self, mass: T) -> Vector3<T> {
        center_of_mass(self.masses, mass)
    }

    /// `X` where all unknowns are zero.
    #[inline(always)]
    pub fn free(&self) -> Twist<T> {
        let mut right = [T::zero(); 6];
        for (to, bias) in right.iter_mut().zip(&self.bias) {
            *to = -*bias;
        }
        Twist::from_array(self.base.solve(&right))
    }

    /// (3) of a joint where all unknowns are zero, from that X.
    #[inline(always)]
    pub fn free_torque(&self, velocity: usize, free: Twist<T>) -> T {
        match (self.rows.get(velocity), self.bias.get(velocity)) {
            (Some(row), Some(bias)) => free.power(*row) + *bias,
            _ => T::zero(),
        }
    }

    /// (2)
    #[inline(never)]
    pub fn moved(&self, x: &[Unknowns<T>; FEET]) -> Moved<T, FEET> {
        let mut right = [T::zero(); 6];
        for (to, bias) in right.iter_mut().zip(&self.bias) {
            *to = -*bias;
        }
        let mut legs = [[T::zero(); MOST_LEG_JOINTS]; FEET];
        let mut on_base = [Wrench::zero(); FEET];
        for (((foot, x), leg), on_base) in self.feet.iter().zip(x).zip(&mut legs).zip(&mut on_base)
        {
            let Some(foot) = foot else { continue };
            let contact = &foot.contact;
            if foot.limits.is_some() {
                *on_base = contact.on_base(x);
                for (to, w) in right.iter_mut().zip(on_base.to_array()) {
                    *to += w;
                }
            } else {
                *leg = contact.moving(x);
                for (joint, moved) in contact.joints.iter().zip(leg).take(contact.count) {
                    let masses = self.masses.get(*joint).map_or([T::zero(); 6], base_entries);
                    for (to, mass) in right.iter_mut().zip(masses) {
                        *to -= mass * *moved;
                    }
                }
            }
        }
        Moved { base: Twist::from_array(self.base.solve(&right)), on_base, legs }
    }

    /// `δ_i` of (1), by the leg's joints.
    #[inline(always)]
    pub fn legs(&self, moved: &Moved<T, FEET>) -> [[T; MOST_LEG_JOINTS]; FEET] {
        let mut legs = moved.legs;
        for (foot, leg) in self.feet.iter().zip(&mut legs) {
            let Some(foot) = foot else { continue };
            for (to, row) in leg.iter_mut().zip(&foot.contact.per_base).take(foot.contact.count) {
                *to += moved.base.power(*row);
            }
        }
        legs
    }

    /// (3), by velocity.
    #[inline(never)]
    pub fn torques(&self, moved: &Moved<T, FEET>) -> [T; NV] {
        let mut torques = self.bias;
        for (torque, row) in torques.iter_mut().zip(&self.rows).skip(6) {
            *torque += moved.base.power(*row);
        }
        let feet = self.feet.iter().zip(moved.on_base.iter().zip(&moved.legs));
        for (number, (foot, (on_base, leg))) in feet.enumerate() {
            let Some(foot) = foot else { continue };
            if foot.limits.is_some() {
                let joints = self.robot.joints.iter().zip(self.screws);
                for (torque, (joint, screw)) in torques.iter_mut().zip(joints).skip(6) {
                    if joint.is_some_and(|joint| has(joint.feet, number)) {
                        *torque -= screw.power(*on_base);
                    }
                }
            } else {
                let joints = self.robot.joints.iter().zip(self.masses);
                for (torque, (joint, masses)) in torques.iter_mut().zip(joints).skip(6) {
                    if joint.is_some_and(|joint| has(joint.coupled, number)) {
                        *torque += along_leg(masses, &foot.contact, leg);
                    }
                }
            }
        }
        torques
    }

    /// What `y · P X` is per unknown.
    #[inline(always)]
    pub fn per_unknown(&self, y: &Twist<T>) -> [Unknowns<T>; FEET] {
        self.gradient(y, None)
    }

    /// What (3) is per unknown.
    #[inline(always)]
    pub fn torque_per_unknown(&self, velocity: usize) -> Option<[Unknowns<T>; FEET]> {
        let y = self.for_base(&self.rows.get(velocity)?.to_array());
        Some(self.gradient(&y, Some(velocity)))
    }

    /// `y` with `Pᵀ y = b`.
    #[inline(always)]
    pub fn for_base(&self, b: &[T; 6]) -> Twist<T> {
        Twist::from_array(self.base.solve_transposed(b))
    }

    /// Of `y · P X`, and of what (3) has beside X for a joint.
    #[inline(never)]
    fn gradient(&self, y: &Twist<T>, direct: Option<usize>) -> [Unknowns<T>; FEET] {
        let joint = direct.and_then(|velocity| self.robot.joints.get(velocity)?.as_ref());
        let row = direct.and_then(|velocity| self.masses.get(velocity));
        let screw = direct.and_then(|velocity| self.screws.get(velocity));
        let mut all = [[T::zero(); DIRECTIONS]; FEET];
        for (number, (to, foot)) in all.iter_mut().zip(self.feet).enumerate() {
            let Some(foot) = foot else { continue };
            let contact = &foot.contact;
            if foot.limits.is_some() {
                let is_outboard = joint.is_some_and(|joint| has(joint.feet, number));
                let twist = match screw {
                    Some(screw) if is_outboard => *y - *screw,
                    _ => *y,
                };
                *to = contact.seen(&twist);
            } else {
                let own = row.filter(|_| joint.is_some_and(|joint| has(joint.coupled, number)));
                let mut forces = [T::zero(); MOST_LEG_JOINTS];
                for (to, joint) in forces.iter_mut().zip(contact.joints).take(contact.count) {
                    let masses = self.masses.get(joint).map_or([T::zero(); 6], base_entries);
                    let own = own.and_then(|row| row.get(joint)).copied().unwrap_or(T::zero());
                    *to = own - y.power(Wrench::from_array(masses));
                }
                *to = contact.gathered(&forces);
            }
        }
        all
    }
}

/// `M_ki J_i⁺ d_i`
#[inline(always)]
fn along_leg<T: Real, const NV: usize>(
    row: &[T; NV],
    contact: &Contact<T>,
    moved: &[T; MOST_LEG_JOINTS],
) -> T {
    let joints = contact.joints.iter().zip(moved).take(contact.count);
    joints.fold(T::zero(), |sum, (joint, moved)| {
        sum + row.get(*joint).copied().unwrap_or(T::zero()) * *moved
    })
}
