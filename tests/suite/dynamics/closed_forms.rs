//! Systems whose equations of motion a person can write down.

use surefoot::dynamics::{forward_dynamics, joint_poses};
use surefoot::model::{Link, Tree};
use surefoot::spatial::Wrench;

const G: f64 = 9.81;

/// A compound pendulum about y: `(I + m l²) θ̈ = −m g l sin θ`, hanging along −z at θ = 0.
#[test]
fn pendulum() {
    let (mass, length, inertia) = (1.3, 0.7, 0.02);
    let tree: Tree<f64, 1, 1, 1> = Tree::new([Link::revolute(0, [0.0, 1.0, 0.0], [0.2, 0.1, 1.0])
        .body(mass, [0.03, inertia, 0.03], [0.2, 0.1, 1.0 - length])]);
    for theta in [-3.0, -1.0, 0.0, 0.4, 1.6, 2.9] {
        let poses = joint_poses(&tree, &[theta]).expect("finite");
        let [found] = forward_dynamics(&tree, &poses, &[2.0], &[0.5], None).expect("regular");
        let expected =
            (0.5 - mass * G * length * f64::sin(theta)) / (inertia + mass * length * length);
        assert!((found - expected).abs() < 1e-12, "{theta}: {found} {expected}");
    }
}

/// Two point masses on massless rods (the inertia that a body must have is 1e-12): the textbook's
/// double pendulum, angles absolute. Masses m₁, m₂, lengths l₁, l₂.
#[test]
fn double_pendulum() {
    let (m1, m2, l1, l2) = (1.0, 2.0, 0.8, 0.5);
    let tiny = [1e-12; 3];
    let tree: Tree<f64, 2, 2, 2> = Tree::new([
        Link::revolute(0, [0.0, 1.0, 0.0], [0.0; 3]).body(m1, tiny, [0.0, 0.0, -l1]),
        Link::revolute(1, [0.0, 1.0, 0.0], [0.0, 0.0, -l1]).body(m2, tiny, [0.0, 0.0, -l1 - l2]),
    ]);
    for (a, b, wa, wb) in [(0.3, 1.1, 0.0, 0.0), (1.2, -0.4, 2.0, -3.0), (3.0, 2.0, -1.0, 0.5)] {
        let poses = joint_poses(&tree, &[a, b - a]).expect("finite");
        let [x, y] =
            forward_dynamics(&tree, &poses, &[wa, wb - wa], &[0.0; 2], None).expect("regular");
        let (aa, bb) = (x, x + y);
        let (s, c) = f64::sin_cos(a - b);
        // (m₁ + m₂) l₁ α̈ + m₂ l₂ β̈ cos(α−β) + m₂ l₂ β̇² sin(α−β) + (m₁ + m₂) g sin α = 0
        let first = (m1 + m2) * l1 * aa
            + m2 * l2 * bb * c
            + m2 * l2 * wb * wb * s
            + (m1 + m2) * G * f64::sin(a);
        // l₂ β̈ + l₁ α̈ cos(α−β) − l₁ α̇² sin(α−β) + g sin β = 0
        let second = l2 * bb + l1 * aa * c - l1 * wa * wa * s + G * f64::sin(b);
        assert!(first.abs() < 1e-9 && second.abs() < 1e-9, "{first} {second}");
    }
}

/// A free body: Euler's equations for the spin, Newton's for the flight (component derivative
/// `v̇ = Rᵀg − ω × v`).
#[test]
fn free_body() {
    let tree: Tree<f64, 1, 7, 6> =
        Tree::new([Link::floating(0).body(2.0, [1.0, 2.0, 2.5], [0.0; 3])]);
    let half = f64::sqrt(0.5);
    // A quarter turn about x: world −z is body −y.
    let q = [1.0, 2.0, 3.0, half, half, 0.0, 0.0];
    let (v, w) = ([0.3, -0.2, 0.5], [1.0, 2.0, -1.5]);
    let poses = joint_poses(&tree, &q).expect("a unit quaternion");
    let beta = [v[0], v[1], v[2], w[0], w[1], w[2]];
    let push = Wrench::from_array([4.0, 0.0, 0.0, 0.0, 0.0, 5.0]);
    let found = forward_dynamics(&tree, &poses, &beta, &[0.0; 6], Some(&[push])).expect("regular");
    let expected = [
        4.0 / 2.0 - (w[1] * v[2] - w[2] * v[1]),
        -G - (w[2] * v[0] - w[0] * v[2]),
        -(w[0] * v[1] - w[1] * v[0]),
        (2.0 - 2.5) * w[1] * w[2] / 1.0,
        (2.5 - 1.0) * w[2] * w[0] / 2.0,
        (5.0 + (1.0 - 2.0) * w[0] * w[1]) / 2.5,
    ];
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-12, "{found:?} {expected:?}");
    }
}

/// A slider on an inclined rail: `m s̈ = F − m g sin(incline)`, here 30°.
#[test]
fn slider() {
    let tree: Tree<f64, 1, 1, 1> =
        Tree::new([Link::prismatic(0, [f64::sqrt(3.0), 0.0, 1.0]).body(
            3.0,
            [0.1; 3],
            [0.1, 0.2, 0.3],
        )]);
    let poses = joint_poses(&tree, &[0.7]).expect("finite");
    let [found] = forward_dynamics(&tree, &poses, &[1.0], &[6.0], None).expect("regular");
    assert!((found - (2.0 - 0.5 * G)).abs() < 1e-12);
}
