//! An interval for a probability from samples with weights.
//!
//! M. P. Fay, E. J. Feuer, "Confidence intervals for directly standardized rates: a method based on the gamma
//! distribution", Statistics in Medicine 16 (1997) 791–801: each failure counts as a Poisson event with a weight. With
//! equal weights it is the exact interval of a Poisson rate.
//!
//! # Notation
//! - `wᵢ`: weight of a failure over the number of all samples; `w_M`: the largest
//! - `p = Σ wᵢ`, `v = Σ wᵢ²`
//! - `χ²⁻¹(q; f)`: quantile of the chi-squared distribution with f degrees of freedom
//!
//! low = v/(2p) χ²⁻¹(δ/2; 2p²/v)                                                                     (1)
//! high = (v + w_M²)/(2(p + w_M)) χ²⁻¹(1 − δ/2; 2(p + w_M)²/(v + w_M²))                              (2)

use super::binomial::Interval;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Of the weights (likelihood ratios) of the failures among `samples` that were drawn independently. `None` where
/// nothing failed: then the weights say nothing of what a failure would have weighed.
pub fn weighted_interval(weights: &[f64], samples: usize, confidence: f64) -> Option<Interval> {
    let n = samples as f64;
    let p = weights.iter().sum::<f64>() / n;
    let v = weights.iter().map(|w| (w / n).powi(2)).sum::<f64>();
    let most = weights.iter().fold(0.0, |most: f64, w| most.max(*w)) / n;
    if !(p > 0.0 && v > 0.0) {
        return None;
    }
    let tail = 0.5 * (1.0 - confidence);
    let scaled = |p: f64, v: f64, share: f64| {
        let quantile = ChiSquared::new(2.0 * p * p / v).map(|law| law.inverse_cdf(share));
        quantile.map_or(f64::NAN, |quantile| 0.5 * v / p * quantile)
    };
    // (1), (2)
    let low = scaled(p, v, tail);
    let high = scaled(p + most, v + most * most, 1.0 - tail).min(1.0);
    Some(Interval { estimate: p.min(1.0), low, high })
}
