//! Motors of a spherical joint: three in a row, as of a robot's hip, whose axes meet in its point.
//!
//! # Notation
//! `M` the outboard body's turn from home, in the inboard body's axes; `e_i` the motors' axes at home, `s` the
//! sign of `e_1 · e_2 × e_3`; `a_i` the axes now, `θ_i` the angles, `τ_i` the torques, `T` what they are together.
//! ```text
//! M = exp(ê_1 θ_1) exp(ê_2 θ_2) exp(ê_3 θ_3)
//! a_1 = e_1,  a_3 = M e_3,  a_2 = s a_3 × a_1 / |a_3 × a_1|,  d = a_1 · a_3 = s sin θ_2                  (1)
//! ω = Σ a_i θ̇_i,   a_i · T = τ_i                                                                  (2)
//! ```
//! (2) is solved in closed form, as `a_2` is at right angles to both others. At `cos θ_2 = 0` all axes lie in a
//! plane: a gimbal's lock.

use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// Axes of three motors in a row, at right angles at home: the first is fixed to the inboard body, the last to
/// the outboard one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gimbal {
    axes: [[f64; 3]; 3],
    handedness: f64,
}

/// Angles and axes at one orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GimbalPose {
    /// rad, within half a turn; the second within a quarter.
    pub angles: [f64; 3],
    /// `a_i`
    pub axes: [Vector3<f64>; 3],
    /// `d`, `1 − d²`
    along: f64,
    across: f64,
}

/// A lock is declared where the middle motor is within 5° of a quarter turn: `cos² 85°`.
const LOCK: f64 = 0.0076;

impl Gimbal {
    /// From unit axes in the inboard body's frame, where the joint is at home; none if they are not at right
    /// angles to each other, to 1e-9.
    pub fn new(axes: [[f64; 3]; 3]) -> Option<Self> {
        let [a, b, c] = axes.map(Vector3::from);
        let handedness = a.dot(&b.cross(&c));
        let off = [a.dot(&b), b.dot(&c), c.dot(&a), a.norm() - 1.0, b.norm() - 1.0, c.norm() - 1.0];
        let fits = off.iter().all(|x| x.abs() < 1e-9);
        fits.then(|| Self { axes, handedness: handedness.signum() })
    }

    /// Axes in the inboard body's frame, at home.
    pub fn axes(&self) -> [[f64; 3]; 3] {
        self.axes
    }

    /// (1), in the inboard body's axes.
    pub(super) fn pose(&self, turned: &Quaternion<f64>) -> GimbalPose {
        let [e1, e2, e3] = self.axes.map(Vector3::from);
        let (a2, a3) = (turned.rotate(e2), turned.rotate(e3));
        let along = e1.dot(&a3);
        let normal = a3.cross(&e1) * self.handedness;
        let across = normal.norm_squared();
        let cosine = across.sqrt();
        let s = self.handedness;
        // Rows and columns of M = R_x R_y R_z, and the mirror image's angles turned round.
        let first = s * f64::atan2(-e2.dot(&a3), e3.dot(&a3));
        let middle = s * along.atan2(cosine);
        let last = s * f64::atan2(-e1.dot(&a2), e1.dot(&turned.rotate(e1)));
        let axes = [e1, normal / cosine, a3];
        GimbalPose { angles: [first, middle, last], axes, along, across }
    }
}

impl GimbalPose {
    /// The same with its axes turned.
    pub fn seen(self, turn: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Self {
        Self { axes: self.axes.map(turn), ..self }
    }

    /// Whether the axes are too near a plane to tell angles; so is what is no orientation.
    pub fn is_locked(&self) -> bool {
        !(self.across > LOCK)
    }

    /// `T`
    pub fn torque(&self, [t1, t2, t3]: [f64; 3]) -> Vector3<f64> {
        let [a1, a2, a3] = &self.axes;
        let d = self.along;
        a2 * t2 + (a1 * (t1 - d * t3) + a3 * (t3 - d * t1)) / self.across
    }

    /// `θ̇`
    pub fn rates(&self, omega: &Vector3<f64>) -> [f64; 3] {
        let [p, middle, q] = self.axes.map(|axis| axis.dot(omega));
        let d = self.along;
        [(p - d * q) / self.across, middle, (q - d * p) / self.across]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [[[f64; 3]; 3]; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.6, 0.8], [1.0, 0.0, 0.0], [0.0, -0.8, 0.6]],
    ];
    const ANGLES: [[f64; 3]; 4] =
        [[0.0; 3], [0.3, -0.7, 1.1], [-2.9, 1.2, 2.5], [1.0, -1.45, -0.2]];

    fn turned(axes: &[[f64; 3]; 3], angles: &[f64; 3]) -> Quaternion<f64> {
        axes.iter().zip(angles).fold(Quaternion::identity(), |q, (axis, angle)| {
            q.product(Quaternion::from_axis_angle(Vector3::from(*axis), *angle))
        })
    }

    /// Of either handedness.
    #[test]
    fn angles_are_those_that_the_orientation_is_made_of() {
        for axes in AXES {
            let gimbal = Gimbal::new(axes).expect("right angles");
            for angles in ANGLES {
                let found = gimbal.pose(&turned(&axes, &angles)).angles;
                for (a, b) in angles.iter().zip(found) {
                    assert!((a - b).abs() < 1e-13, "{angles:?} {found:?}");
                }
            }
        }
    }

    /// Axes by differences of orientations; rates give back the angular velocity, torques the power.
    #[test]
    fn axes_rates_and_torques_belong_to_each_other() {
        for axes in AXES {
            let gimbal = Gimbal::new(axes).expect("right angles");
            for angles in ANGLES {
                let q = turned(&axes, &angles);
                let pose = gimbal.pose(&q);
                for i in 0..3 {
                    let mut moved = angles;
                    moved[i] += 1e-6;
                    let way = turned(&axes, &moved).product(q.conjugate()).v * 2e6;
                    assert!((way - pose.axes[i]).norm() < 1e-5, "{angles:?} {i}");
                }
                let rates = [0.7, -1.3, 0.4];
                let omega: Vector3<f64> = pose.axes.iter().zip(rates).map(|(a, r)| a * r).sum();
                for (a, b) in pose.rates(&omega).iter().zip(rates) {
                    assert!((a - b).abs() < 1e-12);
                }
                let torques = [5.0, -2.0, 3.0];
                let power: f64 = torques.iter().zip(rates).map(|(t, r)| t * r).sum();
                let whole = pose.torque(torques);
                assert!((whole.dot(&omega) - power).abs() < 1e-11 * whole.norm());
            }
        }
    }

    #[test]
    fn a_lock_and_oblique_axes_are_seen() {
        assert!(Gimbal::new([[1.0, 0.0, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]]).is_none());
        let gimbal = Gimbal::new(AXES[0]).expect("right angles");
        let locked = |angle: f64| gimbal.pose(&turned(&AXES[0], &[0.3, angle, 0.1])).is_locked();
        assert!(locked(1.54) && locked(-1.57) && !locked(1.45));
        assert!(gimbal.pose(&Quaternion::from_array([f64::NAN; 4])).is_locked());
    }
}
