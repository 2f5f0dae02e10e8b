//! Links on fixed joints merged.

use super::lumped::apart_where_told;
use nalgebra::Vector3;
use num_dual::Dual64;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::{Floor, Switching};
use surefoot_multibody::{
    Body, BodyState, Closing, Closure, ConstraintFunction, Frame, Joint, JointConstraint, JointLaw,
    Link, Simulation, Site, System, merged,
};
use surefoot_sim::scene::{AnyScene, parse};

pub fn unit<R: rand::Rng>(random: &mut R) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-1.0..1.0)).normalize()
}

/// A random tree that floats, with fixed joints in it, joints of all kinds and perhaps contact sites; it turns and
/// moves as a whole at first.
pub fn random_tree(seed: u64, on_floor: bool) -> (System, Vec<BodyState>, Vec<BodyState>) {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut links = Vec::<Link>::new();
    let mut frames = Vec::<Frame>::new();
    for k in 0..12 {
        let inboard = (k > 0).then(|| random.random_range(0..k));
        let home = Quaternion::from_rotation_vector(unit(&mut random));
        let axis: [f64; 3] = unit(&mut random).into();
        let across: [f64; 3] = Vector3::from(axis).cross(&unit(&mut random)).normalize().into();
        let constraint = match k {
            0 => JointConstraint::Floating,
            _ if k % 2 == 0 => JointConstraint::Fixed,
            1 => JointConstraint::Spherical,
            3 => JointConstraint::Prismatic { axis },
            5 => JointConstraint::Universal {
                outboard_axis: axis,
                inboard_axis: home.rotate(across.into()).into(),
            },
            _ => JointConstraint::Revolute { axis },
        };
        let joint = Joint {
            outboard: (unit(&mut random) * 0.2).into(),
            inboard: (unit(&mut random) * 0.2).into(),
            home: home.to_array(),
            constraint,
        };
        let arm = Vector3::from(joint.inboard) - home.rotate(joint.outboard.into());
        let at = Frame { position: arm, orientation: home };
        let frame = inboard
            .map_or(Frame { position: Vector3::new(0.0, 0.0, 1.2), ..at }, |i: usize| {
                frames[i].then(&at)
            });
        frames.push(frame);
        let mass = random.random_range(0.5..2.0);
        let inertia = [0.02, 0.025, 0.03].map(|i| mass * i);
        links.push(Link { inboard, joint, body: Body { mass, inertia } });
    }
    let sites = (0..12).map(|link| Site { link, position: (unit(&mut random) * 0.2).into() });
    let sites: Vec<Site> = sites.collect();
    let mut system = System::new(links, 9.81)
        .and_then(|system| system.with_law(7, JointLaw { damping: 0.3, ..JointLaw::default() }))
        .expect("a system");
    if on_floor {
        system = system.on_floor(Floor::RUBBER, Switching::WithinTheStep, sites).expect("sites");
    }
    let (omega, v) = (unit(&mut random) * 2.0, unit(&mut random));
    let both = frames.iter().map(|frame| {
        let whole = |p: Vector3<f64>, [s, i, j, k]: [f64; 4]| [p.x, p.y, p.z, s, i, j, k];
        let q = frame.orientation;
        let speed = v + omega.cross(&(frame.position - frames[0].position));
        let q_dot = q.rate(q.conjugate().rotate(omega)).to_array();
        (whole(frame.position, q.to_array()), whole(speed, q_dot))
    });
    let (states, rates) = both.unzip();
    (system, states, rates)
}

/// Without fixed joints, contact included, the motion is the same to round-off: in every body and in the forces
/// on every contact site.
#[test]
fn fixed_links_are_merged_without_a_trace() {
    for seed in 0..10 {
        let (system, states, rates) = random_tree(seed, true);
        let reduced = merged(&system).expect("a system");
        assert_eq!(reduced.system.links().len(), 7);
        let h = 1e-3;
        let mut large = Simulation::new(system, h, &states, &rates).expect("a start");
        let (states, rates) = reduced.start(&states, &rates);
        let mut small =
            Simulation::new(reduced.system.clone(), h, &states, &rates).expect("a start");
        assert_eq!(large.unknowns(), small.unknowns());
        for _ in 0..150 {
            large.step().expect("a step");
            small.step().expect("a step");
        }
        let found = apart_where_told(&large, &mut small, &reduced);
        let (a, b) = (large.energies().expect("energies"), small.energies().expect("energies"));
        println!("{seed}: {found:.1e}, energy {:.1e}", (a.0 + a.1 - b.0 - b.1).abs());
        assert!(found < 1e-9, "{seed}: {found}");
        assert!((a.0 + a.1 - b.0 - b.1).abs() < 1e-7, "{seed}");
    }
}

/// Keeps two bodies' centres as far apart as they are.
#[derive(Debug)]
struct Distance(f64);
impl ConstraintFunction for Distance {
    fn constraints(&self) -> usize {
        1
    }
    fn evaluate(&self, a: &[Dual64; 7], b: &[Dual64; 7]) -> [Dual64; 6] {
        let mut all = [Dual64::from(0.0); 6];
        let apart = [0, 1, 2].map(|i| a[i] - b[i]);
        all[0] = apart.iter().map(|x| *x * *x).sum::<Dual64>() - self.0;
        all
    }
}

/// A loop, and a user's own constraint, between bodies that others carry now.
#[test]
fn loops_of_merged_links_hold() {
    for seed in 20..24 {
        let (system, states, rates) = random_tree(seed, true);
        let between = |a: usize, b: usize| -> f64 {
            (0..3).map(|i| (states[a][i] - states[b][i]).powi(2)).sum()
        };
        let function = std::sync::Arc::new(Distance(between(4, 9)));
        let closing = Closing::General(function);
        let system =
            system.with_closure(Closure { outboard: 4, inboard: Some(9), closing }).expect("links");
        let reduced = merged(&system).expect("a system");
        let mut large = Simulation::new(system, 1e-3, &states, &rates).expect("a start");
        let (states, rates) = reduced.start(&states, &rates);
        let mut small =
            Simulation::new(reduced.system.clone(), 1e-3, &states, &rates).expect("a start");
        for _ in 0..100 {
            large.step().expect("a step");
            small.step().expect("a step");
        }
        let found = apart_where_told(&large, &mut small, &reduced);
        println!("{seed}: {found:.1e}");
        assert!(found < 1e-9, "{seed}: {found}");
    }
}

/// Links that are fixed to the world become part of it: all bodies, the energy and the forces on what is struck or
/// touched are as before; so are loops whose outboard body stands still, which are told from the other one.
#[test]
fn links_on_the_world_are_merged_with_it() {
    for (seed, is_closed) in (30..40).map(|seed| (seed, seed % 2 == 0)) {
        let (floating, states, _) = random_tree(seed, false);
        let mut links = floating.links().to_vec();
        links[0].joint = Joint::weld(&states[0]);
        let mut system = System::new(links, 9.81).expect("a system");
        if is_closed {
            let between = |a: usize, b: usize| -> f64 {
                (0..3).map(|i| (states[a][i] - states[b][i]).powi(2)).sum()
            };
            let far = Closing::General(std::sync::Arc::new(Distance(between(0, 9))));
            // A ball joint where body 11's centre is.
            let of = |k: usize| Frame {
                position: Vector3::new(states[k][0], states[k][1], states[k][2]),
                orientation: Quaternion::from_array([3, 4, 5, 6].map(|i| states[k][i])),
            };
            let ball = Joint {
                outboard: of(0).inverse().then(&of(11)).position.into(),
                inboard: [0.0; 3],
                home: [1.0, 0.0, 0.0, 0.0],
                constraint: JointConstraint::Spherical,
            };
            for (inboard, closing) in [(9, far), (11, Closing::Joint(ball))] {
                let closure = Closure { outboard: 0, inboard: Some(inboard), closing };
                system = system.with_closure(closure).expect("links");
            }
        }
        let reduced = merged(&system).expect("a system");
        assert_eq!(reduced.system.links().len(), 6);
        assert!(matches!(reduced.carrier(0), Some((None, _))));
        let still = vec![[0.0; 7]; states.len()];
        let mut large = Simulation::new(system, 1e-3, &states, &still).expect("a start");
        let (states, still) = reduced.start(&states, &still);
        let mut small =
            Simulation::new(reduced.system.clone(), 1e-3, &states, &still).expect("a start");
        assert_eq!(large.unknowns(), small.unknowns());
        for _ in 0..150 {
            large.step().expect("a step");
            small.step().expect("a step");
        }
        let found = apart_where_told(&large, &mut small, &reduced);
        let (a, b) = (large.energies().expect("energies"), small.energies().expect("energies"));
        let of_energy = (a.0 + a.1 - b.0 - b.1 - reduced.still_energy()).abs();
        println!("{seed}, loops {is_closed}: {found:.1e}, energy {of_energy:.1e}");
        assert!(found < 1e-9 && of_energy < 1e-8, "{seed}: {found} {of_energy}");
    }
    // What can touch a floor stays, lest the forces on it be lost.
    let (floating, states, _) = random_tree(50, false);
    let mut links = floating.links().to_vec();
    links[0].joint = Joint::weld(&states[0]);
    let foot = Site { link: 0, position: [0.0; 3] };
    let system = System::new(links, 9.81)
        .and_then(|system| system.on_floor(Floor::RUBBER, Switching::WithinTheStep, vec![foot]));
    let reduced = merged(&system.expect("a system")).expect("a system");
    assert_eq!((reduced.system.links().len(), reduced.system.sites().len()), (7, 1));
}

/// A scene of bodies of one's own is played without its fixed joints, and tells of all bodies.
#[test]
fn scenes_are_played_without_fixed_joints() {
    let text = |joint: &str| {
        format!(
            r#"
description = "a pendulum with a weight on its rod"
duration_s = 1.0
[integrator]
name = "variational"
step_s = 1e-3
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
[[mechanism.bodies]]
name = "rod"
mass_kg = 1.0
inertia_kg_m2 = [0.01, 0.02, 0.03]
center_m = [0.3, 0.0, 0.0]
joint = {{ kind = "revolute", point_m = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0] }}
torque = 0.7
[[mechanism.bodies]]
name = "weight"
inboard = "rod"
mass_kg = 2.0
inertia_kg_m2 = [0.004, 0.004, 0.002]
center_m = [0.6, 0.1, 0.0]
orientation = [0.8, 0.36, 0.48, 0.0]
joint = {joint}
"#
        )
    };
    let play = |joint: &str| {
        let AnyScene::Mechanism(scene) = parse("test", &text(joint)).expect("a scene") else {
            unreachable!()
        };
        surefoot_sim::mechanism::run(&scene, &mut |_| {}).expect("a run")
    };
    let merged = play(r#"{ kind = "fixed" }"#);
    // A hinge that a stop holds as good as fixed is another way to say it.
    let hinged = play(
        r#"{ kind = "revolute", point_m = [0.6, 0.1, 0.0], axis = [0.0, 1.0, 0.0] }
law = { stiffness = 3e6 }"#,
    );
    assert_eq!((merged.unknowns, hinged.unknowns), (1, 2));
    let (a, b) = (merged.samples.last().expect("samples"), hinged.samples.last().expect("samples"));
    assert_eq!(a.configuration.len(), 14);
    for (x, y) in a.configuration.iter().zip(&b.configuration) {
        assert!((x - y).abs() < 1e-4, "{:?} {:?}", a.configuration, b.configuration);
    }
    assert!(merged.constraint_max < 1e-13, "{}", merged.constraint_max);
}
