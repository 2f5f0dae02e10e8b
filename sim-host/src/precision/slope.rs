//! The order that a method shows: the slope of error against step, where the error is the method's.

use super::measure::Measurement;
use serde::{Deserialize, Serialize};

/// A straight line through logarithms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Its slope: the order.
    pub order: f64,
    /// Points that it goes through.
    pub points: usize,
    /// Longest step among them, s.
    pub from_s: f64,
    /// Shortest, s.
    pub to_s: f64,
}

/// Errors above this are no longer small: the method's first term says little about them.
const SMALL: f64 = 1e-2;
/// Errors below this multiple of what the reference is sure of are left out.
const CLEAN: f64 = 100.0;
/// So are those that round-off may have made.
const ROUND_OFF: f64 = 1e-11;
/// Points at least, and, of the finest, at most.
const LEAST: usize = 3;
const MOST: usize = 7;

/// The order over the finest steps whose error is clean; none where there are too few.
pub fn fitted(measurements: &[Measurement], floor: f64) -> Option<Fit> {
    let least = (CLEAN * floor).max(ROUND_OFF);
    let clean: Vec<[f64; 2]> = measurements
        .iter()
        .filter(|m| m.split_steps == 0)
        .filter_map(|m| Some([m.step_s, m.error?]))
        .filter(|[_, error]| (least..SMALL).contains(error))
        .collect();
    let points = &clean[clean.len().saturating_sub(MOST)..];
    if points.len() < LEAST {
        return None;
    }
    let n = points.len() as f64;
    let mean = |part: usize| points.iter().map(|point| point[part].ln()).sum::<f64>() / n;
    let (h, e) = (mean(0), mean(1));
    let along: f64 = points.iter().map(|p| (p[0].ln() - h) * (p[1].ln() - e)).sum();
    let across: f64 = points.iter().map(|p| (p[0].ln() - h).powi(2)).sum();
    Some(Fit {
        order: along / across,
        points: points.len(),
        from_s: points[0][0],
        to_s: points[points.len() - 1][0],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(step_s: f64, error: f64) -> Measurement {
        Measurement {
            step_s,
            divisions: 1,
            tolerance: None,
            time: None,
            evaluations: 1.0,
            newton_mean: None,
            newton_most: None,
            split_steps: 0,
            error: Some(error),
            energy_band_j: None,
            energy_slope_j_s: None,
            momentum_drift: None,
            constraint: None,
            failure: None,
        }
    }

    #[test]
    fn large_errors_and_those_at_the_floor_are_left_out() {
        let law = |h: f64| point(h, 0.3 * h.powi(3));
        let mut all = vec![point(4.0, 7.0), law(0.2), law(0.1), law(0.05), law(0.025)];
        all.push(point(0.0125, 2e-8));
        let fit = fitted(&all, 1e-9).expect("three points and more");
        assert!((fit.order - 3.0).abs() < 1e-12, "{fit:?}");
        assert_eq!((fit.points, fit.from_s, fit.to_s), (4, 0.2, 0.025));
        assert_eq!(fitted(&all[3..], 1e-9), None);
    }
}
