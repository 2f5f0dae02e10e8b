//! The compiled part of Python's package `surefoot`: what its modules wrap.
//!
//! Numbers come and go as NumPy's arrays of f64, documents as JSON. Errors are `ValueError` with the text that the
//! command line has. What takes long runs without the interpreter's lock.

mod robot;
mod run;
mod scene;
mod simulation;
mod study;

use numpy::PyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use surefoot_sim::closed_loop::Scalar;

/// The module.
#[pymodule]
mod _surefoot {
    #[pymodule_export]
    use super::robot::Robot;
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::simulation::Simulation;
    #[pymodule_export]
    use super::study::Study;
}

/// An error as Python has it.
fn wrong(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn scalar(name: &str) -> PyResult<Scalar> {
    match name {
        "f32" => Ok(Scalar::F32),
        "f64" => Ok(Scalar::F64),
        other => Err(wrong(format!("scalar {other}: expected f32 or f64"))),
    }
}

/// Rows of equal length as an array.
fn rows<'py>(
    py: Python<'py>,
    rows: &[Vec<f64>],
    columns: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    if rows.is_empty() {
        return Ok(PyArray2::zeros(py, [0, columns], false));
    }
    PyArray2::from_vec2(py, rows).map_err(wrong)
}
