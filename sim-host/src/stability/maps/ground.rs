//! What a loop asks of the ground: the forecast of the loop's maps.
//!
//! The same scene is run with feet that are held where they start: no contact code, no slip, no edge to tip
//! over. While that run is at its set point in time, and what it asks of the ground is what feet on the floor
//! can be given, the run on the floor should work.
//!
//! # Notation
//! - `F`, `M`: force of the ground on the robot, and its moment about the world's origin: what the controller
//!   asks of the legs on the central body, and the legs' weight. That legs have inertia is left out.
//! - `c = (−M_y, M_x)/F_z`: where on the floor the force acts (Vukobratović's zero-moment point)
//!
//! `F_z > 0` (no pull), `c` between the outermost corners of the soles, `‖F_xy‖ ≤ μ F_z`; each in the mean over
//! [`FALLING_S`], since a robot lives through violations that are shorter than it takes to tip. Whether it comes
//! to stand on its soles at all is asked in [`super::landing`].

use crate::stability::loop_limits::{Criterion, Loop, play};
use nalgebra::Vector3;
use surefoot_sim::record::Sample;
use surefoot_sim::robot::Robot;
use surefoot_sim::scene::{Feet, Scene};

/// `√(z/g)` of a body 1 m above the ground, in which a fall grows by a factor e, s.
pub(super) const FALLING_S: f64 = 0.32;

/// What a sample asks of the ground.
#[derive(Clone, Copy, Debug, Default)]
struct Asked {
    force: Vector3<f64>,
    moment: Vector3<f64>,
    /// Least and greatest x and y of the soles' corners, m.
    soles: [[f64; 2]; 2],
}

/// Whether a scene should work on its floor once it stands there. Scenes without a floor are as they are.
///
/// # Cost
/// One run with held feet.
pub fn should_stand(scene: &Scene, criterion: &Criterion) -> bool {
    let floor = match &scene.feet {
        Feet::Floor { floor, .. } => Some((scene.robot(), floor.static_friction)),
        Feet::Welded {} => None,
    };
    let mut held = scene.clone();
    held.feet = Feet::Welded {};
    held.duration_s = held.duration_s.max(criterion.least_duration_s);
    let (run, _) = play(&held, Loop::Bare);
    if run.failure.is_some() || !criterion.is_settled(&run.samples, &held.set_point) {
        return false;
    }
    let Some((robot, friction)) = floor else { return true };
    let asked: Option<Vec<Asked>> =
        run.samples.iter().map(|sample| Asked::of(sample, &robot)).collect();
    let window = (FALLING_S * scene.controller.rate_hz).round().max(1.0) as usize;
    // Runs that are shorter than the window are judged as a whole.
    asked.is_some_and(|asked| {
        asked.windows(window.min(asked.len()).max(1)).all(|some| is_given(some, friction))
    })
}

/// Whether the floor gives the mean of what is asked.
fn is_given(some: &[Asked], friction: f64) -> bool {
    let force: Vector3<f64> = some.iter().map(|asked| asked.force).sum();
    let moment: Vector3<f64> = some.iter().map(|asked| asked.moment).sum();
    let at = [-moment.y / force.z, moment.x / force.z];
    let mean = |axis: usize, end: usize| {
        some.iter().map(|asked| asked.soles[axis][end]).sum::<f64>() / some.len() as f64
    };
    force.z > 0.0
        && force.xy().norm() <= friction * force.z
        && (0..2).all(|axis| (mean(axis, 0)..=mean(axis, 1)).contains(&at[axis]))
}

impl Asked {
    /// `None` for positions that are no configuration.
    fn of(sample: &Sample, robot: &Robot) -> Option<Self> {
        let poses = robot.tree.body_poses(&sample.positions).ok()?;
        let body = &poses[0];
        let [fx, fy, fz, tx, ty, tz] = sample.desired_wrench;
        let force = body.rotation * Vector3::new(fx, fy, fz);
        let torque = body.rotation * Vector3::new(tx, ty, tz);
        let mut asked =
            Self { force, moment: torque + body.position.cross(&force), ..Self::default() };
        for (link, pose) in poses.iter().enumerate().skip(1) {
            let weight = -robot.tree.gravity() * robot.tree.body_mass(link);
            asked.force += weight;
            asked.moment += pose.position.cross(&weight);
        }
        asked.soles = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for foot in &robot.feet {
            for point in &foot.points {
                let at = poses[foot.body].transform_point(point.at);
                for (ends, x) in asked.soles.iter_mut().zip([at.x, at.y]) {
                    *ends = [ends[0].min(x), ends[1].max(x)];
                }
            }
        }
        Some(asked)
    }
}
