//! Springs and dampers between two points of bodies, or of a body and the world.

/// An end of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringEnd {
    /// The body's link; none for the world.
    pub link: Option<usize>,
    /// In the body's frame, or the world's, m.
    pub point: [f64; 3],
}

/// A spring and a damper along the line between two points: they pull with `k (l − l₀) + d l̇`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointSpring {
    /// Where it is held.
    pub ends: [SpringEnd; 2],
    /// `k`, N/m.
    pub stiffness: f64,
    /// `l₀`, m.
    pub rest: f64,
    /// `d`, N·s/m.
    pub damping: f64,
}

impl PointSpring {
    /// Whether all its numbers can be used.
    pub fn is_valid(&self) -> bool {
        let fine = |x: f64| x.is_finite() && x >= 0.0;
        let points = self.ends.iter().flat_map(|end| end.point);
        [self.stiffness, self.rest, self.damping].into_iter().all(fine)
            && points.into_iter().all(f64::is_finite)
            && self.ends[0].link != self.ends[1].link
    }

    /// The pull at a length and its rate, N.
    pub fn pull(&self, length: f64, rate: f64) -> f64 {
        self.stiffness * (length - self.rest) + self.damping * rate
    }

    /// Energy held at a length, J.
    pub fn energy(&self, length: f64) -> f64 {
        0.5 * self.stiffness * (length - self.rest).powi(2)
    }
}
