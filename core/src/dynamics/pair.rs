//! Two scalars in one register, of processors that have registers for two.

use super::lanes::Lanes;
use core::ops::{Add, Mul, Neg, Sub};

/// Two scalars of one register.
#[derive(Clone, Copy)]
pub struct Pair<W>(W);

/// `Pair` of `$scalar`, in the first two of the numbers of `$wide`.
macro_rules! pair {
    ($scalar:ty, $wide:ty, $zeros:expr) => {
        impl Add for Pair<$wide> {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self(self.0 + other.0)
            }
        }
        impl Sub for Pair<$wide> {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self(self.0 - other.0)
            }
        }
        impl Mul for Pair<$wide> {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                Self(self.0 * other.0)
            }
        }
        impl Neg for Pair<$wide> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }
        impl Lanes for Pair<$wide> {
            type Scalar = $scalar;
            type Each<A: Copy> = [A; 2];
            const COUNT: usize = 2;
            #[inline(always)]
            fn two<A: Copy>(first: A, second: A) -> [A; 2] {
                [first, second]
            }
            #[inline(always)]
            fn splat(x: $scalar) -> Self {
                Self(<$wide>::splat(x))
            }
            #[inline(always)]
            fn gather<A: Copy>([a, b]: [A; 2], f: impl Fn(A) -> $scalar) -> Self {
                let mut all = $zeros;
                all[0] = f(a);
                all[1] = f(b);
                Self(<$wide>::new(all))
            }
            #[inline(always)]
            fn lane(self, i: usize) -> $scalar {
                let [a, b, ..] = self.0.to_array();
                if i == 0 { a } else { b }
            }
            #[inline(always)]
            fn reciprocal(self) -> Self {
                Self(<$wide>::splat(1.0) / self.0)
            }
            #[inline(always)]
            fn each<A: Copy, B: Copy>(
                [a, b]: [A; 2],
                f: impl Fn(A) -> Option<B>,
            ) -> Option<[B; 2]> {
                Some([f(a)?, f(b)?])
            }
            #[inline(always)]
            fn first<A: Copy>([a, _]: [A; 2]) -> A {
                a
            }
            #[inline(always)]
            fn last<A: Copy>([_, b]: [A; 2]) -> A {
                b
            }
        }
    };
}
pair!(f64, wide::f64x2, [0.0; 2]);
pair!(f32, wide::f32x4, [0.0; 4]);
