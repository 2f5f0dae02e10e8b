//! How near a run came to its limits.

use super::support::{hull, inside};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use surefoot_sim::closed_loop::Run;
use surefoot_sim::plant::PlantState;
use surefoot_sim::record::Sample;
use surefoot_sim::robot::Robot;
use surefoot_sim::scene::{Feet, Scene};

/// The least over a run; 1 is unloaded, 0 at the limit, below 0 beyond it. None where the run has no such limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Margins {
    /// Of all joints: 1 − |τ|/τ_max, with the motors' limits, or those of the robot's description.
    pub torque: Option<f64>,
    /// Of all feet that carry more than [`CARRIES`] of the weight: 1 − f_t/(μ_s f_n).
    pub friction: Option<f64>,
    /// How far the centre of pressure of all feet stays inside of what the points of the feet span that carry, m.
    pub pressure_m: Option<f64>,
    /// Of the central body: 1 − tilt/60°, where it has fallen.
    pub tilt: Option<f64>,
    /// Of the central body: its height above that of a fall, as a share of what it was at the start.
    pub height: Option<f64>,
}

/// Names and units of the margins, as columns and for people.
pub const MARGINS: [(&str, &str); 5] = [
    ("torque_margin", "torque"),
    ("friction_margin", "friction"),
    ("pressure_margin_m", "centre of pressure, m"),
    ("tilt_margin", "tilt"),
    ("height_margin", "height"),
];

/// Share of the weight from which on a foot's friction and pressure are looked at.
pub const CARRIES: f64 = 0.05;
/// A central body tilted by more has fallen, rad.
const FALLEN: f64 = std::f64::consts::FRAC_PI_3;

impl Margins {
    /// In the order of [`MARGINS`].
    pub fn all(&self) -> [Option<f64>; 5] {
        [self.torque, self.friction, self.pressure_m, self.tilt, self.height]
    }

    /// From that order.
    pub fn from_all([torque, friction, pressure_m, tilt, height]: [Option<f64>; 5]) -> Self {
        Self { torque, friction, pressure_m, tilt, height }
    }

    /// Of a run's record.
    pub fn of(scene: &Scene, run: &Run) -> Self {
        let robot = scene.robot();
        let ground = Ground::of(scene, &robot);
        let limits = torque_limits(scene, &robot);
        let first = run.samples.first().map_or(f64::NAN, |sample| sample.positions[2]);
        let mut least = Self::default();
        for sample in &run.samples {
            let loads = sample.torques.iter().zip(&limits).map(|(t, limit)| 1.0 - t.abs() / limit);
            least.torque = lesser(least.torque, loads.fold(f64::INFINITY, f64::min));
            let p = &sample.positions;
            // Third component of the body's z axis in the world.
            let up = (1.0 - 2.0 * (p[4] * p[4] + p[5] * p[5])).clamp(-1.0, 1.0);
            least.tilt = lesser(least.tilt, 1.0 - up.acos() / FALLEN);
            let above = (p[2] - robot.fallen_height) / (first - robot.fallen_height);
            least.height = lesser(least.height, above);
            if let Some(ground) = &ground {
                ground.look(&robot, sample, &mut least);
            }
        }
        least
    }
}

fn lesser(so_far: Option<f64>, now: f64) -> Option<f64> {
    if !now.is_finite() {
        return so_far;
    }
    Some(so_far.map_or(now, |so_far| so_far.min(now)))
}

/// What each motor may give, N·m.
fn torque_limits(scene: &Scene, robot: &Robot) -> Vec<f64> {
    let described = robot.limits.joints.iter().map(|joint| joint.torque);
    match scene.acting.torque_limits_nm {
        None => described.collect(),
        Some(motors) => {
            described.zip(motors.into_iter().cycle()).map(|(own, motor)| own.min(motor)).collect()
        }
    }
}

/// What the feet stand on.
struct Ground {
    friction: f64,
    /// Normals under the feet; none where all is level.
    normals: Vec<Vector3<f64>>,
    weight: f64,
}

impl Ground {
    /// `None` where feet are welded.
    fn of(scene: &Scene, robot: &Robot) -> Option<Self> {
        let Feet::Floor { floor, .. } = &scene.feet else { return None };
        let planes = scene.terrain.planes(robot, &scene.start());
        let normals = planes.iter().map(|plane| plane.rotation().column(2).into_owned()).collect();
        let weight = robot.tree.mass() * robot.tree.gravity().norm();
        Some(Self { friction: floor.static_friction, normals, weight })
    }

    fn look(&self, robot: &Robot, sample: &Sample, least: &mut Margins) {
        let Some(forces) = &sample.corner_forces else { return };
        let state = PlantState {
            positions: sample.positions.clone(),
            velocities: sample.velocities.clone(),
        };
        let places = robot.foot_points(&state);
        let (mut spanned, mut pressed, mut load) = (Vec::new(), Vector2::zeros(), 0.0);
        for (foot, (points, forces)) in places.iter().zip(forces).enumerate() {
            let normal = self.normals.get(foot).copied().unwrap_or(Vector3::z());
            let total: Vector3<f64> = forces.iter().map(|f| Vector3::from(*f)).sum();
            let pressing = normal.dot(&total);
            if !(pressing > CARRIES * self.weight) {
                continue;
            }
            let across = (total - normal * pressing).norm();
            least.friction = lesser(least.friction, 1.0 - across / (self.friction * pressing));
            for (point, force) in points.iter().zip(forces) {
                let pressing = normal.dot(&Vector3::from(*force));
                spanned.push(point.xy());
                pressed += pressing * point.xy();
                load += pressing;
            }
        }
        if load > 0.0
            && let Some(depth) = inside(&hull(&spanned), &(pressed / load))
        {
            least.pressure_m = lesser(least.pressure_m, depth);
        }
    }
}
