//! Sensitivities of a function whose indices are known.

use std::f64::consts::PI;
use surefoot_host::certify::{Sampling, point, sensitivities};

/// Ishigami and Homma's function, "An importance quantification technique in uncertainty analysis for computer models",
/// ISUMA 1990, with a = 7 and b = 0.1: Var = a²/8 + b π⁴/5 + b² π⁸/18 + 1/2, S₁ = (1 + b π⁴/5)²/(2 Var),
/// S₂ = a²/(8 Var), S₃ = 0, S₁₂ = S₁ + S₂ closed.
fn ishigami(u: &[f64]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|k| PI * (2.0 * u[k] - 1.0));
    x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
}

#[test]
fn indices_of_ishigamis_function() {
    let [first, second] = [0.313_905_191, 0.442_411_140];
    for (sampling, samples, near) in [
        // At most 0.032, as the function varies within cells of a 32nd; 0.016; 0.037, which is chance.
        (Sampling::Sobol, 1024, 0.05),
        (Sampling::Sobol, 4096, 0.025),
        (Sampling::Random, 4096, 0.05),
    ] {
        for seed in 0..3 {
            let points: Vec<_> = (0..samples).map(|k| point(sampling, seed, k, 3)).collect();
            let results: Vec<f64> = points.iter().map(|u| ishigami(u)).collect();
            let found = sensitivities(&points, &results).expect("results that differ");
            for (found, expected) in found.first.iter().zip([first, second, 0.0]) {
                assert!((found - expected).abs() < near, "{sampling:?}: {found}, not {expected}");
            }
            let pair = found.pair.expect("three pairs");
            assert_eq!(pair.coordinates, [1, 0]);
            let closed = first + second;
            // At most 0.1 at 1024 samples, 16 cells a side.
            assert!((pair.closed - closed).abs() < 3.0 * near, "{} not {closed}", pair.closed);
        }
    }
}

#[test]
fn indices_of_chance_are_as_large_as_is_said() {
    let (mut squares, mut noise) = (0.0, 0.0);
    for seed in 0..500 {
        let points: Vec<_> = (0..1000).map(|k| point(Sampling::Random, seed, k, 2)).collect();
        let results: Vec<f64> =
            (0..1000).map(|k| point(Sampling::Random, 1000 + seed, k, 1)[0]).collect();
        let found = sensitivities(&points, &results).expect("results that differ");
        squares += found.first[0].powi(2) / 500.0;
        noise = found.noise;
    }
    // 0.00566, where 0.00557 is said.
    assert!((f64::sqrt(squares) / noise - 1.0).abs() < 0.1, "{} and {noise}", f64::sqrt(squares));
}

#[test]
fn nothing_decides_where_nothing_differs() {
    let points: Vec<_> = (0..100).map(|k| point(Sampling::Sobol, 1, k, 2)).collect();
    assert_eq!(sensitivities(&points, &[1.0; 100]), None);
    assert_eq!(sensitivities(&points[..10], &[1.0; 10]), None);
}
