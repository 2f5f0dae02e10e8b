//! One body and the joint that carries it, as a person describes them.

use super::GeneralJoint;

/// What joins a link to its inboard link.
#[derive(Clone, Copy, Debug)]
pub(super) enum Connection {
    Fixed,
    Revolute { axis: [f64; 3], point: [f64; 3] },
    Prismatic { axis: [f64; 3] },
    Spherical { point: [f64; 3] },
    Floating,
    General { point: [f64; 3], joint: GeneralJoint },
}

/// A body with its joint, in the home configuration. Lengths in metres, masses in kilograms,
/// directions and points in the one frame that describes the whole tree (the inertial frame at home).
///
/// `inboard` is the number of the inboard link: 0 for the inertial frame, else 1 for the first link
/// of the list, and so on, as the dissertation numbers them; it must be less than the link's own.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    pub(super) inboard: usize,
    pub(super) connection: Connection,
    pub(super) mass: f64,
    pub(super) inertia: [f64; 6],
    pub(super) center: [f64; 3],
    pub(super) orientation: [f64; 4],
    pub(super) rotor_inertia: f64,
}

impl Link {
    const fn on(inboard: usize, connection: Connection) -> Self {
        Self {
            inboard,
            connection,
            mass: 0.0,
            inertia: [0.0; 6],
            center: [0.0; 3],
            orientation: [1.0, 0.0, 0.0, 0.0],
            rotor_inertia: 0.0,
        }
    }

    /// Fixed to the inboard link.
    pub const fn fixed(inboard: usize) -> Self {
        Self::on(inboard, Connection::Fixed)
    }

    /// Turning about `axis` (of any length but zero) through `point`.
    pub const fn revolute(inboard: usize, axis: [f64; 3], point: [f64; 3]) -> Self {
        Self::on(inboard, Connection::Revolute { axis, point })
    }

    /// Sliding along `axis` (of any length but zero).
    pub const fn prismatic(inboard: usize, axis: [f64; 3]) -> Self {
        Self::on(inboard, Connection::Prismatic { axis })
    }

    /// Turning about `point` in any direction.
    pub const fn spherical(inboard: usize, point: [f64; 3]) -> Self {
        Self::on(inboard, Connection::Spherical { point })
    }

    /// Free to move. The joint's coordinates are the pose of the body frame in the inboard frame.
    pub const fn floating(inboard: usize) -> Self {
        Self::on(inboard, Connection::Floating)
    }

    /// Joined at `point` by a joint of the user's own.
    pub const fn general(inboard: usize, point: [f64; 3], joint: GeneralJoint) -> Self {
        Self::on(inboard, Connection::General { point, joint })
    }

    /// The body: its mass, its principal inertias (kg·m²) about the centre of mass, and where the
    /// centre of mass is.
    pub const fn body(self, mass: f64, principal: [f64; 3], center: [f64; 3]) -> Self {
        let [x, y, z] = principal;
        Self { mass, inertia: [x, y, z, 0.0, 0.0, 0.0], center, ..self }
    }

    /// The body with a full inertia tensor `[xx, yy, zz, yz, zx, xy]` about its centre of mass, in
    /// the axes of the body frame.
    pub const fn body_with_products(self, mass: f64, inertia: [f64; 6], center: [f64; 3]) -> Self {
        Self { mass, inertia, center, ..self }
    }

    /// The body frame's orientation at home as a unit quaternion, scalar first (default: that of the
    /// describing frame).
    pub const fn oriented(self, orientation: [f64; 4]) -> Self {
        Self { orientation, ..self }
    }

    /// The inertia of the joint's motor and gear, reflected to the joint: rotor inertia times the
    /// square of the gear ratio, kg·m² (a mass in kg, for a joint that slides). Also called armature.
    /// Default: none. Only joints that turn or slide can have one.
    ///
    /// It resists the joint's acceleration and nothing else: torque gains `I θ̈`, the mass matrix `I` on
    /// its diagonal. What a rotor weighs belongs to the body that carries it. Left out, as usual, is
    /// what is smaller by the gear ratio: gyroscopic torques of the rotor, and its part in the angular
    /// momentum of the body that carries it.
    pub const fn rotor_inertia(self, rotor_inertia: f64) -> Self {
        Self { rotor_inertia, ..self }
    }
}
