//! What `certify` says and leaves.

use crate::certify::{CONTENTS, Certificate, MARGINS, Nearest, RUNS, Rows, Study, bits, percent};
use crate::report::{Report, certificate_page, page};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use surefoot_sim::closed_loop::{self, Scalar};
use surefoot_sim::scene::{AnyScene, parse};
use surefoot_sim::written::write_text;

/// The files that runs are kept in.
pub(super) fn kept(folder: &Path) -> Vec<PathBuf> {
    [CONTENTS, RUNS].map(|name| folder.join(name)).to_vec()
}

/// Writes the certificate, its page, and the nearest failures: each a scene, run again from its text to the same bits.
pub(super) fn write_files(
    folder: &Path,
    certificate: &Certificate,
    study: &Study,
    rows: &Rows,
) -> Result<Vec<PathBuf>, String> {
    let named = |name: &str| folder.join(name);
    let mut files = vec![named("report.html"), named("certificate.json")];
    let in_study = rows.iter().filter(|(sample, _)| **sample < certificate.samples);
    let in_study: Rows = in_study.map(|(sample, row)| (*sample, row.clone())).collect();
    let drawn = certificate_page(certificate, study, &in_study);
    write_text(&files[0], &drawn.map_err(|error| error.to_string())?)?;
    let document = serde_json::to_string_pretty(certificate).map_err(|error| error.to_string())?;
    write_text(&files[1], &format!("{document}\n"))?;
    files.extend(kept(folder));
    for near in &certificate.nearest {
        let path = named(&near.file);
        let (text, replay) = replayed(certificate, study, near)?;
        write_text(&path, &text)?;
        write_text(&path.with_extension("html"), &replay)?;
        files.push(path);
    }
    Ok(files)
}

/// The text of a failure's scene, and the page of its run.
fn replayed(
    certificate: &Certificate,
    study: &Study,
    near: &Nearest,
) -> Result<(String, String), String> {
    let scene = study.text(near.sample, &near.point).map_err(|error| error.to_string())?;
    let scalar = match certificate.scalar {
        Scalar::F64 => "",
        Scalar::F32 => " --scalar f32",
    };
    let text = format!(
        "# {} at {:.3} s: sample {} of {}, seed {}. It is run by\n#   surefoot run {}{scalar}\n{scene}",
        near.failure, near.time_s, near.sample, certificate.scene, certificate.seed, near.file,
    );
    let name = near.file.trim_end_matches(".toml");
    let scene = match parse(name, &text).map_err(|error| error.to_string())? {
        AnyScene::Robot(scene) => scene,
        AnyScene::Mechanism(_) => return Err(format!("{}: no scene of a robot", near.file)),
    };
    let mut controller = closed_loop::controller(&scene, certificate.scalar);
    let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
    let again = bits(&run.samples);
    if again != near.bits {
        return Err(format!("{}: its run has the bits {again}, not {}", near.file, near.bits));
    }
    let controller = match certificate.scalar {
        Scalar::F32 => "f32, on the host",
        Scalar::F64 => "f64, on the host",
    };
    let report = Report { scene: &scene, controller, run: &run, other: None };
    Ok((text, page(&report).map_err(|error| error.to_string())?))
}

/// The summary.
pub(super) fn text(certificate: &Certificate, files: &[PathBuf]) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = lines(&mut out, certificate);
    let _ = writeln!(out, "\n{}: files", certificate.scene);
    for file in files {
        let _ = writeln!(out, "  {}", file.display());
    }
    out
}

fn lines(out: &mut String, certificate: &Certificate) -> std::fmt::Result {
    writeln!(out, "{}", certificate.sentence())?;
    for mode in &certificate.modes {
        let interval = &mode.probability;
        let [share, low, high] = [interval.estimate, interval.low, interval.high].map(percent);
        writeln!(
            out,
            "  {:<18}{:>6} runs: {share} % ({low} to {high} %)",
            mode.failure, mode.failures
        )?;
    }
    if let Some(deciding) = &certificate.sensitivities {
        writeln!(
            out,
            "\n  share of the variance of the {} (±{:.3}):",
            deciding.of, deciding.noise
        )?;
        for share in deciding.coordinates.iter().take(8) {
            writeln!(out, "  {:>7.3}  {}", share.share, share.name)?;
        }
        if let Some(([a, b], share)) = &deciding.pair {
            writeln!(out, "  {share:>7.3}  {a} and {b} together")?;
        }
    }
    writeln!(out, "\n  {:<24}{:>9}{:>9}{:>9}", "margins", "least", "1 %", "half")?;
    for margin in &certificate.margins {
        let words = MARGINS.iter().find(|(name, _)| *name == margin.name);
        let words = words.map_or(margin.name, |(_, words)| words);
        let [least, one, half] = [margin.least, margin.percentile_1, margin.median];
        writeln!(out, "  {words:<24}{least:>9.3}{one:>9.3}{half:>9.3}")?;
    }
    if let Some(target) = &certificate.target {
        let runs = target.samples.len();
        writeln!(out, "\n  {runs} runs repeated on the target, with the same bits")?;
    }
    if !certificate.nearest.is_empty() {
        writeln!(out, "\n  nearest failures (standard deviations from the middle):")?;
        for near in &certificate.nearest {
            let Nearest { distance, failure, time_s, file, .. } = near;
            writeln!(out, "  {distance:>7.2}  {failure} at {time_s:.2} s: {file}")?;
        }
    }
    Ok(())
}
