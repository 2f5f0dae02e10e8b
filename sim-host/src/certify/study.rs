//! A study: a scene, what varies in it, and the scene of each sample.

use super::distribution::Distribution;
use super::sequence::{MOST_COORDINATES, Sampling, Stream, generator, point};
use super::vary::{Parameter, Vary, VaryError, length, number};
use crate::stability::loop_limits::fingerprint;
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::path::Path;
use surefoot_sim::scene::{AnyScene, BUILT_IN, Scene, SceneError, nearest_built_in, parse};
use toml::{Table, Value};

/// What decides all samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Definition {
    /// Name of the scene.
    pub scene: String,
    /// Its document; paths of files are absolute.
    pub scene_text: String,
    /// Name of the file that says what varies.
    pub vary: String,
    /// Its text.
    pub vary_text: String,
    /// Seed of all samples.
    pub seed: u64,
    /// How they are drawn.
    pub sampling: Sampling,
}

/// A study, checked.
#[derive(Clone, Debug)]
pub struct Study {
    definition: Definition,
    document: Table,
    vary: Vary,
    coordinates: Vec<Coordinate>,
    base: Box<Scene>,
}

/// A coordinate of the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Name, for people and tables.
    pub name: String,
    /// The number of its parameter.
    pub parameter: usize,
    /// Which of that one's coordinates it is.
    pub which: usize,
}

/// Why there is no study.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// The scene cannot be had.
    #[error("{0}")]
    Scene(#[from] SceneError),
    /// What varies is no field, or not so.
    #[error("{0}")]
    Vary(#[from] VaryError),
    /// A sample's scene is refused.
    #[error("sample {sample}: {message}")]
    Sample {
        /// Its number.
        sample: u64,
        /// Why.
        message: String,
    },
}

/// How near to the ends of the unit interval values are tried: samples lie that far out once in 16 million.
const OUTERMOST: f64 = 6e-8;
/// Where the others are meanwhile: not in the very middle, where what is symmetric is nothing.
const MIDST: f64 = 0.4;

impl Definition {
    /// Of a scene and a file, both by their names as users write them.
    ///
    /// # Errors
    /// [`StudyError`] for what cannot be read.
    pub fn read(
        scene: &str,
        vary: &Path,
        seed: u64,
        sampling: Sampling,
    ) -> Result<Self, StudyError> {
        let text = read(vary)?;
        Self::new(scene, (&vary.display().to_string(), &text), seed, sampling)
    }

    /// The same with the name and the text of what varies.
    ///
    /// # Errors
    /// [`StudyError`] for a scene that cannot be read.
    pub fn new(
        scene: &str,
        (vary, vary_text): (&str, &str),
        seed: u64,
        sampling: Sampling,
    ) -> Result<Self, StudyError> {
        let built_in = BUILT_IN.iter().find(|built_in| built_in.name == scene);
        let path = Path::new(scene);
        let (name, text) = match built_in {
            Some(built_in) => (scene.to_owned(), built_in.text.to_owned()),
            None if !path.is_file() => {
                let nearest = nearest_built_in(scene);
                return Err(SceneError::Unknown { name: scene.to_owned(), nearest }.into());
            }
            None => {
                let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("scene");
                (stem.to_owned(), read(path)?)
            }
        };
        let mut document = table(&name, &text)?;
        absolute(&mut document, path.parent());
        let scene_text = document.to_string();
        let (vary, vary_text) = (vary.to_owned(), vary_text.to_owned());
        Ok(Self { scene: name, scene_text, vary, vary_text, seed, sampling })
    }
}

fn read(path: &Path) -> Result<String, SceneError> {
    std::fs::read_to_string(path).map_err(|error| SceneError::Unreadable {
        path: path.display().to_string(),
        reason: error.to_string(),
    })
}

fn table(name: &str, text: &str) -> Result<Table, SceneError> {
    text.parse::<Table>().map_err(|error| {
        let offset = error.span().map_or(0, |span| span.start).min(text.len());
        let line = 1 + text[..offset].matches('\n').count();
        SceneError::Syntax { name: name.to_owned(), line, message: error.message().to_owned() }
    })
}

/// Makes the path of a robot's file absolute, so that a sample's scene can be run from any folder.
fn absolute(document: &mut Table, folder: Option<&Path>) {
    let robot = document.get_mut("robot").and_then(Value::as_table_mut);
    if let Some(Value::String(file)) = robot.and_then(|robot| robot.get_mut("file")) {
        let path = folder.unwrap_or(Path::new("")).join(&*file);
        // What is not there is refused, with its name, when the scene is read.
        let path = std::fs::canonicalize(&path).unwrap_or(path);
        *file = path.display().to_string();
    }
}

impl Study {
    /// Checks that the scene is one of a robot, that what varies are fields of it, and that they may have the values at
    /// the ends of their ranges, one after the other with the others near their middle.
    ///
    /// # Errors
    /// A [`StudyError`].
    pub fn new(definition: Definition) -> Result<Self, StudyError> {
        let Definition { scene, scene_text, vary: file, vary_text, .. } = &definition;
        let base = match parse(scene, scene_text)? {
            AnyScene::Robot(scene) => scene,
            AnyScene::Mechanism(scene) => {
                return Err(SceneError::NotARobot { name: scene.name }.into());
            }
        };
        let vary = Vary::parse(file, vary_text, &table(scene, scene_text)?)?;
        let mut coordinates = Vec::new();
        for (parameter, varied) in vary.parameters.iter().enumerate() {
            for (which, suffix) in varied.distribution.coordinates().iter().enumerate() {
                let space = if suffix.is_empty() { "" } else { " " };
                let name = format!("{}{space}{suffix}", varied.name);
                coordinates.push(Coordinate { name, parameter, which });
            }
        }
        let mut study = Self { document: vary.scene.clone(), vary, coordinates, base, definition };
        let of_all = study.scene_of(&study.document);
        *study.base = of_all.map_err(|message| study.refused(format!("scene: {message}")))?;
        study.check()?;
        Ok(study)
    }

    fn refused(&self, message: String) -> VaryError {
        VaryError { file: self.definition.vary.clone(), line: None, message }
    }

    fn check(&self) -> Result<(), VaryError> {
        let refuse = |message| self.refused(message);
        if self.coordinates.is_empty() || self.coordinates.len() > MOST_COORDINATES {
            let count = self.coordinates.len();
            let expected = format!("expected 1 to {MOST_COORDINATES}, seeds not counted");
            return Err(refuse(format!("{count} coordinates vary: {expected}")));
        }
        for (number, parameter) in self.vary.parameters.iter().enumerate() {
            let law = &parameter.distribution;
            let places: Vec<f64> = match law {
                Distribution::Set(values) => {
                    let count = values.len() as f64;
                    (0..values.len()).map(|k| (k as f64 + 0.5) / count).collect()
                }
                _ => vec![OUTERMOST, MIDST, 1.0 - OUTERMOST],
            };
            for place in places {
                let at = |c: &Coordinate| if c.parameter == number { place } else { MIDST };
                let point: Vec<f64> = self.coordinates.iter().map(at).collect();
                if let Err(StudyError::Sample { message, .. }) = self.scene(0, &point) {
                    let u = vec![place; law.coordinates().len()];
                    let value = match law {
                        Distribution::Seed => "any seed".to_owned(),
                        _ => shown(&law.value(&u, 1.0)),
                    };
                    let name = &parameter.name;
                    return Err(refuse(format!("vary.\"{name}\", at {value}: {message}")));
                }
            }
        }
        Ok(())
    }

    /// What decides it.
    pub fn definition(&self) -> &Definition {
        &self.definition
    }

    /// What varies.
    pub fn vary(&self) -> &Vary {
        &self.vary
    }

    /// Its coordinates, seeds not counted.
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// The scene with nothing varied.
    pub fn base(&self) -> &Scene {
        &self.base
    }

    /// Where a sample is in the unit cube.
    pub fn point(&self, sample: u64) -> Vec<f64> {
        let Definition { sampling, seed, .. } = self.definition;
        point(sampling, seed, sample, self.coordinates.len())
    }

    /// The numbers of the coordinates at a place in the unit cube, for people and tables.
    pub fn numbers(&self, point: &[f64]) -> Vec<f64> {
        let number = |(coordinate, u): (&Coordinate, &f64)| {
            self.parameter(coordinate).distribution.number(coordinate.which, *u)
        };
        self.coordinates.iter().zip(point).map(number).collect()
    }

    /// The parameter of a coordinate.
    pub fn parameter(&self, coordinate: &Coordinate) -> &Parameter {
        &self.vary.parameters[coordinate.parameter]
    }

    /// The document of a sample's scene: the text that is run, and that replays it.
    ///
    /// # Errors
    /// [`StudyError::Sample`].
    pub fn text(&self, sample: u64, point: &[f64]) -> Result<String, StudyError> {
        let mut document = self.document.clone();
        let mut rest = point;
        for (number, parameter) in self.vary.parameters.iter().enumerate() {
            let (own, others) = rest.split_at(parameter.distribution.coordinates().len());
            rest = others;
            let stream = Stream::Seed(number as u64);
            // Fits a whole number of 32 bits, whatever reads it.
            let seed =
                i64::from(generator(self.definition.seed, sample, stream).random::<u32>() >> 1);
            set(&mut document, parameter, own, seed)
                .map_err(|message| StudyError::Sample { sample, message })?;
        }
        Ok(document.to_string())
    }

    /// A sample's scene.
    ///
    /// # Errors
    /// [`StudyError::Sample`].
    pub fn scene(&self, sample: u64, point: &[f64]) -> Result<Scene, StudyError> {
        let text = self.text(sample, point)?;
        let document = table(&self.definition.scene, &text)?;
        self.scene_of(&document).map_err(|message| StudyError::Sample { sample, message })
    }

    fn scene_of(&self, document: &Table) -> Result<Scene, String> {
        match parse(&self.definition.scene, &document.to_string()) {
            Ok(AnyScene::Robot(scene)) => Ok(*scene),
            Ok(AnyScene::Mechanism(_)) => Err("no scene of a robot any more".to_owned()),
            // Lines are of a text that nobody has seen.
            Err(SceneError::Syntax { message, .. }) => Err(message),
            Err(SceneError::Value { field, value, expected, .. }) => {
                Err(format!("{field} = {value}: expected {expected}"))
            }
            Err(other) => Err(other.to_string()),
        }
    }

    /// Digits that tell the samples of this study from those of others.
    pub fn fingerprint(&self) -> String {
        let Definition { scene_text, vary_text, seed, sampling, .. } = &self.definition;
        let seed = format!("{seed} {sampling:?}");
        fingerprint(&[scene_text.as_bytes(), b"\0", vary_text.as_bytes(), b"\0", seed.as_bytes()])
    }
}

/// Puts a parameter's value into a document.
fn set(document: &mut Table, parameter: &Parameter, u: &[f64], seed: i64) -> Result<(), String> {
    let law = &parameter.distribution;
    for path in &parameter.fields {
        let own = path.get(document);
        let value = match law {
            Distribution::Seed => Value::Integer(seed),
            _ => law.value(u, own.and_then(length).unwrap_or(1.0)),
        };
        let value = match (parameter.is_factor, own, number(&value)) {
            (true, Some(own), Some(factor)) => scaled(own, factor),
            _ => value,
        };
        path.set(document, value).map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn scaled(own: &Value, factor: f64) -> Value {
    match own {
        Value::Array(items) => Value::Array(items.iter().map(|own| scaled(own, factor)).collect()),
        own => number(own).map_or_else(|| own.clone(), |own| Value::Float(own * factor)),
    }
}

/// A value as a file has it, in short.
fn shown(value: &Value) -> String {
    match value {
        Value::Float(x) => format!("{x:.6}"),
        other => other.to_string(),
    }
}
