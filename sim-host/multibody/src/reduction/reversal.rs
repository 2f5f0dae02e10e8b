//! A joint, and its motors, told from the other body.

use super::super::Gimbal;
use super::super::joint::{Joint, JointConstraint, rotated};
use surefoot::spatial::Quaternion;

impl Joint {
    /// The same joint, told from the other body: outboard and inboard change places. Angles and ways keep their
    /// sign; the two angles of a universal joint change places.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [s, a, b, c] = self.home;
        let back = [s, -a, -b, -c];
        let opposite = |axis: [f64; 3]| axis.map(|x| -x);
        let constraint = match self.constraint {
            JointConstraint::Revolute { axis } => {
                JointConstraint::Revolute { axis: opposite(rotated(&self.home, &axis)) }
            }
            JointConstraint::Prismatic { axis } => {
                JointConstraint::Prismatic { axis: opposite(rotated(&back, &axis)) }
            }
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                JointConstraint::Universal {
                    outboard_axis: opposite(inboard_axis),
                    inboard_axis: opposite(outboard_axis),
                }
            }
            same @ (JointConstraint::Floating
            | JointConstraint::Spherical
            | JointConstraint::Fixed) => same,
        };
        Self { outboard: self.inboard, inboard: self.outboard, home: back, constraint }
    }
}

impl Gimbal {
    /// The same motors, in the opposite order, of the joint told from the other body; `home` is that of the joint
    /// as it is.
    pub(super) fn reversed(&self, home: [f64; 4]) -> Option<Self> {
        let back = Quaternion::from_array(home).conjugate();
        let [first, middle, last] = self.axes().map(|axis| (-back.rotate(axis.into())).into());
        Self::new([last, middle, first])
    }
}
