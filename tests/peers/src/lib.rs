//! The peer dynibo (Rust, needs std) on the dissertation's biped, with inputs translated to its
//! conventions: angular part first, base velocity and acceleration classical and in the world.

use dynibo::{BaseState, FloatingRobot, Frame, Twist};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

/// dynibo's biped at one state, with its output buffers.
pub struct Peer {
    robot: FloatingRobot,
    base: BaseState,
    q: [f64; 12],
    qd: [f64; 12],
    qdd: [f64; 18],
    output: [f64; 18],
    matrix: [f64; 324],
    frames: [Frame; 13],
    /// Our number of each of its joints: it numbers the tree level by level.
    order: [usize; 12],
}

impl Peer {
    /// At the state and acceleration that `surefoot` calls `(positions, velocities, accelerations)`.
    ///
    /// # Panics
    /// If dynibo does not take the biped's URDF or the state.
    pub fn new(positions: &[f64; 19], velocities: &[f64; 18], accelerations: &[f64; 18]) -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/biped.urdf");
        let robot = FloatingRobot::from_urdf(path).expect("dynibo reads the biped");
        let q = positions;
        // joint_2 is our joint 0.
        let order = std::array::from_fn(|i| {
            let name = robot.joint_name(i).expect("twelve joints");
            let number: usize = name.trim_start_matches("joint_").parse().expect("a number");
            number - 2
        });
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q[3], q[4], q[5], q[6]));
        let frame = Isometry3::from_parts(Translation3::new(q[0], q[1], q[2]), rotation);
        let vector = |a: &[f64]| Vector3::new(a[0], a[1], a[2]);
        let (v, w) = (vector(velocities), vector(&velocities[3..]));
        let (v_dot, w_dot) = (vector(accelerations), vector(&accelerations[3..]));
        let velocity = Twist { linear: rotation * v, angular: rotation * w };
        let classical = rotation * (v_dot + w.cross(&v));
        let acceleration = Twist { linear: classical, angular: rotation * w_dot };
        let base = BaseState::new(frame, velocity, acceleration).expect("a finite state");
        let mut qdd = [0.0; 18];
        qdd[..3].copy_from_slice((rotation * w_dot).as_slice());
        qdd[3..6].copy_from_slice(classical.as_slice());
        for (to, from) in qdd[6..].iter_mut().zip(order) {
            *to = accelerations[6 + from];
        }
        Self {
            robot,
            base,
            q: order.map(|i| positions[7 + i]),
            qd: order.map(|i| velocities[6 + i]),
            qdd,
            output: [0.0; 18],
            matrix: [0.0; 324],
            frames: [Frame::identity(); 13],
            order,
        }
    }

    /// Our number of each of dynibo's joints.
    pub fn order(&self) -> [usize; 12] {
        self.order
    }

    /// Generalized forces, base first (angular, linear).
    ///
    /// # Panics
    /// If dynibo reports an error.
    pub fn inverse_dynamics(&mut self) -> &[f64; 18] {
        let Self { robot, base, q, qd, qdd, output, .. } = self;
        robot.inverse_dynamics(base, q, qd, &qdd[6..], &[], output).expect("regular");
        output
    }

    /// Generalized accelerations for generalized forces (base first).
    ///
    /// # Panics
    /// If dynibo reports an error.
    pub fn forward_dynamics(&mut self, forces: &[f64; 18]) -> &[f64; 18] {
        let Self { robot, base, q, qd, output, .. } = self;
        robot.forward_dynamics(base, q, qd, forces, &[], output).expect("regular");
        output
    }

    /// The mass matrix, by rows.
    ///
    /// # Panics
    /// If dynibo reports an error.
    pub fn mass_matrix(&mut self) -> &[f64; 324] {
        let Self { robot, base, q, matrix, .. } = self;
        robot.mass_matrix(base, q, matrix).expect("regular");
        matrix
    }

    /// Poses of all links; dynibo has no call for the velocities and accelerations of all.
    ///
    /// # Panics
    /// If dynibo reports an error.
    pub fn poses(&mut self) -> &[Frame; 13] {
        let Self { robot, base, q, frames, .. } = self;
        robot.forward_kinematics_all(base, q, frames).expect("regular");
        frames
    }
}

#[cfg(test)]
mod tests {
    use super::Peer;
    use surefoot::dynamics::{inverse_dynamics, joint_poses};
    use surefoot::model::robots::biped;

    /// The peer does the same work: under its gravity, its joint torques are ours.
    #[test]
    fn the_peer_agrees() {
        let tree = biped::TREE.with_gravity([0.0, 0.0, -9.806_65]);
        let mut q: [f64; 19] = std::array::from_fn(|i| 0.3 * (1.7 * i as f64).sin());
        q[3..7].copy_from_slice(&[0.5, -0.5, 0.5, 0.5]);
        let v: [f64; 18] = std::array::from_fn(|i| (0.9 * i as f64).cos());
        let a: [f64; 18] = std::array::from_fn(|i| (1.1 * i as f64).sin());
        let poses = joint_poses(&tree, &q).expect("valid");
        let ours = inverse_dynamics(&tree, &poses, &v, &a, None);
        let mut peer = Peer::new(&q, &v, &a);
        let order = peer.order();
        for (their, our) in peer.inverse_dynamics()[6..].iter().zip(order) {
            assert!((their - ours[6 + our]).abs() < 1e-9, "joint {our}: {their} {}", ours[6 + our]);
        }
    }
}
