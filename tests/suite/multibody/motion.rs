//! Motions of chains and trees.

use super::trees::{floating_chain, mixed_tree};
use surefoot_multibody::{
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

/// Slope of a straight line through points, and its standard error. Neighbours depend on each other: the
/// error is that of the means of a hundred stretches, whose own are nearly independent.
pub fn slope(points: &[(f64, f64)]) -> (f64, f64) {
    let means: Vec<(f64, f64)> = points
        .chunks(points.len().div_ceil(100))
        .map(|chunk| {
            let n = chunk.len() as f64;
            let sum = chunk.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + (p.1 - points[0].1)));
            (sum.0 / n, sum.1 / n)
        })
        .collect();
    let n = means.len() as f64;
    let mean = means.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0 / n, s.1 + p.1 / n));
    let variance: f64 = means.iter().map(|p| (p.0 - mean.0).powi(2)).sum();
    let slope = means.iter().map(|p| (p.0 - mean.0) * (p.1 - mean.1)).sum::<f64>() / variance;
    let left: f64 = means.iter().map(|p| (p.1 - mean.1 - slope * (p.0 - mean.0)).powi(2)).sum();
    (slope, (left / (n - 2.0) / variance).sqrt())
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

/// The 10-link chain at 1 ms over 1e5 steps: energy in a narrow band, constraints at round-off. The line
/// through its energy moves by what the chain's modes exchange among them while it forgets its start (the
/// modified energy is what stays, not the energy): the next test asks whether there is a drift.
#[test]
fn energy_of_a_chain_stays_in_a_narrow_band() {
    let mut simulation = at_rest(&CHAIN, 0.3, 1e-3);
    let first = energy(&mut simulation);
    let (mut low, mut high, mut constraint) = (first, first, 0.0_f64);
    for step in 0..100_000 {
        simulation.step().expect("a step");
        if step % 20 == 0 {
            let now = energy(&mut simulation);
            (low, high) = (low.min(now), high.max(now));
            constraint =
                constraint.max(simulation.system().largest_constraint(&simulation.states()));
        }
    }
    // Potential energy over which the chain moves.
    let size =
        CHAIN.gravity * (0..10).map(|k| CHAIN.mass * CHAIN.length * (k as f64 + 0.5)).sum::<f64>();
    let progress = simulation.progress();
    println!(
        "band {:.1e} of {size:.0} J, constraints {constraint:.1e}, {:.2} iterations, {} at most",
        (high - low) / size,
        progress.mean_iterations(),
        progress.most_iterations,
    );
    assert!((high - low) / size < 1e-3, "{low} {high}");
    assert!(constraint < 1e-10, "{constraint}");
    assert_eq!(progress.split_steps, 0);
}

/// Slopes of the energy over 1e5 steps, of eight chains that have forgotten their starts: their mean is
/// zero within what its standard error allows.
#[test]
fn energy_of_chains_has_no_slope() {
    let slopes: Vec<f64> = std::thread::scope(|scope| {
        let runs = [0, 1].map(|half| {
            scope.spawn(move || -> Vec<f64> {
                (0..4)
                    .map(|k| slope_after_relaxing(0.25 + 0.02 * f64::from(2 * k + half)))
                    .collect()
            })
        });
        runs.into_iter().flat_map(|run| run.join().expect("a run")).collect()
    });
    let n = slopes.len() as f64;
    let mean = slopes.iter().sum::<f64>() / n;
    let variance = slopes.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let error = (variance / n).sqrt();
    println!("slope {mean:.1e} ± {error:.1e} J/s, of {slopes:?}");
    // Of unbiased slopes the mean of eight is within this in 99 of 100 cases (Student, seven degrees of freedom).
    assert!(mean.abs() < 3.5 * error, "{mean} ± {error}");
    // What is asked for matters: over the run, less than a thousandth of the band's limit.
    assert!(error < 1e-5, "{error}");
}

fn slope_after_relaxing(bend: f64) -> f64 {
    let mut simulation = at_rest(&CHAIN, bend, 1e-3);
    let mut energies = Vec::new();
    for step in 0..200_000 {
        simulation.step().expect("a step");
        if step >= 100_000 && step % 20 == 0 {
            energies.push((simulation.progress().time_s, energy(&mut simulation)));
        }
    }
    slope(&energies).0
}

fn energy(simulation: &mut Simulation) -> f64 {
    let (kinetic, potential) = simulation.energies().expect("regular");
    kinetic + potential
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
