//! The supervisor where a robot cannot be held: 200 random falls. Without it each of them ends on the floor, or in
//! torques that no motor has.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::balance::StopReason;
use surefoot::spatial::Quaternion;
use surefoot_sim::closed_loop::{
    self, Commanded, ControlFailure, Controller, Run, Scalar, bare_controller, controller,
};
use surefoot_sim::plant::PlantState;
use surefoot_sim::record::Sample;
use surefoot_sim::scene::{Feet, Outline, Push, Scene, load};

/// A controller one of whose motors gives nothing from a tick on.
struct DeadMotor {
    inner: Box<dyn Controller>,
    from: Option<(u32, usize)>,
    ticks: u32,
}

impl Controller for DeadMotor {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let mut command = self.inner.tick(state)?;
        self.ticks += 1;
        if let Some((from, joint)) = self.from
            && self.ticks > from
        {
            command.torques[joint] = 0.0;
        }
        Ok(command)
    }

    fn stopped(&self) -> Option<StopReason> {
        self.inner.stopped()
    }
}

/// What befalls a robot.
struct Case {
    scene: Scene,
    dead: Option<(u32, usize)>,
    words: String,
}

impl Case {
    fn random(rng: &mut Pcg64Mcg, number: usize) -> Self {
        let names = ["experiment-1", "experiment-2"];
        let mut scene = load(names[rng.random_range(0..2)]).expect("built in");
        let sole = [Outline::A, Outline::R, Outline::M][rng.random_range(0..3)];
        if let Feet::Floor { outline, .. } = &mut scene.feet {
            *outline = Some(sole);
        }
        let mut dead = None;
        let what = match number % 4 {
            0 | 1 => {
                let (force, angle) =
                    (rng.random_range(20.0..500.0), rng.random_range(0.0..std::f64::consts::TAU));
                let (at_s, duration_s) = (rng.random_range(0.1..1.5), rng.random_range(0.02..0.2));
                let force_n =
                    [force * angle.cos(), force * angle.sin(), force * rng.random_range(-0.5..0.5)];
                scene.pushes.push(Push { at_s, duration_s, force_n });
                format!("{force_n:.0?} N at {at_s:.2} s for {duration_s:.2} s")
            }
            2 => {
                let down = rng.random_range(0.02..0.8);
                scene.initial.legs_mut().expect("legs").position_m[2] += down;
                scene.set_point.position_m[2] += if rng.random() { down } else { 0.0 };
                format!("the floor is {down:.2} m lower")
            }
            _ => {
                let (from, joint) = (rng.random_range(20..700), rng.random_range(0..12));
                dead = Some((from, joint));
                format!("motor {joint} is dead from tick {from} on")
            }
        };
        let words = format!("{}, sole {sole:?}: {what}", scene.name);
        Self { scene, dead, words }
    }

    fn play(&self, inner: Box<dyn Controller>) -> Run {
        let mut robot = DeadMotor { inner, from: self.dead, ticks: 0 };
        closed_loop::run(&self.scene, &mut robot, &mut |_| {})
    }
}

fn tilt_deg(sample: &Sample) -> f64 {
    let q = Quaternion::from_array(std::array::from_fn(|i| sample.positions[3 + i]));
    q.rotate(Vector3::z()).z.clamp(-1.0, 1.0).acos().to_degrees()
}

/// How far the body is below the greatest height it has had, of those up to its set point, at the end, m.
fn drop(scene: &Scene, samples: &[Sample]) -> f64 {
    let height = |sample: &Sample| sample.positions[2];
    let highest = samples.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
    samples.last().map_or(0.0, |last| highest.min(scene.set_point.position_m[2]) - height(last))
}

/// Work of all motors that drive, J: exact, as torques are constant between samples.
fn driving_work(samples: &[Sample]) -> f64 {
    let tick = |pair: &[Sample]| -> f64 {
        let moved = |joint: usize| pair[1].positions[7 + joint] - pair[0].positions[7 + joint];
        (0..12).map(|joint| (pair[0].torques[joint] * moved(joint)).max(0.0)).sum()
    };
    samples.windows(2).map(tick).sum()
}

/// A largest value and what it was found in.
#[derive(Default)]
struct Worst(f64, String);

impl Worst {
    fn take(&mut self, value: f64, of: impl Fn() -> String) {
        if value > self.0 {
            *self = Self(value, of());
        }
    }
}

/// Measured: 4 cm, 30°, 17 J.
#[test]
fn two_hundred_falls_are_stopped_in_time() {
    let mut rng = Pcg64Mcg::seed_from_u64(15);
    let (mut falls, mut held) = (0, 0);
    let (mut sunk, mut tilted, mut work) = (Worst::default(), Worst::default(), Worst::default());
    let mut reasons = std::collections::BTreeMap::<String, u32>::new();
    for number in 0.. {
        if falls == 200 {
            break;
        }
        let case = Case::random(&mut rng, number);
        let bare = case.play(bare_controller(&case.scene, Scalar::F64));
        let run = case.play(controller(&case.scene, Scalar::F64));
        if bare.failure.is_none() {
            assert_eq!(run.stop, None, "a false stop: {}", case.words);
            held += 1;
            continue;
        }
        falls += 1;
        let stop = run.stop.unwrap_or_else(|| panic!("not stopped: {}", case.words));
        let reason = format!("{:?}", stop.reason);
        *reasons.entry(reason.split([' ', '(']).next().expect("a word").to_owned()).or_default() +=
            1;
        let at = run.samples.partition_point(|sample| sample.time_s < stop.time_s);
        let until = &run.samples[..=at];
        let said = || format!("{}: {} at {:.3} s", case.words, stop.reason, stop.time_s);
        sunk.take(drop(&case.scene, until), said);
        tilted.take(tilt_deg(&until[at]), said);
        work.take(driving_work(&run.samples[at..]), said);
    }
    println!(
        "{falls} falls, and {held} cases that both loops live through; stopped for {reasons:?}"
    );
    println!("sunk at the stop: {:.3} m ({})", sunk.0, sunk.1);
    println!("tilt at the stop: {:.1}° ({})", tilted.0, tilted.1);
    println!("driving work after the stop: {:.2} J ({})", work.0, work.1);
    assert!(sunk.0 < 0.2, "{}", sunk.1);
    assert!(tilted.0 < 40.0, "{}", tilted.1);
    assert!(work.0 < 60.0, "{}", work.1);
}
