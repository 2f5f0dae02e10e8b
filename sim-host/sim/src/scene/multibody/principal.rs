//! Principal axes of a body whose inertia was given about other ones.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion};
use surefoot::spatial::Quaternion;

/// Moments `[xx, yy, zz]` and products `[xy, xz, yz]`, entries of the matrix, about axes in the body: principal moments,
/// and the principal axes' orientation seen from these, as near to them as can be.
pub(super) fn principal(
    [xx, yy, zz]: [f64; 3],
    [xy, xz, yz]: [f64; 3],
) -> ([f64; 3], Quaternion<f64>) {
    let found = SymmetricEigen::new(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz));
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let along = |order: &[usize; 3]| -> f64 {
        order.iter().enumerate().map(|(k, from)| found.eigenvectors[(k, *from)].abs()).sum()
    };
    // There are six.
    let order =
        orders.into_iter().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or([0, 1, 2]);
    let mut axes = Matrix3::zeros();
    for (k, from) in order.into_iter().enumerate() {
        let axis = found.eigenvectors.column(from);
        axes.set_column(k, &(axis * axis[k].signum()));
    }
    if axes.determinant() < 0.0 {
        axes.column_mut(2).neg_mut();
    }
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    (order.map(|from| found.eigenvalues[from]), Quaternion::from_array([q.w, q.i, q.j, q.k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Back in the axes that they were given about, moments and products are the same, and axes that are nearly
    /// principal stay nearly where they are.
    #[test]
    fn principal_moments_are_those_of_the_same_body() {
        let (moments, products) = ([9.2, 11.0, 2.8], [0.0, -2.4, 0.3]);
        let (own, turn) = principal(moments, products);
        let r = turn.to_matrix();
        let back = r * Matrix3::from_diagonal(&own.into()) * r.transpose();
        let [xy, xz, yz] = products;
        let given = Matrix3::new(9.2, xy, xz, xy, 11.0, yz, xz, yz, 2.8);
        // Measured 4e-15.
        assert!((back - given).abs().max() < 2e-14, "{back} {given}");
        assert!(turn.s > 0.9);
        let (same, none) = principal([1.0, 2.0, 3.0], [0.0; 3]);
        assert_eq!((same, none.to_array()), ([1.0, 2.0, 3.0], [1.0, 0.0, 0.0, 0.0]));
    }
}
