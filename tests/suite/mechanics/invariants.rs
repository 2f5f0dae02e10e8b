//! What the methods conserve.

use surefoot_sim::integrators::{RungeKutta, Variational};
use surefoot_sim::mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody, PendulumAngles};
use surefoot_sim::mechanics::{
    Displacement, Endpoint, Generalized, Midpoint, Natural, carried, symplectic_form,
};

/// The momentum map (2.22) over 1e5 steps, to 1e-10 of itself.
#[test]
fn discrete_momentum_is_conserved() {
    let body = FreeRigidBody::PRINTED;
    let (q, rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 2.0]);
    let h = 0.05;
    let mut motion = Variational::<_, 4, 1, 5>::from_velocity(body, h, q, rate);
    let d = motion.clone().step().expect("a step");
    let first = body.discrete_momentum(&q, &d, h);
    let size = first.iter().map(|m| m * m).sum::<f64>().sqrt();
    let mut largest = 0.0_f64;
    for _ in 0..100_000 {
        let x = *motion.configuration();
        let d = motion.step().expect("a step");
        for (now, then) in body.discrete_momentum(&x, &d, h).iter().zip(first) {
            largest = largest.max((now - then).abs() / size);
        }
    }
    println!("rigid body: {largest:.1e}");
    assert!(largest < 1e-10, "{largest}");

    let pendulum = DoubleSphericalPendulum::PRINTED;
    let (q, v) = pendulum.printed_start();
    let mut motion = Variational::<_, 6, 2, 8>::from_velocity(Midpoint(pendulum), 0.02, q, v);
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

/// The symplectic form of displacements that the exact tangent maps carry along, over 500 steps of a
/// chaotic motion (§2.2.2).
#[test]
fn the_symplectic_form_is_preserved() {
    let pendulum = DoubleSphericalPendulum::PRINTED;
    let chart = PendulumAngles { lengths: pendulum.lengths };
    preserves_the_form(Generalized::<_, _, 6, 2> { system: Midpoint(pendulum), chart });
    preserves_the_form(Generalized::<_, _, 6, 2> { system: Endpoint(pendulum), chart });
}

fn preserves_the_form(system: impl surefoot_sim::mechanics::DiscreteLagrangian<4, 0> + Copy) {
    let h = 0.02;
    let (first, second) = ([0.78, 0.0, 0.86, 0.03], [0.79, 0.02, 0.864, 0.06]);
    let mut motion = Variational::<_, 4, 0, 4>::from_two(system, h, first, second);
    let mut displacements: [Displacement<4>; 8] = std::array::from_fn(|k| Displacement {
        configuration: std::array::from_fn(|i| f64::from(u8::from(i == k))),
        momentum: std::array::from_fn(|i| f64::from(u8::from(i + 4 == k))),
    });
    let canonical = displacements;
    let mut largest = 0.0_f64;
    for step in 0..500 {
        let x = *motion.configuration();
        let d = motion.step().expect("a step");
        if step % 25 == 0 {
            // Before displacements grow as they do in a chaotic motion.
            displacements = canonical;
        }
        for displacement in &mut displacements {
            *displacement = carried(&system, &x, &d, h, displacement).expect("a regular step");
        }
        for (a, a_then) in displacements.iter().zip(&canonical) {
            for (b, b_then) in displacements.iter().zip(&canonical) {
                let change = symplectic_form(a, b) - symplectic_form(a_then, b_then);
                largest = largest.max(change.abs());
            }
        }
    }
    println!("symplectic form: {largest:.1e}");
    assert!(largest < 1e-9, "{largest}");
}

/// Over a million large steps the variational method's energy swings about a constant; that of the
/// Runge–Kutta method, whose constraints drift, runs away.
#[test]
fn energy_of_the_variational_method_has_no_slope() {
    let pendulum = DoubleSphericalPendulum::PRINTED;
    let (q, v) = pendulum.printed_start();
    let h = 0.02;
    let mut variational = Variational::<_, 6, 2, 8>::from_velocity(Midpoint(pendulum), h, q, v);
    let mut runge_kutta = RungeKutta::<_, 6, 2>::new(pendulum, h, q, v);
    let mut line = Line::default();
    let mut lost = None;
    let start = pendulum.energy(&q, &v);
    for step in 0..1_000_000 {
        let time = h * f64::from(step);
        let x = *variational.configuration();
        let d = variational.step().expect("a step");
        let middle = std::array::from_fn(|i| x[i] + 0.5 * h * d[i]);
        line.add(time, pendulum.energy(&middle, &d));
        if lost.is_none() {
            let made = runge_kutta.step();
            let energy = pendulum.energy(runge_kutta.configuration(), runge_kutta.velocity());
            lost = (made.is_err() || (energy - start).abs() > 10.0).then_some(time);
        }
    }
    println!("slope: {:.1e} J/s; Runge–Kutta is 10 J off after {lost:?} s", line.slope());
    assert!(line.slope().abs() < 3e-6, "{} J/s", line.slope());
    assert!(lost.is_some_and(|time| time < 20_000.0), "{lost:?}");
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
