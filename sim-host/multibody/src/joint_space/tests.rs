//! Against closed forms and what is conserved.

use super::super::{
    Body, BodyState, Closing, Closure, Joint, JointConstraint, Link, PointSpring, Rolling,
    SpringEnd, System,
};
use super::{JointSpace, JointSpaceFault};

const FREE: Joint = Joint {
    outboard: [0.0; 3],
    inboard: [0.0; 3],
    home: [1.0, 0.0, 0.0, 0.0],
    constraint: JointConstraint::Floating,
};
const UPRIGHT: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

fn state([x, y, z]: [f64; 3], [s, a, b, c]: [f64; 4]) -> BodyState {
    [x, y, z, s, a, b, c]
}

/// Of an upright body that turns: `q̇ = ½ (0, ω)`.
fn rate([x, y, z]: [f64; 3], omega: [f64; 3]) -> BodyState {
    let [a, b, c] = omega.map(|w| 0.5 * w);
    [x, y, z, 0.0, a, b, c]
}

/// The classical Runge–Kutta method, with the way back to the manifold after each step.
fn run(of: &mut JointSpace, h: f64, steps: usize) -> (Vec<f64>, Vec<f64>) {
    let (q, u) = of.start();
    let (mut q, mut u) = (q.to_vec(), u.to_vec());
    let moved = |x: &[f64], d: &[f64], by: f64| -> Vec<f64> {
        x.iter().zip(d).map(|(x, d)| x + by * d).collect()
    };
    for _ in 0..steps {
        let rates = |q: &[f64], u: &[f64]| {
            let mut q_dot = vec![0.0; q.len()];
            of.position_rates(q, u, &mut q_dot);
            (q_dot, of.accelerations(q, u).expect("accelerations"))
        };
        let a = rates(&q, &u);
        let b = rates(&moved(&q, &a.0, 0.5 * h), &moved(&u, &a.1, 0.5 * h));
        let c = rates(&moved(&q, &b.0, 0.5 * h), &moved(&u, &b.1, 0.5 * h));
        let d = rates(&moved(&q, &c.0, h), &moved(&u, &c.1, h));
        for (by, k) in [(h / 6.0, &a), (h / 3.0, &b), (h / 3.0, &c), (h / 6.0, &d)] {
            (q, u) = (moved(&q, &k.0, by), moved(&u, &k.1, by));
        }
        of.settle(&mut q, &mut u).expect("loops that close");
    }
    (q, u)
}

fn body(mass: f64, inertia: [f64; 3]) -> Link {
    Link { inboard: None, joint: FREE, body: Body { mass, inertia } }
}

/// Down a slope of 10°, `s = ½ g sin α t²/(1 + I/(m r²))`: a wheel across the slope, and a ball.
#[test]
fn wheels_and_balls_roll_down_a_slope_as_the_closed_form_says() {
    let alpha = 10.0_f64.to_radians();
    let normal = [alpha.sin(), 0.0, alpha.cos()];
    for (axis, inertia) in [(Some([0.0, 1.0, 0.0]), 0.5), (None, 0.4)] {
        let (mass, radius) = (2.0, 0.3);
        let spin = inertia * mass * radius * radius;
        let link = body(mass, [spin; 3]);
        let rolling = Rolling { link: 0, center: [0.0; 3], axis, radius, normal, ground: [0.0; 3] };
        let system = System::new(vec![link], 9.81).and_then(|s| s.with_rolling(rolling));
        let start = [state(normal.map(|n| radius * n), UPRIGHT)];
        let system = system.expect("a system");
        let mut all = JointSpace::new(system, &start, &[[0.0; 7]], &[]).expect("a start");
        let (q, _) = run(&mut all, 1e-2, 200);
        let wanted = 0.5 * 9.81 * alpha.sin() * 4.0 / (1.0 + inertia);
        let along = [alpha.cos(), 0.0, -alpha.sin()];
        let rolled: f64 = (0..3).map(|k| along[k] * (q[k] - start[0][k])).sum();
        // Measured 2e-15.
        assert!((rolled - wanted).abs() < 1e-12, "{axis:?}: {rolled} {wanted}");
    }
}

/// A coin that rolls round in a circle, leaning: energy stays, and its lowest point on the plane does not move.
#[test]
fn a_leaning_wheel_keeps_its_energy() {
    let (mass, radius, lean) = (1.0, 0.25, 0.4_f64);
    let flat = 0.5 * mass * radius * radius;
    let link = body(mass, [0.5 * flat, flat, 0.5 * flat]);
    let rolling = Rolling {
        link: 0,
        center: [0.0; 3],
        axis: Some([0.0, 1.0, 0.0]),
        radius,
        normal: [0.0, 0.0, 1.0],
        ground: [0.0; 3],
    };
    let system = System::new(vec![link], 9.81).and_then(|s| s.with_rolling(rolling));
    let system = system.expect("a system");
    let (s, c) = (0.5 * lean).sin_cos();
    let turn = [c, s, 0.0, 0.0];
    // Upright axes of the body: spin 8 rad/s about y', yaw 1 rad/s about z; v = −ω × ρ.
    let (y, z) = ([0.0, lean.cos(), lean.sin()], [0.0, -lean.sin(), lean.cos()]);
    let omega: [f64; 3] = std::array::from_fn(|k| 8.0 * y[k] + [0.0, 0.0, 1.0][k]);
    let rho = z.map(|z| -radius * z);
    let v = [
        omega[2] * rho[1] - omega[1] * rho[2],
        omega[0] * rho[2] - omega[2] * rho[0],
        omega[1] * rho[0] - omega[0] * rho[1],
    ];
    // q̇ = ½ (0, ω) ⋆ q, ω in the world.
    let q_dot = [
        -0.5 * omega[0] * turn[1],
        0.5 * omega[0] * turn[0],
        0.5 * (omega[1] * turn[0] + omega[2] * turn[1]),
        0.5 * (omega[2] * turn[0] - omega[1] * turn[1]),
    ];
    let start = [state([0.0, 0.0, radius * lean.cos()], turn)];
    let rates = [[v[0], v[1], v[2], q_dot[0], q_dot[1], q_dot[2], q_dot[3]]];
    let mut all = JointSpace::new(system, &start, &rates, &[]).expect("a start");
    let energy = |all: &JointSpace, q: &[f64], u: &[f64]| {
        let (states, rates) = all.bodies(q, u);
        (all.system().energy(&states, &rates, |_| 0.0), states)
    };
    let (q, u) = all.start();
    let before = energy(&all, q, u).0;
    let (q, u) = run(&mut all, 1e-3, 3000);
    let (after, states) = energy(&all, &q, &u);
    // Measured 1e-11 J of 3 J, by a method of fourth order.
    assert!((after - before).abs() < 1e-9, "{}", after - before);
    assert!(states[0][2] < radius && states[0][2] > 0.1);
}

/// Two bodies, a spring and a damper between points of them: momenta stay, and energy only goes.
#[test]
fn springs_between_bodies_keep_momentum_and_dampers_take_energy() {
    let links = vec![body(1.0, [0.1, 0.2, 0.25]), body(2.0, [0.3, 0.2, 0.2])];
    let ends = [
        SpringEnd { link: Some(0), point: [0.1, 0.2, 0.0] },
        SpringEnd { link: Some(1), point: [-0.2, 0.1, 0.1] },
    ];
    for damping in [0.0, 0.8] {
        let spring = PointSpring { ends, stiffness: 40.0, rest: 0.5, damping };
        let system = System::new(links.clone(), 0.0).and_then(|s| s.with_spring(spring));
        let states = [state([0.0; 3], UPRIGHT), state([1.0, 0.2, -0.3], UPRIGHT)];
        let rates =
            [rate([0.3, 0.0, 0.1], [0.5, -1.0, 2.0]), rate([-0.2, 0.4, 0.0], [0.0, 1.0, 0.3])];
        let system = system.expect("a system");
        let mut all = JointSpace::new(system, &states, &rates, &[]).expect("a start");
        let seen = |all: &JointSpace, q: &[f64], u: &[f64]| {
            let (states, rates) = all.bodies(q, u);
            let (linear, angular) = all.system().momentum(&states, &rates);
            (all.system().energy(&states, &rates, |_| 0.0), [linear, angular].concat())
        };
        let (q, u) = all.start();
        let (energy, momentum) = seen(&all, q, u);
        let (q, u) = run(&mut all, 1e-3, 2000);
        let (after, kept) = seen(&all, &q, &u);
        for (a, b) in kept.iter().zip(&momentum) {
            // Measured 2e-11, the method's error.
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
        if damping == 0.0 {
            assert!((after - energy).abs() < 1e-8 * energy, "{after} {energy}");
        } else {
            assert!(after < 0.9 * energy, "{after} {energy}");
        }
    }
}

/// A body on a spring to the world, along a line: `x = e^(−δt) cos ωt + …` of the damped oscillator.
#[test]
fn a_damped_spring_swings_as_the_closed_form_says() {
    let joint = Joint { constraint: JointConstraint::Prismatic { axis: [1.0, 0.0, 0.0] }, ..FREE };
    let (m, k, d) = (2.0, 50.0, 3.0);
    let link = Link { inboard: None, joint, body: Body { mass: m, inertia: [1.0; 3] } };
    let ends = [
        SpringEnd { link: Some(0), point: [0.0; 3] },
        SpringEnd { link: None, point: [-1.0, 0.0, 0.0] },
    ];
    let spring = PointSpring { ends, stiffness: k, rest: 1.2, damping: d };
    let system = System::new(vec![link], 0.0).and_then(|s| s.with_spring(spring));
    let start = [state([0.0; 3], UPRIGHT)];
    let mut all =
        JointSpace::new(system.expect("a system"), &start, &[[0.0; 7]], &[]).expect("a start");
    let (q, _) = run(&mut all, 1e-3, 1500);
    let (delta, t): (f64, f64) = (d / (2.0 * m), 1.5);
    let omega = (k / m - delta * delta).sqrt();
    let swing = (-delta * t).exp() * ((omega * t).cos() + delta / omega * (omega * t).sin());
    let wanted = 0.2 - 0.2 * swing;
    // Measured 1e-14.
    assert!((q[0] - wanted).abs() < 1e-11, "{} {wanted}", q[0]);
}

#[test]
fn what_slips_at_the_start_is_refused() {
    let link = body(1.0, [0.1; 3]);
    let rolling = Rolling {
        link: 0,
        center: [0.0; 3],
        axis: None,
        radius: 0.5,
        normal: [0.0, 0.0, 1.0],
        ground: [0.0; 3],
    };
    let system = System::new(vec![link], 9.81).and_then(|s| s.with_rolling(rolling));
    let system = system.expect("a system");
    let on = [state([0.0, 0.0, 0.5], UPRIGHT)];
    let slips = JointSpace::new(system.clone(), &on, &[rate([1.0, 0.0, 0.0], [0.0; 3])], &[]);
    assert!(matches!(slips, Err(JointSpaceFault::System(_))));
    let off = [state([0.0, 0.0, 0.6], UPRIGHT)];
    assert!(JointSpace::new(system.clone(), &off, &[[0.0; 7]], &[]).is_err());
    let rolls = rate([1.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    assert!(JointSpace::new(system, &on, &[rolls], &[]).is_ok());
}

/// Two pendulums side by side whose ends a hinge holds together: one pendulum, whatever its loop is made of.
#[test]
fn a_loop_that_says_nothing_new_changes_nothing() {
    let link = |shift: f64| Link {
        inboard: None,
        joint: Joint {
            outboard: [0.0, shift, 1.0],
            inboard: [0.0; 3],
            home: UPRIGHT,
            constraint: JointConstraint::Revolute { axis: [0.0, 1.0, 0.0] },
        },
        body: Body { mass: 1.0, inertia: [0.1, 0.1, 0.01] },
    };
    let hinge = |y: f64| Joint {
        outboard: [0.0, y, 0.0],
        inboard: [0.0, -y, 0.0],
        home: UPRIGHT,
        constraint: JointConstraint::Revolute { axis: [0.0, 1.0, 0.0] },
    };
    let closure = Closure { outboard: 0, inboard: Some(1), closing: Closing::Joint(hinge(0.1)) };
    let links = vec![link(0.1), link(-0.1)];
    let open = System::new(links, 9.81).expect("a system");
    let closed = open.clone().with_closure(closure).expect("a loop");
    // Hanging beside one another, pushed alike.
    let states = [state([0.0, -0.1, -1.0], UPRIGHT), state([0.0, 0.1, -1.0], UPRIGHT)];
    let rates = [rate([-2.0, 0.0, 0.0], [0.0, 2.0, 0.0]); 2];
    let end = |system: System| {
        let mut all = JointSpace::new(system, &states, &rates, &[]).expect("a start");
        run(&mut all, 1e-3, 1000).0
    };
    let (a, b) = (end(open), end(closed));
    // Measured 1e-14.
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
}
