//! What a walk must know of a robot beside its tree: which way is forward, and which feet step together.

use super::{Contacts, Robot};
use crate::plant::PlantState;
use nalgebra::{Vector2, Vector3};
use surefoot::walk::{Side, StandingRobot};

/// A sole that reaches this much farther ahead of its leg's last joint than behind it says which way is forward, m.
const TOE: f64 = 0.02;

/// Sides and measures.
pub(crate) struct WalkerShape {
    /// All but the length of a leg, which is NaN yet.
    pub robot: StandingRobot<f64>,
    /// By foot.
    pub sides: [Option<Side>; 4],
}

impl WalkerShape {
    /// Of a robot on two or four feet; `None` for another number of them.
    pub fn of(robot: &Robot) -> Option<Self> {
        let contacts = Contacts::of(robot).ok()?;
        let home = PlantState::home(robot.joint_count());
        let poses = robot.tree.body_poses(&home.positions).ok()?;
        let feet: Vec<Vec<Vector3<f64>>> = robot.foot_points(&home);
        let middles: Vec<Vector3<f64>> = feet.iter().map(|foot| box_of(foot).0).collect();
        let ankles = contacts.feet.iter().flatten().zip(&contacts.leg_joints).map(|(_, joints)| {
            let last = joints.last()? + 1;
            let shape = robot.tree.body_shape(last)?;
            Some(poses.get(last)?.transform_point(shape.joint))
        });
        let ahead =
            ankles.zip(&middles).map(|(ankle, middle)| ankle.map_or(0.0, |a| middle.x - a.x));
        let ahead = ahead.sum::<f64>() / middles.len().max(1) as f64;
        let has_area = feet.iter().all(|foot| box_of(foot).1.norm() > TOE);
        let forward = if has_area && ahead < -0.5 * TOE { std::f64::consts::PI } else { 0.0 };
        // From here on forward is +x.
        let turned =
            |p: &Vector3<f64>| if forward > 0.0 { Vector2::new(-p.x, -p.y) } else { p.xy() };
        let at: Vec<Vector2<f64>> = middles.iter().map(turned).collect();
        let center = at.iter().sum::<Vector2<f64>>() / at.len().max(1) as f64;
        let side = |p: &Vector2<f64>| {
            let from = p - center;
            let is_left = match at.len() {
                2 => from.y > 0.0,
                // The left one in front steps with the right one behind.
                _ => from.x * from.y > 0.0,
            };
            if is_left { Side::Left } else { Side::Right }
        };
        if !matches!(at.len(), 2 | 4) {
            return None;
        }
        let patches: Vec<[bool; 3]> =
            contacts.feet.iter().flatten().map(|foot| foot.limits.patch.moments()).collect();
        let moments = patches.first()?;
        let half = box_of(feet.first()?).1 * 0.5;
        let is_point = *moments == [false; 3];
        let only = |is: bool, x: f64| if is { x } else { 0.0 };
        Some(Self {
            robot: StandingRobot {
                mass: robot.tree.mass(),
                gravity: robot.tree.gravity().norm(),
                leg_length: f64::NAN,
                forward,
                sole: if is_point { Vector2::zeros() } else { half.xy() },
                pressure_reach: Vector2::new(only(moments[1], half.x), only(moments[0], half.y)),
            },
            sides: std::array::from_fn(|foot| at.get(foot).map(side)),
        })
    }
}

/// Middle and size of the box around points.
fn box_of(points: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let low = points.iter().fold(Vector3::repeat(f64::INFINITY), |low, p| low.inf(p));
    let high = points.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
    if points.is_empty() {
        return (Vector3::zeros(), Vector3::zeros());
    }
    ((low + high) / 2.0, high - low)
}
