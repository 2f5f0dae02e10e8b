//! Theorem 2.1: constrained and generalized coordinates give the same discrete trajectory.

use surefoot_sim::integrators::Variational;
use surefoot_sim::mechanics::systems::{
    DoubleSphericalPendulum, PendulumAngles, PolarAngles, SphericalPendulum,
};
use surefoot_sim::mechanics::{Chart, DiscreteLagrangian, Generalized, Midpoint};

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
