//! The numbers of this chapter.

use num_dual::DualNum;

/// A number, or one that carries its derivatives along. Whatever is written in it can be
/// differentiated, a step of a method included.
pub trait Scalar: DualNum<Primitive = f64, Real = f64> + Copy {}

impl<D: DualNum<Primitive = f64, Real = f64> + Copy> Scalar for D {}
