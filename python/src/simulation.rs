//! A scene step by step.

use crate::{scalar as precision_of, wrong};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use surefoot_multibody::contact::ContactState;
use surefoot_sim::closed_loop::{Controller, controller, plant};
use surefoot_sim::plant::{PerPoint, Plant, PlantState};
use surefoot_sim::scene::Scene as HostScene;

/// A plant and its controller, which act when they are told to. Sensors and motors are ideal.
#[pyclass(unsendable, module = "surefoot._surefoot")]
pub struct Simulation {
    scene: HostScene,
    plant: Box<dyn Plant>,
    controller: Box<dyn Controller>,
    state: PlantState,
    steps_per_tick: u64,
    made: u64,
}

impl Simulation {
    fn time(&self) -> f64 {
        self.made as f64 * self.scene.integrator.step_s
    }
}

#[pymethods]
impl Simulation {
    /// At the scene's start.
    #[new]
    #[pyo3(signature = (scene, scalar = "f64"))]
    fn new(scene: &crate::scene::Scene, scalar: &str) -> PyResult<Self> {
        let scene = scene.scene.clone();
        let controller = controller(&scene, precision_of(scalar)?);
        let mut plant = plant(&scene).map_err(wrong)?;
        let state = plant.state().map_err(wrong)?;
        let steps = 1.0 / (scene.controller.rate_hz * scene.integrator.step_s);
        // The scene's check has made sure that this is a whole number, at least 1.
        let steps_per_tick = steps.round() as u64;
        Ok(Self { scene, plant, controller, state, steps_per_tick, made: 0 })
    }

    /// s
    #[getter]
    fn time_s(&self) -> f64 {
        self.time()
    }

    /// Position (m) and quaternion (scalar first) of the central body, joint angles (rad).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.state.positions)
    }

    /// Body twist of the central body (m/s, rad/s), joint rates (rad/s).
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.state.velocities)
    }

    /// Vertical forces of the ground on the feet, N.
    #[getter]
    fn foot_forces<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let seen = self.plant.observe().map_err(wrong)?;
        Ok(PyArray1::from_vec(py, seen.foot_forces))
    }

    /// The controller's torques for the present state, N·m: one tick, which counts for its supervisor.
    fn tick<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let time = self.time();
        let mut contacts = PerPoint::new();
        if self.made > 0 && self.plant.read_contacts(&mut contacts) {
            let touches = |foot: &Vec<ContactState>| foot.iter().any(|s| *s != ContactState::Free);
            let feet: Vec<bool> = contacts.iter().map(touches).collect();
            self.controller.touch(time, &feet);
        }
        let seen = self.plant.observe().map_err(wrong)?;
        self.controller.press(time, &seen.foot_forces);
        let command = self.controller.tick(&self.state).map_err(wrong)?;
        Ok(PyArray1::from_vec(py, command.torques))
    }

    /// Advances by one period of the controller under torques (N·m, one a joint), and the scene's pushes.
    fn step(&mut self, torques: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let torques = torques.as_slice().map_err(wrong)?;
        let joints = self.state.joints();
        if torques.len() != joints || torques.iter().any(|torque| !torque.is_finite()) {
            let found = torques.len();
            return Err(wrong(format!("{found} torques; expected {joints} finite numbers")));
        }
        let step = self.scene.integrator.step_s;
        for _ in 0..self.steps_per_tick {
            let (from, to) = (self.time(), (self.made + 1) as f64 * step);
            self.plant.step(step, torques, self.scene.push(from, to)).map_err(wrong)?;
            self.made += 1;
        }
        self.plant.read_state(&mut self.state).map_err(wrong)
    }
}
