//! The robot on still feet, against the floating robot with its feet welded beside the tree.

use nalgebra::Vector3;
use surefoot::model::robots::biped::{FEET, TREE};
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_mechanics::integrators::Progress;
use surefoot_multibody::contact::{ContactState, Switching};
use surefoot_multibody::{
    Body, Closing, Closure, Frame, Joint, JointConstraint, Link, Simulation, Stops, Striker,
    System, lumped, system_of_tree,
};
use surefoot_sim::closed_loop::{Scalar, controller, plant, run_plant};
use surefoot_sim::plant::{
    Additions, BlockSample, Observation, PerPoint, Plant, PlantState, RobotModel, StepFailure,
    ThrownBlock, Variational,
};
use surefoot_sim::robot::{SMALL_BODIES, Start, biped};
use surefoot_sim::scene::{Block, ModelChoice, Outline, Scene, load};

/// The tree afloat, with both feet welded by constraints beside it: what the plant was before it hung from its
/// feet.
struct Afloat {
    motion: Simulation,
    /// Links with motors, and how many.
    joints: Vec<(usize, usize)>,
    central: Frame,
    block: Option<usize>,
}

impl Afloat {
    fn new(state: &PlantState, h: f64, model: RobotModel, block: Option<ThrownBlock>) -> Self {
        let full = system_of_tree(&TREE).expect("a system");
        let start = biped(Outline::A).tree.start(&state.positions, &state.velocities);
        let Start { mut states, mut rates, .. } = start.expect("a configuration");
        let (mut system, mut feet, mut central) = (full.clone(), FEET, Frame::IDENTITY);
        if model == RobotModel::Lumped {
            let reduced = lumped(&full, &SMALL_BODIES).expect("hinges that meet");
            let place = |link: usize| reduced.carrier(link).expect("a body that stays");
            (feet, central) = (FEET.map(|foot| place(foot).0.expect("it moves")), place(0).1);
            (states, rates) = reduced.start(&states, &rates);
            system = reduced.system;
        }
        for outboard in feet {
            let closing = Closing::Joint(Joint::weld(&states[outboard]));
            system =
                system.with_closure(Closure { outboard, inboard: None, closing }).expect("a foot");
        }
        let count = |link: usize| match system.links()[link].joint.constraint {
            JointConstraint::Spherical => 3,
            JointConstraint::Universal { .. } => 2,
            _ => 1,
        };
        let joints = (1..system.links().len()).map(|link| (link, count(link))).collect();
        if let Some(block) = block {
            let ([x, y, z], [u, v, w]) = (block.position, block.velocity);
            states.push([x, y, z, 1.0, 0.0, 0.0, 0.0]);
            rates.push([u, v, w, 0.0, 0.0, 0.0, 0.0]);
            system = with_block(system, &block);
        }
        let motion = Simulation::new(system, h, &states, &rates).expect("a start");
        Self { motion, joints, central, block: block.map(|_| states.len() - 1) }
    }
}

/// A free block as the last link, which strikes the first.
fn with_block(system: System, block: &ThrownBlock) -> System {
    let joint = Joint {
        outboard: [0.0; 3],
        inboard: [0.0; 3],
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Floating,
    };
    let body = Body { mass: block.mass, inertia: block.inertia() };
    let striker = Striker {
        link: system.links().len(),
        points: Striker::box_points(block.size).to_vec(),
        struck: 0,
        around: block.around,
        switching: Switching::WithinTheStep,
    };
    system
        .with_link(Link { inboard: None, joint, body })
        .and_then(|system| system.with_striker(striker))
        .expect("a block")
}

impl Plant for Afloat {
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure> {
        let rates = self.motion.observed_rates()?.to_vec();
        let [x, y, z, s, i, j, k] = self.motion.state(0);
        let q = Quaternion::from_array([s, i, j, k]);
        let arm = q.rotate(self.central.position);
        let turned = q.product(self.central.orientation);
        let [v, omega] = [0, 3].map(|i| Vector3::from_row_slice(&rates[i..i + 3]));
        let seen = |v: Vector3<f64>| turned.conjugate().rotate(v);
        let at = Vector3::new(x, y, z) + arm;
        let twist = [seen(v + omega.cross(&arm)), seen(omega)];
        *state = PlantState::home(12);
        let PlantState { positions, velocities } = state;
        positions[..3].copy_from_slice(at.as_slice());
        positions[3..7].copy_from_slice(&turned.to_array());
        velocities[..3].copy_from_slice(twist[0].as_slice());
        velocities[3..6].copy_from_slice(twist[1].as_slice());
        velocities[6..].copy_from_slice(&rates[6..18]);
        let mut next = 7;
        for (joint, motors) in &self.joints {
            positions[next..next + motors].copy_from_slice(&self.motion.angles(*joint)[..*motors]);
            next += motors;
        }
        Ok(())
    }

    fn step(
        &mut self,
        _: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure> {
        assert!(load.is_none(), "no load in these scenes");
        let mut next = 0;
        for (joint, motors) in &self.joints {
            self.motion.set_torques(*joint, &torques[next..next + motors]);
            next += motors;
        }
        Ok(self.motion.step()?)
    }

    fn read_contacts(&self, _: &mut PerPoint<ContactState>) -> bool {
        false
    }

    fn unknowns(&self) -> usize {
        self.motion.unknowns()
    }

    fn observe(&mut self) -> Result<Observation, StepFailure> {
        let (kinetic_energy, potential_energy) = self.motion.energies()?;
        let h = self.motion.progress().h;
        let impulses = self.motion.loop_impulses();
        Ok(Observation {
            kinetic_energy,
            potential_energy,
            foot_forces: vec![impulses[2] / h, impulses[8] / h],
            contacts: None,
            corner_forces: None,
            block: self.block.map(|link| BlockSample {
                pose: self.motion.state(link),
                force: self.motion.strike_forces()[0],
            }),
            constraint: self.motion.system().largest_constraint(&self.motion.states()),
        })
    }

    fn step_limit(&self) -> Option<f64> {
        None
    }

    fn progress(&self) -> Option<&Progress> {
        Some(self.motion.progress())
    }
}

fn models() -> [(ModelChoice, RobotModel, usize); 2] {
    [(ModelChoice::Full, RobotModel::Full, 16), (ModelChoice::Lumped, RobotModel::Lumped, 12)]
}

fn scene(name: &str, model: ModelChoice) -> Scene {
    Scene { model, ..load(name).expect("built in") }
}

/// Numbers for people.
fn told(all: &[f64]) -> String {
    all.iter().map(|x| format!("{x:.1e}")).collect::<Vec<_>>().join(", ")
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Over the whole of both experiments the robot on still feet, with both models, is the floating one with welds, to
/// round-off: state, torques, foot forces, energies and the block that strikes it, in every sample.
#[test]
fn still_feet_are_welded_feet() {
    let scenes = ["experiment-1-welded", "experiment-2-welded"];
    let all = scenes.into_iter().flat_map(|name| models().map(|model| (name, model)));
    for (name, (choice, model, unknowns)) in all {
        let scene = scene(name, choice);
        let start = scene.initial.state();
        let block = scene.block.as_ref().map(Block::thrown);
        let mut new = plant(&scene).expect("a plant");
        let of_block = if block.is_some() { 6 } else { 0 };
        assert_eq!(new.unknowns(), unknowns + of_block);
        let mut old = Afloat::new(&start, scene.integrator.step_s, model, block);
        assert_eq!(old.motion.unknowns(), 30 + of_block);
        let play = |plant: &mut dyn Plant| {
            let mut controller = controller(&scene, Scalar::F64);
            let run = run_plant(&scene, plant, controller.as_mut(), None, &mut |_| {});
            assert!(run.failure.is_none(), "{:?}", run.failure);
            run
        };
        let (a, b) = (play(new.as_mut()), play(&mut old));
        assert_eq!(a.samples.len(), b.samples.len());
        let mut apart = [0.0_f64; 6];
        for (a, b) in a.samples.iter().zip(&b.samples) {
            let found = [
                largest(&a.positions, &b.positions),
                largest(&a.velocities, &b.velocities),
                largest(&a.torques, &b.torques),
                largest(&a.foot_forces, &b.foot_forces),
                largest(&a.energy, &b.energy),
                match (&a.block, &b.block) {
                    (Some(a), Some(b)) => largest(&a.pose, &b.pose),
                    (a, b) => {
                        assert!(a.is_none() && b.is_none());
                        0.0
                    }
                },
            ];
            apart = std::array::from_fn(|i| apart[i].max(found[i]));
        }
        let iterations = [new.progress(), old.progress()]
            .map(|progress| progress.expect("implicit").mean_iterations());
        println!(
            "{name}, {model}: positions, velocities, torques, foot forces, energies, block {}; \
             iterations {:.2} and {:.2}",
            told(&apart),
            iterations[0],
            iterations[1]
        );
        // A smooth motion is foretold so well that one is enough; a block is not.
        assert!(block.is_some() || iterations.iter().all(|mean| *mean < 1.1), "{iterations:?}");
        assert!(apart[0] < 1e-9 && apart[5] < 1e-9, "{apart:?}");
        assert!(apart[1] < 1e-8 && apart[2] < 1e-6 && apart[3] < 1e-5 && apart[4] < 1e-8);
    }
}

/// The same under torques that know nothing of balance.
#[test]
fn still_feet_bear_any_torques() {
    for (choice, model, _) in models() {
        let scene = scene("experiment-1-welded", choice);
        let start = scene.initial.state();
        let h = 1e-3;
        let additions = Additions { model, ..Additions::default() };
        let mut new =
            Variational::welded(&biped(Outline::A), &start, h, &additions).expect("a plant");
        let mut old = Afloat::new(&start, h, model, None);
        let mut apart = [0.0_f64; 3];
        for step in 0..100 {
            let torques: [f64; 12] = std::array::from_fn(|motor| {
                20.0 * (2.1 * motor as f64 + 0.13 * step as f64 + 0.3).sin()
            });
            new.step(h, &torques, None).expect("a step");
            old.step(h, &torques, None).expect("a step");
            let (a, b) = (new.state().expect("a state"), old.state().expect("a state"));
            let (x, y) = (new.observe().expect("seen"), old.observe().expect("seen"));
            let found = [
                largest(&a.positions, &b.positions),
                largest(&a.velocities, &b.velocities),
                largest(&x.foot_forces, &y.foot_forces),
            ];
            apart = std::array::from_fn(|i| apart[i].max(found[i]));
        }
        println!("{model}: positions, velocities, foot forces {}", told(&apart));
        assert!(apart[0] < 1e-9 && apart[1] < 1e-8 && apart[2] < 1e-5, "{apart:?}");
    }
}

/// Stops need joints of the tree: then it hangs from one foot, and the other is welded. Stops that are never
/// reached change nothing.
#[test]
fn stops_leave_one_foot_welded() {
    let scene = scene("experiment-1-welded", ModelChoice::Full);
    let start = scene.initial.state();
    let stops = Stops { low: -3.0, high: 3.0, stiffness: 100.0 };
    let with = Additions { stops: Some(vec![stops; 12]), ..Additions::default() };
    let h = 1e-3;
    let mut held = Variational::welded(&biped(Outline::A), &start, h, &with).expect("a plant");
    let mut free =
        Variational::welded(&biped(Outline::A), &start, h, &Additions::default()).expect("a plant");
    assert_eq!((held.unknowns(), free.unknowns()), (18, 16));
    let mut apart = [0.0_f64; 3];
    for step in 0..100 {
        let torques: [f64; 12] =
            std::array::from_fn(|motor| 20.0 * (1.7 * motor as f64 + 0.11 * step as f64).sin());
        held.step(h, &torques, None).expect("a step");
        free.step(h, &torques, None).expect("a step");
        let (a, b) = (held.state().expect("a state"), free.state().expect("a state"));
        let (x, y) = (held.observe().expect("seen"), free.observe().expect("seen"));
        let energies =
            [x.kinetic_energy - y.kinetic_energy, x.potential_energy - y.potential_energy];
        let found = [
            largest(&a.positions, &b.positions),
            largest(&x.foot_forces, &y.foot_forces),
            largest(&energies, &[0.0; 2]),
        ];
        apart = std::array::from_fn(|i| apart[i].max(found[i]));
    }
    println!("positions, foot forces, energies {}", told(&apart));
    assert!(apart[0] < 1e-9 && apart[1] < 1e-5 && apart[2] < 1e-8, "{apart:?}");
}
