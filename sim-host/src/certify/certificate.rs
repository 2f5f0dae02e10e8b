//! What the runs of a study come to.

use super::binomial::{Interval, clopper_pearson};
use super::cross_entropy::Round;
use super::margins::MARGINS;
use super::normal::quantile;
use super::row::Row;
use super::sensitivity::sensitivities;
use super::study::Study;
use super::table::{Contents, Rows};
use super::vary::Require;
use serde::Serialize;
use std::collections::BTreeMap;
use surefoot_sim::closed_loop::Scalar;

/// The result.
#[derive(Clone, Debug, Serialize)]
pub struct Certificate {
    /// The scene.
    pub scene: String,
    /// What it is, for people.
    pub description: String,
    /// What a run must do so as not to fail.
    pub require: Require,
    /// What varies.
    pub parameters: Vec<Varied>,
    /// Seed of the samples.
    pub seed: u64,
    /// Precision of the controller.
    pub scalar: Scalar,
    /// How many were run.
    pub samples: u64,
    /// How many failed.
    pub failures: u64,
    /// Confidence of all intervals.
    pub confidence: f64,
    /// Exact interval of the share that fails.
    pub failure_probability: Interval,
    /// The same of each failure mode, each for itself; the most frequent is first.
    pub modes: Vec<Mode>,
    /// Which parameters decide; none where all results are the same.
    pub sensitivities: Option<Deciding>,
    /// How near runs came to their limits.
    pub margins: Vec<MarginSummary>,
    /// The failures that are nearest to what is usual.
    pub nearest: Vec<Nearest>,
    /// What was looked for where no sample failed.
    pub search: Option<Searched>,
    /// Runs that the target has repeated with the same bits, if any were asked for.
    pub target: Option<TargetRuns>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Varied {
    /// Its name.
    pub name: String,
    /// How it is distributed, for people.
    pub distribution: String,
}

/// A failure mode.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mode {
    /// Its word.
    pub failure: String,
    /// How many runs failed so.
    pub failures: u64,
    /// Exact interval of their share.
    pub probability: Interval,
}

/// Shares of a variance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Deciding {
    /// Of what: `failure`, yes or no, or `reserve`, where too few fail or do not.
    pub of: &'static str,
    /// Coordinates, the most important is first.
    pub coordinates: Vec<Share>,
    /// The two that decide most together, and their share.
    pub pair: Option<([String; 2], f64)>,
    /// Shares of this size are no more than chance in a third of all cases.
    pub noise: f64,
}

/// What a coordinate decides alone.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Share {
    /// Its name.
    pub name: String,
    /// Its number in the points.
    #[serde(skip)]
    pub coordinate: usize,
    /// Its share of the variance.
    pub share: f64,
}

/// A margin over all runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MarginSummary {
    /// Its column.
    pub name: &'static str,
    /// The least.
    pub least: f64,
    /// One run of a hundred has less.
    pub percentile_1: f64,
    /// Half of the runs have less.
    pub median: f64,
}

/// A failure that is near.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Nearest {
    /// The sample's number.
    pub sample: u64,
    /// Its mode.
    pub failure: String,
    /// When it ended, s.
    pub time_s: f64,
    /// How far it is from the middle of all distributions, in standard deviations of a normal one.
    pub distance: f64,
    /// Digits of its motion.
    pub bits: String,
    /// What its coordinates are.
    pub values: BTreeMap<String, f64>,
    /// Where it is in the unit cube.
    #[serde(skip)]
    pub point: Vec<f64>,
    /// The scene that replays it, beside the certificate.
    pub file: String,
}

/// A search where no sample failed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Searched {
    /// Runs that it took.
    pub runs: usize,
    /// Its failures.
    pub failures: usize,
    /// Probability of the failures that it found, from weighted samples; none where nothing failed.
    pub failure_probability: Option<Interval>,
    /// Round by round.
    pub rounds: Vec<Round>,
}

/// Runs on the target.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetRuns {
    /// Their samples, each with the bits of its run on the host.
    pub samples: Vec<u64>,
}

/// Failures that are kept as scenes.
const KEPT: usize = 10;
/// Failures, and runs that do not fail, from which on shares are of the failures.
const FEW: u64 = 5;

impl Certificate {
    /// Of all rows of a study.
    pub fn of(study: &Study, contents: &Contents, rows: &Rows, confidence: f64) -> Self {
        let rows: Vec<&Row> = rows.range(..contents.samples).map(|(_, row)| row).collect();
        let samples = rows.len() as u64;
        let points: Vec<Vec<f64>> = rows.iter().map(|row| study.point(row.sample)).collect();
        let failures = rows.iter().filter(|row| row.is_failure()).count() as u64;
        let definition = study.definition();
        let varied = study.vary().parameters.iter().map(|parameter| Varied {
            name: parameter.name.clone(),
            distribution: {
                let factor = if parameter.is_factor { ", times the scene's own" } else { "" };
                format!("{}{factor}", parameter.distribution.words())
            },
        });
        let failed = rows.iter().zip(&points).filter(|(row, _)| row.is_failure());
        let found = failed.map(|(row, point)| ((*row).clone(), point.clone())).collect();
        Self {
            scene: definition.scene.clone(),
            description: study.base().description.clone(),
            require: study.vary().require,
            parameters: varied.collect(),
            seed: definition.seed,
            scalar: contents.scalar,
            samples,
            failures,
            confidence,
            failure_probability: clopper_pearson(failures, samples, confidence),
            modes: modes(&rows, confidence),
            sensitivities: deciding(study, &rows, &points, failures),
            margins: margins(&rows),
            nearest: nearest(study, found),
            search: None,
            target: None,
        }
    }

    /// The result in a sentence.
    pub fn sentence(&self) -> String {
        let Self { scene, samples, failures, confidence, failure_probability, .. } = self;
        let Interval { estimate, low, high } = *failure_probability;
        let sure = format!("{} % confidence", rounded(100.0 * confidence));
        let mut out = match failures {
            0 => format!(
                "{scene} fails in none of {samples} runs: in at most {} % of all, with {sure}.",
                percent(high)
            ),
            _ => format!(
                "{scene} fails in {} % ({} to {} %) of what was varied: {failures} of {samples} runs, {sure}.",
                percent(estimate),
                percent(low),
                percent(high)
            ),
        };
        if let Some(searched) = &self.search {
            let runs = searched.runs;
            out.push_str(&match &searched.failure_probability {
                Some(Interval { estimate, low, high }) => format!(
                    " A search of {runs} runs finds failures, with a probability of {} % ({} to {} %).",
                    percent(*estimate),
                    percent(*low),
                    percent(*high)
                ),
                None => format!(" A search of {runs} runs finds no failure either."),
            });
        }
        out
    }
}

/// The failures that are nearest to the middle of all distributions that have an order.
pub fn nearest(study: &Study, found: Vec<(Row, Vec<f64>)>) -> Vec<Nearest> {
    let coordinates = study.coordinates();
    let distance = |point: &[f64]| {
        let ordered = coordinates.iter().zip(point);
        let ordered = ordered.filter(|(c, _)| study.parameter(c).distribution.is_ordered());
        ordered.map(|(_, u)| quantile(*u).powi(2)).sum::<f64>().sqrt()
    };
    let mut all: Vec<Nearest> = found
        .into_iter()
        .map(|(row, point)| Nearest {
            sample: row.sample,
            failure: row.failure,
            time_s: row.time_s,
            distance: distance(&point),
            bits: row.bits,
            values: coordinates.iter().map(|c| c.name.clone()).zip(study.numbers(&point)).collect(),
            point,
            file: String::new(),
        })
        .collect();
    all.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.sample.cmp(&b.sample)));
    all.truncate(KEPT);
    for (number, near) in all.iter_mut().enumerate() {
        near.file = format!("failure-{}.toml", number + 1);
    }
    all
}

fn modes(rows: &[&Row], confidence: f64) -> Vec<Mode> {
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.is_failure()) {
        *counts.entry(&row.failure).or_default() += 1;
    }
    let mode = |(failure, failures): (&str, u64)| Mode {
        failure: failure.to_owned(),
        failures,
        probability: clopper_pearson(failures, rows.len() as u64, confidence),
    };
    let mut modes: Vec<Mode> = counts.into_iter().map(mode).collect();
    modes.sort_by_key(|mode| std::cmp::Reverse(mode.failures));
    modes
}

fn deciding(study: &Study, rows: &[&Row], points: &[Vec<f64>], failures: u64) -> Option<Deciding> {
    let is_of_failures = failures.min(rows.len() as u64 - failures) >= FEW;
    let result = |row: &&Row| match is_of_failures {
        true => f64::from(u8::from(row.is_failure())),
        false => row.reserve,
    };
    let results: Vec<f64> = rows.iter().map(result).collect();
    let found = sensitivities(points, &results)?;
    let name = |k: usize| study.coordinates()[k].name.clone();
    let share = |(coordinate, share): (usize, &f64)| Share {
        name: name(coordinate),
        coordinate,
        share: *share,
    };
    let mut coordinates: Vec<Share> = found.first.iter().enumerate().map(share).collect();
    coordinates.sort_by(|a, b| b.share.total_cmp(&a.share));
    Some(Deciding {
        of: if is_of_failures { "failure" } else { "reserve" },
        coordinates,
        pair: found.pair.map(|pair| (pair.coordinates.map(name), pair.closed)),
        noise: found.noise,
    })
}

fn margins(rows: &[&Row]) -> Vec<MarginSummary> {
    let of = |(place, (name, _)): (usize, &(&'static str, &str))| {
        let mut all: Vec<f64> = rows.iter().filter_map(|row| row.margins.all()[place]).collect();
        all.sort_by(f64::total_cmp);
        let at = |share: f64| all.get((share * all.len() as f64) as usize).copied();
        Some(MarginSummary { name, least: at(0.0)?, percentile_1: at(0.01)?, median: at(0.5)? })
    };
    MARGINS.iter().enumerate().filter_map(of).collect()
}

/// A share in percent, with two digits that count.
pub fn percent(share: f64) -> String {
    rounded(100.0 * share)
}

fn rounded(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return "0".to_owned();
    }
    if x.abs() < 1e-4 {
        return format!("{x:.1e}");
    }
    let digits = (1 - x.abs().log10().floor() as i32).clamp(0, 9) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn percents_have_two_digits() {
        let shares = [0.003, 0.123456, 0.00098, 1.0, 0.0, 1.23e-5, 1.2e-9];
        let expected = ["0.3", "12", "0.098", "100", "0", "0.0012", "1.2e-7"];
        assert_eq!(shares.map(percent), expected);
        assert_eq!(percent(0.9999), "100");
    }
}
