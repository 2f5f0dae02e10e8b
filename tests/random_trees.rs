//! Seeded random trees with all joint kinds, and their description for computing by other means.

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use surefoot::model::robots::branching::UNIVERSAL;
use surefoot::model::{Link, Tree};

/// Bodies of a random tree.
pub const N: usize = 8;

/// A tree that floats: floating, three revolute, prismatic, spherical, fixed and universal joints.
pub type Floating = Tree<f64, N, 17, 15>;
/// A tree on the ground: revolute ×3, prismatic, spherical ×2, fixed, universal.
pub type Grounded = Tree<f64, N, 14, 12>;

/// What a test needs to know of a body, apart from the tree that is tested.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// kg
    pub mass: f64,
    /// Principal moments about the centre of mass, kg·m².
    pub inertia: [f64; 3],
}

#[derive(Clone, Copy)]
enum Kind {
    Revolute,
    Prismatic,
    Spherical,
    Fixed,
    Universal,
}

/// A random number generator for test number `seed`.
pub fn random(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

/// Uniform in [−1, 1].
pub fn symmetric<const M: usize>(rng: &mut Pcg64) -> [f64; M] {
    std::array::from_fn(|_| rng.random_range(-1.0..1.0))
}

fn unit_quaternion(rng: &mut Pcg64) -> [f64; 4] {
    loop {
        let q: [f64; 4] = symmetric(rng);
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        if norm > 0.1 {
            return q.map(|x| x / norm);
        }
    }
}

/// A direction: half the time a coordinate axis, of either sign, else oblique.
fn axis(rng: &mut Pcg64) -> [f64; 3] {
    if rng.random() {
        let mut axis = [0.0; 3];
        axis[rng.random_range(0..3)] = if rng.random() { 1.0 } else { -1.0 };
        axis
    } else {
        let [x, y, z] = symmetric(rng);
        [x, y, z + 1.5]
    }
}

/// A body from random masses in a box: its moments obey the triangle inequality by construction.
fn body(rng: &mut Pcg64) -> Body {
    let mass = rng.random_range(0.3..4.0);
    let [a, b, c] = std::array::from_fn(|_| mass * rng.random_range(0.01..0.1));
    Body { mass, inertia: [b + c, c + a, a + b] }
}

fn link(rng: &mut Pcg64, link: Link, body: &Body, center: [f64; 3]) -> Link {
    let described = link.body(body.mass, body.inertia, center);
    if rng.random() { described.oriented(unit_quaternion(rng)) } else { described }
}

fn links(rng: &mut Pcg64, floating: bool, kinds: &mut [Kind]) -> ([Link; N], [Body; N]) {
    kinds.shuffle(rng);
    let first = usize::from(floating);
    let mut links = [Link::fixed(0); N];
    let bodies: [Body; N] = std::array::from_fn(|_| body(rng));
    if floating {
        let center = symmetric(rng);
        links[0] = link(rng, Link::floating(0), &bodies[0], center);
    }
    for (k, kind) in kinds.iter().enumerate().map(|(i, kind)| (i + first, kind)) {
        // Long branches more often than bushes.
        let inboard = if rng.random_bool(0.6) { k } else { rng.random_range(first..=k) };
        let point = symmetric(rng);
        let joined = match kind {
            Kind::Revolute => Link::revolute(inboard, axis(rng), point),
            Kind::Prismatic => Link::prismatic(inboard, axis(rng)),
            Kind::Spherical => Link::spherical(inboard, point),
            Kind::Fixed => Link::fixed(inboard),
            Kind::Universal => Link::general(inboard, point, UNIVERSAL),
        };
        let center = if rng.random_bool(0.3) { point } else { symmetric(rng) };
        links[k] = link(rng, joined, &bodies[k], center);
    }
    (links, bodies)
}

/// A random tree that floats.
pub fn floating(rng: &mut Pcg64) -> (Floating, [Body; N]) {
    use Kind::{Fixed, Prismatic, Revolute, Spherical, Universal};
    let mut kinds = [Revolute, Revolute, Revolute, Prismatic, Spherical, Fixed, Universal];
    let (links, bodies) = links(rng, true, &mut kinds);
    (Tree::new(links), bodies)
}

/// A random tree on the ground.
pub fn grounded(rng: &mut Pcg64) -> (Grounded, [Body; N]) {
    grounded_with(rng, [0.0; N])
}

/// The same with rotor inertias on the joints that can have one.
pub fn grounded_with(rng: &mut Pcg64, rotors: [f64; N]) -> (Grounded, [Body; N]) {
    use Kind::{Fixed, Prismatic, Revolute, Spherical, Universal};
    let mut kinds =
        [Revolute, Revolute, Revolute, Prismatic, Spherical, Spherical, Fixed, Universal];
    let (mut links, bodies) = links(rng, false, &mut kinds);
    for ((link, kind), rotor) in links.iter_mut().zip(kinds).zip(rotors) {
        if matches!(kind, Revolute | Prismatic) {
            *link = link.rotor_inertia(rotor);
        }
    }
    (Tree::new(links), bodies)
}

/// Random coordinates of a tree, with unit quaternions where its joints have them.
pub fn positions<const M: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    tree: &Tree<f64, M, NQ, NV>,
) -> [f64; NQ] {
    use surefoot::model::JointKind;
    let mut q = symmetric(rng);
    for k in 0..M {
        let (joint, (start, _)) = tree.joint(k).zip(tree.starts(k)).expect("a body");
        let quaternion = match joint {
            JointKind::Spherical => start,
            JointKind::Floating => start + 3,
            _ => continue,
        };
        q[quaternion..quaternion + 4].copy_from_slice(&unit_quaternion(rng));
    }
    q
}
