//! What a command says of itself is what the equations of motion make of it.

use super::{command, reference, state};
use surefoot::balance::{WholeBodyCommand, WholeBodySettings, WholeBodyState};
use surefoot::dynamics::{forward_dynamics, forward_kinematics, joint_poses};
use surefoot::spatial::Wrench;
use surefoot_tests::legged_trees::{Legged, five, quadruped, seven};
use surefoot_tests::random_trees::random;

/// Greatest differences, and how often something bound.
#[derive(Default, Debug)]
struct Found {
    /// Of accelerations from those of the forward dynamics, relative to the greatest.
    forward: f64,
    /// Of a pressing foot's acceleration from the one asked for, in the directions of its contact.
    feet: f64,
    /// Of the central body's acceleration from the wanted one, where nothing binds, relative.
    body: f64,
    limited: usize,
    free: usize,
}

fn check<const N: usize, const NQ: usize, const NV: usize>(
    robot: &Legged<N, NQ, NV>,
    state: &WholeBodyState<f64, NQ, NV>,
    settings: &WholeBodySettings<f64, NV>,
    command: &WholeBodyCommand<f64, 4, NV>,
    found: &mut Found,
) {
    let poses = joint_poses(&robot.tree, &state.positions).expect("a configuration");
    let kinematics =
        forward_kinematics(&robot.tree, &poses, &state.velocities, &command.accelerations);
    let central = kinematics[0].pose.rotation;
    let mut external = [Wrench::zero(); N];
    for (foot, w) in robot.feet.iter().zip(command.foot_wrenches) {
        let Some(foot) = foot else { continue };
        let body = &kinematics[foot.body];
        let to_body = body.pose.rotation.transpose() * central;
        let w = Wrench { force: to_body * w.force, torque: to_body * w.torque };
        external[foot.body] = w.shifted(foot.reference);
        // The point's velocity and acceleration, world axes.
        let (v, a) = (body.velocity, body.acceleration);
        let velocity = v.linear + v.angular.cross(&foot.reference);
        let linear = a.linear + a.angular.cross(&foot.reference) + v.angular.cross(&velocity);
        let left = body.pose.rotation * (linear + velocity * settings.rest_rate);
        found.feet = found.feet.max(left.amax());
        let turn = a.angular + v.angular * settings.rest_rate;
        match foot.limits.patch {
            patch if patch == surefoot::balance::ContactPatch::point() => {}
            // The edge is the body's x at home; its turn about that is nobody's.
            patch if patch == surefoot::balance::ContactPatch::edge_along_x(0.18) => {
                found.feet = found.feet.max(turn.y.abs()).max(turn.z.abs());
            }
            _ => found.feet = found.feet.max(turn.amax()),
        }
    }
    let forward =
        forward_dynamics(&robot.tree, &poses, &state.velocities, &command.torques, Some(&external))
            .expect("a body moves");
    let most = forward.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (a, b) in forward.iter().zip(command.accelerations) {
        found.forward = found.forward.max((a - b).abs() / most);
    }
}

fn survey<const N: usize, const NQ: usize, const NV: usize>(
    seed: u64,
    make: impl Fn(&mut rand_pcg::Pcg64) -> Legged<N, NQ, NV>,
) -> Found {
    let mut rng = random(seed);
    let mut found = Found::default();
    for round in 0..300 {
        let robot = make(&mut rng);
        let share = [0.02, 0.3, 1.0][round % 3];
        let state = state(&mut rng, &robot, share);
        let mut reference = reference(&mut rng, share);
        reference.position = nalgebra::Vector3::from_row_slice(&state.positions[..3]);
        let settings =
            WholeBodySettings { posture: robot.stance, ..WholeBodySettings::scaled(0.8, 9.81, 4) };
        let command =
            command(&robot.tree, &robot.feet, &settings, &state, &reference).expect("torques");
        assert!(command.limits.singular.iter().all(Option::is_none));
        check(&robot, &state, &settings, &command, &mut found);
        match command.limits.is_limited() {
            true => found.limited += 1,
            false => {
                found.free += 1;
                let size = command.desired_wrench.force.norm();
                let left = command.limits.given_up;
                found.body =
                    found.body.max(left.force.norm() / size).max(left.torque.norm() / size);
            }
        }
    }
    found
}

#[test]
fn accelerations_and_contact_forces_obey_the_equations_of_motion() {
    // Of the body: points and edges leave 1e-6 to moments that no foot can make, soles nothing.
    for (found, body) in
        [(survey(1, quadruped), 3e-6), (survey(2, five), 5e-6), (survey(3, seven), 1e-13)]
    {
        // Measured: 1.2e-12, 1.8e-13.
        assert!(found.forward < 5e-12 && found.feet < 1e-12, "{found:?}");
        assert!(found.body < body, "{found:?}");
        assert!(found.free > 30 && found.limited > 30, "{found:?}");
    }
}
