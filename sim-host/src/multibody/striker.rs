//! A free body that is thrown at another.

use crate::contact::{Switching, YieldingBox};

/// A free body whose points strike a box around another body.
#[derive(Clone, Debug, PartialEq)]
pub struct Striker {
    /// The free body's link: one that floats, and comes after the one that it strikes.
    pub link: usize,
    /// Its points, in its frame, m.
    pub points: Vec<[f64; 3]>,
    /// The body that it strikes.
    pub struck: usize,
    /// The box, in that body's frame.
    pub around: YieldingBox,
    /// When points enter and leave it.
    pub switching: Switching,
}

impl Striker {
    /// The corners of a box about the body's centre of mass, and the centres of its faces: these meet what a
    /// face is wider than.
    pub fn box_points(size: [f64; 3]) -> Vec<[f64; 3]> {
        let half = size.map(|edge| 0.5 * edge);
        let corner =
            |k: usize| std::array::from_fn(|i| if k >> i & 1 == 0 { -half[i] } else { half[i] });
        let face = |k: usize| {
            let mut center = [0.0; 3];
            center[k / 2] = if k.is_multiple_of(2) { -half[k / 2] } else { half[k / 2] };
            center
        };
        (0..8).map(corner).chain((0..6).map(face)).collect()
    }

    /// Whether all its numbers can be used.
    pub(super) fn is_valid(&self) -> bool {
        let YieldingBox { center, half_size, .. } = self.around;
        self.points.iter().flatten().chain(&center).all(|x| x.is_finite())
            && half_size.iter().all(|b| b.is_finite() && *b > 0.0)
    }
}
