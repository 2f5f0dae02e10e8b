//! Quaternions, poses, adjoints.

use nalgebra::{
    Isometry3, Quaternion as Theirs, SMatrix, SVector, Translation3, UnitQuaternion, Vector3,
};
use surefoot::spatial::{AxisTurn, Pose, Quaternion, Rotation, Twist, Wrench};
use surefoot_tests::random_trees::{random, symmetric};

fn theirs(q: Quaternion<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Theirs::new(q.s, q.v.x, q.v.y, q.v.z))
}

#[test]
fn quaternions() {
    let mut rng = random(51);
    for _ in 0..500 {
        let w = Vector3::from(symmetric(&mut rng)) * 4.0;
        let v = Vector3::from(symmetric(&mut rng));
        let a = Quaternion::from_rotation_vector(w);
        let b = Quaternion::from_rotation_vector(v * 2.0);
        assert!((theirs(a).angle_to(&UnitQuaternion::from_scaled_axis(w))).abs() < 1e-7);
        assert!((a.to_matrix() - theirs(a).to_rotation_matrix().matrix()).norm() < 1e-14);
        assert!((a.rotate(v) - theirs(a) * v).norm() < 1e-14);
        let product = (theirs(a) * theirs(b)).to_rotation_matrix();
        assert!((a.product(b).to_matrix() - product.matrix()).norm() < 1e-14);
        let inverse = a.product(a.conjugate());
        assert!((inverse.s - 1.0).abs() < 1e-15 && inverse.v.norm() < 1e-15);
        // q̇ = ½ q ⋆ ω, against a difference of exponentials.
        let h = 1e-5;
        let ahead = a.product(Quaternion::from_rotation_vector(v * h)).to_array();
        let back = a.product(Quaternion::from_rotation_vector(v * -h)).to_array();
        for ((x, y), rate) in ahead.iter().zip(back).zip(a.rate(v).to_array()) {
            assert!(((x - y) / (2.0 * h) - rate).abs() < 1e-10);
        }
    }
    // The series near zero joins the closed form.
    for angle in [0.0, 1e-9, 0.99e-4, 1.01e-4] {
        let q = Quaternion::from_rotation_vector(Vector3::new(0.0, angle, 0.0));
        assert!((q.v.y - f64::sin(angle / 2.0)).abs() < 1e-17);
        assert!((q.s - f64::cos(angle / 2.0)).abs() < 2e-16);
    }
    assert_eq!(Quaternion::from_array([0.0; 4]).normalized(), None);
    assert_eq!(Quaternion::from_array([f64::NAN, 0.0, 0.0, 0.0]).normalized(), None);
}

/// `[R p̂R; 0 R]`, from the page.
fn adjoint(pose: &Pose<f64>) -> SMatrix<f64, 6, 6> {
    let mut m = SMatrix::<f64, 6, 6>::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(&pose.rotation);
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&(pose.position.cross_matrix() * pose.rotation));
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(&pose.rotation);
    m
}

fn pose(rng: &mut rand_pcg::Pcg64) -> Pose<f64> {
    Pose {
        rotation: Quaternion::from_rotation_vector(Vector3::from(symmetric(rng)) * 3.0).to_matrix(),
        position: Vector3::from(symmetric(rng)),
    }
}

#[test]
fn poses_and_adjoints() {
    let mut rng = random(52);
    for _ in 0..500 {
        let (g, h) = (pose(&mut rng), pose(&mut rng));
        let isometry = |g: &Pose<f64>| {
            Isometry3::from_parts(
                Translation3::from(g.position),
                UnitQuaternion::from_matrix(&g.rotation),
            )
        };
        let v = Vector3::from(symmetric(&mut rng));
        let seen = (isometry(&g) * isometry(&h)) * nalgebra::Point3::from(v);
        assert!((g.compose(&h).transform_point(v) - seen.coords).norm() < 1e-9);
        let back = g.inverse().transform_point(g.transform_point(v));
        assert!((back - v).norm() < 1e-14);

        let twist = Twist::from_array(symmetric(&mut rng));
        let wrench = Wrench::from_array(symmetric(&mut rng));
        let moved = adjoint(&g) * SVector::from(twist.to_array());
        assert!((SVector::from(g.adjoint(twist).to_array()) - moved).norm() < 1e-14);
        let dual = adjoint(&g).transpose().try_inverse().expect("regular");
        let carried = dual * SVector::from(wrench.to_array());
        assert!((SVector::from(g.carry_wrench(wrench).to_array()) - carried).norm() < 1e-13);
        // Power does not depend on the frame.
        let power = g.adjoint(twist).power(g.carry_wrench(wrench));
        assert!((power - twist.power(wrench)).abs() < 1e-13);
        // The bracket is the derivative of the adjoint: ad_V W = d/dt Ad_{exp(V t)} W.
        let other = Twist::from_array(symmetric(&mut rng));
        let t = 1e-6;
        let step = |t: f64| Pose {
            rotation: Quaternion::from_rotation_vector(twist.angular * t).to_matrix(),
            position: twist.linear * t,
        };
        let rate = (step(t).adjoint(other) - step(-t).adjoint(other)) * (0.5 / t);
        let difference = (rate - twist.bracket(other)).to_array();
        assert!(difference.iter().all(|x| x.abs() < 1e-9));
    }
}

#[test]
fn turns_about_axes_are_rotations() {
    let mut rng = random(53);
    for _ in 0..200 {
        let [angle] = symmetric(&mut rng).map(|x: f64| 6.0 * x);
        let turn = AxisTurn::new(angle);
        let v = Vector3::from(symmetric(&mut rng));
        let general = pose(&mut rng).rotation;
        for (rotation, axis) in [
            (Rotation::X(turn), Vector3::x()),
            (Rotation::Y(turn), Vector3::y()),
            (Rotation::Z(turn), Vector3::z()),
            (Rotation::Identity, Vector3::zeros()),
            (Rotation::General(general), Vector3::zeros()),
        ] {
            let matrix = match rotation {
                Rotation::General(m) => m,
                _ => *UnitQuaternion::from_scaled_axis(axis * angle).to_rotation_matrix().matrix(),
            };
            assert!((rotation.to_matrix() - matrix).norm() < 1e-14);
            assert!((rotation.inboard(v) - matrix * v).norm() < 1e-14);
            assert!((rotation.outboard(v) - matrix.transpose() * v).norm() < 1e-14);
            assert!((rotation.compose(&general) - general * matrix).norm() < 1e-14);
        }
    }
}
