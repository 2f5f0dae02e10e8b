//! Closed loops, and constraints of a user's own.

use num_dual::Dual64;
use std::sync::Arc;
use surefoot_multibody::{
    Body, Closing, Closure, ConstraintFunction, Joint, JointConstraint, Link, Simulation, System,
    SystemError,
};
use surefoot_sim::scene::{AnyScene, Mechanism, Multibody, open};

fn four_bar() -> Multibody {
    let AnyScene::Mechanism(scene) = open("four-bar").expect("built in") else {
        unreachable!("a mechanism")
    };
    let Mechanism::Multibody(bodies) = scene.mechanism else { unreachable!("of bodies") };
    bodies
}

/// Over 1e5 steps the loop stays closed to round-off, and energy has no slope.
#[test]
fn a_four_bar_stays_closed_and_keeps_its_energy() {
    let mut simulation = four_bar().start(5e-3).expect("a start");
    let (mut constraint, mut energies) = (0.0_f64, Vec::new());
    for step in 0..100_000 {
        simulation.step().expect("a step");
        if step % 20 == 0 {
            let (kinetic, potential) = simulation.energies().expect("regular");
            energies.push((simulation.progress().time_s, kinetic + potential));
            constraint =
                constraint.max(simulation.system().largest_constraint(&simulation.states()));
        }
    }
    let (slope, error) = super::motion::slope(&energies);
    println!("constraints {constraint:.1e}, energy slope {slope:.1e} ± {error:.1e} J/s");
    assert!(constraint < 1e-10, "{constraint}");
    assert!(slope.abs() < 3.0 * error, "{slope} ± {error}");
}

/// A parallelogram moves like the pendulum that it is: its coupler does not turn, and bars and coupler
/// make one inertia, so that the period is known.
#[test]
fn a_parallelogram_is_a_pendulum() {
    let (l, m_bar, i_bar, m_c, g) = (0.5, 1.0, 0.02, 3.0, 9.81);
    let joint = |outboard: [f64; 3], inboard: [f64; 3]| Joint {
        outboard,
        inboard,
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Revolute { axis: [0.0, 1.0, 0.0] },
    };
    let bar = Body { mass: m_bar, inertia: [i_bar, i_bar, 1e-3] };
    let (up, down, half) = ([0.0, 0.0, 0.5 * l], [0.0, 0.0, -0.5 * l], 0.4);
    let links = vec![
        Link { inboard: None, joint: joint(up, [-half, 0.0, 0.0]), body: bar },
        Link { inboard: None, joint: joint(up, [half, 0.0, 0.0]), body: bar },
        Link {
            inboard: Some(0),
            joint: joint([-half, 0.0, 0.0], down),
            body: Body { mass: m_c, inertia: [0.01, 0.2, 0.2] },
        },
    ];
    let closing = Closing::Joint(joint([half, 0.0, 0.0], down));
    let closure = Closure { outboard: 2, inboard: Some(1), closing };
    let system = System::new(links, g).expect("a tree").with_closure(closure).expect("a loop");
    let amplitude = 0.8_f64;
    let (s, c) = (0.5 * amplitude).sin_cos();
    let (sin, cos) = amplitude.sin_cos();
    let bar_at = |x: f64| [x - 0.5 * l * sin, 0.0, -0.5 * l * cos, c, 0.0, s, 0.0];
    let states = [bar_at(-half), bar_at(half), [-l * sin, 0.0, -l * cos, 1.0, 0.0, 0.0, 0.0]];
    let inertia = 2.0 * (i_bar + m_bar * l * l / 4.0) + m_c * l * l;
    let small = ((2.0 * m_bar * 0.5 + m_c) * g * l / inertia).sqrt();
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    let period = std::f64::consts::TAU / (small * a);
    let error = |steps: u32| {
        let h = period / f64::from(steps);
        let mut simulation =
            Simulation::new(system.clone(), h, &states, &[[0.0; 7]; 3]).expect("a start");
        for _ in 0..steps {
            simulation.step().expect("a step");
        }
        // At rest again: an error in time shows in the velocity.
        simulation.rates().expect("rates")[2][0].abs()
    };
    let (coarse, fine) = (error(100), error(400));
    println!("velocity after a period: {coarse:.1e}, {fine:.1e} m/s");
    assert!(((coarse / fine).log2() / 2.0 - 2.0).abs() < 0.05, "{coarse} {fine}");
}

/// A ring of six rods on ball joints, afloat: the loop's impulses act on two bodies alike, so that momenta stay.
#[test]
fn a_floating_ring_keeps_its_momenta() {
    let (side, m) = (0.3, 0.8);
    let home = [1.0, 0.0, 0.0, 0.0];
    let body = Body { mass: m, inertia: [1e-3, 7e-3, 7e-3] };
    // Rods lie along their x axes; the ring is a regular hexagon in the plane z = 0.
    let corner = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / 6.0).sin_cos();
        [side * cos, side * sin, 0.0]
    };
    let (mut links, mut states) = (Vec::new(), Vec::new());
    for k in 0..6 {
        let (a, b) = (corner(k), corner(k + 1));
        let (s, c) = (0.5 * f64::atan2(b[1] - a[1], b[0] - a[0])).sin_cos();
        let center: [f64; 3] = std::array::from_fn(|i| 0.5 * (a[i] + b[i]));
        states.push([center[0], center[1], 0.0, c, 0.0, 0.0, s]);
        let (outboard, inboard) = ([-0.5 * side, 0.0, 0.0], [0.5 * side, 0.0, 0.0]);
        let constraint =
            if k == 0 { JointConstraint::Floating } else { JointConstraint::Spherical };
        links.push(Link {
            inboard: k.checked_sub(1),
            joint: Joint { outboard, inboard, home, constraint },
            body,
        });
    }
    let closing = Closing::Joint(Joint {
        outboard: [0.5 * side, 0.0, 0.0],
        inboard: [-0.5 * side, 0.0, 0.0],
        home,
        constraint: JointConstraint::Spherical,
    });
    let system = System::new(links, 0.0)
        .expect("a tree")
        .with_closure(Closure { outboard: 5, inboard: Some(0), closing })
        .expect("a ring");
    let rates = super::trees::rigid(&states, [0.1, 0.0, -0.2], [0.5, 0.9, 1.3]);
    let mut simulation = Simulation::new(system, 2e-3, &states, &rates).expect("a start");
    let momenta = |simulation: &mut Simulation| {
        let rates = simulation.rates().expect("rates");
        let (linear, angular) = simulation.system().momentum(&simulation.states(), &rates);
        [linear, angular]
    };
    let first = momenta(&mut simulation);
    let mut drift = 0.0_f64;
    for _ in 0..10_000 {
        simulation.step().expect("a step");
    }
    for (now, then) in momenta(&mut simulation).iter().zip(&first) {
        let size = then.iter().map(|m| m * m).sum::<f64>().sqrt();
        for (a, b) in now.iter().zip(then) {
            drift = drift.max((a - b).abs() / size);
        }
    }
    let constraint = simulation.system().largest_constraint(&simulation.states());
    println!("momenta change by {drift:.1e}, constraints {constraint:.1e}");
    assert!(drift < 1e-9, "{drift}");
    assert!(constraint < 1e-10, "{constraint}");
}

/// A bead on an ellipse: a constraint that no joint is.
#[derive(Debug)]
struct Ellipse;

impl ConstraintFunction for Ellipse {
    fn constraints(&self) -> usize {
        2
    }

    fn evaluate(&self, bead: &[Dual64; 7], _: &[Dual64; 7]) -> [Dual64; 6] {
        let zero = Dual64::from(0.0);
        let on = bead[0] * bead[0] / 4.0 + bead[2] * bead[2] - 1.0;
        [on, bead[1], zero, zero, zero, zero]
    }
}

#[test]
fn a_constraint_of_ones_own_holds() {
    let floating = Joint {
        outboard: [0.0; 3],
        inboard: [0.0; 3],
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Floating,
    };
    let body = Body { mass: 0.3, inertia: [0.01, 0.02, 0.03] };
    let link = Link { inboard: None, joint: floating, body };
    let closing = Closing::General(Arc::new(Ellipse));
    let closure = Closure { outboard: 0, inboard: None, closing };
    let system =
        System::new(vec![link], 9.81).expect("a body").with_closure(closure).expect("a bead");
    let angle = 0.7_f64;
    let start = [2.0 * angle.cos(), 0.0, angle.sin(), 1.0, 0.0, 0.0, 0.0];
    let mut simulation =
        Simulation::new(system.clone(), 2e-3, &[start], &[[0.0; 7]]).expect("a start");
    let energy = |simulation: &mut Simulation| {
        let (kinetic, potential) = simulation.energies().expect("regular");
        kinetic + potential
    };
    let first = energy(&mut simulation);
    let (mut worst, mut lowest) = (0.0_f64, f64::INFINITY);
    for _ in 0..5000 {
        simulation.step().expect("a step");
        let x = simulation.state(0);
        worst = worst.max((x[0] * x[0] / 4.0 + x[2] * x[2] - 1.0).abs()).max(x[1].abs());
        lowest = lowest.min(x[2]);
        assert!((energy(&mut simulation) - first).abs() < 1e-4);
    }
    println!("off the ellipse by {worst:.1e}, down to {lowest}");
    assert!(worst < 1e-12, "{worst}");
    assert!(lowest < -0.999, "it swings through the lowest point: {lowest}");
    // Off the ellipse there is no start.
    let off = [2.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0];
    let refused = Simulation::new(system, 2e-3, &[off], &[[0.0; 7]]).err();
    assert!(matches!(refused, Some(SystemError::OpenLoop { closure: 0, .. })), "{refused:?}");
}

#[test]
fn impossible_loops_are_refused() {
    let system = || super::motion::CHAIN.system().expect("a system");
    let joint = system().links()[1].joint;
    for (outboard, inboard) in [(10, None), (0, Some(10)), (3, Some(3))] {
        let closure = Closure { outboard, inboard, closing: Closing::Joint(joint) };
        let refused = system().with_closure(closure).err();
        assert_eq!(refused, Some(SystemError::Closure { closure: 0 }));
    }
}
