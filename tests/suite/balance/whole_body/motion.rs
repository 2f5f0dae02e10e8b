//! Feet that press and feet that swing: against other software, against the equations of motion, and
//! whatever comes in.

mod equations;
mod hostile;
mod sequence;
mod vectors;

use super::state;
use nalgebra::Vector3;
use rand::RngExt;
use rand_pcg::Pcg64;
use surefoot::Real;
use surefoot::balance::{
    AngularTask, FootTask, LinearTask, MotionTask, ObservedMotion, WholeBody, WholeBodyCommand,
    WholeBodyController, WholeBodyMemory, WholeBodySettings, WholeBodyState, observe,
    whole_body_motion_tick,
};
use surefoot_tests::legged_trees::Legged;
use surefoot_tests::random_trees::symmetric;

/// A robot near its stance with a task, and the motion that it reports.
#[derive(Clone)]
struct Play<const N: usize, const NQ: usize, const NV: usize> {
    robot: Legged<N, NQ, NV>,
    model: WholeBody<f64, 4, NV>,
    settings: WholeBodySettings<f64, NV>,
    state: WholeBodyState<f64, NQ, NV>,
    motion: ObservedMotion<f64, 4>,
    task: MotionTask<f64, 4>,
}

impl<const N: usize, const NQ: usize, const NV: usize> Play<N, NQ, NV> {
    /// `share` of the greatest deviations, and of what is asked for; some feet press.
    fn new(rng: &mut Pcg64, robot: Legged<N, NQ, NV>, share: f64) -> Self {
        let settings =
            WholeBodySettings { posture: robot.stance, ..WholeBodySettings::scaled(0.8, 9.81, 4) };
        let model = WholeBody::new(&robot.tree, &robot.feet).expect("a robot");
        let state = state(rng, &robot, share);
        let controller =
            WholeBodyController { tree: &robot.tree, robot: &model, settings: &settings };
        let observed = observe(&controller, &state).expect("a state");
        let motion = observed.motion(&controller).expect("a motion");
        let pressing =
            std::array::from_fn(|foot| robot.feet[foot].is_some() && rng.random_bool(0.6));
        let task = task(rng, &motion, &pressing, share);
        Self { robot, model, settings, state, motion, task }
    }

    /// What it reports where it is now.
    fn observed(&self) -> ObservedMotion<f64, 4> {
        let controller = WholeBodyController {
            tree: &self.robot.tree,
            robot: &self.model,
            settings: &self.settings,
        };
        let observed = observe(&controller, &self.state).expect("a state");
        observed.motion(&controller).expect("a motion")
    }

    fn command(&self, settings: &WholeBodySettings<f64, NV>) -> WholeBodyCommand<f64, 4, NV> {
        let tree = &self.robot.tree;
        let controller = WholeBodyController { tree, robot: &self.model, settings };
        let observed = observe(&controller, &self.state).expect("a state");
        let mut memory = WholeBodyMemory::new();
        whole_body_motion_tick(&controller, &observed, &self.task, &mut memory).expect("torques")
    }

    fn presses(&self, foot: usize) -> bool {
        self.robot.feet[foot].is_some() && matches!(self.task.feet[foot], FootTask::Press { .. })
    }
}

fn vector<T: Real>(rng: &mut Pcg64, size: f64) -> Vector3<T> {
    Vector3::from(symmetric::<3>(rng).map(|x| T::of(size * x)))
}

/// Something that a planner might ask for.
fn task<T: Real>(
    rng: &mut Pcg64,
    motion: &ObservedMotion<T, 4>,
    pressing: &[bool; 4],
    share: f64,
) -> MotionTask<T, 4> {
    let feet = std::array::from_fn(|foot| {
        if pressing[foot] {
            FootTask::Press { most_force: T::of(f64::INFINITY) }
        } else {
            FootTask::Swing { linear: vector(rng, 5.0 * share), angular: vector(rng, 10.0 * share) }
        }
    });
    let count = pressing.iter().filter(|presses| **presses).count();
    let linear = if count == 0 {
        LinearTask::Free
    } else if rng.random() {
        LinearTask::CenterOfMass(vector(rng, share))
    } else {
        let sum = motion.feet.iter().zip(pressing).filter(|(_, presses)| **presses);
        let sum = sum.fold(Vector3::zeros(), |sum: Vector3<T>, (foot, _)| sum + foot.position);
        let mean = sum / T::of(count as f64) + vector::<T>(rng, 0.02 * share);
        let vertical = T::of(share * rng.random_range(-1.0..1.0));
        LinearTask::CenterOfPressure { point: [mean.x, mean.y], vertical, per_length: T::of(12.0) }
    };
    MotionTask { linear, angular: AngularTask::CentralBody(vector(rng, share)), feet }
}

/// The central body's angular acceleration that a task asks for.
fn asked_turn(task: &MotionTask<f64, 4>) -> Vector3<f64> {
    match task.angular {
        AngularTask::CentralBody(acceleration) => acceleration,
        AngularTask::Momentum { .. } => panic!("not of these tasks"),
    }
}
