//! What is kept of a run.

use super::margins::{MARGINS, Margins};
use super::study::{Study, StudyError};
use super::vary::Require;
use crate::stability::loop_limits::{Criterion, Ending, fingerprint};
use serde::{Deserialize, Serialize};
use surefoot_sim::closed_loop::{self, Controller, Run, Scalar};
use surefoot_sim::record::Sample;
use surefoot_sim::scene::Scene;

/// A run of a sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The sample's number.
    pub sample: u64,
    /// How it failed, in the words of the failure modes; empty for a run that did not.
    pub failure: String,
    /// When it ended, s.
    pub time_s: f64,
    /// How far it was from failing, in (0, 1]: the least of tilt and height margin. Of a failure the share of the
    /// scene's time that was left, negative.
    pub reserve: f64,
    /// How near it came to its limits.
    pub margins: Margins,
    /// Digits that tell this motion from any that is not the same to the last bit.
    pub bits: String,
}

/// The least reserve of a run that has not failed, and the greatest of one that has, in size.
const LEAST: f64 = 1e-9;

impl Row {
    /// Whether the run failed.
    pub fn is_failure(&self) -> bool {
        !self.failure.is_empty()
    }

    /// Runs a scene under its controller on this machine, supervised.
    pub fn of(sample: u64, scene: &Scene, require: Require, scalar: Scalar) -> Self {
        Self::under(sample, scene, require, closed_loop::controller(scene, scalar).as_mut())
    }

    /// The same under a given controller.
    pub fn under(
        sample: u64,
        scene: &Scene,
        require: Require,
        controller: &mut dyn Controller,
    ) -> Self {
        let run = closed_loop::run(scene, controller, &mut |_| {});
        let time_s = run.samples.last().map_or(0.0, |last| last.time_s);
        let margins = Margins::of(scene, &run);
        let failure = failure(scene, &run, require);
        let reserve = if failure.is_empty() {
            let [tilt, height] = [margins.tilt, margins.height].map(|m| m.unwrap_or(1.0));
            tilt.min(height).max(LEAST)
        } else {
            let ended_s = run.stop.map_or(time_s, |stop| stop.time_s);
            -(1.0 - ended_s / scene.duration_s).max(LEAST)
        };
        Self { sample, failure, time_s, reserve, margins, bits: bits(&run.samples) }
    }

    /// Names of the columns, before those of the coordinates.
    pub fn columns() -> Vec<String> {
        let first = ["sample", "failure", "time_s", "reserve"].map(str::to_owned);
        let margins = MARGINS.map(|(name, _)| name.to_owned());
        let mut all: Vec<String> = first.into_iter().chain(margins).collect();
        all.push("bits".to_owned());
        all
    }

    /// Their values. Numbers have the digits that come back to the same bits.
    pub fn cells(&self) -> Vec<String> {
        let mut all = vec![
            self.sample.to_string(),
            self.failure.clone(),
            self.time_s.to_string(),
            self.reserve.to_string(),
        ];
        let margin = |margin: Option<f64>| margin.map_or_else(String::new, |x| x.to_string());
        all.extend(self.margins.all().map(margin));
        all.push(self.bits.clone());
        all
    }

    /// From such values; `None` where they are not those of a row.
    pub fn from_cells(cells: &[String]) -> Option<Self> {
        let [sample, failure, time_s, reserve, margins @ .., bits] = cells else { return None };
        let margin = |text: &String| match text.as_str() {
            "" => Some(None),
            text => Some(Some(text.parse::<f64>().ok()?)),
        };
        let margins: Option<Vec<Option<f64>>> = margins.iter().map(margin).collect();
        Some(Self {
            sample: sample.parse().ok()?,
            failure: failure.clone(),
            time_s: time_s.parse().ok()?,
            reserve: reserve.parse().ok()?,
            margins: Margins::from_all(margins?.try_into().ok()?),
            bits: bits.clone(),
        })
    }
}

impl Study {
    /// Runs a sample of its own.
    ///
    /// # Errors
    /// [`StudyError::Sample`] for one whose scene is refused.
    pub fn run(&self, sample: u64, scalar: Scalar) -> Result<Row, StudyError> {
        self.run_at(sample, &self.point(sample), scalar)
    }

    /// Runs a sample elsewhere in the unit cube.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub fn run_at(&self, sample: u64, point: &[f64], scalar: Scalar) -> Result<Row, StudyError> {
        let scene = self.scene(sample, point)?;
        Ok(Row::of(sample, &scene, self.vary().require, scalar))
    }
}

/// In which mode a run failed, as tables have it; empty for one that did not.
fn failure(scene: &Scene, run: &Run, require: Require) -> String {
    if run.failure.is_none() && require == Require::Upright {
        return String::new();
    }
    if let Some(failure) = run.failure.as_ref().filter(|failure| failure.kind == "estimator") {
        return failure.kind.to_owned();
    }
    let ending = Ending { scene, run, fault: None };
    let mode = ending.manner(&Criterion::default());
    // A mode is serialized as its word.
    let word = mode.and_then(|mode| serde_json::to_value(mode).ok());
    word.as_ref().and_then(|word| word.as_str()).unwrap_or_default().to_owned()
}

/// Of all positions, velocities and torques of a record.
pub fn bits(samples: &[Sample]) -> String {
    let mut bytes = Vec::new();
    for sample in samples {
        let numbers = sample.positions.iter().chain(&sample.velocities).chain(&sample.torques);
        bytes.extend(numbers.flat_map(|x| x.to_bits().to_le_bytes()));
    }
    fingerprint(&[&bytes])
}
