//! A robot that is not the biped: four legs of six joints, hips that do not meet in a point, one
//! oblique axis per leg, a torso with products of inertia. The controller must not care.

use surefoot::balance::LeggedRobot;
use surefoot::model::{Link, Tree};

/// 25 bodies, 24 joints.
pub const TREE: Tree<f64, 25, 31, 30> = Tree::new(links());

/// The same in single precision.
pub const TREE_F32: Tree<f32, 25, 31, 30> = TREE.to_f32();

/// As the controller sees it.
pub const ROBOT: LeggedRobot<f64, 4> = LeggedRobot::new(&TREE);

/// As the controller sees it, in single precision.
pub const ROBOT_F32: LeggedRobot<f32, 4> = ROBOT.to_f32();

/// Indices of the feet.
pub const FEET: [usize; 4] = [6, 12, 18, 24];

const fn links() -> [Link; 25] {
    let mut links = [Link::fixed(0); 25];
    links[0] = Link::floating(0).body_with_products(
        20.0,
        [0.4, 0.9, 1.0, 0.02, -0.01, 0.03],
        [0.0, 0.0, 0.6],
    );
    let mut leg = 0;
    while leg < 4 {
        let x = if leg < 2 { 0.3 } else { -0.3 };
        let y = if leg % 2 == 0 { 0.15 } else { -0.15 };
        let first = 6 * leg + 1;
        let small = [4e-4, 5e-4, 6e-4];
        links[first] = Link::revolute(1, [1.0, 0.0, 0.0], [x, y, 0.55]).body(
            0.6,
            small,
            [x, y + 0.02 * y, 0.54],
        );
        links[first + 1] = Link::revolute(first + 1, [0.0, 1.0, 0.0], [x, 1.3 * y, 0.55]).body(
            1.2,
            [0.01, 0.011, 0.002],
            [x + 0.01, 1.3 * y, 0.42],
        );
        links[first + 2] = Link::revolute(first + 2, [0.0, 1.0, 0.2], [x, 1.3 * y, 0.30]).body(
            0.5,
            [0.002, 0.002, 0.0005],
            [x, 1.3 * y, 0.20],
        );
        links[first + 3] = Link::revolute(first + 3, [0.0, 0.0, 1.0], [x, 1.3 * y, 0.15]).body(
            0.2,
            small,
            [x, 1.3 * y, 0.12],
        );
        links[first + 4] = Link::revolute(first + 4, [0.0, 1.0, 0.0], [x, 1.3 * y, 0.08]).body(
            0.1,
            [1e-4, 1e-4, 1e-4],
            [x, 1.3 * y, 0.08],
        );
        links[first + 5] = Link::revolute(first + 5, [1.0, 0.0, 0.0], [x, 1.3 * y, 0.05])
            .body(0.3, [3e-4, 4e-4, 5e-4], [x + 0.02, 1.3 * y, 0.02])
            .oriented([0.8, 0.0, 0.6, 0.0]);
        leg += 1;
    }
    links
}
