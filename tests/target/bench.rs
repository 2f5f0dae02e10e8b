//! A plant on the host with a target at its motors, in lock step, and every wire open to tampering.

use std::path::PathBuf;
use surefoot::balance::{JointLimits, Mode, SafetyLimits};
use surefoot::model::robots::biped;
use surefoot_sim::closed_loop::firmware::{Emulator, sensors, set_point, settings};
use surefoot_sim::plant::{Additions, Plant, Variational};
use surefoot_sim::scene::{Feet, Scene, load};

/// Of a robot with twelve joints.
pub const JOINTS: usize = 12;
pub type ToTarget = surefoot_link::ToTarget<JOINTS>;
pub type Sensors = surefoot_link::Sensors<JOINTS>;
pub type Torques = surefoot_link::Torques<JOINTS>;
pub type Target = surefoot_sim::closed_loop::firmware::Target<JOINTS>;

/// Images that `cargo xtask firmware` leaves.
pub fn image(name: &str) -> PathBuf {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/firmware");
    PathBuf::from(folder).join("biped").join(format!("{name}.elf"))
}

pub fn emulator(name: &str) -> Emulator {
    Emulator::start(&image(name), env!("CARGO_TARGET_TMPDIR").as_ref()).expect("an emulator")
}

pub fn target() -> Target {
    Target::connect(emulator("emulation")).expect("a firmware that answers")
}

/// Experiment 1 with a target in its loop.
pub struct Bench {
    pub scene: Scene,
    pub plant: Variational,
    pub target: Target,
    pub limits: SafetyLimits<f32, 2>,
    time: f64,
    torques: [f64; 12],
}

impl Bench {
    /// Armed, before its first tick.
    pub fn new(mut target: Target) -> Self {
        let scene = load("experiment-1").expect("built in");
        arm(&mut target, &scene);
        let Feet::Floor { floor, .. } = &scene.feet else { panic!("it has a floor") };
        let (start, step) = (scene.initial.state(), scene.integrator.step_s);
        let additions = Additions::default();
        let plant = Variational::on_floor(&scene.robot(), &start, step, *floor, &additions)
            .expect("a plant");
        Self { scene, plant, target, limits: biped::LIMITS.to_f32(), time: 0.0, torques: [0.0; 12] }
    }

    /// After `ticks` ordinary ticks, at the end of which it is active.
    pub fn after(ticks: usize) -> Self {
        let mut bench = Self::new(target());
        for _ in 0..ticks {
            assert_eq!(bench.tick(|_| {}).mode, Mode::Active);
        }
        bench
    }

    /// What the sensors read now.
    pub fn sensors(&mut self) -> Sensors {
        sensors(&self.plant.state().expect("a state"))
    }

    /// What they read at a scene's start.
    pub fn sensors_of(scene: &Scene) -> Sensors {
        sensors(&scene.initial.state())
    }

    /// One tick with sensors that read what `spoil` makes of it.
    pub fn tick(&mut self, spoil: impl FnOnce(&mut Sensors)) -> Torques {
        let mut sensors = self.sensors();
        spoil(&mut sensors);
        let torques = self.target.tick(&sensors).expect("an answer");
        self.obey(&torques);
        torques
    }

    /// One tick whose frame arrives as `spoil` makes it.
    pub fn tick_with_frame(&mut self, spoil: impl FnOnce(Vec<u8>) -> Vec<u8>) -> Torques {
        let sensors = self.sensors();
        let measurement = self.target.measurement(&sensors);
        let frame = self.target.frame(&measurement);
        let torques = self.target.tick_raw(&spoil(frame)).expect("an answer");
        self.obey(&torques);
        torques
    }

    /// The plant moves by one tick under these torques, which are within their limits.
    pub fn obey(&mut self, torques: &Torques) {
        let joints = self.limits.joints.iter().flatten();
        for (torque, JointLimits { torque: limit, .. }) in torques.joint_torques.iter().zip(joints)
        {
            assert!(torque.abs() <= *limit, "{torque} N·m, and the limit is {limit}");
        }
        for (to, torque) in self.torques.iter_mut().zip(&torques.joint_torques) {
            *to = f64::from(*torque);
        }
        let step = self.scene.integrator.step_s;
        let steps = (1.0 / (self.scene.controller.rate_hz * step)).round() as usize;
        for number in 0..steps {
            let begun = self.time + number as f64 * step;
            let push = self.scene.push(begun, begun + step);
            self.plant.step(step, &self.torques, push).expect("a motion");
        }
        self.time += 1.0 / self.scene.controller.rate_hz;
    }
}

/// Configures a target for a scene, and arms it.
pub fn arm(target: &mut Target, scene: &Scene) {
    for (name, order) in [
        ("disarm", ToTarget::Disarm),
        ("configure", ToTarget::Configure(settings(scene))),
        ("set point", ToTarget::SetPoint(set_point(scene))),
        ("arm", ToTarget::Arm(scene.robot().id().expect("legs of six joints"))),
    ] {
        target.order(name, &order).expect("obeyed");
    }
}
