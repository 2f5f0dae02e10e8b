//! Flights of a run: when no foot carries, how high the centre of mass rises, and how hard the landing is.

use super::Run;
use crate::robot::Robot;
use nalgebra::Vector3;
use serde::Serialize;

/// A time without load that is shorter is a bounce of contacts, s.
const LEAST: f64 = 0.02;
/// A landing is as hard as its greatest load within this time, s.
const LANDING: f64 = 0.1;

/// Flights in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Flights {
    /// Of 0.02 s and more.
    pub count: u32,
    /// In the air, of the time since the robot was first told to go.
    pub share: f64,
    /// Most by which the centre of mass rises between the last load of a take-off and the apex, m.
    pub apex_m: f64,
    /// The same of the lowest flight, m.
    pub least_apex_m: f64,
    /// Greatest load on the feet at a landing, in weights of the robot.
    pub landing_weights: f64,
}

impl Flights {
    /// Of a run's samples from `begun` on; none where it never leaves the ground.
    pub(super) fn of(run: &Run, begun: usize, robot: &Robot) -> Option<Self> {
        let samples = run.samples.get(begun..)?;
        let load = |k: usize| samples[k].foot_forces.iter().sum::<f64>();
        let weight = robot.tree.mass() * robot.tree.gravity().norm();
        let (mut flights, mut aloft) =
            (Self { least_apex_m: f64::INFINITY, ..Self::default() }, 0.0);
        let mut k = 0;
        while k < samples.len() {
            if load(k) > 0.0 {
                k += 1;
                continue;
            }
            let end = (k..samples.len()).find(|at| load(*at) > 0.0).unwrap_or(samples.len());
            let time = samples[end.min(samples.len() - 1)].time_s - samples[k].time_s;
            if time >= LEAST && k > 0 {
                let from = center(robot, &samples[k - 1].positions).z;
                let heights = samples[k..end].iter().map(|s| center(robot, &s.positions).z);
                let apex = heights.fold(from, f64::max) - from;
                let until =
                    samples.partition_point(|s| s.time_s < samples[k].time_s + time + LANDING);
                let hardest = (end..until).map(load).fold(0.0, f64::max) / weight;
                aloft += time;
                flights.count += 1;
                flights.apex_m = flights.apex_m.max(apex);
                flights.least_apex_m = flights.least_apex_m.min(apex);
                flights.landing_weights = flights.landing_weights.max(hardest);
            }
            k = end;
        }
        let all = samples.last()?.time_s - samples.first()?.time_s;
        flights.share = if all > 0.0 { aloft / all } else { 0.0 };
        (flights.count > 0).then_some(flights)
    }
}

/// Centre of mass of the robot's own bodies, m.
fn center(robot: &Robot, positions: &[f64]) -> Vector3<f64> {
    let poses = robot.tree.body_poses(positions).unwrap_or_default();
    let sum = poses.iter().enumerate().fold(Vector3::zeros(), |sum, (body, pose)| {
        sum + pose.position * robot.tree.body_mass(body)
    });
    sum / robot.tree.mass()
}
