//! Studies: samples of a scene in which something varies.

use crate::{rows, scalar as precision_of, wrong};
use numpy::PyArray2;
use pyo3::exceptions::PyInterruptedError;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use surefoot_host::certify::{
    Certificate, Contents, Definition, Folder, Row, Rows, Sampling, Shard, Study as HostStudy,
    all_processors, on_all,
};
use surefoot_sim::closed_loop::Scalar;

/// A study. It goes to other processes as what decides it.
#[pyclass(frozen, module = "surefoot._surefoot")]
pub struct Study {
    study: HostStudy,
    scalar: Scalar,
}

impl Study {
    fn of(definition: Definition, scalar: Scalar) -> PyResult<Self> {
        Ok(Self { study: HostStudy::new(definition).map_err(wrong)?, scalar })
    }

    fn contents(&self, samples: u64) -> Contents {
        let definition = self.study.definition().clone();
        Contents { definition, scalar: self.scalar, samples, shard: Shard::WHOLE }
    }

    /// Rows of which each sample has one.
    fn rows(&self, rows: &str, samples: u64) -> PyResult<Rows> {
        let list: Vec<Row> = serde_json::from_str(rows).map_err(wrong)?;
        let mut rows = Rows::new();
        for row in list {
            let sample = row.sample;
            if sample >= samples {
                let expected = format!("sample {sample}: expected numbers below {samples}");
                return Err(wrong(expected));
            }
            if rows.insert(sample, row).is_some() {
                return Err(wrong(format!("sample {sample} is there twice: expected it once")));
            }
        }
        match (0..samples).find(|sample| !rows.contains_key(sample)) {
            Some(missing) => Err(wrong(format!("sample {missing} of {samples} is missing"))),
            None => Ok(rows),
        }
    }
}

#[pymethods]
impl Study {
    /// Of a scene by its name or path, and the text of what varies.
    #[new]
    #[pyo3(signature = (scene, vary_text, seed = 1, sampling = "sobol", scalar = "f64", vary_name = "vary"))]
    fn new(
        scene: &str,
        vary_text: &str,
        seed: u64,
        sampling: &str,
        scalar: &str,
        vary_name: &str,
    ) -> PyResult<Self> {
        let sampling = match sampling {
            "sobol" => Sampling::Sobol,
            "random" => Sampling::Random,
            other => return Err(wrong(format!("sampling {other}: expected sobol or random"))),
        };
        let definition = Definition::new(scene, (vary_name, vary_text), seed, sampling);
        Self::of(definition.map_err(wrong)?, precision_of(scalar)?)
    }

    /// The same study again.
    #[staticmethod]
    fn from_json(definition: &str, scalar: &str) -> PyResult<Self> {
        Self::of(serde_json::from_str(definition).map_err(wrong)?, precision_of(scalar)?)
    }

    /// What decides it.
    #[getter]
    fn definition_json(&self) -> PyResult<String> {
        serde_json::to_string(self.study.definition()).map_err(wrong)
    }

    /// Precision of the controller.
    #[getter]
    fn scalar(&self) -> &'static str {
        match self.scalar {
            Scalar::F32 => "f32",
            Scalar::F64 => "f64",
        }
    }

    /// Names of what varies.
    #[getter]
    fn coordinates(&self) -> Vec<String> {
        self.study.coordinates().iter().map(|coordinate| coordinate.name.clone()).collect()
    }

    /// The numbers of samples' coordinates, a row a sample.
    fn values<'py>(
        &self,
        py: Python<'py>,
        samples: Vec<u64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let of = |sample: &u64| self.study.numbers(&self.study.point(*sample));
        let all: Vec<Vec<f64>> = samples.iter().map(of).collect();
        rows(py, &all, self.study.coordinates().len())
    }

    /// The scene of a sample.
    fn scene_text(&self, sample: u64) -> PyResult<String> {
        self.study.text(sample, &self.study.point(sample)).map_err(wrong)
    }

    /// Runs samples, on so many processors; a list of rows, as JSON.
    #[pyo3(signature = (samples, workers = None))]
    fn run_json(
        &self,
        py: Python<'_>,
        samples: Vec<u64>,
        workers: Option<usize>,
    ) -> PyResult<String> {
        let workers = workers.unwrap_or_else(all_processors);
        let stop = AtomicBool::new(false);
        let done = py.detach(|| {
            let work = |sample: &u64| self.study.run(*sample, self.scalar);
            on_all(&samples, workers, &stop, &work, &mut |_| Ok(()))
        });
        let rows: Option<Vec<Row>> = done.map_err(wrong)?.into_iter().collect();
        let rows = rows.ok_or_else(|| PyInterruptedError::new_err("not all samples were run"))?;
        serde_json::to_string(&rows).map_err(wrong)
    }

    /// The certificate of the rows of samples 0 to `samples` − 1, each there once; as JSON.
    fn certificate_json(&self, rows: &str, samples: u64, confidence: f64) -> PyResult<String> {
        if !(confidence > 0.0 && confidence < 1.0) {
            return Err(wrong(format!(
                "confidence {confidence}: expected a number between 0 and 1"
            )));
        }
        let rows = self.rows(rows, samples)?;
        let certificate = Certificate::of(&self.study, &self.contents(samples), &rows, confidence);
        serde_json::to_string(&certificate).map_err(wrong)
    }

    /// Writes the rows as a folder that `surefoot certify merge` makes a report of.
    fn save_json(&self, rows: &str, samples: u64, folder: PathBuf) -> PyResult<()> {
        let rows = self.rows(rows, samples)?;
        let contents = self.contents(samples);
        let (table, _) = Folder::open(&folder, &self.study, &contents, false).map_err(wrong)?;
        table.finish(&self.study, &rows).map_err(wrong)
    }
}
