//! A ladder of models as a table, as bars and as files, whatever it is a ladder of.

use crate::callgrind::word;
use crate::chart::{Bar, Bars};
use crate::parsimony::{Ladder, MechanismLadder, MechanismRung, Rung, Saving};
use crate::report::Figure;
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use surefoot_sim::written::{write_rows, write_text};

/// A rung's figures; of the CSV file a row.
#[derive(Debug, Serialize)]
struct Line {
    rung: String,
    bodies: usize,
    unknowns: Option<usize>,
    instructions: Option<u64>,
    us_per_step: Option<f64>,
    reference: String,
    deviation_m: Option<f64>,
    deviation_rad: Option<f64>,
    failure: Option<String>,
}

/// A ladder.
pub(super) struct LadderTable {
    scene: String,
    about: &'static str,
    /// What strays: the central body, or any.
    who: &'static str,
    lines: Vec<Line>,
    chosen: String,
    /// The largest model of the scene's own motion, and the smallest.
    ends: [String; 2],
    /// What smaller models save, and why no more.
    savings: Vec<String>,
}

impl From<&Ladder> for LadderTable {
    fn from(ladder: &Ladder) -> Self {
        let line = |row: &crate::parsimony::Row| Line {
            rung: word(row.rung),
            bodies: row.bodies,
            unknowns: row.unknowns,
            instructions: row.instructions,
            us_per_step: row.us_per_step,
            reference: word(row.reference),
            deviation_m: row.deviation_m,
            deviation_rad: row.deviation_rad,
            failure: row.failure.clone(),
        };
        Self {
            scene: ladder.scene.clone(),
            about: "One motion on every rung; afloat, limbs in motion without gravity.",
            who: "the central body",
            lines: ladder.rows.iter().map(line).collect(),
            chosen: format!("{} model: {}", ladder.chosen.model, ladder.chosen.reason),
            ends: if ladder.rows.iter().any(|row| row.rung == Rung::FloorFull) {
                [Rung::FloorFull, Rung::FloorLumped].map(word)
            } else {
                [Rung::WeldedFull, Rung::WeldedLumped].map(word)
            },
            savings: ladder.savings.iter().map(saved).collect(),
        }
    }
}

impl From<&MechanismLadder> for LadderTable {
    fn from(ladder: &MechanismLadder) -> Self {
        let line = |row: &crate::parsimony::MechanismRow| Line {
            rung: word(row.rung),
            bodies: row.bodies,
            unknowns: row.unknowns,
            instructions: row.instructions,
            us_per_step: row.us_per_step,
            reference: word(MechanismRung::JointCoordinates),
            deviation_m: row.deviation_m,
            deviation_rad: row.deviation_rad,
            failure: row.failure.clone(),
        };
        Self {
            scene: ladder.scene.clone(),
            about: "One motion on every rung.",
            who: "a body",
            lines: ladder.rows.iter().map(line).collect(),
            chosen: format!("{} model: {}", ladder.chosen.model, ladder.chosen.reason),
            ends: [
                word(MechanismRung::JointCoordinates),
                ladder.rows.last().map_or_else(String::new, |row| word(row.rung)),
            ],
            savings: Vec::new(),
        }
    }
}

impl LadderTable {
    /// For people.
    pub fn text(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{}: {}\nDeviation of {}, at most, from the rung that is named.\n\n  \
             {:<20}{:>7}{:>10}{:>14}{:>10}{:>12}{:>12}  from",
            self.scene,
            self.about,
            self.who,
            "",
            "bodies",
            "unknowns",
            "instructions",
            "µs/step",
            "m",
            "rad"
        );
        let dash = || "–".to_owned();
        for line in &self.lines {
            let _ = writeln!(
                out,
                "  {:<20}{:>7}{:>10}{:>14}{:>10}{:>12}{:>12}  {}",
                line.rung,
                line.bodies,
                line.unknowns.map_or_else(dash, |n| n.to_string()),
                line.instructions.map_or_else(dash, |n| n.to_string()),
                line.us_per_step.map_or_else(dash, |t| format!("{t:.2}")),
                line.deviation_m.map_or_else(dash, |m| format!("{m:.1e}")),
                line.deviation_rad.map_or_else(dash, |a| format!("{a:.1e}")),
                line.reference,
            );
        }
        let mut last = None;
        for line in &self.lines {
            let Some(failure) = &line.failure else { continue };
            if last != Some(failure) {
                let _ = writeln!(out, "  {}: {failure}", line.rung);
            }
            last = Some(failure);
        }
        for saving in &self.savings {
            let _ = writeln!(out, "\n{saving}");
        }
        let _ = writeln!(out, "\n`surefoot run` takes the {}.", self.chosen);
        out
    }

    /// What the chosen model saves.
    pub fn headline(&self) -> String {
        let count = |rung: &String| {
            self.lines.iter().find(|line| line.rung == *rung).and_then(|line| line.instructions)
        };
        let [large, small] = &self.ends;
        match count(large).zip(count(small)) {
            Some((many, few)) => format!(
                "{}: {few} instructions a step ({small}) in place of {many} ({large}): {:.2} times less.",
                self.scene,
                many as f64 / few as f64
            ),
            None => format!("{} runs on the {}.", self.scene, self.chosen),
        }
    }

    /// Bars, as SVG.
    ///
    /// # Errors
    /// What went wrong.
    pub fn drawing(&self) -> Result<String, String> {
        Bars::svg(&self.panels()).map_err(|error| error.to_string())
    }

    /// The drawing in a page, with links to the files.
    pub fn figure(&self, drawing: &str, files: &[PathBuf]) -> Figure {
        let note = format!(
            "`run` takes the {}. {} Deviations are of {}, at most, from the largest model of the same motion. {}",
            self.chosen,
            self.about,
            self.who,
            self.savings.join(" ")
        );
        let names = files.iter().filter_map(|f| Some(f.file_name()?.to_string_lossy().into()));
        Figure::new(drawing, self.headline(), note).with_files(names)
    }

    /// CSV, the ladder itself as JSON, and bars as SVG.
    ///
    /// # Errors
    /// What went wrong, with the file's name.
    pub fn write(
        &self,
        folder: &Path,
        ladder: &impl Serialize,
        drawing: &str,
    ) -> Result<Vec<PathBuf>, String> {
        let named = |ending: &str| folder.join(format!("parsimony-{}.{ending}", self.scene));
        let (csv, json, svg) = (named("csv"), named("json"), named("svg"));
        write_rows(&csv, |writer| self.lines.iter().try_for_each(|line| writer.serialize(line)))?;
        let document = serde_json::to_string_pretty(ladder)
            .map_err(|error| format!("{}: {error}", json.display()))?;
        write_text(&json, &(document + "\n"))?;
        write_text(&svg, drawing)?;
        Ok(vec![csv, json, svg])
    }

    fn panels(&self) -> Vec<Bars> {
        let bars = |value: &dyn Fn(&Line) -> Option<f64>, label: &dyn Fn(f64) -> String| {
            let bar = |line: &Line| Bar {
                name: line.rung.clone(),
                value: value(line),
                label: value(line).map_or_else(|| "–".to_owned(), label),
            };
            self.lines.iter().map(bar).collect::<Vec<_>>()
        };
        let scene = &self.scene;
        let mut panels = Vec::new();
        if self.lines.iter().any(|line| line.instructions.is_some()) {
            let counts = bars(&|line| line.instructions.map(|n| n as f64), &|n| format!("{n:.0}"));
            panels.push(Bars::new(format!("{scene}: instructions per step"), counts));
        }
        let times = bars(&|line| line.us_per_step, &|t| format!("{t:.2}"));
        panels.push(Bars::new(format!("{scene}: time per step, µs"), times));
        let unknowns = bars(&|line| line.unknowns.map(|n| n as f64), &|n| format!("{n:.0}"));
        panels.push(Bars::new(format!("{scene}: unknowns"), unknowns));
        let deviations = bars(&|line| line.deviation_m, &|m| format!("{m:.1e}"));
        let title =
            format!("{scene}: deviation of {} from the full model, m (logarithmic)", self.who);
        panels.push(Bars::new(title, deviations).logarithmic());
        panels
    }
}

/// What lumping saves, and why no more.
fn saved(saving: &Saving) -> String {
    let Saving { full, lumped, share, bodies, each, common, each_for_half } = *saving;
    format!(
        "{} takes {:.0} % of {}: {bodies} bodies go, at {each:.0} instructions each. {common:.0} are for what both \
         have (velocities, contact points, constraints, the step itself), whatever bodies cost; for half, a body \
         would have to take {each_for_half:.0}.",
        word(lumped),
        100.0 * share,
        word(full),
    )
}
