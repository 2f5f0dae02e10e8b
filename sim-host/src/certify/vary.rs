//! The file that says what varies, and how.
//!
//! ```toml
//! require = "upright"                    # or "settled": at the set point at the end
//!
//! [scene]                                # fields that are otherwise than in the scene, but do not vary
//! "duration_s" = 2.0
//!
//! [vary."block.mass_kg"]                 # any field of the scene, by its path
//! uniform = [1.0, 3.0]
//!
//! [vary.friction]                        # several fields that have the same value
//! fields = ["feet.floor.static_friction", "feet.floor.dynamic_friction"]
//! normal = [0.3, 0.05]
//! within = [0.1, 0.6]
//! ```

use super::distribution::Distribution;
use super::path::{FieldPath, PathError};
use serde::{Deserialize, Serialize};
use toml::de::{DeTable, DeValue, ValueDeserializer};
use toml::{Table, Value};

/// What varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// What a run must do so as not to fail.
    pub require: Require,
    /// The scene's document with what is otherwise in all samples.
    pub scene: Table,
    /// What varies, in the order of the names.
    pub parameters: Vec<Parameter>,
}

/// What a run must do so as not to fail.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Require {
    /// Not to fall, and not to be stopped.
    #[default]
    Upright,
    /// To be at the set point at the end, too.
    Settled,
}

/// One thing that varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name: the path of its field, unless it has several.
    pub name: String,
    /// Where its value goes.
    pub fields: Vec<FieldPath>,
    /// Whether the scene's own values are multiplied by it.
    pub is_factor: bool,
    /// How it is distributed.
    pub distribution: Distribution,
}

/// Why a file does not say what varies.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}: {message}", line.map_or_else(String::new, |line| format!(":{line}")))]
pub struct VaryError {
    /// The file.
    pub file: String,
    /// In the file, from 1.
    pub line: Option<usize>,
    /// What was found, and what was expected.
    pub message: String,
}

/// An entry as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    #[serde(default, deserialize_with = "two")]
    uniform: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "two")]
    log_uniform: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "two")]
    normal: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "two")]
    integers: Option<[i64; 2]>,
    set: Option<Vec<Value>>,
    direction: Option<Directions>,
    #[serde(default, deserialize_with = "two")]
    time: Option<[f64; 2]>,
    seed: Option<bool>,
    #[serde(default, deserialize_with = "two")]
    within: Option<[f64; 2]>,
    #[serde(default, deserialize_with = "two")]
    length: Option<[f64; 2]>,
    #[serde(default)]
    factor: bool,
    fields: Option<Vec<String>>,
}

/// Two numbers. An array of serde's takes the first two of any list.
fn two<'de, T, D>(list: D) -> Result<Option<[T; 2]>, D::Error>
where
    T: Deserialize<'de>,
    D: serde::Deserializer<'de>,
{
    let numbers = Vec::<T>::deserialize(list)?;
    let found = numbers.len();
    let expected = || serde::de::Error::custom(format_args!("{found} numbers; expected two"));
    <[T; 2]>::try_from(numbers).map(Some).map_err(|_| expected())
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Directions {
    Any,
    Horizontal,
}

const KINDS: &str =
    "one of `uniform`, `log_uniform`, `normal`, `integers`, `set`, `direction`, `time` and `seed`";

impl Vary {
    /// Reads the text of a file, for the document of a scene.
    ///
    /// # Errors
    /// A [`VaryError`]: with the line and what was expected.
    pub fn parse(file: &str, text: &str, scene: &Table) -> Result<Self, VaryError> {
        let at = |offset: Option<usize>, message: String| VaryError {
            file: file.to_owned(),
            line: offset.map(|offset| 1 + text[..offset.min(text.len())].matches('\n').count()),
            message,
        };
        let document = DeTable::parse(text)
            .map_err(|error| at(error.span().map(|s| s.start), error.message().to_owned()))?;
        let mut require = Require::default();
        let mut scene = scene.clone();
        if let Some((key, value)) = document.get_ref().get_key_value("scene") {
            let wrong = |message| at(Some(key.span().start), format!("scene: {message}"));
            let fixed = Table::deserialize(ValueDeserializer::from(value.clone()))
                .map_err(|error| wrong(error.message().to_owned()))?;
            for (path, value) in fixed {
                let path = FieldPath::parse(&path);
                path.and_then(|path| path.set(&mut scene, value))
                    .map_err(|error| wrong(error.to_string()))?;
            }
        }
        let mut parameters = Vec::new();
        for (key, value) in document.get_ref() {
            let start = Some(key.span().start);
            let deserializer = ValueDeserializer::from(value.clone());
            match (key.get_ref().as_ref(), value.get_ref()) {
                ("require", _) => {
                    require = Require::deserialize(deserializer)
                        .map_err(|error| at(start, format!("require: {}", error.message())))?;
                }
                ("scene", DeValue::Table(_)) => {}
                ("vary", DeValue::Table(entries)) => {
                    for (name, entry) in entries {
                        let start = Some(name.span().start);
                        let name = name.get_ref().as_ref();
                        let wrong =
                            |message: String| at(start, format!("vary.\"{name}\": {message}"));
                        let entry = Entry::deserialize(ValueDeserializer::from(entry.clone()))
                            .map_err(|error| wrong(error.message().to_owned()))?;
                        parameters.push(entry.parameter(name, &scene).map_err(wrong)?);
                    }
                }
                (other, _) => {
                    let expected = "expected `require`, [scene] and tables [vary.\"FIELD\"]";
                    return Err(at(start, format!("{other}: {expected}")));
                }
            }
        }
        if parameters.is_empty() {
            return Err(at(None, "nothing varies: expected tables [vary.\"FIELD\"]".to_owned()));
        }
        let taken = |k: usize, path: &FieldPath| {
            parameters[..k].iter().any(|other: &Parameter| other.fields.contains(path))
        };
        for (k, parameter) in parameters.iter().enumerate() {
            if let Some(path) = parameter.fields.iter().find(|path| taken(k, path)) {
                return Err(at(None, format!("{path}: varied twice; expected each field once")));
            }
        }
        Ok(Self { require, scene, parameters })
    }
}

impl Entry {
    fn parameter(self, name: &str, scene: &Table) -> Result<Parameter, String> {
        let is_factor = self.factor;
        let texts = self.fields.clone().unwrap_or_else(|| vec![name.to_owned()]);
        if texts.is_empty() {
            return Err("fields = []: expected at least one path".to_owned());
        }
        let paths = texts.iter().map(|text| FieldPath::parse(text));
        let fields =
            paths.collect::<Result<Vec<_>, PathError>>().map_err(|error| error.to_string())?;
        let distribution = self.distribution(scene)?;
        for path in &fields {
            let own = path.get(scene);
            if is_factor && !own.is_some_and(is_number) {
                let expected = "expected a number or a list of numbers that the scene file has";
                return Err(format!("factor of {path}: {expected}"));
            }
            if matches!(distribution, Distribution::Direction { length: None, .. })
                && own.and_then(length).is_none()
            {
                let expected = "expected `length`, or a vector that the scene file has";
                return Err(format!("direction of {path}: {expected}"));
            }
        }
        Ok(Parameter { name: name.to_owned(), fields, is_factor, distribution })
    }

    fn distribution(self, scene: &Table) -> Result<Distribution, String> {
        let range = |what: &str, [low, high]: [f64; 2]| match low < high && (high - low).is_finite()
        {
            true => Ok([low, high]),
            false => Err(format!(
                "{what} = [{low}, {high}]: expected a smaller number, then a larger one"
            )),
        };
        let mut said = Vec::new();
        if let Some(r) = self.uniform {
            said.push(Distribution::Uniform(range("uniform", r)?));
        }
        if let Some(r) = self.time {
            let [from, to] = range("time", r)?;
            let end = scene.get("duration_s").and_then(number).unwrap_or(f64::INFINITY);
            if !(from >= 0.0 && to <= end) {
                return Err(format!(
                    "time = [{from}, {to}]: expected times within the scene's {end} s"
                ));
            }
            said.push(Distribution::Uniform([from, to]));
        }
        if let Some(r) = self.log_uniform {
            let [low, high] = range("log_uniform", r)?;
            if !(low > 0.0) {
                return Err(format!("log_uniform = [{low}, {high}]: expected numbers above 0"));
            }
            said.push(Distribution::LogUniform([low, high]));
        }
        if let Some([mean, deviation]) = self.normal {
            if !(deviation > 0.0 && deviation.is_finite() && mean.is_finite()) {
                let expected = "expected a mean, then a standard deviation above 0";
                return Err(format!("normal = [{mean}, {deviation}]: {expected}"));
            }
            let within = self.within.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let nearest = mean.clamp(within[0].min(within[1]), within[1].max(within[0]));
            if !(within[0] < within[1]) || (nearest - mean).abs() > 6.0 * deviation {
                let [low, high] = within;
                let expected = "expected a range within six deviations of the mean";
                return Err(format!("within = [{low}, {high}]: {expected}"));
            }
            said.push(Distribution::Normal { mean, deviation, within });
        }
        if let Some([low, high]) = self.integers {
            if !(low < high && high.checked_sub(low).is_some_and(|count| count < 1 << 53)) {
                let expected = "expected a smaller number, then a larger one";
                return Err(format!("integers = [{low}, {high}]: {expected}"));
            }
            said.push(Distribution::Integers([low, high]));
        }
        if let Some(values) = self.set {
            if values.len() < 2 {
                return Err(format!("set of {}: expected two values or more", values.len()));
            }
            said.push(Distribution::Set(values));
        }
        if let Some(directions) = self.direction {
            let length = self.length;
            if let Some([low, high]) = length.filter(|[low, high]| !(*low >= 0.0 && low < high)) {
                let expected = "expected a smaller number, 0 or more, then a larger one";
                return Err(format!("length = [{low}, {high}]: {expected}"));
            }
            let horizontal = directions == Directions::Horizontal;
            said.push(Distribution::Direction { horizontal, length });
        }
        match self.seed {
            Some(true) => said.push(Distribution::Seed),
            Some(false) => return Err("seed = false: expected true".to_owned()),
            None => {}
        }
        let count = said.len();
        let only = said.pop().filter(|_| count == 1);
        let law = only.ok_or_else(|| format!("{count} distributions: expected {KINDS}"))?;
        let idle = [
            ("within", self.within.is_some() && !matches!(law, Distribution::Normal { .. })),
            ("length", self.length.is_some() && !matches!(law, Distribution::Direction { .. })),
            (
                "factor",
                self.factor
                    && matches!(
                        law.value(&[0.5; 3], 1.0),
                        Value::Array(_) | Value::String(_) | Value::Boolean(_)
                    ),
            ),
            ("factor", self.factor && matches!(law, Distribution::Seed | Distribution::Set(_))),
        ];
        match idle.iter().find(|(_, is_idle)| *is_idle) {
            Some((what, _)) => Err(format!("{what}: without effect here; expected none")),
            None => Ok(law),
        }
    }
}

/// The number of a value, whole or not.
pub(super) fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

fn is_number(value: &Value) -> bool {
    match value {
        Value::Array(items) => !items.is_empty() && items.iter().all(|item| number(item).is_some()),
        other => number(other).is_some(),
    }
}

/// Length of a vector of three numbers.
pub(super) fn length(value: &Value) -> Option<f64> {
    let items: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
    let items = items.filter(|items| items.len() == 3)?;
    Some(items.iter().map(|x| x * x).sum::<f64>().sqrt())
}
