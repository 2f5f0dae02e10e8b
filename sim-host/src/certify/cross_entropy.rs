//! A search for rare failures, and an estimate of their probability.
//!
//! R. Y. Rubinstein, D. P. Kroese, "The Cross-Entropy Method", Springer 2004, §3.2 (algorithm 3.2.1): samples are drawn
//! ever nearer to failure, each round from the normal distribution that is nearest to the best of the round before. The
//! last round's samples are weighted by how much likelier the search has made them; some are of the distribution as it
//! was given, so that no weight is large (T. Hesterberg, "Weighted average importance sampling and defensive mixture
//! distributions", Technometrics 37 (1995) 185–194).
//!
//! # Notation
//! - `z ∈ ℝᵈ`: a sample, standard normal as it was given: density `φ`
//! - `q = N(μ, diag σ²)`: what the search draws from
//! - `r(z)`: the reserve, 0 and below for a failure; `γ`: the level that a share `ρ` of a round is below
//! - `W = φ/q`
//!
//! γ = max(0, quantile ρ of r)                                                                      (1)
//! μ = Σ W 1{r ≤ γ} z / Σ W 1{r ≤ γ}, σ² = Σ W 1{r ≤ γ} (z − μ)² / Σ W 1{r ≤ γ}                     (2)
//! p = mean of 1{r ≤ 0} φ/(α φ + (1 − α) q)                                                         (3)

use super::binomial::Interval;
use super::normal::{ordinary, standard_normal};
use super::sequence::{Stream, generator};
use super::weighted::weighted_interval;
use serde::{Deserialize, Serialize};

/// How much is spent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effort {
    /// Samples of each round.
    pub per_round: usize,
    /// Rounds at most.
    pub rounds: usize,
    /// Samples of the estimate.
    pub estimate: usize,
}

/// What a search has found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Round by round.
    pub rounds: Vec<Round>,
    /// What the samples of the estimate were drawn from, but for a share `α` of them.
    pub proposal: Proposal,
    /// Probability of the failures that are found there; none where nothing failed.
    pub probability: Option<Interval>,
    /// All that failed.
    pub failures: Vec<FoundFailure>,
    /// All that was run.
    pub runs: usize,
}

/// A round.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Round {
    /// `γ`
    pub level: f64,
    /// How many of its samples failed.
    pub failures: usize,
}

/// A normal distribution whose coordinates are independent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proposal {
    /// `μ`
    pub mean: Vec<f64>,
    /// `σ`
    pub deviation: Vec<f64>,
}

/// A sample that failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundFailure {
    /// Where it is among all samples of the search, from 0.
    pub number: usize,
    /// `z`
    pub at: Vec<f64>,
}

/// `ρ`
const ELITE: f64 = 0.1;
/// `α`
const DEFENSIVE: f64 = 0.1;
/// How much of (2) is taken over; the rest stays (Rubinstein and Kroese, §2.6).
const SMOOTHING: f64 = 0.8;
/// `σ` is not narrower than as it was given: (2) from few samples is too narrow, and then few failures have almost all
/// the weight. Shifted only, the samples of a half-space have weights that are bounded there.
const NARROWEST: f64 = 1.0;

impl Proposal {
    fn given(dimensions: usize) -> Self {
        Self { mean: vec![0.0; dimensions], deviation: vec![1.0; dimensions] }
    }

    fn place(&self, z: Vec<f64>) -> Vec<f64> {
        z.iter().zip(&self.mean).zip(&self.deviation).map(|((z, m), s)| m + s * z).collect()
    }

    /// ln(q/φ)
    fn log_ratio(&self, z: &[f64]) -> f64 {
        let each = z.iter().zip(&self.mean).zip(&self.deviation);
        each.map(|((z, m), s)| 0.5 * z * z - 0.5 * ((z - m) / s).powi(2) - libm::log(*s)).sum()
    }

    /// (2)
    fn toward(&mut self, elite: &[&Vec<f64>]) {
        let logs: Vec<f64> = elite.iter().map(|z| -self.log_ratio(z)).collect();
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights: Vec<f64> = logs.iter().map(|log| libm::exp(log - most)).collect();
        let sum: f64 = weights.iter().sum();
        let average = |of: &dyn Fn(&[f64]) -> f64| {
            elite.iter().zip(&weights).map(|(z, w)| w * of(z)).sum::<f64>() / sum
        };
        for i in 0..self.mean.len() {
            let mean = average(&|z| z[i]);
            let deviation = average(&|z| (z[i] - mean).powi(2)).sqrt();
            self.mean[i] += SMOOTHING * (mean - self.mean[i]);
            let smoothed = self.deviation[i] + SMOOTHING * (deviation - self.deviation[i]);
            self.deviation[i] = smoothed.max(NARROWEST);
        }
    }
}

/// What runs samples, given with the number of the first, and tells the reserve of each.
pub type Batches<'a, E> = dyn FnMut(usize, &[Vec<f64>]) -> Result<Vec<f64>, E> + 'a;

/// Searches. `reserves` runs samples, given with the number of the first, and tells the reserve of each.
///
/// # Errors
/// Those of `reserves`.
pub fn search<E>(
    dimensions: usize,
    effort: &Effort,
    (seed, confidence): (u64, f64),
    reserves: &mut Batches<'_, E>,
) -> Result<Found, E> {
    let mut proposal = Proposal::given(dimensions);
    let (mut rounds, mut failures, mut runs) = (Vec::new(), Vec::new(), 0);
    let mut note = |first: usize, points: &[Vec<f64>], reserves: &[f64]| {
        let failed = points.iter().zip(reserves).enumerate().filter(|(_, (_, r))| **r <= 0.0);
        let all = failed.map(|(k, (z, _))| FoundFailure { number: first + k, at: z.clone() });
        let before = failures.len();
        failures.extend(all);
        failures.len() - before
    };
    let drawn = |round: usize, number: usize| -> Vec<f64> {
        let mut random = generator(seed, number as u64, Stream::Round(round as u64));
        (0..dimensions).map(|_| standard_normal(&mut random)).collect()
    };
    for round in 0..effort.rounds {
        let points: Vec<_> =
            (0..effort.per_round).map(|k| proposal.place(drawn(round, k))).collect();
        let found = reserves(runs, &points)?;
        let failed = note(runs, &points, &found);
        runs += points.len();
        let mut sorted = found.clone();
        sorted.sort_by(f64::total_cmp);
        let elite = ((ELITE * sorted.len() as f64).ceil() as usize).max(1);
        // (1)
        let level = sorted.get(elite - 1).map_or(0.0, |r| r.max(0.0));
        rounds.push(Round { level, failures: failed });
        let best: Vec<&Vec<f64>> =
            points.iter().zip(&found).filter(|(_, r)| **r <= level).map(|(z, _)| z).collect();
        proposal.toward(&best);
        if level <= 0.0 {
            break;
        }
    }
    let defensive = (DEFENSIVE * effort.estimate as f64).round() as usize;
    let share = defensive as f64 / effort.estimate.max(1) as f64;
    let points: Vec<_> = (0..effort.estimate)
        .map(|k| {
            let z = drawn(effort.rounds, k);
            if k < defensive { z } else { proposal.place(z) }
        })
        .collect();
    let found = reserves(runs, &points)?;
    note(runs, &points, &found);
    runs += points.len();
    // (3)
    let weight = |z: &Vec<f64>| 1.0 / (share + (1.0 - share) * libm::exp(proposal.log_ratio(z)));
    let failed = points.iter().zip(&found).filter(|(_, r)| **r <= 0.0);
    let weights: Vec<f64> = failed.map(|(z, _)| weight(z)).collect();
    let probability = weighted_interval(&weights, effort.estimate, confidence);
    Ok(Found { rounds, proposal, probability, failures, runs })
}

/// The point of the unit cube that a sample is.
pub fn in_cube(z: &[f64]) -> Vec<f64> {
    z.iter().map(|z| ordinary(*z)).collect()
}
