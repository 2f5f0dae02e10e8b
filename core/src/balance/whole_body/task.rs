//! What a robot is asked to do in a tick while feet lift and land: what a planner hands the controller.

use nalgebra::Vector3;

/// Wanted motion of the whole, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionTask<T, const FEET: usize> {
    /// Of the centre of mass.
    pub linear: LinearTask<T>,
    /// Of its rotation.
    pub angular: AngularTask<T>,
    /// What each foot does.
    pub feet: [FootTask<T>; FEET],
}

/// How the centre of mass is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinearTask<T> {
    /// By its acceleration, m/s²: the sum of the ground's forces.
    CenterOfMass(Vector3<T>),
    /// By where the ground's forces act, so that what a swinging leg takes does not lean the robot.
    CenterOfPressure {
        /// Wanted centre of pressure, m; the height is that of the pressing feet.
        point: [T; 2],
        /// Wanted vertical acceleration of the centre of mass, m/s².
        vertical: T,
        /// What a distance between wanted and made centre of pressure counts as, 1/s²: `g/z` makes it the
        /// horizontal acceleration of the centre of mass, at the height `z` above the feet.
        per_length: T,
    },
    /// Not at all: no foot presses.
    Free,
}

/// What is driven of the rotation, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AngularTask<T> {
    /// The central body's angular acceleration, rad/s².
    CentralBody(Vector3<T>),
    /// The angular momentum of the whole about its centre of mass: what it takes along into a flight. The moments of
    /// the feet that press alone change it.
    Momentum {
        /// Wanted rate of change, N·m.
        rate: Vector3<T>,
        /// What divides an error of it to count like an angular acceleration, kg·m²; positive.
        inertia: T,
    },
}

/// What a foot does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FootTask<T> {
    /// It presses.
    Press {
        /// Greatest normal force that it may take, N; infinite where nothing but its limits says so.
        most_force: T,
    },
    /// It swings with this acceleration of its reference point, softly.
    Swing {
        /// m/s²
        linear: Vector3<T>,
        /// rad/s²; not read for a foot that is a point.
        angular: Vector3<T>,
    },
}

/// What the model tells of the motion at a measured state: all that a planner may know of the robot.
/// World axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservedMotion<T, const FEET: usize> {
    /// Centre of mass, m.
    pub center_of_mass: Vector3<T>,
    /// Its velocity, m/s.
    pub velocity: Vector3<T>,
    /// Angular momentum about it, N·m·s.
    pub angular_momentum: Vector3<T>,
    /// World axes from those of the central body.
    pub central_rotation: nalgebra::Matrix3<T>,
    /// Of the central body, rad/s.
    pub angular_velocity: Vector3<T>,
    /// The feet; of one that the robot does not have, zeros.
    pub feet: [ObservedFoot<T>; FEET],
}

/// A foot of [`ObservedMotion`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservedFoot<T> {
    /// Reference point, m.
    pub position: Vector3<T>,
    /// World axes from sole axes; for a point the world's own.
    pub rotation: nalgebra::Matrix3<T>,
    /// Of the reference point, m/s.
    pub velocity: Vector3<T>,
    /// rad/s
    pub angular_velocity: Vector3<T>,
    /// From the leg's first joint (hip) to its last (ankle), or to the reference point of a point foot, m.
    pub leg: Vector3<T>,
}
