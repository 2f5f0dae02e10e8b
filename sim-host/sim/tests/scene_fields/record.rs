//! What a scene's run records, whatever its kind.

use super::representative::STEPS;
use surefoot_sim::closed_loop::{self, Scalar};
use surefoot_sim::mechanism;
use surefoot_sim::scene::AnyScene;

/// All numbers of all samples, and how it ended; or why it did not begin.
pub type Record = Result<(Vec<f64>, String), String>;

/// Plays a scene for its first steps.
pub fn record(scene: AnyScene) -> Record {
    match scene {
        AnyScene::Robot(mut scene) => {
            let per_tick = (1.0 / (scene.controller.rate_hz * scene.integrator.step_s)).max(1.0);
            if per_tick > STEPS as f64 {
                return Err("a tick of so many steps takes too long here".into());
            }
            let most = (STEPS as f64 / per_tick).floor() / scene.controller.rate_hz;
            let wanted_s = scene.duration_s;
            scene.duration_s = wanted_s.min(most);
            let mut controller = closed_loop::controller(&scene, Scalar::F64);
            let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
            let numbers = run.samples.iter().flat_map(|sample| {
                let block = sample.block.iter().flat_map(|block| block.pose).collect::<Vec<_>>();
                std::iter::once(sample.time_s)
                    .chain(sample.positions.clone())
                    .chain(sample.velocities.clone())
                    .chain(sample.torques.clone())
                    .chain(sample.energy)
                    .chain(sample.foot_forces.clone())
                    .chain(block)
            });
            // The time to be played counts, however little of it is.
            let numbers = numbers.chain([wanted_s]).collect();
            Ok((numbers, format!("{:?} {:?}", run.failure, run.cut_torques)))
        }
        AnyScene::Mechanism(scene) => {
            let mut moving = mechanism::start(&scene).map_err(|error| error.to_string())?;
            let steps =
                (scene.duration_s / scene.integrator.step_s).round().min(STEPS as f64) as u64;
            let (mut numbers, mut failure) = (Vec::new(), None);
            for step in 0..=steps {
                if step > 0 {
                    failure = moving.step().err();
                }
                let seen = moving.state().and_then(|state| Ok((state, moving.conserved()?)));
                let Ok(((x, v), (energy, momentum, constraint))) = seen else {
                    break;
                };
                numbers.push(moving.progress().time_s);
                numbers.extend(x.into_iter().chain(v).chain(momentum).chain([energy, constraint]));
                if failure.is_some() {
                    break;
                }
            }
            // The time to be played counts, however little of it is.
            numbers.push(scene.duration_s);
            Ok((numbers, format!("{failure:?}")))
        }
    }
}
