//! Symmetric matrices, rigid and articulated inertias.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use surefoot::spatial::{
    ArticulatedInertia, AxisTurn, Pose, Quaternion, RigidInertia, Rotation, SymmetricMatrix3, Twist,
};
use surefoot_tests::random_trees::{random, symmetric};

fn positive(rng: &mut rand_pcg::Pcg64) -> SymmetricMatrix3<f64> {
    let m = Matrix3::from_column_slice(&symmetric::<9>(rng));
    SymmetricMatrix3::from_matrix(&(m * m.transpose() + Matrix3::identity() * 0.1))
}

#[test]
fn symmetric_matrices() {
    let mut rng = random(61);
    for _ in 0..300 {
        let s = positive(&mut rng);
        let v = Vector3::from(symmetric(&mut rng));
        let full = s.to_matrix();
        assert_eq!(full, full.transpose());
        assert!((s.product(v) - full * v).norm() < 1e-15);
        let r = Quaternion::from_rotation_vector(v * 3.0).to_matrix();
        assert!((s.congruence(&r).to_matrix() - r * full * r.transpose()).norm() < 1e-14);
        let inverse = s.inverse().expect("positive").to_matrix();
        assert!((inverse * full - Matrix3::identity()).norm() < 1e-11);
        assert!((SymmetricMatrix3::outer(v).to_matrix() - v * v.transpose()).norm() < 1e-15);
    }
    assert_eq!(SymmetricMatrix3::<f64>::zero().inverse(), None);
    assert_eq!(SymmetricMatrix3::scalar(f64::NAN).inverse(), None);
}

fn dense(p: &ArticulatedInertia<f64>) -> SMatrix<f64, 6, 6> {
    let rows = p.to_array();
    SMatrix::from_fn(|i, j| rows[i][j])
}

/// `Ad` of the inboard-to-outboard transformation of twists.
fn transport(rotation: &Matrix3<f64>, position: Vector3<f64>) -> SMatrix<f64, 6, 6> {
    let pose = Pose { rotation: *rotation, position }.inverse();
    let mut m = SMatrix::<f64, 6, 6>::zeros();
    for i in 0..6 {
        let mut unit = [0.0; 6];
        unit[i] = 1.0;
        let column = pose.adjoint(Twist::from_array(unit)).to_array();
        m.set_column(i, &SVector::from(column));
    }
    m
}

/// Rotating and shifting the 21 numbers is the congruence `Aᵀ P A` of the 36.
#[test]
fn articulated_inertias_move_as_6_by_6_matrices() {
    let mut rng = random(62);
    for _ in 0..200 {
        let p = ArticulatedInertia {
            linear: positive(&mut rng),
            coupling: Matrix3::from_column_slice(&symmetric::<9>(&mut rng)),
            angular: positive(&mut rng),
        };
        let twist = Twist::from_array(symmetric(&mut rng));
        let product = dense(&p) * SVector::from(twist.to_array());
        assert!((SVector::from(p.product(twist).to_array()) - product).norm() < 1e-14);

        let arm = Vector3::from(symmetric(&mut rng));
        let turn = AxisTurn::new(3.0 * symmetric::<1>(&mut rng)[0]);
        let general = Quaternion::from_rotation_vector(arm * 2.0).to_matrix();
        for rotation in [
            Rotation::Identity,
            Rotation::X(turn),
            Rotation::Y(turn),
            Rotation::Z(turn),
            Rotation::General(general),
        ] {
            let moved = p.rotated_inboard(&rotation).shifted(arm);
            let a = transport(&rotation.to_matrix(), arm);
            assert!((dense(&moved) - a.transpose() * dense(&p) * a).norm() < 1e-12);
        }
    }
}

/// A rigid body's ten numbers against the parallel-axis theorem, by its articulated form.
#[test]
fn rigid_inertias_shift_as_their_articulated_forms() {
    let mut rng = random(63);
    for _ in 0..200 {
        let body = RigidInertia::about(2.5, Vector3::from(symmetric(&mut rng)), positive(&mut rng));
        let twist = Twist::from_array(symmetric(&mut rng));
        let full = ArticulatedInertia::from(body);
        let difference = (body.product(twist) - full.product(twist)).to_array();
        assert!(difference.iter().all(|x| x.abs() < 1e-14));
        let arm = Vector3::from(symmetric(&mut rng));
        let a = dense(&ArticulatedInertia::from(body.shifted(arm)));
        assert!((a - dense(&full.shifted(arm))).norm() < 1e-13);
    }
}
