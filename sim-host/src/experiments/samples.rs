//! Runs of chapter 2, sampled, and the errors made of them.

/// Samples of a run.
pub(super) const SAMPLES: usize = 301;
/// Their distance, s.
const SAMPLE_S: f64 = 0.1;

/// A run's samples.
pub(super) struct Sampled<const N: usize, const M: usize> {
    /// Which method.
    pub method: &'static str,
    /// Step, s.
    pub h: f64,
    /// Time that the run took, s.
    pub wall_s: f64,
    pub configurations: Vec<[f64; N]>,
    pub energies: Vec<[f64; 1]>,
    pub momenta: Vec<[f64; M]>,
}

impl<const N: usize, const M: usize> Sampled<N, M> {
    pub fn new(method: &'static str, h: f64) -> Self {
        let (configurations, energies, momenta) = (Vec::new(), Vec::new(), Vec::new());
        Self { method, h, wall_s: 0.0, configurations, energies, momenta }
    }

    /// When the samples were taken, s.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        (0..self.configurations.len()).map(|k| SAMPLE_S * k as f64)
    }
}

/// Steps between samples.
pub(super) fn sampled_every(h: f64) -> usize {
    (SAMPLE_S / h).round() as usize
}

/// The error of (2.53) and (2.56): mean distance of two series of vectors, divided by their length.
pub(super) fn mean_distance<'a, const M: usize>(
    pairs: impl Iterator<Item = (&'a [f64; M], &'a [f64; M])>,
) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for (a, b) in pairs {
        sum += a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt();
        count += 1;
    }
    sum / (count * M) as f64
}

/// Slope of the straight line through `(log x, log y)`, by least squares.
pub(super) fn slope_of(x: &[f64], y: &[f64]) -> f64 {
    let logs = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| v.ln()).collect() };
    let (x, y) = (logs(x), logs(y));
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mx, my) = (mean(&x), mean(&y));
    let products: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    products / x.iter().map(|x| (x - mx) * (x - mx)).sum::<f64>()
}
