//! The program of the foot wrenches, as the solver takes it.

use super::super::least_norm::LeastNorm;
use super::metric::Metric;
use super::rows::{first_row, split_row};
use super::{ContactFoot, ContactLimit, ContactWeights};
use crate::Real;
use crate::qp::{Program, ProgramCost, Search, Work};
use crate::spatial::{SymmetricMatrix3, Wrench};
use nalgebra::{Matrix3, Vector3};

/// Edges and points alone may leave a moment that no foot can make, and S singular. A moment that no
/// foot makes is then an unknown too, so dear that it is used for nothing else: it counts as a force at
/// 1 mm, `ρ = (1 mm)²`, m².
const MOMENT_HELP: f64 = 1e-6;

/// Feet in contact, the wrench that they shall make, and its least-norm split.
#[derive(Clone, Copy, Debug)]
pub struct ContactProgram<'a, T, const FEET: usize, const JOINTS: usize> {
    feet: &'a [Option<ContactFoot<'a, T, JOINTS>>; FEET],
    weights: &'a ContactWeights<T>,
    world: &'a Matrix3<T>,
    split: LeastNorm<T, FEET>,
    least_norm: [Wrench<T>; FEET],
    norm_squared: T,
}

impl<'a, T: Real, const FEET: usize, const JOINTS: usize> ContactProgram<'a, T, FEET, JOINTS> {
    /// For the wrench `desired` on the central body, in its frame; `world`: world axes from frame 1.
    /// `None` where no foot is in contact, or where feet are so far away that numbers overflow.
    #[inline(always)]
    pub fn new(
        feet: &'a [Option<ContactFoot<'a, T, JOINTS>>; FEET],
        weights: &'a ContactWeights<T>,
        world: &'a Matrix3<T>,
        desired: Wrench<T>,
    ) -> Option<Self> {
        if feet.iter().all(Option::is_none) {
            return None;
        }
        let norm_squared = weights.norm_length * weights.norm_length;
        // First term of S: what moments the feet have.
        let mut soles = T::zero();
        let mut moments = SymmetricMatrix3::zero();
        let mut remaining = desired;
        for foot in feet.iter().flatten() {
            if foot.limits.patch.is_sole() {
                soles += T::one();
            } else {
                let r = &foot.rotation;
                let axes = [
                    Vector3::new(r.m11, r.m21, r.m31),
                    Vector3::new(r.m12, r.m22, r.m32),
                    Vector3::new(r.m13, r.m23, r.m33),
                ];
                for (axis, free) in axes.into_iter().zip(foot.limits.patch.moments()) {
                    if free {
                        moments = moments + SymmetricMatrix3::outer(axis);
                    }
                }
                remaining.torque -= foot.fixed_moment();
            }
        }
        moments = if soles > T::zero() {
            SymmetricMatrix3::scalar(soles * norm_squared) + moments.scaled(norm_squared)
        } else {
            SymmetricMatrix3::scalar(T::of(MOMENT_HELP)) + moments.scaled(norm_squared)
        };
        let positions = feet.each_ref().map(|foot| foot.as_ref().map(|foot| foot.position));
        let split = LeastNorm::new(positions, moments)?;
        let (y, forces) = split.forces(remaining);
        let mut least_norm = [Wrench::zero(); FEET];
        for ((wrench, force), foot) in least_norm.iter_mut().zip(forces).zip(feet) {
            if let (Some(force), Some(foot)) = (force, foot) {
                let torque = foot.free_moment(y) * norm_squared;
                *wrench = Wrench { force, torque };
                if !foot.limits.patch.is_sole() {
                    wrench.torque += foot.fixed_moment();
                }
            }
        }
        Some(Self { feet, weights, world, split, least_norm, norm_squared })
    }

    /// `w₀`.
    #[inline(always)]
    pub fn least_norm(&self) -> [Wrench<T>; FEET] {
        self.least_norm
    }

    /// The same around other wrenches that make the desired one: where no limit binds, they are the
    /// answer, and where one does, the distance is taken from them.
    #[inline(always)]
    pub fn around(self, wrenches: [Wrench<T>; FEET]) -> Self {
        Self { least_norm: wrenches, ..self }
    }

    /// The wrench on the central body that these foot wrenches make, in its frame.
    pub fn achieved(&self, wrenches: &[Wrench<T>; FEET]) -> Wrench<T> {
        let feet = self.feet.iter().zip(wrenches);
        feet.fold(Wrench::zero(), |sum, (foot, w)| match foot {
            Some(foot) => sum + w.shifted(foot.position),
            None => sum,
        })
    }

    /// Foot and limit of a row.
    pub fn limit_of(&self, row: u8) -> (usize, ContactLimit) {
        let (foot, row) = split_row(row);
        (foot, ContactLimit::of_row(row, JOINTS as u8))
    }

    /// A foot in contact.
    #[inline(always)]
    pub(super) fn foot(&self, foot: usize) -> Option<&ContactFoot<'a, T, JOINTS>> {
        self.feet.get(foot)?.as_ref()
    }
}

/// A row's normal: on one foot.
#[derive(Clone, Copy, Debug)]
pub struct OnFoot<T> {
    foot: usize,
    wrench: Wrench<T>,
}

#[inline(always)]
fn dot<T: Real>(a: &Wrench<T>, b: &Wrench<T>) -> T {
    a.force.dot(&b.force) + a.torque.dot(&b.torque)
}

impl<T: Real, const FEET: usize, const JOINTS: usize> Program<T>
    for ContactProgram<'_, T, FEET, JOINTS>
{
    type Point = [Wrench<T>; FEET];
    type Normal = OnFoot<T>;
    type Factor = Metric<T>;

    const COST: ProgramCost = {
        assert!(FEET >= 1 && FEET <= 8, "a row's number is one byte");
        assert!(JOINTS <= 7, "a foot has 32 row numbers, of which 18 are the contact's");
        let (feet, joints) = (FEET as Work, JOINTS as Work);
        ProgramCost {
            factor: 170,
            response: 66 + 21 * feet,
            row: 18,
            product: 6,
            scan: feet * (46 + 6 * joints),
        }
    };

    #[inline(always)]
    fn minimum(&self) -> [Wrench<T>; FEET] {
        self.least_norm
    }

    #[inline(always)]
    fn zero(&self) -> [Wrench<T>; FEET] {
        [Wrench::zero(); FEET]
    }

    #[inline(always)]
    fn moved(&self, x: &[Wrench<T>; FEET], by: &[Wrench<T>; FEET]) -> [Wrench<T>; FEET] {
        let mut sum = *x;
        for (x, by) in sum.iter_mut().zip(by) {
            *x += *by;
        }
        sum
    }

    #[inline(always)]
    fn is_finite(&self, x: &[Wrench<T>; FEET]) -> bool {
        x.iter().all(|wrench| wrench.is_finite())
    }

    #[inline(always)]
    fn factor(&self) -> Option<Metric<T>> {
        Metric::new(self.weights, self.world, &self.split)
    }

    #[inline(always)]
    fn response(&self, factor: &Metric<T>, gradient: &[Wrench<T>; FEET]) -> [Wrench<T>; FEET] {
        factor.response(self.feet, &self.split, self.norm_squared, gradient)
    }

    #[inline(always)]
    fn row_response(&self, factor: &Metric<T>, normal: &OnFoot<T>) -> [Wrench<T>; FEET] {
        let OnFoot { foot, wrench } = normal;
        factor.row_response(self.feet, &self.split, self.norm_squared, (*foot, wrench))
    }

    #[inline(always)]
    fn row(&self, row: u8) -> Option<(OnFoot<T>, T)> {
        let (foot, row) = split_row(row);
        let (wrench, bound) = self.feet.get(foot)?.as_ref()?.row(row)?;
        Some((OnFoot { foot, wrench }, bound))
    }

    #[inline(always)]
    fn product(&self, normal: &OnFoot<T>, x: &[Wrench<T>; FEET]) -> T {
        x.get(normal.foot).map_or(T::zero(), |x| dot(&normal.wrench, x))
    }

    #[inline(always)]
    fn accumulate(&self, gradient: &mut [Wrench<T>; FEET], normal: &OnFoot<T>, multiplier: T) {
        if let Some(gradient) = gradient.get_mut(normal.foot) {
            *gradient += normal.wrench * multiplier;
        }
    }

    #[inline(always)]
    fn scan(&self, x: &[Wrench<T>; FEET], search: &mut Search<'_, T>) {
        for (number, (foot, w)) in self.feet.iter().zip(x).enumerate() {
            if let Some(foot) = foot {
                foot.scan(w, first_row(number), search);
            }
        }
    }
}
