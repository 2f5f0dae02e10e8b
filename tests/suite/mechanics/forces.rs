//! External and dissipative forces (§5.1).

use surefoot_mechanics::integrators::{Integrator, Method, StartError, Variational, start_natural};
use surefoot_mechanics::systems::PolarAngles;
use surefoot_mechanics::{Generalized, Lagrangian, Midpoint, Natural, Scalar};

const RATE: f64 = 3.0;
const DAMPING: f64 = 0.4;

/// A mass on a spring in oil: closed form.
#[derive(Clone, Copy)]
struct Oscillator;

impl Natural<1, 0> for Oscillator {
    fn masses(&self) -> [f64; 1] {
        [2.0]
    }

    fn potential<D: Scalar>(&self, q: &[D; 1]) -> D {
        q[0] * q[0] * (RATE * RATE)
    }

    fn constraints<D: Scalar>(&self, _: &[D; 1]) -> [D; 0] {
        []
    }

    fn force<D: Scalar>(&self, _: &[D; 1], v: &[D; 1]) -> Option<[D; 1]> {
        Some([-v[0] * (4.0 * DAMPING)])
    }
}

/// From 1 at rest: `e^{−δt} (cos ωt + δ/ω sin ωt)`, `ω² = Ω² − δ²`.
fn exact(time: f64) -> f64 {
    let omega = (RATE * RATE - DAMPING * DAMPING).sqrt();
    (-DAMPING * time).exp() * ((omega * time).cos() + DAMPING / omega * (omega * time).sin())
}

#[test]
fn damped_motions_are_of_each_methods_order() {
    for method in Method::all() {
        let error = |n: usize| -> Result<f64, StartError> {
            let h = 1.0 / n as f64;
            let mut motion =
                start_natural::<_, f64, 1, 0, 1>(*method, Oscillator, h, [1.0], [0.0])?;
            for _ in 0..2 * n {
                motion.step().expect("a step");
            }
            Ok((motion.configuration()[0] - exact(2.0)).abs())
        };
        let (coarse, fine) = match (error(100), error(400)) {
            (Ok(coarse), Ok(fine)) => (coarse, fine),
            (Err(StartError::NotFor { .. }), _) => {
                println!("{method}: takes no forces");
                continue;
            }
            (a, b) => panic!("{method}: {a:?}, {b:?}"),
        };
        let order = (coarse / fine).ln() / 4.0_f64.ln();
        println!("{method}: order {order:.3}, error {fine:.1e}");
        match method {
            Method::DormandPrince8 => assert!(fine < 1e-11),
            // (2.45) takes a force that depends on velocities at the wrong time; of sixth order the
            // errors are round-off's.
            Method::VariationalEndpoint => assert!((order - 1.0).abs() < 0.1, "{order}"),
            Method::Yoshida6 => assert!(fine < 1e-12, "{fine}"),
            _ => {
                let expected = f64::from(method.order().expect("an order"));
                assert!((order - expected).abs() < 0.1, "{method}: {order}");
            }
        }
    }
}

/// A spherical pendulum in air.
#[derive(Clone, Copy)]
struct InAir;

impl Natural<3, 1> for InAir {
    fn masses(&self) -> [f64; 3] {
        [1.5; 3]
    }

    fn potential<D: Scalar>(&self, q: &[D; 3]) -> D {
        q[2] * (1.5 * 9.81)
    }

    fn constraints<D: Scalar>(&self, q: &[D; 3]) -> [D; 1] {
        [q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - 4.0]
    }

    /// Drag, as the square of the speed.
    fn force<D: Scalar>(&self, _: &[D; 3], v: &[D; 3]) -> Option<[D; 3]> {
        let speed = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        Some(v.map(|v| -v * speed * 0.2))
    }
}

/// Theorem 2.1 holds with forces, too, and energy only falls.
#[test]
fn forces_through_a_chart_are_the_same() {
    let generalized = Generalized::<_, _, 3, 1> {
        system: Midpoint(InAir),
        chart: PolarAngles { lengths: [2.0] },
    };
    let (angles, rates) = ([0.9, 0.0], [0.3, 1.5]);
    let h = 0.01;
    let mut in_chart = Variational::<_, 2, 0, 2>::from_velocity(generalized, h, angles, rates);
    let (s, c) = angles[0].sin_cos();
    let x = [2.0 * s, 0.0, -2.0 * c];
    let v = [2.0 * c * rates[0], 2.0 * s * rates[1], 2.0 * s * rates[0]];
    let mut in_space = Variational::<_, 3, 1, 4>::from_velocity(Midpoint(InAir), h, x, v);
    let mut apart = 0.0_f64;
    let mut energy = InAir.energy(&x, &v);
    for _ in 0..1000 {
        in_chart.step().expect("a step");
        in_space.step().expect("a step");
        let (q, x) = (in_chart.configuration(), in_space.configuration());
        let embedded =
            [2.0 * q[0].sin() * q[1].cos(), 2.0 * q[0].sin() * q[1].sin(), -2.0 * q[0].cos()];
        for (a, b) in embedded.iter().zip(x) {
            apart = apart.max((a - b).abs());
        }
        let now = InAir.energy(x, &in_space.velocity().expect("a velocity"));
        // Swings of the method's energy are smaller than what drag takes in a step.
        assert!(now < energy + 1e-4, "{now} after {energy}");
        energy = now;
    }
    println!("{apart:.1e} m apart, energy left {energy:.3} J");
    assert!(apart < 1e-10, "{apart}");
}
