//! Numbers of one limb, or of two at once.
//!
//! The two legs of a robot take the same steps with other numbers. Where the processor has registers
//! for two numbers, both go through the recursions together: what is written once over [`Lanes`] runs
//! for one limb with a scalar, and for a limb and its twin with a pair of scalars. Each lane sees
//! the operations of a scalar in the same order, and so gives the same bits.

use crate::Real;
use core::ops::{Add, Mul, Neg, Sub};

/// One scalar, or a pair.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Of one lane.
    type Scalar: Real;
    /// An `A` for each lane.
    type Each<A: Copy>: Copy;

    /// How many lanes there are.
    const COUNT: usize;

    /// The same in every lane.
    fn splat(x: Self::Scalar) -> Self;
    /// For the first lane and the second, where there are two.
    fn two<A: Copy>(first: A, second: A) -> Self::Each<A>;
    /// What `f` makes of each lane's `A`.
    fn gather<A: Copy>(from: Self::Each<A>, f: impl Fn(A) -> Self::Scalar) -> Self;
    /// Lane `i`; the last beyond it.
    fn lane(self, i: usize) -> Self::Scalar;
    /// `1 / x`
    fn reciprocal(self) -> Self;
    /// Where each lane's `f` gives something: all, or nothing.
    fn each<A: Copy, B: Copy>(
        from: Self::Each<A>,
        f: impl Fn(A) -> Option<B>,
    ) -> Option<Self::Each<B>>;
    /// What is known to be the same in every lane.
    fn first<A: Copy>(each: Self::Each<A>) -> A;
    /// That of the last lane.
    fn last<A: Copy>(each: Self::Each<A>) -> A;
}

impl<T: Real> Lanes for T {
    type Scalar = T;
    type Each<A: Copy> = A;
    const COUNT: usize = 1;
    #[inline(always)]
    fn two<A: Copy>(first: A, _: A) -> A {
        first
    }
    #[inline(always)]
    fn splat(x: T) -> T {
        x
    }
    #[inline(always)]
    fn gather<A: Copy>(from: A, f: impl Fn(A) -> T) -> T {
        f(from)
    }
    #[inline(always)]
    fn lane(self, _: usize) -> T {
        self
    }
    #[inline(always)]
    fn reciprocal(self) -> T {
        T::one() / self
    }
    #[inline(always)]
    fn each<A: Copy, B: Copy>(from: A, f: impl Fn(A) -> Option<B>) -> Option<B> {
        f(from)
    }
    #[inline(always)]
    fn first<A: Copy>(each: A) -> A {
        each
    }
    #[inline(always)]
    fn last<A: Copy>(each: A) -> A {
        each
    }
}

/// Three components.
pub(super) type V<L> = [L; 3];

#[inline(always)]
pub(super) fn cross<L: Lanes>(a: &V<L>, b: &V<L>) -> V<L> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub(super) fn dot<L: Lanes>(a: &V<L>, b: &V<L>) -> L {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn plus<L: Lanes>(a: &V<L>, b: &V<L>) -> V<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn times<L: Lanes>(a: &V<L>, factor: L) -> V<L> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// `R v` of a turn about axis `I` with cosine and sine `(c, s)`.
#[inline(always)]
pub(super) fn turned<L: Lanes, const I: usize>((c, s): (L, L), v: &V<L>) -> V<L> {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let mut w = *v;
    w[j] = c * v[j] - s * v[k];
    w[k] = s * v[j] + c * v[k];
    w
}

/// Three components of each lane's `A`.
#[inline(always)]
pub(super) fn vector<L: Lanes, A: Copy>(
    from: L::Each<A>,
    f: impl Fn(A) -> nalgebra::Vector3<L::Scalar>,
) -> V<L> {
    [L::gather(from, |a| f(a).x), L::gather(from, |a| f(a).y), L::gather(from, |a| f(a).z)]
}

/// Calls `$pass` for the limb that begins with joint `$k`, and for its twin in the same breath or, where
/// no register holds two numbers, before it.
macro_rules! along_limb {
    ($scalar:ty, $k:expr, $node:expr, $pass:ident($($argument:expr),*)) => {{
        let (k, twin, count) = ($k, $node.twin, $node.limb);
        if twin == 0 {
            $pass::<$scalar, _, _, _>($($argument,)* k, count)
        } else if <$scalar as Real>::Pair::COUNT == 2 {
            let both = <$scalar as Real>::Pair::two(k, twin);
            $pass::<<$scalar as Real>::Pair, _, _, _>($($argument,)* both, count)
        } else {
            $pass::<$scalar, _, _, _>($($argument,)* twin, count)
                .and_then(|()| $pass::<$scalar, _, _, _>($($argument,)* k, count))
        }
    }};
}
pub(super) use along_limb;

/// Does `$body` with each lane's number and what `$each` has for it, the last lane first. No function, so
/// that each lane's number is a constant where its numbers are taken out of registers.
macro_rules! for_each_lane {
    ($lanes:ident, $each:expr, |$i:ident, $k:ident| $body:block) => {{
        let each = $each;
        if $lanes::COUNT == 2 {
            let ($i, $k) = (1, $lanes::last(each));
            $body
        }
        let ($i, $k) = (0, $lanes::first(each));
        $body
    }};
}
pub(super) use for_each_lane;
