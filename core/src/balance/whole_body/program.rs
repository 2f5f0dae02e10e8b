//! The ground's wrenches on the feet as a quadratic program, with the torques of all joints.
//!
//! The objective and the contacts' rows are those of [`ContactProgram`], whose feet have no joints here
//! and carry nothing: its unknowns are then what the ground gives. Torques are rows over all feet, as
//! those of arms and waist depend on the acceleration that the feet make:
//! ```text
//! τ_k = τ_k(0) + Σ_i t_ki · w_i,    t_ki = y_k − s_k (foot i outboard of k) or y_k,   Pᵀ y_k = B_k
//! ```
//! | row | limit |
//! |---|---|
//! | 0 … 127 | of feet, 32 numbers each: 18 of the contact, and two for the range of each of the leg's joints |
//! | 128 + 2k, 129 + 2k | `limit − τ_k`, `limit + τ_k` of the joint with velocity 6 + k |

use super::reduced::Reduced;
use super::robot::{BodyJoint, WHOLE_BODY_FEET, WholeBody};
use crate::Real;
use crate::balance::contact_wrenches::{CONTACT_ROWS, split_row};
use crate::balance::{ContactLimit, ContactProgram, Reason};
use crate::qp::{ActiveRows, Program, ProgramCost, Search, Work};
use crate::spatial::{Twist, Wrench};
use nalgebra::Vector3;

/// Number of the first row of a torque.
pub(super) const TORQUES: u8 = 128;
/// Velocities of the central body.
const BASE: usize = 6;

/// A limit of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WholeBodyLimit {
    /// Of a foot's contact.
    Foot {
        /// Number of the foot.
        foot: usize,
        /// Which; never a torque.
        limit: ContactLimit,
    },
    /// The torque (or force) of a joint.
    Torque {
        /// Index of its velocity.
        velocity: usize,
    },
    /// The range of a leg's joint: how fast it may still turn towards the end.
    Range {
        /// Index of its velocity.
        velocity: usize,
    },
}

/// The program of one tick.
pub(super) struct WholeBodyProgram<'a, T, const FEET: usize, const NV: usize> {
    pub contacts: ContactProgram<'a, T, FEET, 0>,
    pub positions: &'a [Vector3<T>; FEET],
    pub reduced: &'a Reduced<T, NV>,
    pub robot: &'a WholeBody<T, FEET, NV>,
    /// Greatest torques.
    pub torques: &'a [T; NV],
}

/// A row's normal.
#[derive(Clone, Copy, Debug)]
pub(super) enum Normal<N, T, const FEET: usize> {
    /// On one foot.
    OnFoot(N),
    /// On all of them, each about its reference point.
    OnAll([Twist<T>; FEET]),
}

/// What the contacts' program calls its own.
type Contacts<'a, T, const FEET: usize> = ContactProgram<'a, T, FEET, 0>;

impl<T: Real, const FEET: usize, const NV: usize> WholeBodyProgram<'_, T, FEET, NV> {
    /// `G_i w_i`.
    #[inline(always)]
    pub fn on_base(&self, x: &[Wrench<T>; FEET]) -> [Wrench<T>; FEET] {
        let mut all = [Wrench::zero(); FEET];
        for (to, (w, p)) in all.iter_mut().zip(x.iter().zip(self.positions)) {
            *to = w.shifted(*p);
        }
        all
    }

    /// X of the central body under wrenches about frame 1's origin.
    #[inline(always)]
    pub fn acceleration(&self, on_base: &[Wrench<T>; FEET]) -> Twist<T> {
        self.reduced.acceleration(on_base.iter().fold(Wrench::zero(), |sum, w| sum + *w))
    }

    /// The limit that costs most, with its relief: by how much the objective falls per 100 % by which it
    /// is widened.
    pub fn worst<const K: usize>(
        &self,
        x: &[Wrench<T>; FEET],
        active: &ActiveRows<T, K>,
    ) -> Option<(WholeBodyLimit, T)> {
        worst(self.contacts.reason(x, active), self.torques, active)
    }
}

/// Which limit a row is; `joint` is the velocity of a leg's joint by foot and number, foot to hip.
pub(super) fn limit_of(row: u8, joint: impl Fn(usize, usize) -> usize) -> WholeBodyLimit {
    match row.checked_sub(TORQUES) {
        Some(pair) => WholeBodyLimit::Torque { velocity: BASE + usize::from(pair / 2) },
        None => {
            let (foot, own) = split_row(row);
            match range_row::<f32>(own) {
                Some((number, _)) => WholeBodyLimit::Range { velocity: joint(foot, number) },
                None => WholeBodyLimit::Foot { foot, limit: ContactLimit::of_row(own, 0) },
            }
        }
    }
}

/// Number of a leg's joint (foot to hip) and sign of a foot's row that is of a range: an acceleration at most so much,
/// or at least.
#[inline(always)]
pub(super) fn range_row<T: Real>(own: u8) -> Option<(usize, T)> {
    let pair = own.checked_sub(CONTACT_ROWS)?;
    let sign = if pair % 2 == 0 { -T::one() } else { T::one() };
    Some((usize::from(pair / 2), sign))
}

/// The limit that costs most, with its relief: of the feet's and those of torques.
pub(super) fn worst<T: Real, const NV: usize, const K: usize>(
    of_feet: Option<Reason<T>>,
    torques: &[T; NV],
    active: &ActiveRows<T, K>,
) -> Option<(WholeBodyLimit, T)> {
    let of_feet = of_feet.map(|reason| {
        let limit = WholeBodyLimit::Foot { foot: reason.foot, limit: reason.limit };
        (limit, reason.relief)
    });
    active.iter().fold(of_feet, |most, (row, multiplier)| {
        let Some((velocity, _)) = torque_row::<T>(row) else { return most };
        let limit = torques.get(velocity).copied().unwrap_or(T::zero());
        let relief = multiplier * limit;
        match most {
            Some((_, greatest)) if greatest >= relief => most,
            _ => Some((WholeBodyLimit::Torque { velocity }, relief)),
        }
    })
}

/// Joint (by velocity) and sign of a torque's row: `limit − τ ≥ 0`, or `limit + τ ≥ 0`.
#[inline(always)]
pub(super) fn torque_row<T: Real>(row: u8) -> Option<(usize, T)> {
    let pair = row.checked_sub(TORQUES)?;
    let sign = if pair % 2 == 0 { -T::one() } else { T::one() };
    Some((BASE + usize::from(pair / 2), sign))
}

/// Joints by velocity, with their limit and the number of the first of their two rows.
#[inline(always)]
pub(super) fn joints<'a, T: Real, const FEET: usize, const NV: usize>(
    robot: &'a WholeBody<T, FEET, NV>,
    torques: &'a [T; NV],
) -> impl Iterator<Item = (usize, &'a BodyJoint, T, u8)> {
    let all = robot.joints.iter().zip(torques).enumerate().skip(BASE);
    all.zip((TORQUES..=u8::MAX).step_by(2)).filter_map(|((velocity, (joint, limit)), row)| {
        Some((velocity, joint.as_ref()?, *limit, row))
    })
}

impl<'a, T: Real, const FEET: usize, const NV: usize> Program<T>
    for WholeBodyProgram<'a, T, FEET, NV>
{
    type Point = [Wrench<T>; FEET];
    type Normal = Normal<<Contacts<'a, T, FEET> as Program<T>>::Normal, T, FEET>;
    type Factor = <Contacts<'a, T, FEET> as Program<T>>::Factor;

    const COST: ProgramCost = {
        // As if all places had feet: a robot's work does not depend on how many it is given room for.
        let contacts = <Contacts<'a, T, WHOLE_BODY_FEET> as Program<T>>::COST;
        let (feet, joints) = (WHOLE_BODY_FEET as Work, NV.saturating_sub(BASE) as Work);
        ProgramCost {
            factor: contacts.factor,
            response: contacts.response,
            row: 60 + 18 * feet,
            product: 6 * feet,
            scan: contacts.scan + 6 * feet + 36 + 12 * joints,
        }
    };

    #[inline(always)]
    fn minimum(&self) -> [Wrench<T>; FEET] {
        self.contacts.minimum()
    }

    #[inline(always)]
    fn zero(&self) -> [Wrench<T>; FEET] {
        self.contacts.zero()
    }

    #[inline(always)]
    fn moved(&self, x: &[Wrench<T>; FEET], by: &[Wrench<T>; FEET]) -> [Wrench<T>; FEET] {
        self.contacts.moved(x, by)
    }

    #[inline(always)]
    fn is_finite(&self, x: &[Wrench<T>; FEET]) -> bool {
        self.contacts.is_finite(x)
    }

    #[inline(always)]
    fn factor(&self) -> Option<Self::Factor> {
        self.contacts.factor()
    }

    #[inline(always)]
    fn response(&self, factor: &Self::Factor, gradient: &[Wrench<T>; FEET]) -> [Wrench<T>; FEET] {
        self.contacts.response(factor, gradient)
    }

    #[inline(always)]
    fn row(&self, row: u8) -> Option<(Self::Normal, T)> {
        let Some((velocity, sign)) = torque_row(row) else {
            let (normal, bound) = self.contacts.row(row)?;
            return Some((Normal::OnFoot(normal), bound));
        };
        let joint = self.robot.joints.get(velocity)?.as_ref()?;
        let limit = *self.torques.get(velocity)?;
        let nothing = [Wrench::zero(); FEET];
        let free = self.reduced.torque(velocity, self.acceleration(&nothing), &nothing);
        let [outboard, other] = self.reduced.torque_per_wrench(velocity)?;
        let mut normal = [Twist::zero(); FEET];
        for (foot, (normal, p)) in normal.iter_mut().zip(self.positions).enumerate() {
            let twist = if joint.feet & (1 << (foot & 7)) != 0 { outboard } else { other };
            let linear = twist.linear + twist.angular.cross(p);
            *normal = Twist { linear, angular: twist.angular } * sign;
        }
        Some((Normal::OnAll(normal), -limit - free * sign))
    }

    #[inline(always)]
    fn product(&self, normal: &Self::Normal, x: &[Wrench<T>; FEET]) -> T {
        match normal {
            Normal::OnFoot(normal) => self.contacts.product(normal, x),
            Normal::OnAll(all) => {
                all.iter().zip(x).fold(T::zero(), |sum, (twist, w)| sum + twist.power(*w))
            }
        }
    }

    #[inline(always)]
    fn accumulate(&self, gradient: &mut [Wrench<T>; FEET], normal: &Self::Normal, multiplier: T) {
        match normal {
            Normal::OnFoot(normal) => self.contacts.accumulate(gradient, normal, multiplier),
            Normal::OnAll(all) => {
                for (gradient, twist) in gradient.iter_mut().zip(all) {
                    *gradient += Wrench { force: twist.linear, torque: twist.angular } * multiplier;
                }
            }
        }
    }

    #[inline(always)]
    fn scan(&self, x: &[Wrench<T>; FEET], search: &mut Search<'_, T>) {
        self.contacts.scan(x, search);
        let on_base = self.on_base(x);
        let acceleration = self.acceleration(&on_base);
        for (velocity, _, limit, row) in joints(self.robot, self.torques) {
            let torque = self.reduced.torque(velocity, acceleration, &on_base);
            search.offer_pair(limit, torque, [row, row.wrapping_add(1)]);
        }
    }
}
