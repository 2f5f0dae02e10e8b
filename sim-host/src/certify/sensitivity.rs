//! Which parameter decides: shares of a result's variance, from the samples that there are.
//!
//! M. D. McKay, "Evaluating prediction uncertainty", NUREG/CR-6311 (1995), §4 (the correlation ratio); E. Plischke,
//! E. Borgonovo, C. L. Smith, "Global sensitivity measures from given data", European Journal of Operational Research
//! 226 (2013) 536–550, §3. Samples of a Sobol sequence lie evenly in the cells of its coordinates. Estimators by ranks or
//! nearest neighbours are no use for them: neighbours in one coordinate are never neighbours in the others.
//!
//! # Notation
//! - `X ∈ (0, 1)ᵈ`, `Y`: coordinates of the samples and their results; `N` of them
//! - `c`: cells, equal intervals of `Xᵢ` or equal squares of `(Xᵢ, Xₖ)`; `M` of them with `n_c` samples each
//! - `s_c²`: variance of the results in a cell, `s²`: of all, unbiased
//! - `Sᵢ = Var E[Y | Xᵢ]/Var Y`, `Sᵢₖ = Var E[Y | Xᵢ, Xₖ]/Var Y`, the closed index of two
//!
//! S ≈ 1 − Σ (n_c/N) s_c²/s²                                                                        (1)
//!
//! Where `Y` does not depend on them, (1) is 0 with a standard deviation of √(2(M − 1))/(N − M); where it does, (1) misses
//! what `E[Y | X]` varies by within a cell.

use serde::Serialize;

/// Shares of the variance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sensitivities {
    /// `Sᵢ` of each coordinate.
    pub first: Vec<f64>,
    /// The two coordinates that decide most together.
    pub pair: Option<Pair>,
    /// Standard deviation of an index `Sᵢ` that is 0.
    pub noise: f64,
}

/// Two coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// Their numbers; the one with the larger index of its own is first.
    pub coordinates: [usize; 2],
    /// Their closed index.
    pub closed: f64,
}

/// Samples of a cell on average, and cells at most along a coordinate.
const PER_INTERVAL: usize = 32;
const PER_SQUARE: usize = 4;
const MOST_CELLS: usize = 64;

/// Of points and their results; `None` where all results are the same, or there are too few for two cells.
///
/// # Cost
/// Linear in the samples, for each pair of coordinates.
pub fn sensitivities(points: &[Vec<f64>], results: &[f64]) -> Option<Sensitivities> {
    let n = results.len();
    let dimensions = points.first()?.len();
    let mean = results.iter().sum::<f64>() / n as f64;
    let variance = results.iter().map(|y| (y - mean).powi(2)).sum::<f64>();
    // Powers of two: cells of a Sobol sequence.
    let intervals = power_of_two(n / PER_INTERVAL).min(MOST_CELLS);
    let sides = power_of_two(((n / PER_SQUARE) as f64).sqrt() as usize).min(MOST_CELLS);
    if !(variance > 0.0) || intervals < 2 {
        return None;
    }
    let index = |cells: &dyn Fn(&[f64]) -> usize, number: usize| {
        within(points, results, cells, number).map_or(0.0, |within| 1.0 - within / variance)
    };
    let along = |u: f64, cells: usize| ((u * cells as f64) as usize).min(cells - 1);
    let first: Vec<f64> =
        (0..dimensions).map(|i| index(&|point| along(point[i], intervals), intervals)).collect();
    let mut pair: Option<Pair> = None;
    for a in 0..dimensions {
        for b in a + 1..dimensions {
            let square = |point: &[f64]| along(point[a], sides) * sides + along(point[b], sides);
            let closed = index(&square, sides * sides);
            if pair.is_none_or(|best| closed > best.closed) {
                let coordinates = if first[a] >= first[b] { [a, b] } else { [b, a] };
                pair = Some(Pair { coordinates, closed });
            }
        }
    }
    let noise = (2.0 * (intervals - 1) as f64).sqrt() / (n - intervals) as f64;
    Some(Sensitivities { first, pair, noise })
}

/// The sum of squares about the means of cells, as it would be if all had many samples; `None` where no cell has two.
fn within(
    points: &[Vec<f64>],
    results: &[f64],
    cell: &dyn Fn(&[f64]) -> usize,
    number: usize,
) -> Option<f64> {
    // Number, mean and sum of squares about it, by Welford's update.
    let mut cells = vec![(0.0, 0.0, 0.0); number];
    for (point, y) in points.iter().zip(results) {
        let (n, mean, squares) = &mut cells[cell(point)];
        *n += 1.0;
        let away = y - *mean;
        *mean += away / *n;
        *squares += away * (y - *mean);
    }
    let seen = || cells.iter().filter(|(n, _, _)| *n >= 2.0);
    let counted: f64 = seen().map(|(n, _, _)| n).sum();
    let sum: f64 = seen().map(|(n, _, squares)| n * squares / (n - 1.0)).sum();
    // (1): s² is the whole sum of squares over N − 1.
    let n = results.len() as f64;
    (counted > 0.0).then(|| sum / counted * (n - 1.0))
}

fn power_of_two(at_most: usize) -> usize {
    at_most.checked_ilog2().map_or(0, |power| 1 << power)
}
