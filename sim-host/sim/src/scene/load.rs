//! From a name or a file to a scene, with errors that say what, where and what was expected.

use super::builtin::BUILT_IN;
use super::check::check;
use super::robot_entry::resolve;
use super::source::Source;
use super::{Feet, Initial, LegsStart, MechanismScene, Scene};
use crate::plant::PlantState;
use nalgebra::Vector3;
use serde::de::DeserializeOwned;
use std::path::Path;
use surefoot::spatial::Quaternion;
use toml::de::Deserializer;

/// Why there is no scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// No built-in scene and no file has this name.
    #[error("no scene is called '{name}', and there is no such file{}", advice(.nearest))]
    Unknown {
        /// The name asked for.
        name: String,
        /// The built-in scene whose name is nearest.
        nearest: Option<&'static str>,
    },
    /// The file cannot be read.
    #[error("{path}: {reason}")]
    Unreadable {
        /// The file.
        path: String,
        /// The system's reason.
        reason: String,
    },
    /// The file is not a scene.
    #[error("{name}:{line}: {message}")]
    Syntax {
        /// The file, or the scene's name.
        name: String,
        /// In the file, from 1.
        line: usize,
        /// The field, what was found and what was expected.
        message: String,
    },
    /// The scene is of the other kind.
    #[error("{name}: a mechanism without a controller; expected a robot")]
    NotARobot {
        /// The scene.
        name: String,
    },
    /// A value makes no sense.
    #[error("{name}{}: {field}{}: expected {expected}", at_line(.line), assigned(.value))]
    Value {
        /// The file, or the scene's name.
        name: String,
        /// In the file, from 1, if the value is one of a file.
        line: Option<usize>,
        /// Path of the field in the file.
        field: String,
        /// What it holds; empty for what is left out, and for tables.
        value: String,
        /// What would be right.
        expected: String,
    },
}

fn advice(nearest: &Option<&'static str>) -> String {
    match nearest {
        Some(name) => format!(" (did you mean '{name}'? `surefoot list` shows all)"),
        None => " (`surefoot list` shows all)".to_owned(),
    }
}

fn at_line(line: &Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!(":{line}"))
}

fn assigned(value: &str) -> String {
    if value.is_empty() { String::new() } else { format!(" = {value}") }
}

/// A scene of either kind.
#[expect(clippy::large_enum_variant, reason = "a program holds one or a dozen of them")]
#[derive(Clone, Debug, PartialEq)]
pub enum AnyScene {
    /// A robot under its controller.
    Robot(Box<Scene>),
    /// A mechanism that nobody controls.
    Mechanism(MechanismScene),
}

impl AnyScene {
    /// The scene's name and its line for people.
    pub fn names(&self) -> (&str, &str) {
        match self {
            Self::Robot(scene) => (&scene.name, &scene.description),
            Self::Mechanism(scene) => (&scene.name, &scene.description),
        }
    }
}

/// The built-in scene with the most similar name, if one is similar.
pub fn nearest_built_in(name: &str) -> Option<&'static str> {
    let distance = |to: &'static str| (strsim::damerau_levenshtein(name, to), to);
    let all = BUILT_IN.iter().map(|scene| distance(scene.name));
    all.filter(|(distance, _)| *distance <= 5).min().map(|(_, name)| name)
}

/// A built-in scene by its name, or a scene file by its path.
///
/// # Errors
/// A [`SceneError`].
pub fn open(name: &str) -> Result<AnyScene, SceneError> {
    if let Some(scene) = BUILT_IN.iter().find(|scene| scene.name == name) {
        return parse(name, scene.text);
    }
    let path = Path::new(name);
    if !path.is_file() {
        let nearest = nearest_built_in(name);
        return Err(SceneError::Unknown { name: name.to_owned(), nearest });
    }
    let text = std::fs::read_to_string(path).map_err(|error| SceneError::Unreadable {
        path: name.to_owned(),
        reason: error.to_string(),
    })?;
    let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("scene");
    parse_at(name, stem, &text, path.parent())
}

/// The same, of a robot.
///
/// # Errors
/// A [`SceneError`], also for a scene of the other kind.
pub fn load(name: &str) -> Result<Scene, SceneError> {
    match open(name)? {
        AnyScene::Robot(scene) => Ok(*scene),
        AnyScene::Mechanism(scene) => Err(SceneError::NotARobot { name: scene.name }),
    }
}

/// A scene from its text, checked. One with a table `mechanism` is a mechanism's.
///
/// # Errors
/// [`SceneError::Syntax`] or [`SceneError::Value`], with the line.
pub fn parse(name: &str, text: &str) -> Result<AnyScene, SceneError> {
    parse_at(name, name, text, None)
}

/// The same of the text at a place that messages name; robot files are found from its folder.
fn parse_at(
    place: &str,
    name: &str,
    text: &str,
    folder: Option<&Path>,
) -> Result<AnyScene, SceneError> {
    let source = Source::parse(place, text)?;
    source.check_numbers()?;
    let scene = if source.has("mechanism") {
        let mut scene: MechanismScene = deserialized(&source)?;
        name.clone_into(&mut scene.name);
        scene.is_unadvised = !source.has("integrator");
        scene.check().map(|()| AnyScene::Mechanism(scene))
    } else {
        let mut scene: Scene = deserialized(&source)?;
        name.clone_into(&mut scene.name);
        said(&source, &scene)?;
        resolve(&mut scene, folder, source.has("set_point"))
            .and_then(|()| check(&scene))
            .map(|()| AnyScene::Robot(Box::new(scene)))
    };
    scene.map_err(|error| source.locate(error))
}

/// What only the biped's scenes must have.
fn said(source: &Source<'_>, scene: &Scene) -> Result<(), SceneError> {
    if scene.robot.is_none() && !source.has("set_point") {
        return Err(source.missing("", "set_point"));
    }
    if scene.robot.is_none() && matches!(scene.feet, Feet::Floor { outline: None, .. }) {
        return Err(source.missing("feet", "outline"));
    }
    Ok(())
}

fn deserialized<T: DeserializeOwned>(source: &Source<'_>) -> Result<T, SceneError> {
    T::deserialize(Deserializer::from(source.document())).map_err(|error| source.syntax(&error))
}

impl Scene {
    /// Checks the scene again, after a field was changed.
    ///
    /// # Errors
    /// [`SceneError::Value`].
    pub fn check(&self) -> Result<(), SceneError> {
        check(self)
    }
}

impl Initial {
    /// The robot's state at the start.
    pub fn state(&self) -> PlantState {
        match self {
            Self::Legs(start) => start.state(),
            Self::Joints(start) => start.state.clone(),
        }
    }

    /// Of the biped, leg by leg.
    pub fn legs(&self) -> Option<&LegsStart> {
        match self {
            Self::Legs(start) => Some(start),
            Self::Joints(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn legs_mut(&mut self) -> Option<&mut LegsStart> {
        match self {
            Self::Legs(start) => Some(start),
            Self::Joints(_) => None,
        }
    }
}

impl LegsStart {
    /// The biped's state at the start.
    fn state(&self) -> PlantState {
        let axis = Vector3::from(self.turn_axis).normalize();
        let q = Quaternion::from_axis_angle(axis, self.turn_deg.to_radians());
        let angles: Vec<f64> = self.left_leg_deg.into_iter().chain(self.right_leg_deg).collect();
        let mut state = PlantState::home(angles.len());
        let positions = &mut state.positions;
        positions[..3].copy_from_slice(&self.position_m);
        positions[3..7].copy_from_slice(&q.to_array());
        for (to, degrees) in positions[7..].iter_mut().zip(angles) {
            *to = degrees.to_radians();
        }
        state
    }
}
