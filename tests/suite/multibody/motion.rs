//! Motions of chains and trees.

use super::trees::{floating_chain, mixed_tree};
use surefoot_sim::multibody::{
    Body, BodyState, Chain, ChainJoint, Link, Simulation, System, SystemError,
};

pub const CHAIN: Chain = Chain {
    links: 10,
    mass: 1.0,
    length: 0.5,
    radius: 0.05,
    joint: ChainJoint::Alternating,
    floats: false,
    gravity: 9.81,
};

fn at_rest(chain: &Chain, angle: f64, h: f64) -> Simulation {
    let system = chain.system().expect("a system");
    let still = vec![[0.0; 7]; chain.links];
    Simulation::new(system, h, &chain.bent(angle), &still).expect("a start")
}

/// One link on a hinge is the physical pendulum: its period by the arithmetic-geometric mean.
#[test]
fn one_link_is_the_physical_pendulum() {
    let chain = Chain { links: 1, joint: ChainJoint::Revolute, ..CHAIN };
    let (m, l, r) = (chain.mass, chain.length, chain.radius);
    let inertia = m * (3.0 * r * r + l * l) / 12.0 + m * l * l / 4.0;
    let small = (m * chain.gravity * l / 2.0 / inertia).sqrt();
    let amplitude = 1.2_f64;
    let (mut a, mut g) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..10 {
        (a, g) = (0.5 * (a + g), f64::sqrt(a * g));
    }
    let period = std::f64::consts::TAU / (small * a);
    let error = |steps: usize| {
        let mut simulation = at_rest(&chain, amplitude, period / steps as f64);
        let start = simulation.state(0);
        for _ in 0..steps {
            simulation.step().expect("a step");
        }
        // At rest again, so that errors in time show in the velocity.
        let rates = simulation.rates().expect("rates");
        let apart = (simulation.state(0)[0] - start[0]).abs();
        (rates[0][0].abs(), apart)
    };
    let (coarse, fine) = (error(200).0, error(400).0);
    println!("velocity after a period: {coarse:.1e}, {fine:.1e} m/s");
    assert!(((coarse / fine).log2() - 2.0).abs() < 0.05, "{coarse} {fine}");
    assert!(error(400).1 < 1e-6);
}

/// Free trees keep their momenta, constraints stay, in every kind of joint.
#[test]
fn free_trees_keep_their_momenta() {
    for (name, links, joint) in [
        ("revolute", 6, Some(ChainJoint::Alternating)),
        ("spherical", 20, Some(ChainJoint::Spherical)),
        ("mixed", 50, None),
    ] {
        let (system, states, rates) = match joint {
            Some(joint) => floating_chain(links, joint),
            None => mixed_tree(links),
        };
        let mut simulation = Simulation::new(system, 2e-3, &states, &rates).expect("a start");
        let momentum = |simulation: &mut Simulation| {
            let rates = simulation.rates().expect("rates");
            let (linear, angular) = simulation.system().momentum(&simulation.states(), &rates);
            [linear, angular]
        };
        let first = momentum(&mut simulation);
        let mut constraint = 0.0_f64;
        let mut drift = 0.0_f64;
        for step in 0..10_000 {
            simulation.step().unwrap_or_else(|error| panic!("{name}: {error}"));
            if step % 100 == 0 {
                constraint =
                    constraint.max(simulation.system().largest_constraint(&simulation.states()));
                for (now, then) in momentum(&mut simulation).iter().zip(&first) {
                    let size = then.iter().map(|m| m * m).sum::<f64>().sqrt();
                    for (a, b) in now.iter().zip(then) {
                        drift = drift.max((a - b).abs() / size);
                    }
                }
            }
        }
        let progress = simulation.progress();
        println!(
            "{name}: momentum {drift:.1e}, constraints {constraint:.1e}, {:.2} iterations",
            progress.mean_iterations()
        );
        assert!(drift < 1e-9, "{name}: momentum {drift}");
        assert!(constraint < 1e-10, "{name}: constraint {constraint}");
    }
}

/// The 10-link chain at 1 ms: energy in a narrow band without a slope, constraints at round-off.
#[test]
fn energy_of_a_chain_has_no_slope() {
    let mut simulation = at_rest(&CHAIN, 0.3, 1e-3);
    let energy = |simulation: &mut Simulation| {
        let rates = simulation.rates().expect("rates");
        simulation.system().energy(&simulation.states(), &rates)
    };
    let first = energy(&mut simulation);
    let (mut low, mut high) = (first, first);
    let (mut n, mut t, mut e, mut tt, mut te) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let (mut constraint, mut fastest) = (0.0_f64, 0.0_f64);
    for step in 0..100_000 {
        if step % 20 == 0 {
            let (time, now) = (simulation.progress().time_s, energy(&mut simulation));
            (low, high) = (low.min(now), high.max(now));
            let rates = simulation.rates().expect("rates");
            fastest = rates.iter().fold(fastest, |m, v| m.max(v[0].abs()));
            n += 1.0;
            t += time;
            e += now - first;
            tt += time * time;
            te += time * (now - first);
            constraint =
                constraint.max(simulation.system().largest_constraint(&simulation.states()));
        }
        simulation.step().expect("a step");
    }
    let slope = (n * te - t * e) / (n * tt - t * t);
    // Potential energy over which the chain moves.
    let size =
        CHAIN.gravity * (0..10).map(|k| CHAIN.mass * CHAIN.length * (k as f64 + 0.5)).sum::<f64>();
    let progress = simulation.progress();
    println!(
        "band {:.1e} of {size:.0} J, speed up to {fastest:.1} m/s, slope {slope:.1e} J/s, constraints \
         {constraint:.1e}, {:.2} iterations, {} at most",
        (high - low) / size,
        progress.mean_iterations(),
        progress.most_iterations,
    );
    assert!((high - low) / size < 0.011, "{low} {high}");
    assert!(constraint < 1e-10, "{constraint}");
    // Over the whole run the line moves by less than a hundredth of the band.
    assert!(slope.abs() * 100.0 < 0.01 * size, "{slope}");
}

#[test]
fn impossible_systems_and_starts_are_refused() {
    let link = CHAIN.system().expect("a system").links()[1];
    let loose = Link { inboard: Some(1), ..link };
    assert_eq!(
        System::new(vec![link, loose], 9.81).err(),
        Some(SystemError::Order { link: 0, inboard: 0 })
    );
    let weightless = Link { inboard: None, body: Body { mass: 0.0, ..link.body }, ..link };
    assert_eq!(System::new(vec![weightless], 9.81).err(), Some(SystemError::Inertia { link: 0 }));
    let system = CHAIN.system().expect("a system");
    let (states, still) = (CHAIN.bent(0.3), vec![[0.0; 7]; 10]);
    let start = |h, states: Vec<BodyState>, rates: Vec<BodyState>| {
        Simulation::new(system.clone(), h, &states, &rates).err()
    };
    for h in [0.0, f64::NAN, -1.0] {
        assert!(matches!(start(h, states.clone(), still.clone()), Some(SystemError::Step { .. })));
    }
    let short = start(1e-3, states[1..].to_vec(), still.clone());
    assert_eq!(short, Some(SystemError::Length { given: 9, links: 10 }));
    let mut moved = states.clone();
    moved[4][0] += 1e-3;
    let found = start(1e-3, moved, still.clone());
    assert!(matches!(found, Some(SystemError::OffManifold { link: 4, .. })), "{found:?}");
    let mut lost = states.clone();
    lost[7][3] = f64::NAN;
    assert_eq!(
        start(1e-3, lost, still.clone()),
        Some(SystemError::NotFinite { link: 7, coordinate: 3 })
    );
    let mut across = still;
    across[0][0] = 1.0;
    assert!(matches!(start(1e-3, states, across), Some(SystemError::OffManifold { link: 0, .. })));
}
