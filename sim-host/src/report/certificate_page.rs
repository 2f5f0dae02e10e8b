//! The page of a certificate.

use crate::certify::{Certificate, MARGINS, Require, Rows, Study, percent};
use crate::chart::{ChartError, DotGroup, Dots, Histogram};
use askama::Template;
use std::collections::BTreeMap;

/// The page cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum CertificateFailure {
    /// Nor a chart in it.
    #[error("{0}")]
    Chart(#[from] ChartError),
    /// Its template.
    #[error("{0}")]
    Template(#[from] askama::Error),
}

/// Texts are escaped by the template, but for the style, which comes with the program, and drawings, whose backend
/// escapes.
#[derive(Template)]
#[template(path = "certificate.html")]
struct Page<'a> {
    style: &'static str,
    certificate: &'a Certificate,
    sentence: String,
    settled: bool,
    confidence: String,
    modes: Vec<[String; 5]>,
    deciding_note: Option<String>,
    shares: Vec<(String, String)>,
    maps: Vec<String>,
    search: Option<String>,
    nearest: Vec<Near>,
    margins: Vec<[String; 4]>,
    histograms: String,
}

struct Near {
    file: String,
    page: String,
    failure: String,
    time: String,
    distance: String,
    values: String,
}

/// Draws the page of a certificate and the runs that it is of.
///
/// # Errors
/// A [`CertificateFailure`].
pub fn certificate_page(
    certificate: &Certificate,
    study: &Study,
    rows: &Rows,
) -> Result<String, CertificateFailure> {
    let modes = certificate.modes.iter().map(|mode| {
        let interval = &mode.probability;
        let shares = [interval.estimate, interval.low, interval.high];
        let [share, low, high] = shares.map(|share| format!("{} %", percent(share)));
        [mode.failure.clone(), mode.failures.to_string(), share, low, high]
    });
    let margins = certificate.margins.iter().map(|margin| {
        let words = MARGINS.iter().find(|(name, _)| *name == margin.name);
        let numbers = [margin.least, margin.percentile_1, margin.median];
        let [least, one, half] = numbers.map(|x| format!("{x:.3}"));
        [words.map_or(margin.name, |(_, words)| words).to_owned(), least, one, half]
    });
    let page = Page {
        style: concat!(include_str!("page.css"), include_str!("charts.css")),
        certificate,
        sentence: certificate.sentence(),
        settled: certificate.require == Require::Settled,
        confidence: percent(certificate.confidence),
        modes: modes.collect(),
        deciding_note: deciding_note(certificate),
        shares: shares(certificate),
        maps: failure_map(certificate, study, rows)?.into_iter().collect(),
        search: search(certificate),
        nearest: nearest(certificate),
        margins: margins.collect(),
        histograms: histograms(rows)?,
    };
    Ok(page.render()?)
}

fn deciding_note(certificate: &Certificate) -> Option<String> {
    let deciding = certificate.sensitivities.as_ref()?;
    let of = match deciding.of {
        "failure" => "of failing or not",
        _ => "of the reserve, the least of tilt and height margin, as too few runs fail or do not",
    };
    let pair = deciding
        .pair
        .as_ref()
        .map_or_else(String::new, |([a, b], share)| format!(" {a} and {b} together: {share:.2}."));
    let noise = deciding.noise;
    Some(format!(
        "Shares of the variance {of}, each parameter alone; {noise:.3} may be chance.{pair} What is missing to 1 is \
         decided by several together, or by noise."
    ))
}

fn shares(certificate: &Certificate) -> Vec<(String, String)> {
    let Some(deciding) = &certificate.sensitivities else { return Vec::new() };
    let row = |share: &crate::certify::Share| (share.name.clone(), format!("{:.3}", share.share));
    deciding.coordinates.iter().map(row).collect()
}

/// All samples in the two parameters that decide together.
fn failure_map(
    certificate: &Certificate,
    study: &Study,
    rows: &Rows,
) -> Result<Option<String>, ChartError> {
    let coordinates = study.coordinates();
    let deciding = certificate.sensitivities.as_ref();
    let pair = deciding.and_then(|deciding| deciding.pair.as_ref()).map(|(names, _)| names.clone());
    let place = |name: &String| coordinates.iter().position(|c| c.name == *name);
    let Some([Some(a), Some(b)]) = pair.as_ref().map(|pair| pair.each_ref().map(place)) else {
        return Ok(None);
    };
    let mut groups: BTreeMap<&str, Vec<(f64, f64)>> = BTreeMap::new();
    for row in rows.values() {
        let numbers = study.numbers(&study.point(row.sample));
        groups.entry(&row.failure).or_default().push((numbers[a], numbers[b]));
    }
    // What did not fail has no word.
    let worked = groups.remove("").unwrap_or_default();
    let mut dots = vec![DotGroup { name: "no failure".to_owned(), places: worked }];
    let failed = groups.into_iter();
    dots.extend(failed.map(|(name, places)| DotGroup { name: name.to_owned(), places }));
    let axes = [a, b].map(|k| coordinates[k].name.clone());
    let title = format!("{}: what fails", certificate.scene);
    Dots::new(title, axes, dots).svg().map(|svg| Some(in_page(&svg)))
}

fn histograms(rows: &Rows) -> Result<String, ChartError> {
    let panels = MARGINS.iter().enumerate().filter_map(|(place, (_, words))| {
        let of = |is_failure: bool| {
            let of = rows.values().filter(|row| row.is_failure() == is_failure);
            of.filter_map(|row| row.margins.all()[place]).collect::<Vec<f64>>()
        };
        let (worked, failed) = (of(false), of(true));
        let is_there = !(worked.is_empty() && failed.is_empty());
        is_there.then(|| Histogram { axis: format!("{words}: least margin"), worked, failed })
    });
    Histogram::svg("Margins", &panels.collect::<Vec<_>>()).map(|svg| in_page(&svg))
}

/// A drawing in a page needs no namespace.
fn in_page(svg: &str) -> String {
    svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1)
}

fn search(certificate: &Certificate) -> Option<String> {
    let searched = certificate.search.as_ref()?;
    let level = |round: &crate::certify::Round| format!("{:.2}", round.level);
    let levels: Vec<String> = searched.rounds.iter().map(level).collect();
    let found = match &searched.failure_probability {
        Some(interval) => format!(
            "{} runs failed. Weighted by how much likelier the search has made them, such failures have a probability \
             of {} % ({} to {} %); failures elsewhere, that it has not come upon, are not in that figure.",
            searched.failures,
            percent(interval.estimate),
            percent(interval.low),
            percent(interval.high),
        ),
        None if searched.failures > 0 => format!(
            "{} runs failed on the way, none of those that the estimate is made from.",
            searched.failures
        ),
        None => "None failed.".to_owned(),
    };
    Some(format!(
        "As no sample failed, {} more runs looked for failures, by the cross-entropy method; in its rounds the reserve \
         of the worst tenth was {}. {found}",
        searched.runs,
        levels.join(", "),
    ))
}

fn nearest(certificate: &Certificate) -> Vec<Near> {
    let near = |near: &crate::certify::Nearest| {
        let value = |(name, x): (&String, &f64)| format!("{name} = {}", significant(*x));
        let values: Vec<String> = near.values.iter().map(value).collect();
        Near {
            file: near.file.clone(),
            page: near.file.replace(".toml", ".html"),
            failure: near.failure.clone(),
            time: format!("{:.2}", near.time_s),
            distance: format!("{:.2}", near.distance),
            values: values.join(", "),
        }
    };
    certificate.nearest.iter().map(near).collect()
}

/// With four digits that count.
fn significant(x: f64) -> String {
    let digits = (3 - x.abs().max(1e-12).log10().floor() as i32).clamp(0, 9) as usize;
    format!("{x:.digits$}")
}
