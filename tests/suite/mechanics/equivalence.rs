//! Theorem 2.1: constrained and generalized coordinates give the same discrete trajectory.

use super::systems::{PENDULUM, pendulum};
use num_dual::Dual64;
use surefoot_mechanics::integrators::{Form, Integrator, Method, Rattle, Shake, Variational};
use surefoot_mechanics::systems::{
    DoubleSphericalPendulum, FreeRigidBody, Pendulum, Planet, PolarAngles,
};
use surefoot_mechanics::{
    Chart, DiscreteLagrangian, Endpoint, Generalized, Lagrangian, Midpoint, Momenta, Natural,
    Scalar, action_sum,
};

/// Largest distance of the two trajectories over 1000 steps, from the same two points.
fn distance<S, K, const N: usize, const C: usize, const U: usize, const M: usize>(
    system: S,
    chart: K,
    first: [f64; M],
    second: [f64; M],
    h: f64,
) -> f64
where
    S: DiscreteLagrangian<N, C> + Copy,
    K: Chart<M, N> + Copy,
{
    let generalized = Generalized::<S, K, N, C> { system, chart };
    let mut in_chart = Variational::<_, M, 0, M>::from_two(generalized, h, first, second);
    let (a, b) = (chart.embed(&first), chart.embed(&second));
    let mut in_space = Variational::<_, N, C, U>::from_two(system, h, a, b);
    let mut largest = 0.0_f64;
    for _ in 0..1000 {
        in_chart.step().expect("a step in the chart");
        in_space.step().expect("a step in space");
        let embedded = chart.embed(in_chart.configuration());
        for (x, y) in embedded.iter().zip(in_space.configuration()) {
            largest = largest.max((x - y).abs());
        }
    }
    largest
}

#[test]
fn constrained_and_generalized_coordinates_agree() {
    let pendulum = Pendulum { masses: [1.5], lengths: [2.0], gravity: 9.81 };
    let largest = distance::<_, _, 3, 1, 4, 2>(
        Midpoint(pendulum),
        PolarAngles { lengths: [2.0] },
        [0.9, 0.0],
        [0.903, 0.02],
        0.01,
    );
    println!("spherical pendulum: {largest:.1e} m");
    assert!(largest < 1e-10, "{largest} m");
    let double = DoubleSphericalPendulum::PRINTED;
    let largest = distance::<_, _, 6, 2, 8, 4>(
        Midpoint(double),
        PolarAngles { lengths: double.lengths },
        [0.78, 0.0, 0.86, 0.03],
        [0.785, 0.01, 0.862, 0.045],
        0.01,
    );
    println!("double spherical pendulum: {largest:.1e} m");
    assert!(largest < 1e-10, "{largest} m");
}

/// The discrete variational principle with (2.45) gives SHAKE's, and so RATTLE's, positions; RATTLE's
/// momenta satisfy the hidden constraint, too.
#[test]
fn the_endpoint_rule_gives_rattles_positions() {
    let pendulum = DoubleSphericalPendulum::PRINTED;
    let (q, v) = pendulum.printed_start();
    let mut rattle = Rattle::<_, 6, 2>::new(pendulum, 0.01, q, &v);
    let mut shake = Variational::<_, 6, 2, 8>::from_velocity(Endpoint(pendulum), 0.01, q, v);
    let (mut apart, mut hidden) = (0.0_f64, 0.0_f64);
    for _ in 0..1000 {
        rattle.step().expect("a step");
        shake.step().expect("a step");
        let (x, v) = (rattle.configuration(), rattle.velocity().expect("a velocity"));
        for (a, b) in x.iter().zip(shake.configuration()) {
            apart = apart.max((a - b).abs());
        }
        let along = |i: usize, j: usize| (x[i] - x[j]) * (v[i] - v[j]);
        hidden = hidden.max((x[0] * v[0] + x[1] * v[1] + x[2] * v[2]).abs());
        hidden = hidden.max((along(3, 0) + along(4, 1) + along(5, 2)).abs());
    }
    println!("positions {apart:.1e} m apart, hidden constraint {hidden:.1e} m²/s");
    assert!(apart < 1e-10 && hidden < 1e-11, "{apart} {hidden}");
}

/// SHAKE's two forms, and the variational method they follow from, show the same positions; the form in
/// positions with more round-off.
#[test]
fn shake_in_both_forms_is_the_variational_method() {
    let (q, v) = PENDULUM.printed_start();
    let h = 0.01;
    let start = |form| Shake::<_, 6, 2>::new(PENDULUM, form, h, q, v).expect("a first step");
    let (mut positions, mut velocities) = (start(Form::Positions), start(Form::Velocities));
    let mut variational = Variational::<_, 6, 2, 8>::from_velocity(Endpoint(PENDULUM), h, q, v);
    let mut apart = [0.0_f64; 2];
    for _ in 0..1000 {
        positions.step().expect("a step");
        velocities.step().expect("a step");
        variational.step().expect("a step");
        for (apart, shake) in apart.iter_mut().zip([&positions, &velocities]) {
            for (a, b) in shake.configuration().iter().zip(variational.configuration()) {
                *apart = apart.max((a - b).abs());
            }
        }
    }
    println!("SHAKE in positions {:.1e} m, in velocities {:.1e} m away", apart[0], apart[1]);
    assert!(apart[0] < 1e-8 && apart[1] < 1e-10, "{apart:?}");
}

/// For quadratic constraints and a linear potential (`errata.md`'s remark on §2.4.2).
#[test]
fn the_energy_momentum_method_is_the_implicit_midpoint_rule_here() {
    let start = |method| pendulum(method, 0.01).expect("a start");
    let (mut a, mut b) = (start(Method::EnergyMomentum), start(Method::ImplicitMidpoint));
    let mut apart = 0.0_f64;
    for _ in 0..1000 {
        a.step().expect("a step");
        b.step().expect("a step");
        for (a, b) in a.configuration().iter().zip(b.configuration()) {
            apart = apart.max((a - b).abs());
        }
    }
    println!("{apart:.1e} m apart");
    assert!(apart < 1e-9, "{apart}");
}

/// The same Lagrangian with none of its derivatives written out.
#[derive(Clone, Copy)]
struct Plain<S>(S);

impl<const N: usize, const C: usize, S: Natural<N, C>> Lagrangian<N, C> for Plain<S> {
    fn lagrangian<D: Scalar>(&self, v: &[D; N], v_dot: &[D; N]) -> D {
        self.0.lagrangian(v, v_dot)
    }

    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C] {
        Lagrangian::constraints(&self.0, v)
    }
}

/// (2.51) with none of its derivatives written out.
struct PlainBody(FreeRigidBody);

impl DiscreteLagrangian<4, 1> for PlainBody {
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; 4], d: &[D; 4], h: f64) -> D {
        self.0.discrete_lagrangian(x, d, h)
    }

    fn constraints<D: Scalar>(&self, v: &[D; 4]) -> [D; 1] {
        DiscreteLagrangian::constraints(&self.0, v)
    }
}

/// What the free body writes out is what differentiation gives, off the unit sphere, too.
#[test]
fn the_free_bodys_derivatives_are_the_automatic_ones() {
    let body = FreeRigidBody::PRINTED;
    let (x, d) = ([0.9, -0.2, 0.5, 0.3], [0.4, 1.1, -0.7, 2.0]);
    for h in [0.0, 1e-3, 0.3] {
        let (written, plain) = (body.momenta(&x, &d, h), PlainBody(body).momenta(&x, &d, h));
        let all = |m: Momenta<4>| [m.begin.to_vec(), m.end.to_vec(), m.stiffness.concat()].concat();
        for (a, b) in all(written).into_iter().zip(all(plain)) {
            assert!((a - b).abs() < 1e-13, "{h}: {written:?} {plain:?}");
        }
    }
}

/// What natural systems write out is what differentiation gives.
#[test]
fn written_derivatives_are_the_automatic_ones() {
    let (q, v) = PENDULUM.printed_start();
    let relative = |a: f64, b: f64| (a - b).abs() / (1.0 + b.abs());
    let worst = |a: &Momenta<6>, b: &Momenta<6>| {
        let rows =
            |m: &Momenta<6>| [m.begin.to_vec(), m.end.to_vec(), m.stiffness.concat()].concat();
        rows(a).into_iter().zip(rows(b)).fold(0.0, |m: f64, (a, b)| m.max(relative(a, b)))
    };
    let stretched = Stretched { stiffness: 40.0, length: 1.2 };
    for h in [0.0, 1e-3, 0.2] {
        let (plain, written) = (Plain(PENDULUM), PENDULUM);
        assert!(
            worst(&Midpoint(written).momenta(&q, &v, h), &Midpoint(plain).momenta(&q, &v, h))
                < 1e-14
        );
        assert!(
            worst(&Endpoint(written).momenta(&q, &v, h), &Endpoint(plain).momenta(&q, &v, h))
                < 1e-14
        );
        assert!(
            worst(&Endpoint(written).start(&q, &v, h), &Endpoint(plain).start(&q, &v, h)) < 1e-14
        );
        let (midpoint, plain) = (Midpoint(stretched), Midpoint(Plain(stretched)));
        assert!(worst(&midpoint.momenta(&q, &v, h), &plain.momenta(&q, &v, h)) < 1e-13);
    }
    let (a, b) = (PENDULUM.inertia_and_force(&q, &v), Plain(PENDULUM).inertia_and_force(&q, &v));
    assert_eq!(a.0, b.0);
    assert!(a.1.iter().zip(b.1).all(|(a, b)| relative(*a, b) < 1e-14));
}

/// Two masses and a spring between them: a potential whose second derivatives are not zero.
#[derive(Clone, Copy)]
struct Stretched {
    stiffness: f64,
    length: f64,
}

impl Natural<6, 0> for Stretched {
    fn masses(&self) -> [f64; 6] {
        [2.0, 2.0, 2.0, 3.5, 3.5, 3.5]
    }

    fn potential<D: Scalar>(&self, q: &[D; 6]) -> D {
        let d: [D; 3] = std::array::from_fn(|i| q[3 + i] - q[i]);
        let stretch = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt() - self.length;
        stretch * stretch * (0.5 * self.stiffness)
    }

    fn constraints<D: Scalar>(&self, _: &[D; 6]) -> [D; 0] {
        []
    }
}

/// Two particles on a spring: momentum and energy by the energy-momentum method are those of the start,
/// energy exactly although the potential is no polynomial.
#[test]
fn the_discrete_gradient_conserves_energy_of_any_potential() {
    let system = Stretched { stiffness: 40.0, length: 1.2 };
    let (q, v) = PENDULUM.printed_start();
    let mut motion = surefoot_mechanics::integrators::start_natural::<_, f64, 6, 0, 6>(
        Method::EnergyMomentum,
        system,
        0.05,
        q,
        v,
    )
    .expect("a start");
    let energy = system.energy(&q, &v);
    let mut largest = 0.0_f64;
    for _ in 0..10_000 {
        motion.step().expect("a step");
        let v = motion.velocity().expect("a velocity");
        largest = largest.max((system.energy(motion.configuration(), &v) / energy - 1.0).abs());
    }
    println!("energy changes by {largest:.1e}");
    assert!(largest < 1e-11, "{largest}");
}

/// The discrete variational principle: along a motion the action's derivative by every interior point is
/// zero; off it, it is not.
#[test]
fn motions_are_extrema_of_the_action_sum() {
    let system = Midpoint(Planet);
    let (q, v) = Planet::perihelion(0.3);
    let h = 0.05;
    let mut motion = Variational::<_, 2, 0, 2>::from_velocity(system, h, q, v);
    let mut path = vec![q];
    for _ in 0..60 {
        motion.step().expect("a step");
        path.push(*motion.configuration());
    }
    let slope = |path: &[[f64; 2]], at: usize, along: usize| {
        let mut dual: Vec<[Dual64; 2]> = path.iter().map(|x| x.map(Dual64::from_re)).collect();
        dual[at][along].eps = 1.0;
        action_sum(&system, &dual, h).eps
    };
    let steepest = |path: &[[f64; 2]]| {
        let all = (1..60).flat_map(|at| (0..2).map(move |along| (at, along)));
        all.map(|(at, along)| slope(path, at, along).abs()).fold(0.0, f64::max)
    };
    let on = steepest(&path);
    path[30][0] += 1e-3;
    let off = steepest(&path);
    println!("steepest {on:.1e} on the motion, {off:.1e} off it");
    // Momenta are of size 1, and divided by the step.
    assert!(on < 1e-12 && off > 0.1, "{on} {off}");
}
