//! What a run has given.

use crate::{rows, wrong};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use surefoot_host::certify::{Margins, bits};
use surefoot_sim::closed_loop::Run as HostRun;
use surefoot_sim::record::Sample;
use surefoot_sim::scene::Scene;

/// The record of a run, and how it ended.
#[pyclass(frozen, module = "surefoot._surefoot")]
pub struct Run {
    run: HostRun,
    margins: Margins,
}

impl Run {
    pub fn new(scene: &Scene, run: HostRun) -> Self {
        let margins = Margins::of(scene, &run);
        Self { run, margins }
    }

    fn array<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&Sample) -> &Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let all: Vec<Vec<f64>> = self.run.samples.iter().map(|sample| of(sample).clone()).collect();
        rows(py, &all, 0)
    }
}

#[pymethods]
impl Run {
    /// `balanced`, `completed`, `stopped`, `fell` or `failed`.
    #[getter]
    fn outcome(&self) -> PyResult<String> {
        let word = serde_json::to_value(self.run.outcome).map_err(wrong)?;
        Ok(word.as_str().unwrap_or_default().to_owned())
    }

    /// Why it ended early, as JSON; `null` where it did not.
    #[getter]
    fn failure_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.run.failure).map_err(wrong)
    }

    /// How near it came to its limits, as JSON.
    #[getter]
    fn margins_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.margins).map_err(wrong)
    }

    /// Digits that tell this motion from any that is not the same to the last bit.
    #[getter]
    fn bits(&self) -> String {
        bits(&self.run.samples)
    }

    #[getter]
    fn time_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.run.samples.iter().map(|sample| sample.time_s).collect())
    }

    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.array(py, |sample| &sample.positions)
    }

    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.array(py, |sample| &sample.velocities)
    }

    #[getter]
    fn torques<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.array(py, |sample| &sample.torques)
    }

    #[getter]
    fn foot_forces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.array(py, |sample| &sample.foot_forces)
    }
}
