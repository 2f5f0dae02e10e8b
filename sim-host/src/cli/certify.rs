//! `surefoot certify`: how often a controller fails, and how sure that is.

use super::certify_files::{kept, text, write_files};
use super::controller::{ControllerOptions, Place};
use super::interrupt::{self, INTERRUPTED};
use super::{bad_input, complain, say};
use crate::certify::{
    Certificate, Contents, Definition, Effort, Folder, Row, Rows, Sampling, Shard, Study,
    TargetRuns, all_processors, merge, on_all, search_failures,
};
use clap::{Args, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Options of `certify`.
#[derive(Debug, Parser)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Options {
    #[command(subcommand)]
    command: Option<Command>,
    /// A built-in scene of a robot (see `surefoot list`) or a TOML file
    #[arg(required = true)]
    scene: Option<String>,
    /// What varies, and how: a TOML file of tables [vary."FIELD"]
    #[arg(long, value_name = "FILE", required = true)]
    vary: Option<PathBuf>,
    /// Runs
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..))]
    samples: u64,
    /// Decides all samples
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How samples are drawn
    #[arg(long, value_enum, default_value = "sobol")]
    sampling: Sampling,
    /// One part of several: `certify merge` puts them together
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Go on where a study in this folder was broken off, or with more samples
    #[arg(long)]
    resume: bool,
    /// Runs at a time (default: one a processor); results do not depend on it
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1024))]
    workers: Option<u64>,
    #[command(flatten)]
    controller: ControllerOptions,
    /// With `--controller firmware`: how many of the runs are repeated there, all but their bits being the host's
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u64).range(1..))]
    target_samples: u64,
    #[command(flatten)]
    result: ResultOptions,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Put the shards of a study together
    Merge {
        /// Folders of all shards
        #[arg(required = true)]
        folders: Vec<PathBuf>,
        #[command(flatten)]
        result: ResultOptions,
    },
}

/// Options about the result.
#[derive(Debug, Args)]
struct ResultOptions {
    /// Of all intervals
    #[arg(long, default_value_t = 0.99)]
    confidence: f64,
    /// Runs that look for failures where no sample has failed (default: as many as there are samples; 0: none)
    #[arg(long, value_name = "RUNS")]
    search: Option<usize>,
    /// Where the table and the report go (default: out/certify-SCENE)
    #[arg(long)]
    out: Option<PathBuf>,
    /// One JSON document on stdout instead of the summary
    #[arg(long)]
    json: bool,
}

/// Why there is no certificate.
enum Ended {
    /// Bad input, or a file that cannot be written.
    Wrong(String),
    /// By the user, after so many runs.
    Interrupted(usize),
}

impl From<String> for Ended {
    fn from(message: String) -> Self {
        Self::Wrong(message)
    }
}

/// Runs a study, or puts one together.
pub fn certify(options: &Options) -> ExitCode {
    let result = match &options.command {
        Some(Command::Merge { result, .. }) => result,
        None => &options.result,
    };
    let done = match &options.command {
        Some(Command::Merge { folders, result }) => merged(folders, result),
        None => ran(options),
    };
    match done {
        Ok(said) => say(&said, ExitCode::SUCCESS),
        Err(Ended::Wrong(message)) => bad_input(&message, result.json),
        Err(Ended::Interrupted(runs)) => {
            complain(format_args!(
                "interrupted after {runs} runs, which are kept: --resume goes on"
            ));
            ExitCode::from(INTERRUPTED)
        }
    }
}

fn ran(options: &Options) -> Result<String, Ended> {
    let Options { controller, samples, result, .. } = options;
    let (Some(scene), Some(vary)) = (&options.scene, &options.vary) else {
        return Err("expected a scene and --vary FILE".to_owned().into());
    };
    check(result)?;
    controller.check()?;
    if controller.place == Place::Bare {
        return Err("--controller bare: expected host or firmware".to_owned().into());
    }
    let definition = Definition::read(scene, vary, options.seed, options.sampling);
    let study = definition.and_then(Study::new).map_err(|error| error.to_string())?;
    controller.serves(study.base())?;
    let shard = options.shard.unwrap_or(Shard::WHOLE);
    let folder = result.out.clone().unwrap_or_else(|| folder_of(&study, shard));
    let (samples, scalar) = (*samples, controller.scalar());
    let contents = Contents { definition: study.definition().clone(), scalar, samples, shard };
    let workers = options.workers.map_or_else(all_processors, |workers| workers as usize);
    let rows = run_missing(&study, &contents, (&folder, options.resume), workers)?;
    let target = match controller.place {
        Place::Firmware => Some(on_target(&study, &rows, options)?),
        _ => None,
    };
    if shard != Shard::WHOLE {
        let files = kept(&folder);
        return Ok(if result.json {
            let shard = serde_json::json!({
                "scene": study.definition().scene, "shard": shard, "runs": rows.len(), "files": files,
            });
            format!("{shard:#}\n")
        } else {
            let (k, n, runs) = (shard.number, shard.of, rows.len());
            let merge = "`surefoot certify merge` puts the shards together";
            format!("shard {k} of {n}: {runs} runs in {}; {merge}\n", folder.display())
        });
    }
    finished(&study, &contents, &rows, (target, workers), (&folder, result))
}

fn merged(folders: &[PathBuf], result: &ResultOptions) -> Result<String, Ended> {
    check(result)?;
    let (study, contents, rows) = merge(folders)?;
    let folder = result.out.clone().unwrap_or_else(|| folder_of(&study, Shard::WHOLE));
    let is_one_of_them = folders.iter().any(|shard| {
        let [a, b] = [shard, &folder].map(|path| std::fs::canonicalize(path).ok());
        a.is_some() && a == b
    });
    if !is_one_of_them {
        let (table, _) = Folder::open(&folder, &study, &contents, false)?;
        table.finish(&study, &rows)?;
    }
    finished(&study, &contents, &rows, (None, all_processors()), (&folder, result))
}

fn check(result: &ResultOptions) -> Result<(), String> {
    let confidence = result.confidence;
    match confidence > 0.0 && confidence < 1.0 {
        true => Ok(()),
        false => {
            Err(format!("--confidence {confidence}: expected a number between 0 and 1, as 0.99"))
        }
    }
}

fn folder_of(study: &Study, shard: Shard) -> PathBuf {
    let scene = &study.definition().scene;
    Path::new("out").join(match shard {
        Shard::WHOLE => format!("certify-{scene}"),
        Shard { number, of } => format!("certify-{scene}-{number}-of-{of}"),
    })
}

/// Runs what a folder has not, and keeps each run there as soon as it is done.
fn run_missing(
    study: &Study,
    contents: &Contents,
    (folder, resume): (&Path, bool),
    workers: usize,
) -> Result<Rows, Ended> {
    let (mut table, mut rows) = Folder::open(folder, study, contents, resume)?;
    let own = contents.shard.samples(contents.samples);
    let missing: Vec<u64> = own.filter(|sample| !rows.contains_key(sample)).collect();
    let bar = bar(&study.definition().scene, missing.len());
    let work = |sample: &u64| study.run(*sample, contents.scalar).map_err(|e| e.to_string());
    let mut each = |row: &Row| {
        bar.inc(1);
        table.keep(study, row)
    };
    let done = on_all(&missing, workers, interrupt::watched(), &work, &mut each)?;
    bar.finish_and_clear();
    let (wanted, done): (usize, Vec<Row>) = (missing.len(), done.into_iter().flatten().collect());
    let is_whole = done.len() == wanted;
    rows.extend(done.into_iter().map(|row| (row.sample, row)));
    if !is_whole {
        return Err(Ended::Interrupted(rows.len()));
    }
    table.finish(study, &rows)?;
    Ok(rows)
}

/// A bar over runs, with the time that is left; it hides itself where stderr is no terminal.
fn bar(name: &str, runs: usize) -> ProgressBar {
    let bar = ProgressBar::new(runs as u64);
    // The template is constant and valid; were it not, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} runs {eta} left")
    {
        bar.set_style(style);
    }
    bar.set_message(name.to_owned());
    bar
}

/// Repeats the first runs under the controller on the target, which must give the same bits.
fn on_target(study: &Study, rows: &Rows, options: &Options) -> Result<TargetRuns, String> {
    let first = rows.values().take(options.target_samples as usize);
    let mut samples = Vec::new();
    for row in first {
        let point = study.point(row.sample);
        let scene = study.scene(row.sample, &point).map_err(|error| error.to_string())?;
        let controller = options.controller.controller(&scene);
        let mut controller = controller.map_err(|error| error.to_string())?;
        let there = Row::under(row.sample, &scene, study.vary().require, controller.as_mut());
        if there.bits != row.bits {
            return Err(format!(
                "sample {}: the target's run is not the host's: bits {} and {}, ended at {} s ({}) and {} s ({})",
                row.sample,
                there.bits,
                row.bits,
                there.time_s,
                there.failure,
                row.time_s,
                row.failure
            ));
        }
        samples.push(row.sample);
    }
    Ok(TargetRuns { samples })
}

/// The certificate of all runs, its files, and what is said of it.
fn finished(
    study: &Study,
    contents: &Contents,
    rows: &Rows,
    (target, workers): (Option<TargetRuns>, usize),
    (folder, result): (&Path, &ResultOptions),
) -> Result<String, Ended> {
    let mut certificate = Certificate::of(study, contents, rows, result.confidence);
    certificate.target = target;
    let effort = Effort::of_runs(result.search.unwrap_or(contents.samples as usize));
    if certificate.failures == 0 && effort.estimate > 0 {
        let bar = bar("search", effort.most_runs());
        let found = search_failures(
            study,
            contents.scalar,
            (&effort, result.confidence),
            (workers, interrupt::watched()),
            &mut || bar.inc(1),
        );
        bar.finish_and_clear();
        let found = found.map_err(|error| error.to_string())?;
        let (searched, nearest) = found.ok_or(Ended::Interrupted(rows.len()))?;
        (certificate.search, certificate.nearest) = (Some(searched), nearest);
    }
    let files = write_files(folder, &certificate, study, rows)?;
    if result.json {
        let mut document = serde_json::to_value(&certificate).map_err(|error| error.to_string())?;
        document["files"] = serde_json::json!(files);
        return Ok(format!("{document:#}\n"));
    }
    Ok(text(&certificate, &files))
}

#[cfg(test)]
mod tests {
    use super::*;
    use surefoot_sim::closed_loop::Scalar;

    #[test]
    fn precision_is_the_controllers() {
        let parsed = |line: &str| Options::try_parse_from(line.split(' ')).expect("options");
        let scalar = |line: &str| parsed(line).controller.scalar();
        assert_eq!(scalar("certify walk --vary a.toml"), Scalar::F64);
        assert_eq!(scalar("certify walk --vary a.toml --controller firmware"), Scalar::F32);
        assert!(parsed("certify merge a b --out c").command.is_some());
        assert!(Options::try_parse_from(["certify", "walk"]).is_err());
    }
}
