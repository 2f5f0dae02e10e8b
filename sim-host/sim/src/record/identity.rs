//! What decides a motion, so that one that was saved is not taken up by another scene.

use crate::mechanism::ChosenModel;
use crate::scene::{MechanismScene, Scene};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A scene's content, as far as it decides the motion: not its name, nor how long it is played.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct MotionIdentity(Map<String, Value>);

/// Fields that decide nothing: those for people, the time to be played, and what the method and the model, which do
/// count, were chosen for.
const IDLE: [&str; 3] = ["description", "duration_s", "matters"];
/// Tables that name their kind: what is in them is one table further down.
const TAGGED: [&str; 3] = ["mechanism", "joint", "feet"];

impl MotionIdentity {
    /// Of a robot's scene.
    pub fn of_robot(scene: &Scene) -> Self {
        Self::of(scene).with("model", scene.rung().model.to_string())
    }

    /// Of a mechanism's scene, played with a model if there are several.
    pub fn of_mechanism(scene: &MechanismScene, model: Option<&ChosenModel>) -> Self {
        Self::of(scene)
            .with("model", model.map_or("its only one".to_owned(), |m| m.model.to_string()))
    }

    fn of(scene: &impl Serialize) -> Self {
        // Scenes are tables with text keys, and nothing else fails.
        let mut fields = match serde_json::to_value(scene) {
            Ok(Value::Object(fields)) => fields,
            _ => Map::new(),
        };
        fields.retain(|key, _| !IDLE.contains(&key.as_str()));
        Self(fields)
    }

    /// With something else that decides the motion.
    fn with(mut self, what: &str, value: String) -> Self {
        self.0.insert(what.to_owned(), Value::String(value));
        self
    }

    /// The first field in which another one differs, with this value and the other's.
    pub fn difference(&self, other: &Self) -> Option<String> {
        if self == other {
            return None;
        }
        let (a, b) = (Value::Object(self.0.clone()), Value::Object(other.0.clone()));
        difference("", &a, &b)
    }
}

fn difference(path: &str, a: &Value, b: &Value) -> Option<String> {
    match (a, b) {
        (Value::Object(a), Value::Object(b)) => {
            let nothing = Value::Null;
            let mut keys: Vec<&String> = a.keys().chain(b.keys()).collect();
            keys.dedup();
            let key = path.rsplit(['.', ']']).next().unwrap_or_default();
            let is_kind = TAGGED.contains(&key) && a.len() == 1 && a.keys().eq(b.keys());
            keys.into_iter().find_map(|key| {
                let below = match (path, is_kind) {
                    ("", _) => key.clone(),
                    (_, true) => path.to_owned(),
                    (_, false) => format!("{path}.{key}"),
                };
                let (a, b) = (a.get(key).unwrap_or(&nothing), b.get(key).unwrap_or(&nothing));
                difference(&below, a, b)
            })
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            let mut pairs = a.iter().zip(b).enumerate();
            pairs.find_map(|(k, (a, b))| difference(&format!("{path}[{k}]"), a, b))
        }
        _ => (a != b).then(|| format!("{path} = {}, not {}", shown(a), shown(b))),
    }
}

/// A value on a line: tables and lists by what they are.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "none".to_owned(),
        Value::Array(items) => format!("{} entries", items.len()),
        Value::Object(fields) => {
            format!("a table of {}", fields.keys().cloned().collect::<Vec<_>>().join(", "))
        }
        plain => plain.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{AnyScene, open};

    #[test]
    fn what_decides_the_motion_differs_and_nothing_else() {
        let AnyScene::Robot(scene) = open("experiment-2").expect("built in") else {
            unreachable!()
        };
        let identity = MotionIdentity::of_robot(&scene);
        let mut other = scene.clone();
        other.name = "another".into();
        other.description = "the same".into();
        other.duration_s = 17.0;
        assert_eq!(identity.difference(&MotionIdentity::of_robot(&other)), None);
        other.controller.position_gain[2] = 1.0;
        let text = identity.difference(&MotionIdentity::of_robot(&other)).expect("another gain");
        assert_eq!(text, "controller.position_gain[2] = 200.0, not 1.0");
        let AnyScene::Mechanism(mut scene) = open("four-bar").expect("built in") else {
            unreachable!()
        };
        let identity = MotionIdentity::of_mechanism(&scene, None);
        scene.integrator.step_s = 0.5e-3;
        let text =
            identity.difference(&MotionIdentity::of_mechanism(&scene, None)).expect("a step");
        assert_eq!(text, "integrator.step_s = 0.001, not 0.0005");
    }
}
