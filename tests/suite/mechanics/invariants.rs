//! What the methods conserve.

use super::systems::{PENDULUM, body, pendulum};
use num_dual::{Dual, Dual64};
use surefoot_mechanics::integrators::{Integrator, Method, Motion, Variational, start_natural};
use surefoot_mechanics::systems::{FreeRigidBody, Planet, PolarAngles};
use surefoot_mechanics::{Chart, Displacement, Lagrangian, Midpoint, jacobian, symplectic_form};

/// The momentum map (2.22) over 1e5 steps, to 1e-10 of itself.
#[test]
fn discrete_momentum_is_conserved() {
    let body = FreeRigidBody::PRINTED;
    let (q, rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 2.0]);
    let h = 0.05;
    let mut motion = Variational::<_, 4, 1, 5>::from_velocity(body, h, q, rate);
    let mut first = None;
    let mut largest = 0.0_f64;
    for _ in 0..100_000 {
        let x = *motion.configuration();
        motion.step().expect("a step");
        let momentum = body.discrete_momentum(&x, motion.mean_velocity(), h);
        let first = first.get_or_insert(momentum);
        let size = first.iter().map(|m| m * m).sum::<f64>().sqrt();
        for (now, then) in momentum.iter().zip(first) {
            largest = largest.max((now - *then).abs() / size);
        }
    }
    println!("rigid body: {largest:.1e}");
    assert!(largest < 1e-10, "{largest}");

    let (q, v) = PENDULUM.printed_start();
    let mut motion = Variational::<_, 6, 2, 8>::from_velocity(Midpoint(PENDULUM), 0.02, q, v);
    let about_vertical =
        |x: &[f64; 6], p: &[f64; 6]| x[0] * p[1] - x[1] * p[0] + x[3] * p[4] - x[4] * p[3];
    motion.step().expect("a step");
    let first = about_vertical(motion.configuration(), motion.momentum());
    let mut largest = 0.0_f64;
    for _ in 0..100_000 {
        motion.step().expect("a step");
        let now = about_vertical(motion.configuration(), motion.momentum());
        largest = largest.max((now / first - 1.0).abs());
    }
    println!("double spherical pendulum: {largest:.1e}");
    assert!(largest < 1e-10, "{largest}");
}

/// Angular momentum about the vertical, from what the methods show as velocities.
#[test]
fn symplectic_momentum_methods_keep_the_momentum_that_they_show() {
    for method in [
        Method::Variational,
        Method::Yoshida4,
        Method::Yoshida6,
        Method::ImplicitMidpoint,
        Method::VelocityShake,
        Method::Rattle,
        Method::EnergyMomentum,
    ] {
        let mut motion = pendulum(method, 0.02).expect("a start");
        motion.step().expect("a step");
        let momentum = |motion: &Motion<6>| {
            let v = motion.velocity().expect("a velocity");
            PENDULUM.vertical_momentum(motion.configuration(), &v)
        };
        let first = momentum(&motion);
        let mut largest = 0.0_f64;
        for _ in 0..10_000 {
            motion.step().expect("a step");
            largest = largest.max((momentum(&motion) / first - 1.0).abs());
        }
        println!("{method}: {largest:.1e}");
        assert!(largest < 1e-11, "{method}: {largest}");
    }
}

/// States of the pendulum in numbers that carry one of the eight displacements along the manifold each.
fn displaced() -> Vec<([Dual64; 6], [Dual64; 6])> {
    let chart = PolarAngles { lengths: PENDULUM.lengths };
    let (angles, rates) = ([0.78, 0.0, 0.86, 0.03], [0.5, 1.0, 0.2, 1.5]);
    (0..8)
        .map(|k| {
            let seed = |i: usize| f64::from(u8::from(i == k));
            let q: [Dual64; 4] = std::array::from_fn(|i| Dual64::new(angles[i], seed(i)));
            let rate: [Dual64; 4] = std::array::from_fn(|i| Dual64::new(rates[i], seed(i + 4)));
            let (x, slope) = jacobian(&q, |q: &[Dual<Dual64>; 4]| chart.embed(q));
            (x, slope.map(|row| row.into_iter().zip(rate).map(|(s, r)| s * r).sum()))
        })
        .collect()
}

/// Largest change of the symplectic form of any two displacements that a method carries along, relative
/// to the largest form.
fn change_of_form<const N: usize>(
    motions: &mut [Motion<N, Dual64>],
    steps: usize,
    displacement: impl Fn(&Motion<N, Dual64>) -> Displacement<N>,
) -> f64 {
    let forms = |motions: &[Motion<N, Dual64>]| -> Vec<f64> {
        let all: Vec<_> = motions.iter().map(&displacement).collect();
        all.iter().flat_map(|a| all.iter().map(|b| symplectic_form(a, b))).collect()
    };
    let first = forms(motions);
    let size = first.iter().fold(0.0_f64, |m, form| m.max(form.abs()));
    for _ in 0..steps {
        for motion in &mut *motions {
            motion.step().expect("a step");
        }
    }
    let last = forms(motions);
    first.iter().zip(last).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size
}

/// By tangent maps that are exact, as steps in dual numbers are (§2.2.2): over 2 s, in which
/// displacements of this chaotic motion do not grow past what round-off allows.
#[test]
fn the_symplectic_form_is_preserved_by_symplectic_methods_only() {
    for method in Method::all() {
        let symplectic = match method {
            Method::Verlet | Method::LieGroup | Method::DormandPrince8 => continue,
            Method::Variational
            | Method::VariationalEndpoint
            | Method::Yoshida4
            | Method::Yoshida6
            | Method::Shake
            | Method::VelocityShake
            | Method::Rattle => true,
            _ => false,
        };
        let mut motions: Vec<Motion<6, Dual64>> = displaced()
            .into_iter()
            .map(|(x, v)| {
                start_natural::<_, Dual64, 6, 2, 8>(*method, PENDULUM, 0.02, x, v).expect("a start")
            })
            .collect();
        let change = change_of_form(&mut motions, 100, |motion| {
            let v = motion.velocity().expect("a velocity");
            Displacement::of(&PENDULUM, motion.configuration(), &v)
        });
        println!("pendulum, {method}: {change:.1e}");
        if symplectic {
            assert!(change < 1e-9, "{method}: {change}");
        } else {
            assert!(change > 1e-8, "{method}: {change}");
        }
    }
}

/// Without constraints more methods are symplectic.
#[test]
fn the_symplectic_form_of_a_planet() {
    let (q, v) = Planet::perihelion(0.3);
    for method in Method::all() {
        let symplectic = match method {
            Method::LieGroup | Method::DormandPrince8 => continue,
            Method::RungeKutta4 | Method::RungeKutta4Projected | Method::EnergyMomentum => false,
            _ => true,
        };
        let mut motions: Vec<Motion<2, Dual64>> = (0..4)
            .map(|k| {
                let seed = |i: usize| f64::from(u8::from(i == k));
                let x = std::array::from_fn(|i| Dual64::new(q[i], seed(i)));
                let v = std::array::from_fn(|i| Dual64::new(v[i], seed(i + 2)));
                start_natural::<_, Dual64, 2, 0, 2>(*method, Planet, 0.05, x, v).expect("a start")
            })
            .collect();
        let change = change_of_form(&mut motions, 200, |motion| {
            let v = motion.velocity().expect("a velocity");
            Displacement::of(&Planet, motion.configuration(), &v)
        });
        println!("planet, {method}: {change:.1e}");
        assert_eq!(change < 1e-9, symplectic, "{method}: {change}");
    }
}

/// Over a million large steps energies of symplectic methods swing about a constant; those of the
/// Runge–Kutta method run away, with the constraints or without them.
#[test]
fn energies_of_symplectic_methods_have_no_slope() {
    let bodies = [Method::Variational, Method::LieGroup, Method::Yoshida4];
    for method in bodies {
        let run = slope(body(method, 0.05).expect("a start"), 1_000_000, |q, v| {
            FreeRigidBody::PRINTED.energy(q, v)
        });
        println!("free body, {method}: {run:?}");
        assert!(run.slope.abs() < 3e-8 && run.lost_s.is_none(), "{method}: {run:?}");
    }
    for method in [Method::Variational, Method::Rattle, Method::VelocityShake, Method::Yoshida4] {
        let run = slope(pendulum(method, 0.02).expect("a start"), 1_000_000, |q, v| {
            PENDULUM.energy(q, v)
        });
        println!("pendulum, {method}: {run:?}");
        assert!(run.slope.abs() < 3e-6 && run.lost_s.is_none(), "{method}: {run:?}");
    }
    for method in [Method::RungeKutta4, Method::RungeKutta4Projected] {
        let run = slope(body(method, 0.05).expect("a start"), 1_000_000, |q, v| {
            FreeRigidBody::PRINTED.energy(q, v)
        });
        println!("free body, {method}: {run:?}");
        assert!(run.slope.abs() > 1e-5 || run.lost_s.is_some(), "{method}: {run:?}");
        let run = slope(pendulum(method, 0.02).expect("a start"), 1_000_000, |q, v| {
            PENDULUM.energy(q, v)
        });
        println!("pendulum, {method}: {run:?}");
        assert!(run.slope.abs() > 1e-5 || run.lost_s.is_some(), "{method}: {run:?}");
    }
}

/// A long run's energy.
#[derive(Debug)]
#[allow(dead_code, reason = "printed")]
struct Energy {
    /// J/s
    slope: f64,
    /// Half the distance of extremes, J.
    band: f64,
    /// When it was 10 J off, or a step could not be made.
    lost_s: Option<f64>,
}

fn slope<const N: usize>(
    mut motion: Motion<N>,
    steps: u32,
    energy: impl Fn(&[f64; N], &[f64; N]) -> f64,
) -> Energy {
    let mut line = Line::default();
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for step in 0..steps {
        let time = motion.progress().time_s;
        // Every tenth step shows the same line.
        if step % 10 == 0 {
            let v = motion.velocity().expect("a velocity");
            let energy = energy(motion.configuration(), &v);
            line.add(time, energy);
            (low, high) = (low.min(energy), high.max(energy));
        }
        if motion.step().is_err() || high - low > 10.0 {
            return Energy { slope: line.slope(), band: 0.5 * (high - low), lost_s: Some(time) };
        }
    }
    Energy { slope: line.slope(), band: 0.5 * (high - low), lost_s: None }
}

/// A straight line through points, by least squares.
#[derive(Default)]
struct Line {
    n: f64,
    t: f64,
    e: f64,
    tt: f64,
    te: f64,
    first: Option<f64>,
}

impl Line {
    fn add(&mut self, time: f64, energy: f64) {
        // Differences from the first, as sums of squares lose digits.
        let e = energy - *self.first.get_or_insert(energy);
        self.n += 1.0;
        self.t += time;
        self.e += e;
        self.tt += time * time;
        self.te += time * e;
    }

    fn slope(&self) -> f64 {
        (self.n * self.te - self.t * self.e) / (self.n * self.tt - self.t * self.t)
    }
}
