//! Kinematics against differences of poses, torques against the principle of virtual work, power
//! against the rate of energy. None of these uses a recursion of the algorithm that it checks; body
//! data come from the description of the tree, not from the tree.

use nalgebra::{Matrix3, Vector3};
use surefoot::dynamics::{
    Kinematics, body_poses, body_velocities, forward_kinematics, inverse_dynamics, joint_poses,
    position_rates,
};
use surefoot::model::Tree;
use surefoot::spatial::{Pose, Twist, Wrench};
use surefoot_tests::random_trees::{Body, N, floating, grounded, positions, random, symmetric};
use surefoot_tests::vectors::relative_error;

/// Half-width of second-order central differences: truncation ~ h² = 1e-10, round-off ~ 1e-16/h.
const H: f64 = 1e-5;

/// `(q + s θ̇, β + s β̇)`.
struct Motion<'a, const NQ: usize, const NV: usize> {
    tree: &'a Tree<f64, N, NQ, NV>,
    q: [f64; NQ],
    v: [f64; NV],
    a: [f64; NV],
}

impl<const NQ: usize, const NV: usize> Motion<'_, NQ, NV> {
    fn at(&self, s: f64) -> ([Pose<f64>; N], [Twist<f64>; N]) {
        let rates = position_rates(self.tree, &self.q, &self.v);
        let q = std::array::from_fn(|i| self.q[i] + s * rates[i]);
        let v = std::array::from_fn(|i| self.v[i] + s * self.a[i]);
        let poses = joint_poses(self.tree, &q).expect("near a valid state");
        (body_poses(self.tree, &poses), body_velocities(self.tree, &poses, &v))
    }
}

/// Body twist from poses before and after: `(Rᵀ ṗ, (Rᵀ Ṙ)ˇ)`.
fn difference(before: &Pose<f64>, now: &Pose<f64>, after: &Pose<f64>) -> Twist<f64> {
    let p = (after.position - before.position) / (2.0 * H);
    let r: Matrix3<f64> = now.rotation.transpose() * (after.rotation - before.rotation) / (2.0 * H);
    Twist {
        linear: now.rotation.transpose() * p,
        angular: Vector3::new(r.m32 - r.m23, r.m13 - r.m31, r.m21 - r.m12) * 0.5,
    }
}

/// `M V̇ + Ω M V` of a free body (3.15), less gravity: the wrench on it from all else.
fn free_body_wrench(
    body: &Body,
    k: usize,
    kinematics: &Kinematics<f64, N>,
    gravity: Vector3<f64>,
) -> Wrench<f64> {
    let (v, a) = (kinematics[k].velocity, kinematics[k].acceleration);
    let inertia = Matrix3::from_diagonal(&Vector3::from(body.inertia));
    let weight = kinematics[k].pose.rotation.transpose() * gravity * body.mass;
    Wrench {
        force: (a.linear + v.angular.cross(&v.linear)) * body.mass - weight,
        torque: inertia * a.angular + v.angular.cross(&(inertia * v.angular)),
    }
}

fn energy(
    bodies: &[Body; N],
    poses: &[Pose<f64>; N],
    twists: &[Twist<f64>; N],
    gravity: Vector3<f64>,
) -> f64 {
    bodies
        .iter()
        .zip(poses.iter().zip(twists))
        .map(|(body, (pose, twist))| {
            let inertia = Vector3::from(body.inertia);
            0.5 * body.mass * twist.linear.norm_squared()
                + 0.5 * twist.angular.dot(&inertia.component_mul(&twist.angular))
                - body.mass * gravity.dot(&pose.position)
        })
        .sum()
}

/// Largest errors: velocity, acceleration, torque, power.
fn check<const NQ: usize, const NV: usize>(
    rng: &mut rand_pcg::Pcg64,
    tree: &Tree<f64, N, NQ, NV>,
    bodies: &[Body; N],
) -> [f64; 4] {
    let q = positions(rng, tree);
    let motion = Motion { tree, q, v: symmetric(rng), a: symmetric(rng) };
    let relative = joint_poses(tree, &q).expect("a valid state");
    let kinematics = forward_kinematics(tree, &relative, &motion.v, &motion.a);
    let (before, after) = (motion.at(-H), motion.at(H));
    let mut errors = [0.0_f64; 4];

    for k in 0..N {
        let seen = difference(&before.0[k], &kinematics[k].pose, &after.0[k]);
        let ours = kinematics[k].velocity.to_array();
        errors[0] = errors[0].max(relative_error(&ours, &seen.to_array()));
        let seen = (after.1[k] - before.1[k]) * (0.5 / H);
        let ours = kinematics[k].acceleration.to_array();
        errors[1] = errors[1].max(relative_error(&ours, &seen.to_array()));
    }

    // τ_i = Σ_k (∂V_k/∂β_i)ᵀ F_k
    let applied: [Wrench<f64>; N] =
        std::array::from_fn(|_| Wrench::from_array(symmetric::<6>(rng)));
    let needed: [Wrench<f64>; N] = std::array::from_fn(|k| {
        free_body_wrench(&bodies[k], k, &kinematics, tree.gravity()) - applied[k]
    });
    let virtual_work: Vec<f64> = (0..NV)
        .map(|i| {
            let mut unit = [0.0; NV];
            unit[i] = 1.0;
            let twists = body_velocities(tree, &relative, &unit);
            twists.iter().zip(&needed).map(|(v, f)| v.power(*f)).sum()
        })
        .collect();
    let torques = inverse_dynamics(tree, &relative, &motion.v, &motion.a, Some(&applied));
    errors[2] = relative_error(&torques, &virtual_work);

    // Power of torques and wrenches = rate of kinetic and potential energy.
    let g = tree.gravity();
    let rate = (energy(bodies, &after.0, &after.1, g) - energy(bodies, &before.0, &before.1, g))
        / (2.0 * H);
    let power = torques.iter().zip(&motion.v).map(|(t, v)| t * v).sum::<f64>()
        + kinematics.iter().zip(&applied).map(|(body, f)| body.velocity.power(*f)).sum::<f64>();
    errors[3] = relative_error(&[power], &[rate]);
    errors
}

#[test]
fn kinematics_torques_and_power_on_random_trees() {
    let mut rng = random(4);
    let mut worst = [0.0_f64; 4];
    for _ in 0..100 {
        let (tree, bodies) = floating(&mut rng);
        let errors = check(&mut rng, &tree, &bodies);
        worst = std::array::from_fn(|i| worst[i].max(errors[i]));
        let (tree, bodies) = grounded(&mut rng);
        let errors = check(&mut rng, &tree, &bodies);
        worst = std::array::from_fn(|i| worst[i].max(errors[i]));
    }
    println!("velocity, acceleration, torque, power: {worst:?}");
    // Differences are good to ~1e-8; virtual work uses none.
    assert!(worst[0] < 1e-7 && worst[1] < 1e-7 && worst[3] < 1e-7, "{worst:?}");
    assert!(worst[2] < 1e-12, "{worst:?}");
}
