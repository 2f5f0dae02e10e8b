//! Serial chains of revolute joints, of any length: what cost grows with.

use surefoot::model::{Link, Tree};

/// A chain of `N` links on a fixed base: each 0.1 m long and 0.5 kg, joint axes x, y, z in turn.
pub const fn chain<const N: usize>() -> Tree<f64, N, N, N> {
    const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut links = [Link::fixed(0); N];
    let mut k = 0;
    while k < N {
        let at = 0.1 * k as f64;
        links[k] = Link::revolute(k, AXES[k % 3], [at, 0.0, 0.0]).body(
            0.5,
            [2e-4, 5e-4, 5e-4],
            [at + 0.05, 0.0, 0.0],
        );
        k += 1;
    }
    Tree::new(links)
}
