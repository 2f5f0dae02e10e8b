//! Legged robots that are not the biped: random ones of legs with three to seven joints, arms, and a waist
//! above or below the central body.

use crate::random_trees::symmetric;
use nalgebra::Vector3;
use rand::RngExt;
use rand_pcg::Pcg64;
use surefoot::balance::{ContactLimits, ContactPatch, WholeBodyFoot, WholeBodyState};
use surefoot::model::{Link, Tree};
use surefoot::spatial::Quaternion;

/// A robot with its feet.
#[derive(Clone, Debug)]
pub struct Legged<const N: usize, const NQ: usize, const NV: usize> {
    /// Bodies.
    pub tree: Tree<f64, N, NQ, NV>,
    /// Feet.
    pub feet: [Option<WholeBodyFoot<f64>>; 4],
    /// Angles of a stance, knees bent.
    pub stance: [f64; NV],
}

/// Four legs of three joints on points.
pub type Quadruped = Legged<13, 19, 18>;
/// Two legs of five joints on edges, and a prismatic one in each.
pub type Five = Legged<11, 17, 16>;
/// Two legs of seven joints (one prismatic) on soles below a waist that they share; two arms of two joints
/// above.
pub type Seven = Legged<20, 26, 25>;

/// Feet in single precision.
pub fn feet_f32(feet: &[Option<WholeBodyFoot<f64>>; 4]) -> [Option<WholeBodyFoot<f32>>; 4] {
    feet.map(|foot| {
        foot.map(|foot| WholeBodyFoot {
            body: foot.body,
            reference: foot.reference.map(|x| x as f32),
            axes: Quaternion::from_array(foot.axes.to_array().map(|x| x as f32)),
            limits: foot.limits.to_f32(),
        })
    })
}

/// Near the stance of a robot, level or not, moving or not.
pub fn near_stance<const N: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    robot: &Legged<N, NQ, NV>,
    share: f64,
) -> WholeBodyState<f64, NQ, NV> {
    let mut positions = [0.0; NQ];
    let [x, y, z, a, b, c]: [f64; 6] = symmetric(rng);
    positions[..3].copy_from_slice(&[x, y, z]);
    let turned = Quaternion::from_rotation_vector(Vector3::new(a, b, c) * (0.5 * share));
    positions[3..7].copy_from_slice(&turned.to_array());
    for (to, at) in positions[7..].iter_mut().zip(&robot.stance[6..]) {
        let [off] = symmetric(rng);
        *to = *at + 0.15 * share * off;
    }
    let velocities = symmetric::<NV>(rng).map(|x| share * x);
    WholeBodyState { positions, velocities }
}

/// Limits of a foot on such a patch, N.
pub fn limits(patch: ContactPatch<f64>, weight: f64) -> ContactLimits<f64, 0> {
    ContactLimits {
        least_force: 0.01 * weight,
        greatest_force: 4.0 * weight,
        friction: 0.6,
        patch,
        torques: [],
    }
}

/// An axis, now and then oblique or against itself.
fn axis(rng: &mut Pcg64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = if rng.random_bool(0.3) { symmetric(rng).map(|x| 0.2 * x) } else { [0.0; 3] };
    let sign = if rng.random() { 1.0 } else { -1.0 };
    [sign * (x + a), sign * (y + b), sign * (z + c)]
}

/// The link and its centre of mass, near the one given.
fn body(rng: &mut Pcg64, link: Link, mass: f64, center: [f64; 3]) -> (Link, [f64; 3]) {
    let [a, b, c] = symmetric::<3>(rng).map(|x| mass * (0.004 + 0.002 * x));
    let [x, y, z]: [f64; 3] = symmetric(rng);
    let near = [center[0] + 0.02 * x, center[1] + 0.02 * y, center[2] + 0.02 * z];
    let link = link.body(mass, [b + c, c + a, a + b], near);
    (if rng.random_bool(0.3) { link.rotor_inertia(0.01 * mass) } else { link }, near)
}

fn torso(rng: &mut Pcg64, mass: f64, z: f64) -> Link {
    let [a, b, c]: [f64; 3] = symmetric(rng);
    Link::floating(0).body_with_products(
        mass,
        [0.02 * mass, 0.03 * mass, 0.035 * mass, 1e-3 * a * mass, 1e-3 * b * mass, 1e-3 * c * mass],
        [0.02 * a, 0.01 * b, z],
    )
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// As [`Quadruped`]. Thigh and shank of 0.2 m; at home they hang straight.
pub fn quadruped(rng: &mut Pcg64) -> Quadruped {
    let mut links = vec![torso(rng, 6.0, 0.42)];
    let mut feet = [None; 4];
    let mut stance = [0.0; 18];
    for (leg, place) in feet.iter_mut().enumerate() {
        let (x, y) = ([0.2, 0.2, -0.2, -0.2][leg], [0.12, -0.12, 0.12, -0.12][leg]);
        let first = links.len();
        let joint = [(1, X, 0.4, 0.4), (first + 1, Y, 0.4, 0.3), (first + 2, Y, 0.2, 0.1)];
        let mut signs = [1.0; 3];
        let mut last = [0.0; 3];
        for (k, (inboard, along, z, center)) in joint.into_iter().enumerate() {
            let along = axis(rng, along);
            signs[k] = (along[0] + along[1]).signum();
            let link = Link::revolute(inboard, along, [x, y, z]);
            let (link, near) = body(rng, link, 0.5, [x, y, center]);
            links.push(link);
            last = near;
        }
        let at = 6 + 3 * leg;
        stance[at + 1] = 0.7 * signs[1];
        stance[at + 2] = -1.4 * signs[2];
        let limits = limits(ContactPatch::point(), 120.0);
        *place = Some(foot(links.len() - 1, [x, y, 0.0], last, limits));
    }
    let tree = Tree::try_new(links.try_into().expect("13 links")).expect("a tree");
    Legged { tree, feet, stance }
}

/// As [`Five`]: hip yaw, roll and pitch, a thigh that slides, ankle pitch.
pub fn five(rng: &mut Pcg64) -> Five {
    let mut links = vec![torso(rng, 15.0, 1.0)];
    let mut feet = [None; 4];
    let mut stance = [0.0; 16];
    for (leg, place) in feet.iter_mut().enumerate().take(2) {
        let y = [0.1, -0.1][leg];
        let chain =
            [(Z, 0.8, false), (X, 0.8, false), (Y, 0.8, false), (Z, 0.4, true), (Y, 0.08, false)];
        let mut last = [0.0; 3];
        for (k, (along, z, slides)) in chain.into_iter().enumerate() {
            let inboard = if k == 0 { 1 } else { links.len() };
            let along = axis(rng, along);
            let link = if slides {
                Link::prismatic(inboard, along)
            } else {
                Link::revolute(inboard, along, [0.0, y, z])
            };
            let (link, near) = body(rng, link, 1.0, [0.0, y, 0.8 * z]);
            links.push(link);
            last = near;
            if k == 2 || k == 4 {
                let sign = along[1].signum();
                stance[6 + 5 * leg + k] = if k == 2 { -0.1 } else { 0.1 } * sign;
            }
        }
        let limits = limits(ContactPatch::edge_along_x(0.18), 250.0);
        *place = Some(foot(links.len() - 1, [0.02, y, 0.0], last, limits));
    }
    let tree = Tree::try_new(links.try_into().expect("11 links")).expect("a tree");
    Legged { tree, feet, stance }
}

/// As [`Seven`].
pub fn seven(rng: &mut Pcg64) -> Seven {
    let mut links = vec![torso(rng, 20.0, 1.2)];
    for side in [1.0, -1.0] {
        let y = 0.2 * side;
        let upper = Link::revolute(1, axis(rng, Y), [0.0, y, 1.4]);
        links.push(body(rng, upper, 1.5, [0.0, y, 1.3]).0);
        let lower = Link::revolute(links.len(), axis(rng, Y), [0.0, y, 1.15]);
        links.push(body(rng, lower, 1.0, [0.1, y, 1.1]).0);
    }
    let waist = Link::revolute(1, axis(rng, Z), [0.0, 0.0, 1.0]);
    links.push(body(rng, waist, 5.0, [0.0, 0.0, 0.95]).0);
    let pelvis = links.len();
    let mut feet = [None; 4];
    let mut stance = [0.0; 25];
    for (leg, place) in feet.iter_mut().enumerate().take(2) {
        let y = [0.1, -0.1][leg];
        let chain = [
            (Z, 0.9, false),
            (X, 0.9, false),
            (Y, 0.9, false),
            (Z, 0.6, true),
            (Y, 0.5, false),
            (Y, 0.08, false),
            (X, 0.08, false),
        ];
        let mut last = [0.0; 3];
        for (k, (along, z, slides)) in chain.into_iter().enumerate() {
            let inboard = if k == 0 { pelvis } else { links.len() };
            let along = axis(rng, along);
            let link = if slides {
                Link::prismatic(inboard, along)
            } else {
                Link::revolute(inboard, along, [0.0, y, z])
            };
            let (link, near) = body(rng, link, 1.2, [0.0, y, (z - 0.1).max(0.05)]);
            links.push(link);
            last = near;
            let bend = [0.0, 0.0, -0.4, 0.0, 0.8, -0.4, 0.0][k];
            stance[11 + 7 * leg + k] = bend * along[1].signum();
        }
        let sole = ContactPatch::sole([-0.1, 0.12], [-0.04, 0.05], -0.03);
        *place = Some(foot(links.len() - 1, [0.02, y, 0.03], last, limits(sole, 460.0)));
    }
    let tree = Tree::try_new(links.try_into().expect("20 links")).expect("a tree");
    Legged { tree, feet, stance }
}

/// A foot at a point of the home configuration, where its sole is level; `center` is its body's.
fn foot(
    body: usize,
    point: [f64; 3],
    center: [f64; 3],
    limits: ContactLimits<f64, 0>,
) -> WholeBodyFoot<f64> {
    let reference = Vector3::from(point) - Vector3::from(center);
    WholeBodyFoot { body, reference, axes: Quaternion::identity(), limits }
}
