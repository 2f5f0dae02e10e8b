//! Trees that hang from the links that the world holds, against floating trees with welds beside them.

use super::merged::{random_tree, unit};
use super::oracle::apart;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{
    Body, BodyState, Closing, ClosingMotors, Closure, Gimbal, Joint, JointConstraint, JointLaw,
    Link, Reduced, Rerooted, Seat, Simulation, System, SystemError, merged, rerooted,
};

/// A random floating tree at rest, with motors in its spherical joint and a spring in a hinge.
fn tree(seed: u64) -> (System, Vec<BodyState>) {
    let (system, states, _) = random_tree(seed, false);
    let mut random = Pcg64Mcg::seed_from_u64(seed + 1000);
    let first = unit(&mut random);
    let second = first.cross(&unit(&mut random)).normalize();
    let axes = [first, second, first.cross(&second)].map(Into::into);
    let gimbal = Gimbal::new(axes).expect("right angles");
    let spring = JointLaw { stiffness: 2.0, rest: 0.1, ..JointLaw::default() };
    let system = system.with_gimbal(1, gimbal).and_then(|system| system.with_law(9, spring));
    (system.expect("a system"), states)
}

/// A random floating chain of seven bodies at rest, on joints of all kinds with motors.
fn chain(seed: u64) -> (System, Vec<BodyState>) {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let (mut links, mut states, mut gimbals) = (Vec::new(), Vec::<BodyState>::new(), Vec::new());
    for k in 0..7_usize {
        let home = Quaternion::from_rotation_vector(unit(&mut random));
        let axis = unit(&mut random);
        let across = axis.cross(&unit(&mut random)).normalize();
        let constraint = match k {
            0 => JointConstraint::Floating,
            1 | 4 => JointConstraint::Spherical,
            2 | 5 => JointConstraint::Revolute { axis: axis.into() },
            _ => JointConstraint::Universal {
                outboard_axis: axis.into(),
                inboard_axis: home.rotate(across).into(),
            },
        };
        if constraint == JointConstraint::Spherical {
            let axes = [axis, across, axis.cross(&across)].map(Into::into);
            gimbals.push((k, Gimbal::new(axes).expect("right angles")));
        }
        let joint = Joint {
            outboard: (unit(&mut random) * 0.3).into(),
            inboard: (unit(&mut random) * 0.3).into(),
            home: home.to_array(),
            constraint,
        };
        let arm = Vector3::from(joint.inboard) - home.rotate(joint.outboard.into());
        let (mut p, mut q) = (Vector3::zeros(), Quaternion::identity());
        if let Some([x, y, z, s, i, j, l]) = states.last().copied() {
            let on = Quaternion::from_array([s, i, j, l]);
            (p, q) = (Vector3::new(x, y, z) + on.rotate(arm), on.product(home));
        }
        let [s, i, j, l] = q.to_array();
        states.push([p.x, p.y, p.z, s, i, j, l]);
        let mass = random.random_range(0.5..2.0);
        let body = Body { mass, inertia: [0.02, 0.025, 0.03].map(|i| mass * i) };
        links.push(Link { inboard: k.checked_sub(1), joint, body });
    }
    let mut system = System::new(links, 9.81).expect("a system");
    for (link, gimbal) in gimbals {
        system = system.with_gimbal(link, gimbal).expect("a ball");
    }
    (system, states)
}

fn welded(mut system: System, states: &[BodyState], held: &[usize]) -> System {
    for link in held {
        let closing = Closing::Joint(Joint::weld(&states[*link]));
        system = system
            .with_closure(Closure { outboard: *link, inboard: None, closing })
            .expect("links");
    }
    system
}

/// Numbers for people.
pub fn told(all: &[f64]) -> String {
    all.iter().map(|x| format!("{x:.1e}")).collect::<Vec<_>>().join(", ")
}

fn motors(system: &System, link: usize) -> usize {
    match system.links()[link].joint.constraint {
        JointConstraint::Revolute { .. } | JointConstraint::Prismatic { .. } => 1,
        JointConstraint::Universal { .. } => 2,
        JointConstraint::Spherical => 3,
        JointConstraint::Floating | JointConstraint::Fixed => 0,
    }
}

/// Holds the same torques in both motions' motors, or compares the motors' angles.
struct Both<'a> {
    large: &'a mut Simulation,
    small: &'a mut Simulation,
    turned: &'a Rerooted,
    carrier: &'a dyn Fn(usize) -> Option<usize>,
}

impl Both<'_> {
    fn drive(&mut self, link: usize, torques: &[f64]) {
        self.large.set_torques(link, torques);
        match self.turned.seats[link] {
            Some(Seat::Tree { link, is_reversed }) => {
                let mut own = torques.to_vec();
                if is_reversed {
                    own.reverse();
                }
                (self.carrier)(link)
                    .into_iter()
                    .for_each(|link| self.small.set_torques(link, &own));
            }
            Some(Seat::Closure { closure }) => self.small.set_closing_torques(closure, torques),
            None => {}
        }
    }

    /// Largest difference of a joint's angles and rates.
    fn apart(&mut self, link: usize, count: usize) -> [f64; 2] {
        let of_large = self.large.columns(link);
        let rates = self.large.observed_rates().expect("rates")[of_large].to_vec();
        let angles = self.large.angles(link)[..count].to_vec();
        let (mut own, mut own_rates) = match self.turned.seats[link] {
            Some(Seat::Tree { link, is_reversed }) => {
                let Some(link) = (self.carrier)(link) else { return [0.0; 2] };
                let columns = self.small.columns(link);
                let mut own = self.small.angles(link)[..count].to_vec();
                let mut rates = self.small.observed_rates().expect("rates")[columns].to_vec();
                if is_reversed {
                    own.reverse();
                    rates.reverse();
                }
                (own, rates)
            }
            Some(Seat::Closure { closure }) => {
                let rates = self.small.closing_rates(closure)[..count].to_vec();
                (self.small.closing_angles(closure)[..count].to_vec(), rates)
            }
            None => return [0.0; 2],
        };
        let largest = |a: &mut Vec<f64>, b: &[f64]| {
            a.drain(..).zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        [largest(&mut own, &angles), largest(&mut own_rates, &rates)]
    }
}

/// The motion of a floating tree with welded links, and of the tree rooted there, under the same random torques:
/// what bodies, angles, rates, the energy and the forces that hold a link are apart by, at most.
fn compare(
    (system, states): (System, Vec<BodyState>),
    seed: u64,
    held: &[usize],
    cut: &[usize],
) -> [f64; 5] {
    let at: Vec<(usize, BodyState)> = held.iter().map(|link| (*link, states[*link])).collect();
    let turned = rerooted(&system, &at, cut).expect("a tree");
    let reduced = merged(&turned.system).expect("a system");
    let (h, still) = (1e-3, vec![[0.0; 7]; states.len()]);
    let mut order = vec![0; states.len()];
    for (old, new) in turned.links.iter().enumerate() {
        order[*new] = old;
    }
    let large_system = welded(system.clone(), &states, held);
    let mut large = Simulation::new(large_system, h, &states, &still).expect("a start");
    let in_order: Vec<BodyState> = order.iter().map(|old| states[*old]).collect();
    let (states, still) = reduced.start(&in_order, &still);
    let mut small = Simulation::new(reduced.system.clone(), h, &states, &still).expect("a start");
    assert!(small.unknowns() + 6 * held.len() < large.unknowns(), "{}", small.unknowns());
    let carrier = |link: usize| reduced.carrier(link).and_then(|(link, _)| link);
    let mut random = Pcg64Mcg::seed_from_u64(seed + 2000);
    let mut largest = [0.0_f64; 5];
    let mut note = |i: usize, found: f64| largest[i] = largest[i].max(found);
    for _ in 0..150 {
        let mut both =
            Both { large: &mut large, small: &mut small, turned: &turned, carrier: &carrier };
        for link in 0..system.links().len() {
            let torques: Vec<f64> =
                (0..motors(&system, link)).map(|_| random.random_range(-0.5..0.5)).collect();
            both.drive(link, &torques);
        }
        both.large.step().expect("a step");
        both.small.step().expect("a step");
        for link in 0..system.links().len() {
            let [angles, rates] = both.apart(link, motors(&system, link));
            // A spherical joint's columns are told as its motors.
            note(1, angles);
            note(2, rates);
        }
        let (states, rates) = (small.states(), small.rates().expect("rates"));
        let told = reduced.expanded(&states, &rates);
        for (new, state) in told.iter().enumerate() {
            let (told, _) = state.expect("merging loses no body");
            note(0, apart(&[told], &[large.state(order[new])]));
        }
        let (a, b) = (large.energies().expect("energies"), small.energies().expect("energies"));
        note(3, (a.0 + a.1 - b.0 - b.1 - reduced.still_energy()).abs());
    }
    // What holds the tree: the weld's impulse, and that of the world on what hangs there, with the weight of
    // what has become part of the world.
    let hanging: Vec<usize> = (0..reduced.system.links().len())
        .filter(|k| reduced.system.links()[*k].inboard.is_none())
        .collect();
    let held_by_world =
        |i: usize| -> f64 { hanging.iter().map(|k| small.world_impulse(*k)[i]).sum() };
    let by_welds = |i: usize| -> f64 { large.loop_impulses().chunks(6).map(|weld| weld[i]).sum() };
    let weight = reduced_weight(&system, &reduced, &order) * h;
    for i in 0..3 {
        let own = if i == 2 { weight } else { 0.0 };
        note(4, (held_by_world(i) + own - by_welds(i)).abs() / h);
    }
    largest
}

/// Weight of what is part of the world now, N.
fn reduced_weight(system: &System, reduced: &Reduced, order: &[usize]) -> f64 {
    let is_still = |new: usize| matches!(reduced.carrier(new), Some((None, _)));
    let masses = order.iter().enumerate().filter(|(new, _)| is_still(*new));
    masses.map(|(_, old)| system.links()[*old].body.mass).sum::<f64>() * system.gravity()
}

/// Rooted at any link that is held, the tree moves as the floating one with that link welded to the world: all
/// bodies, motors' angles and rates, energy and the force that holds it, to round-off; under random torques in all
/// joints, of all kinds, and a spring and a damper.
#[test]
fn a_tree_hangs_from_any_link() {
    let mut worst = [0.0_f64; 5];
    for seed in 100..112 {
        let held = (seed as usize * 5) % 12;
        let found = compare(tree(seed), seed, &[held], &[]);
        println!("{seed}, held at {held}: {}", told(&found));
        worst = std::array::from_fn(|i| worst[i].max(found[i]));
    }
    println!("worst {}", told(&worst));
    assert!(worst[0] < 1e-9 && worst[1] < 1e-9 && worst[3] < 1e-8, "{worst:?}");
    assert!(worst[2] < 1e-6 && worst[4] < 1e-5, "{worst:?}");
}

/// Held at two links and cut at any joint between them, the same: the joint closes the loop, with its motors.
#[test]
fn a_joint_that_is_cut_closes_the_loop() {
    let mut worst = [0.0_f64; 5];
    for seed in 200..204 {
        for cut in 1..6 {
            let mut found = compare(chain(seed), seed, &[0, 6], &[cut]);
            if cut == 1 {
                // The loop is closed on the world, which hears of it by its constraints.
                found[4] = 0.0;
            }
            println!("{seed}, cut at {cut}: {}", told(&found));
            worst = std::array::from_fn(|i| worst[i].max(found[i]));
        }
    }
    println!("worst {}", told(&worst));
    assert!(worst[0] < 1e-9 && worst[1] < 1e-9 && worst[3] < 1e-8, "{worst:?}");
    assert!(worst[2] < 1e-6 && worst[4] < 1e-5, "{worst:?}");
}

/// What cannot be rooted anew says which link, and what it would take.
#[test]
fn what_is_held_must_hang_together() {
    let (system, states) = chain(300);
    let at = |links: &[usize]| -> Vec<(usize, BodyState)> {
        links.iter().map(|link| (*link, states[*link])).collect()
    };
    let refused = |system: &System, held: &[usize], cut: &[usize]| {
        rerooted(system, &at(held), cut).map(|_| ()).expect_err("no tree")
    };
    let unsupported = |error: SystemError, link: usize, word: &str| {
        assert!(matches!(error, SystemError::Unsupported { link: l, .. } if l == link), "{error}");
        assert!(error.to_string().contains(word), "{error}");
    };
    // No cut between two that are held; nothing held beyond a cut; a joint that has a spring.
    let error = refused(&system, &[0, 6], &[]);
    assert!(error.to_string().contains("a cut between"), "{error}");
    unsupported(refused(&system, &[0], &[4]), 4, "held beyond");
    let with_spring =
        system.clone().with_law(5, JointLaw { stiffness: 1.0, ..JointLaw::default() });
    unsupported(refused(&with_spring.expect("a hinge"), &[0, 6], &[5]), 5, "without a law");
    unsupported(refused(&system, &[0, 6], &[9]), 9, "exists");
    // A tree that the world holds by another joint already.
    let mut links = system.links().to_vec();
    links[0].joint = Joint::weld(&states[0]);
    unsupported(refused(&System::new(links, 0.0).expect("a system"), &[3], &[]), 0, "floats");
    // A driven joint is told from a body that moves.
    let turned = rerooted(&system, &at(&[0, 6]), &[6]).expect("a tree");
    unsupported(merged(&turned.system).map(|_| ()).expect_err("told from the world"), 6, "driven");
    // Motors of a closing joint need one that turns, and one set of them.
    let closed = welded(system, &states, &[6]);
    let motors = ClosingMotors { closure: 0, gimbal: None };
    let refused = closed.with_closing_motors(motors).map(|_| ()).expect_err("a weld");
    assert_eq!(refused, SystemError::ClosingMotors { closure: 0 });
}
