//! `surefoot chart`

mod ladder_table;
mod limits;
mod limits_table;
mod map_picture;
mod maps;
mod parsimony;
mod precision;
mod stability;
mod steps;

use super::{bad_input, say};
use crate::precision::machine;
use crate::report::{Chapter, charts_page};
use crate::stability::loop_limits::Quantity;
use clap::Parser;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use surefoot_sim::written::write_text;

/// Options of `chart`.
#[derive(Debug, Parser)]
pub struct Options {
    /// What to chart
    #[arg(value_enum)]
    what: What,
    /// A scene, built in or a TOML file: of stability, a robot's, for the limits of its control loop in place of
    /// methods' steps; of parsimony, the motion (default: experiment-1, hinged-chain and box-drop)
    #[arg(long)]
    scene: Option<String>,
    /// Of stability, with `--scene`: only this limit; may be given more than once
    #[arg(long, value_enum, requires = "scene")]
    only: Vec<Quantity>,
    /// Without `--scene`: only the longest steps, or only the maps
    #[arg(long, value_enum, conflicts_with = "scene")]
    part: Option<Part>,
    /// Cells along each side of a map
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u16).range(2..=200))]
    cells: u16,
    /// Forget what an earlier call has found
    #[arg(long)]
    fresh: bool,
    /// Of `work-precision`: only this problem; may be given more than once
    #[arg(long)]
    problem: Vec<String>,
    /// Of `work-precision`: MuJoCo too, on the same models in the same run
    #[arg(long)]
    peers: bool,
    /// Where the page, the drawings and the tables go
    #[arg(long, default_value = "out/chart")]
    out: PathBuf,
    /// One JSON document instead of a table
    #[arg(long)]
    json: bool,
}

/// What can be charted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum What {
    /// The longest step of each method on each problem, how it fails beyond, and what was foretold, with maps in
    /// two parameters; of a robot's scene, how far its control loop goes
    Stability,
    /// What models of different size cost for one motion, and how far they are off
    Parsimony,
    /// Error against computing time, step and evaluations, of each method on each problem
    WorkPrecision,
    /// Everything that needs no scene: half an hour at most
    All,
}

/// A part of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Part {
    /// The longest step of each method on each problem
    Steps,
    /// The maps in two parameters
    Maps,
}

/// The bytes of this program: what another one has found is not taken up.
fn this_program() -> Result<Vec<u8>, String> {
    std::env::current_exe()
        .and_then(std::fs::read)
        .map_err(|error| format!("this program cannot read itself: {error}"))
}

/// What a chart has found.
struct Made {
    /// For people.
    text: String,
    /// For programs.
    json: Value,
    /// What has been written.
    files: Vec<PathBuf>,
    /// For the page.
    chapter: Chapter,
}

/// Charts, and puts what was charted on a page.
pub fn chart(options: &Options) -> ExitCode {
    match make(options) {
        Ok((made, page)) => {
            let text = if options.json {
                format!("{:#}\n", document(made, &page))
            } else {
                let texts: String = made.iter().map(|one| one.text.as_str()).collect();
                // The page links to the others.
                format!("{texts}\nwritten: {}\n", page.display())
            };
            say(&text, ExitCode::SUCCESS)
        }
        Err(message) => bad_input(&message, options.json),
    }
}

fn make(options: &Options) -> Result<(Vec<Made>, PathBuf), String> {
    let folder = &options.out;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let (name, made) = match (options.what, &options.scene) {
        (What::Stability, None) => ("stability", vec![stability::chart(options)?]),
        (What::Stability, Some(scene)) => {
            ("limits", vec![limits::chart(&[scene.as_str()], options)?])
        }
        (What::Parsimony, _) => ("parsimony", vec![parsimony::chart(options)?]),
        (What::WorkPrecision, _) => ("work-precision", vec![precision::chart(options)?]),
        (What::All, _) => {
            let mut all = vec![precision::chart(options)?, stability::chart(options)?];
            all.push(limits::chart(&limits::SCENES, options)?);
            all.push(parsimony::chart(options)?);
            ("index", all)
        }
    };
    let chapters: Vec<Chapter> = made.iter().map(|one| one.chapter.clone()).collect();
    let page = charts_page(&chapters, &machine()).map_err(|error| error.to_string())?;
    let path = folder.join(name).with_extension("html");
    write_text(&path, &page)?;
    Ok((made, path))
}

/// One document: a chart's own, or all of them.
fn document(made: Vec<Made>, page: &Path) -> Value {
    let documents = made.into_iter().map(|one| {
        let mut document = one.json;
        document["files"] = json!(one.files);
        document["page"] = json!(page);
        document
    });
    let mut documents: Vec<Value> = documents.collect();
    match documents.len() {
        1 => documents.remove(0),
        _ => json!({ "charts": documents, "page": page }),
    }
}
