//! Wheels and balls that roll on a plane without slip: a nonholonomic constraint.

/// A wheel, as a thin disc, or a ball on a plane, which it neither leaves nor slips on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rolling {
    /// The body's link.
    pub link: usize,
    /// Centre of the disc or ball, in the body's frame, m.
    pub center: [f64; 3],
    /// The disc's axis in the body's frame, of unit length; none for a ball.
    pub axis: Option<[f64; 3]>,
    /// m
    pub radius: f64,
    /// The plane's normal, of unit length, world axes.
    pub normal: [f64; 3],
    /// A point of the plane, m.
    pub ground: [f64; 3],
}

impl Rolling {
    /// Whether all its numbers can be used.
    pub fn is_valid(&self) -> bool {
        let is_unit = |v: &[f64; 3]| (v.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12;
        self.radius.is_finite()
            && self.radius > 0.0
            && self.center.iter().chain(&self.ground).all(|x| x.is_finite())
            && is_unit(&self.normal)
            && self.axis.as_ref().is_none_or(is_unit)
    }
}
