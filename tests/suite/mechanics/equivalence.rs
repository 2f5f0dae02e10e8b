//! Theorem 2.1: constrained and generalized coordinates give the same discrete trajectory.

use surefoot_sim::integrators::{Rattle, Variational};
use surefoot_sim::mechanics::systems::{
    DoubleSphericalPendulum, PendulumAngles, PolarAngles, SphericalPendulum,
};
use surefoot_sim::mechanics::{Chart, DiscreteLagrangian, Endpoint, Generalized, Midpoint};

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
    let pendulum = SphericalPendulum { mass: 1.5, length: 2.0, gravity: 9.81 };
    let largest = distance::<_, _, 3, 1, 4, 2>(
        Midpoint(pendulum),
        PolarAngles { length: 2.0 },
        [0.9, 0.0],
        [0.903, 0.02],
        0.01,
    );
    println!("spherical pendulum: {largest:.1e} m");
    assert!(largest < 1e-10, "{largest} m");
    let double = DoubleSphericalPendulum::PRINTED;
    let largest = distance::<_, _, 6, 2, 8, 4>(
        Midpoint(double),
        PendulumAngles { lengths: double.lengths },
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
        let (x, v) = (rattle.configuration(), rattle.velocity());
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
