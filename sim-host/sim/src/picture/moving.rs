//! A moving picture of a while, as SVG that browsers play.

use super::still::{HEIGHT, WIDTH, scene};
use crate::record::Record;
use std::fmt::Write;
use surefoot::dynamics::DynamicsFault;

/// Pictures a second.
const RATE_HZ: f64 = 25.0;

/// Draws what moves from one time (s) to another, over and over.
///
/// # Errors
/// A [`DynamicsFault`] for a sample that is no configuration.
pub fn moving(record: &dyn Record, [from_s, to_s]: [f64; 2]) -> Result<String, DynamicsFault> {
    let times = record.times();
    let first = if times.is_empty() { None } else { Some(record.moment(0)?.poses[0]) };
    let height = first.map_or(1.0, |pose| pose.position.z.max(1e-2));
    let count = ((to_s - from_s) * RATE_HZ).floor().max(1.0);
    let mut svg = format!(
        "<svg width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#FFFFFF\"/>\n"
    );
    for k in 0..count as usize {
        let time = from_s + k as f64 / RATE_HZ;
        let sample = times.partition_point(|other| *other < time).min(times.len().max(1) - 1);
        let Some(time) = times.get(sample) else { break };
        // Writing to a string cannot fail.
        let _ = write!(svg, "<g visibility=\"hidden\">{}", shown_at(k as f64, count));
        // Without shadows it is a third as long.
        let _ = scene(&mut svg, record, height, false, (*time, &record.moment(sample)?));
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

/// When one of `count` pictures is seen.
fn shown_at(k: f64, count: f64) -> String {
    let (begin, end) = (k / count, (k + 1.0) / count);
    let (values, times) = match (k == 0.0, k + 1.0 == count) {
        (true, _) => ("visible;hidden", format!("0;{end:.5}")),
        (_, true) => ("hidden;visible", format!("0;{begin:.5}")),
        _ => ("hidden;visible;hidden", format!("0;{begin:.5};{end:.5}")),
    };
    format!(
        "<animate attributeName=\"visibility\" calcMode=\"discrete\" repeatCount=\"indefinite\" \
         dur=\"{:.2}s\" values=\"{values}\" keyTimes=\"{times}\"/>\n",
        count / RATE_HZ
    )
}
