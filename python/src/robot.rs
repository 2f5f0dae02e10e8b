//! Robots of files, and their dynamics.

use crate::wrong;
use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::path::PathBuf;
use surefoot_robots::dynamics::{Convention, Dynamics, Precision};
use surefoot_robots::{Options, Robot as Imported, import};

/// A robot of a URDF, MJCF or robot.toml file.
#[pyclass(frozen, module = "surefoot._surefoot")]
pub struct Robot {
    robot: Imported,
    convention: Convention,
    coordinates: usize,
}

#[pymethods]
impl Robot {
    /// Reads it; `lock` fixes joints at coordinates (rad, or m). `convention` says how floating and spherical joints
    /// are written: as `mujoco` or as `pinocchio` does.
    #[new]
    #[pyo3(signature = (path, lock = None, convention = "mujoco"))]
    fn new(path: PathBuf, lock: Option<BTreeMap<String, f64>>, convention: &str) -> PyResult<Self> {
        let convention = match convention {
            "mujoco" => Convention::Mujoco,
            "pinocchio" => Convention::Pinocchio,
            other => {
                return Err(wrong(format!("convention {other}: expected mujoco or pinocchio")));
            }
        };
        let locks = lock.unwrap_or_default().into_iter().collect();
        let options = Options { locks, ..Options::default() };
        let robot = import(&path, &options).map_err(wrong)?.robot;
        let dynamics = Dynamics::new(&robot, Precision::F64).map_err(wrong)?;
        let coordinates = dynamics.coordinates(convention);
        Ok(Self { robot, convention, coordinates })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.robot.name
    }

    /// Of all that moves, kg.
    #[getter]
    fn mass(&self) -> f64 {
        self.robot.mass()
    }

    /// Coordinates of a state.
    #[getter]
    fn nq(&self) -> usize {
        self.coordinates
    }

    /// Velocities of a state.
    #[getter]
    fn nv(&self) -> usize {
        self.robot.degrees_of_freedom()
    }

    /// Names of the joints, in the order of coordinates.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.robot.links.iter().map(|link| link.joint.name.clone()).collect()
    }

    /// Names of the links that move, in the same order.
    #[getter]
    fn links(&self) -> Vec<String> {
        self.robot.links.iter().map(|link| link.name.clone()).collect()
    }

    /// Inverse dynamics, forward dynamics, mass matrix and places of links, at each row of states.
    fn dynamics<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray2<'_, f64>,
        v: PyReadonlyArray2<'_, f64>,
        a: PyReadonlyArray2<'_, f64>,
        tau: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let dynamics = Dynamics::new(&self.robot, Precision::F64).map_err(wrong)?;
        let states = q.as_array().nrows();
        let all = [&q, &v, &a, &tau]
            .map(|array| array.as_array().outer_iter().map(|row| row.to_vec()).collect::<Vec<_>>());
        if all.iter().any(|rows| rows.len() != states) {
            return Err(wrong(format!("q has {states} rows; expected as many of v, a and tau")));
        }
        let (mut inverse, mut forward, mut mass, mut places) = (vec![], vec![], vec![], vec![]);
        for state in 0..states {
            let [q, v, a, tau] = all.each_ref().map(|rows| rows[state].as_slice());
            let found = dynamics
                .evaluate(self.convention, [q, v, a, tau])
                .map_err(|error| wrong(format!("row {state}: {error}")))?;
            inverse.push(found.inverse.as_slice().to_vec());
            forward.push(found.forward.as_slice().to_vec());
            let by_rows = found.mass_matrix.row_iter().map(|row| row.iter().copied().collect());
            mass.push(by_rows.collect::<Vec<Vec<f64>>>());
            let place = found.poses.iter().map(|pose| pose.translation.vector.as_slice().to_vec());
            places.push(place.collect::<Vec<Vec<f64>>>());
        }
        let out = PyDict::new(py);
        out.set_item("inverse", PyArray2::from_vec2(py, &inverse).map_err(wrong)?)?;
        out.set_item("forward", PyArray2::from_vec2(py, &forward).map_err(wrong)?)?;
        out.set_item("mass_matrix", PyArray3::from_vec3(py, &mass).map_err(wrong)?)?;
        out.set_item("link_positions", PyArray3::from_vec3(py, &places).map_err(wrong)?)?;
        Ok(out)
    }

    /// Coordinates with all joints at 0.
    fn home<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let home = self.robot.home_poses();
        let mut q = Vec::new();
        for (link, pose) in self.robot.links.iter().zip(home) {
            use surefoot_robots::RobotMotion::{
                Continuous, Floating, Prismatic, Revolute, Spherical,
            };
            let is_mujoco = self.convention == Convention::Mujoco;
            let [x, y, z, w] = <[f64; 4]>::from(pose.rotation.coords);
            let turn = if is_mujoco { [w, x, y, z] } else { [x, y, z, w] };
            match link.joint.motion {
                Floating => q.extend(pose.translation.vector.iter().copied().chain(turn)),
                Spherical if is_mujoco => q.extend([1.0, 0.0, 0.0, 0.0]),
                Spherical => q.extend([0.0, 0.0, 0.0, 1.0]),
                Continuous if !is_mujoco => q.extend([1.0, 0.0]),
                Continuous | Revolute | Prismatic => q.push(0.0),
            }
        }
        PyArray1::from_vec(py, q)
    }
}
