//! Scenes.

use crate::run::Run;
use crate::{scalar as precision_of, wrong};
use pyo3::prelude::*;
use std::path::Path;
use surefoot_host::certify::FieldPath;
use surefoot_sim::closed_loop::{bare_controller, controller, run};
use surefoot_sim::scene::{AnyScene, BUILT_IN, Scene as HostScene, SceneError, load, parse};
use toml::{Table, Value};

/// A robot, where it starts, its controller, its ground, and what happens to it.
#[pyclass(frozen, module = "surefoot._surefoot")]
pub struct Scene {
    pub scene: HostScene,
    text: String,
}

impl Scene {
    fn of_text(text: String, name: &str) -> PyResult<Self> {
        match parse(name, &text).map_err(wrong)? {
            AnyScene::Robot(scene) => Ok(Self { scene: *scene, text }),
            AnyScene::Mechanism(scene) => Err(wrong(SceneError::NotARobot { name: scene.name })),
        }
    }
}

#[pymethods]
impl Scene {
    /// A built-in scene by its name, or a file by its path.
    #[new]
    fn new(name: &str) -> PyResult<Self> {
        let scene = load(name).map_err(wrong)?;
        let text = match BUILT_IN.iter().find(|built_in| built_in.name == name) {
            Some(built_in) => built_in.text.to_owned(),
            None => std::fs::read_to_string(Path::new(name)).map_err(wrong)?,
        };
        Ok(Self { scene, text })
    }

    /// A scene from its text; paths of robot files are relative to the working folder.
    #[staticmethod]
    #[pyo3(signature = (text, name = "scene"))]
    fn parse(text: String, name: &str) -> PyResult<Self> {
        Self::of_text(text, name)
    }

    /// The same scene with another value in a field, which is given as JSON.
    fn with_json(&self, path: &str, value: &str) -> PyResult<Self> {
        let value: Value = serde_json::from_str(value).map_err(wrong)?;
        let mut document: Table = self.text.parse().map_err(wrong)?;
        FieldPath::parse(path).and_then(|path| path.set(&mut document, value)).map_err(wrong)?;
        // A robot's file is found again wherever its scene's was.
        let robot = self.scene.robot.as_ref().and_then(|entry| entry.path());
        if let (Some(path), Some(Value::Table(robot))) = (robot, document.get_mut("robot")) {
            robot.insert("file".to_owned(), Value::String(path.display().to_string()));
        }
        Self::of_text(document.to_string(), &self.scene.name)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.scene.name
    }

    #[getter]
    fn description(&self) -> &str {
        &self.scene.description
    }

    #[getter]
    fn duration_s(&self) -> f64 {
        self.scene.duration_s
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// Names of the joints in the order of torques.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.scene.robot().joints.clone()
    }

    /// Runs it under its controller, supervised unless said.
    #[pyo3(signature = (scalar = "f64", supervised = true))]
    fn run(&self, py: Python<'_>, scalar: &str, supervised: bool) -> PyResult<Run> {
        let precision = precision_of(scalar)?;
        let done = py.detach(|| {
            let mut controller = match supervised {
                true => controller(&self.scene, precision),
                false => bare_controller(&self.scene, precision),
            };
            run(&self.scene, controller.as_mut(), &mut |_| {})
        });
        Ok(Run::new(&self.scene, done))
    }
}
