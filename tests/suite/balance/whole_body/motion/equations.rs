//! What a command says of itself is what the equations of motion make of it, and it is the optimum of what
//! is minimised.

use super::{Play, asked_turn};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use surefoot::balance::{ContactPatch, FootTask, LinearTask, WholeBodyCommand, WholeBodySettings};
use surefoot::dynamics::{
    BodyKinematics, forward_dynamics, forward_kinematics, joint_poses, mass_matrix,
};
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_tests::legged_trees::{Legged, five, quadruped, seven};
use surefoot_tests::random_trees::random;

/// Classical acceleration of a foot's point and its angular one, world axes.
fn foot_acceleration(body: &BodyKinematics<f64>, r: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let (v, a) = (body.velocity, body.acceleration);
    let velocity = v.linear + v.angular.cross(r);
    let linear = a.linear + a.angular.cross(r) + v.angular.cross(&velocity);
    [body.pose.rotation * linear, body.pose.rotation * a.angular]
}

/// Directions that a foot's contact has, as rows of six, world axes.
fn directions(patch: &ContactPatch<f64>, foot: &Matrix3<f64>) -> Vec<[f64; 6]> {
    let mut all: Vec<[f64; 6]> =
        (0..3).map(|k| std::array::from_fn(|i| f64::from(i == k))).collect();
    for (k, free) in patch.moments().into_iter().enumerate() {
        if free {
            let axis = foot.column(k);
            all.push([0.0, 0.0, 0.0, axis[0], axis[1], axis[2]]);
        }
    }
    all
}

/// Axes of a contact: of a sole its own, of an edge along x the edge and an upright normal.
fn contact_axes(patch: &ContactPatch<f64>, sole: &Matrix3<f64>) -> Matrix3<f64> {
    match patch.moments() {
        [true, true, true] => *sole,
        [false, false, false] => Matrix3::identity(),
        _ => {
            let edge = sole.column(0).into_owned();
            let across = Vector3::z().cross(&edge).normalize();
            Matrix3::from_columns(&[edge, across, edge.cross(&across)])
        }
    }
}

#[derive(Default, Debug)]
struct Found {
    /// Of accelerations from those of the forward dynamics, relative to the greatest.
    forward: f64,
    /// Of a pressing foot's acceleration from its coming to rest.
    rest: f64,
    /// Of the objective's slope along any unknown, relative to its parts.
    slope: f64,
    /// Greatest deviation of a swinging foot, m/s².
    deviation: f64,
    limited: usize,
    free: usize,
}

/// The dynamics' residual, and what pressing feet do.
fn check<const N: usize, const NQ: usize, const NV: usize>(
    at: &Play<N, NQ, NV>,
    command: &WholeBodyCommand<f64, 4, NV>,
    found: &mut Found,
) {
    let Legged { tree, feet, .. } = &at.robot;
    let poses = joint_poses(tree, &at.state.positions).expect("a configuration");
    let kinematics = forward_kinematics(tree, &poses, &at.state.velocities, &command.accelerations);
    let central = kinematics[0].pose.rotation;
    let mut external = [Wrench::zero(); N];
    for (number, foot) in feet.iter().enumerate() {
        let Some(foot) = foot else { continue };
        let body = &kinematics[foot.body];
        let w = command.foot_wrenches[number];
        let to_body = body.pose.rotation.transpose() * central;
        let w = Wrench { force: to_body * w.force, torque: to_body * w.torque };
        external[foot.body] = w.shifted(foot.reference);
        let [linear, angular] = foot_acceleration(body, &foot.reference);
        let (v, r) = (body.velocity, foot.reference);
        let velocity = body.pose.rotation * (v.linear + v.angular.cross(&r));
        let rate = body.pose.rotation * v.angular;
        match at.task.feet[number] {
            FootTask::Press { .. } => {
                let axes = contact_axes(&foot.limits.patch, &at.motion.feet[number].rotation);
                let left = linear + velocity * at.settings.rest_rate;
                found.rest = found.rest.max(left.amax());
                let turn = axes.tr_mul(&(angular + rate * at.settings.rest_rate));
                for (x, free) in turn.iter().zip(foot.limits.patch.moments()) {
                    found.rest = found.rest.max(if free { x.abs() } else { 0.0 });
                }
            }
            FootTask::Swing { linear: wanted, .. } => {
                assert_eq!(w.force.norm() + w.torque.norm(), 0.0);
                found.deviation = found.deviation.max((linear - wanted).norm());
            }
        }
    }
    let forward =
        forward_dynamics(tree, &poses, &at.state.velocities, &command.torques, Some(&external))
            .expect("a body moves");
    let most = forward.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    for (a, b) in forward.iter().zip(command.accelerations) {
        found.forward = found.forward.max((a - b).abs() / most);
    }
}

/// Slopes of the stated objective along every unknown, from dense equations of motion: an unknown's response
/// is what accelerations and torques follow it where all others stay.
fn slopes<const N: usize, const NQ: usize, const NV: usize>(
    at: &Play<N, NQ, NV>,
    command: &WholeBodyCommand<f64, 4, NV>,
    found: &mut Found,
) {
    let Legged { tree, feet, .. } = &at.robot;
    let poses = joint_poses(tree, &at.state.positions).expect("a configuration");
    let masses = mass_matrix(tree, &poses);
    let masses = DMatrix::from_fn(NV, NV, |i, j| masses[i][j]);
    let mass = tree.mass();
    // Accelerations are affine in those of the joints: columns by difference.
    let kinematics = |accelerations: &[f64; NV]| {
        forward_kinematics(tree, &poses, &at.state.velocities, accelerations)
    };
    let still = kinematics(&[0.0; NV]);
    let moved: Vec<_> =
        (0..NV).map(|j| kinematics(&std::array::from_fn(|i| f64::from(i == j)))).collect();
    let mut jacobians = Vec::new();
    for (number, foot) in feet.iter().enumerate() {
        let Some(foot) = foot else { continue };
        let r = &foot.reference;
        let axes = contact_axes(&foot.limits.patch, &at.motion.feet[number].rotation);
        let rows = directions(&foot.limits.patch, &axes);
        let zero = foot_acceleration(&still[foot.body], r);
        let jacobian = DMatrix::from_fn(rows.len(), NV, |i, j| {
            let one = foot_acceleration(&moved[j][foot.body], r);
            let (a, b) = (one[0] - zero[0], one[1] - zero[1]);
            let [x, y, z, p, q, s] = rows[i];
            Vector3::new(x, y, z).dot(&a) + Vector3::new(p, q, s).dot(&b)
        });
        jacobians.push((number, rows, jacobian));
    }
    let mut leg = [false; NV];
    for (number, _, _) in &jacobians {
        at.model.leg(*number).for_each(|joint| leg[joint] = true);
    }
    // Unknowns of the response: accelerations and torques of joints.
    let size = 2 * NV - 6;
    let mut equations = DMatrix::zeros(size, size);
    equations.view_mut((0, 0), (NV, NV)).copy_from(&masses);
    for k in 6..NV {
        equations[(k, NV + k - 6)] = -1.0;
    }
    let mut row = NV;
    let mut first_rows = Vec::new();
    for (_, rows, jacobian) in &jacobians {
        first_rows.push(row);
        equations.view_mut((row, 0), (rows.len(), NV)).copy_from(jacobian);
        row += rows.len();
    }
    for (k, is_leg) in leg.iter().enumerate().skip(6) {
        if !is_leg {
            equations[(row, k)] = 1.0;
            row += 1;
        }
    }
    assert_eq!(row, size, "legs have as many joints as contacts have directions");
    let equations = equations.lu();
    // What the task lacks.
    let weights = &at.settings.motion;
    let central = at.motion.central_rotation;
    let all = DVector::from_column_slice(&command.accelerations);
    let of_center = |accelerations: &DVector<f64>| {
        let force = masses.rows(0, 3) * accelerations;
        central * Vector3::new(force[0], force[1], force[2]) / mass
    };
    let turn = |a: &DVector<f64>| central * Vector3::new(a[3], a[4], a[5]);
    // The sum of forces, and the moment about a wanted centre of pressure, of wrenches given by foot.
    let of_task = |forces: &[(usize, [Vector3<f64>; 2])]| {
        let sum = forces.iter().fold(Vector3::zeros(), |sum, (_, [f, _])| sum + f) / mass;
        match at.task.linear {
            LinearTask::CenterOfPressure { point: [x, y], per_length, .. } => {
                let moment = forces.iter().fold([0.0; 2], |[a, b], (foot, [f, n])| {
                    let p = at.motion.feet[*foot].position;
                    [a + n.y - (p.x - x) * f.z, b - n.x - (p.y - y) * f.z]
                });
                let scale = per_length / (mass * 9.81);
                Vector3::new(moment[0] * scale, moment[1] * scale, sum.z)
            }
            LinearTask::CenterOfMass(_) => sum,
            LinearTask::Free => Vector3::zeros(),
        }
    };
    let made: Vec<_> = (0..4)
        .map(|foot| {
            let w = command.foot_wrenches[foot];
            (foot, [central * w.force, central * w.torque])
        })
        .collect();
    let goal = match at.task.linear {
        LinearTask::CenterOfMass(a) => a + Vector3::z() * 9.81,
        LinearTask::CenterOfPressure { vertical, .. } => Vector3::z() * (vertical + 9.81),
        LinearTask::Free => Vector3::zeros(),
    };
    let linear_error = of_task(&made) - goal;
    let angular_error = turn(&all) - asked_turn(&at.task);
    let bodies = kinematics(&command.accelerations);
    let square = mass * mass;
    for ((number, rows, jacobian), first) in jacobians.iter().zip(first_rows) {
        let foot = feet[*number].as_ref().expect("a foot");
        let presses = at.presses(*number);
        for (k, direction) in rows.iter().enumerate() {
            let [x, y, z, p, q, s] = *direction;
            let (lin, ang) = (Vector3::new(x, y, z), Vector3::new(p, q, s));
            let mut right = DVector::zeros(size);
            if presses {
                right.rows_mut(0, NV).copy_from(&jacobian.row(k).transpose());
            } else {
                right[first + k] = 1.0;
            }
            let response = equations.solve(&right).expect("regular");
            let response = response.rows(0, NV).into_owned();
            let mut parts = vec![weights.angular * square * angular_error.dot(&turn(&response))];
            if presses {
                let unit = [(*number, [lin, ang])];
                parts.push(weights.linear * square * linear_error.dot(&of_task(&unit)));
                let [f, n] = made[*number].1;
                let length = weights.norm_length;
                parts
                    .push(weights.regularization * (f.dot(&lin) + n.dot(&ang) / (length * length)));
                if matches!(at.task.linear, LinearTask::CenterOfMass(_)) {
                    // The sum of forces is what accelerates the centre of mass.
                    let difference = of_center(&response) - lin / mass;
                    assert!(difference.norm() < 1e-9, "{difference}");
                }
            } else {
                let FootTask::Swing { linear, angular } = at.task.feet[*number] else { continue };
                let made = foot_acceleration(&bodies[foot.body], &foot.reference);
                parts.push(weights.swing_linear * square * (made[0] - linear).dot(&lin));
                parts.push(weights.swing_angular * square * (made[1] - angular).dot(&ang));
            }
            let scale = parts.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            found.slope = found.slope.max(parts.iter().sum::<f64>().abs() / scale);
        }
    }
}

fn survey<const N: usize, const NQ: usize, const NV: usize>(
    seed: u64,
    is_square: bool,
    make: impl Fn(&mut rand_pcg::Pcg64) -> Legged<N, NQ, NV>,
) -> Found {
    let mut rng = random(seed);
    let mut found = Found::default();
    for round in 0..150 {
        let robot = make(&mut rng);
        let at = Play::new(&mut rng, robot, [0.02, 0.3, 1.0][round % 3]);
        let command = at.command(&at.settings);
        assert!(command.limits.singular.iter().all(Option::is_none));
        check(&at, &command, &mut found);
        if command.limits.is_limited() {
            found.limited += 1;
        } else {
            found.free += 1;
            if is_square {
                slopes(&at, &command, &mut found);
            }
        }
    }
    found
}

#[test]
fn commands_obey_the_equations_of_motion_and_are_optimal() {
    let all = [survey(1, true, quadruped), survey(2, true, five), survey(3, false, seven)];
    for found in all {
        // Measured: 1.8e-12, 8.5e-14, 4.5e-12.
        assert!(found.forward < 5e-12 && found.rest < 5e-13 && found.slope < 2e-11, "{found:?}");
        assert!(found.free > 20 && found.limited > 20 && found.deviation > 0.1, "{found:?}");
    }
}

#[test]
fn in_flight_gravity_alone_acts() {
    let mut rng = random(8);
    let mut most = [0.0_f64; 2];
    for round in 0..60 {
        let robot = seven(&mut rng);
        let mut at = Play::new(&mut rng, robot, [0.1, 1.0][round % 2]);
        let swing = |rng: &mut _| FootTask::Swing {
            linear: super::vector(rng, 5.0),
            angular: super::vector(rng, 10.0),
        };
        at.task.feet = std::array::from_fn(|_| swing(&mut rng));
        at.task.linear = LinearTask::Free;
        let command = at.command(&at.settings);
        for w in command.foot_wrenches {
            assert_eq!(w.force.norm() + w.torque.norm(), 0.0);
        }
        // The motion a moment later and a moment before.
        let h = 1e-4;
        let [after, before] = [h, -h].map(|h| {
            let mut next = at.clone();
            let v = &at.state.velocities;
            for (k, (v, a)) in
                next.state.velocities.iter_mut().zip(command.accelerations).enumerate()
            {
                *v += h * a;
                if k >= 6 {
                    next.state.positions[k + 1] += h * at.state.velocities[k] + 0.5 * h * h * a;
                }
            }
            let q = Quaternion::from_array(std::array::from_fn(|k| at.state.positions[3 + k]));
            let rate = Vector3::new(v[3], v[4], v[5]);
            let a = &command.accelerations;
            let turn = rate * h + Vector3::new(a[3], a[4], a[5]) * (0.5 * h * h);
            let turned = q.product(Quaternion::from_rotation_vector(turn));
            next.state.positions[3..7].copy_from_slice(&turned.to_array());
            next.observed()
        });
        let momentum = (after.angular_momentum - before.angular_momentum) / (2.0 * h);
        let fall = (after.velocity - before.velocity) / (2.0 * h) + Vector3::z() * 9.81;
        most[0] = most[0].max(momentum.norm() / (1.0 + at.motion.angular_momentum.norm()));
        most[1] = most[1].max(fall.norm());
    }
    // What differences over 0.1 ms leave: 1.3e-5, 1.2e-6.
    assert!(most[0] < 5e-5 && most[1] < 5e-6, "{most:?}");
}

#[test]
fn weights_that_cannot_be_are_refused() {
    let good = WholeBodySettings::<f64, 18>::scaled(0.8, 9.81, 2);
    assert!(good.check().is_ok());
    for spoil in [
        (|m: &mut WholeBodySettings<f64, 18>| m.motion.regularization = 0.0) as fn(&mut _),
        |m| m.motion.swing_linear = -1.0,
        |m| m.motion.angular = f64::NAN,
    ] {
        let mut bad = good;
        spoil(&mut bad);
        assert!(bad.check().is_err());
    }
}
