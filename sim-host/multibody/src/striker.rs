//! A free body that is thrown at another.

use crate::contact::{Switching, YieldingBox};

/// A free body whose points strike a box around another body.
#[derive(Clone, Debug, PartialEq)]
pub struct Striker {
    /// The free body's link: one that floats, and comes after all that do not strike.
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

/// Corners of a box.
pub const CORNERS: usize = 8;
/// Corners of a box and centres of its faces.
pub const BOX_POINTS: usize = CORNERS + 6;

impl Striker {
    /// The corners of a box about the body's centre of mass, and then the centres of its faces, which meet
    /// what is narrower than a face.
    pub fn box_points(size: [f64; 3]) -> [[f64; 3]; BOX_POINTS] {
        let half = size.map(|edge| 0.5 * edge);
        std::array::from_fn(|k| match k.checked_sub(CORNERS) {
            None => std::array::from_fn(|i| if k >> i & 1 == 0 { -half[i] } else { half[i] }),
            Some(face) => {
                let (axis, side) = (face / 2, face % 2);
                let mut center = [0.0; 3];
                center[axis] = if side == 0 { -half[axis] } else { half[axis] };
                center
            }
        })
    }

    /// Whether all its numbers can be used.
    pub(super) fn is_valid(&self) -> bool {
        let YieldingBox { center, half_size, .. } = self.around;
        self.points.iter().flatten().chain(&center).all(|x| x.is_finite())
            && half_size.iter().all(|b| b.is_finite() && *b > 0.0)
    }
}
