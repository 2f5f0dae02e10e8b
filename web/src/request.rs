//! What a page asks for: a built-in scene, with some of its numbers changed.

use serde::Deserialize;
use surefoot_sim::scene::{AnyScene, BUILT_IN, Scene, parse};
use toml::{Table, Value};

/// A scene of a robot, and what is changed in it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// Name of a built-in scene.
    pub scene: String,
    /// Friction of the floor; the scene's where it is not said, as all that follows.
    #[serde(default)]
    pub friction: Option<f64>,
    /// Mass that is added to the first body of the plant, and of which the controller does not know, kg.
    #[serde(default)]
    pub load_kg: Option<f64>,
    /// Factor of the gains of positions; those of velocities have its square root.
    #[serde(default)]
    pub gain: Option<f64>,
    /// Ticks a second.
    #[serde(default)]
    pub rate_hz: Option<f64>,
    /// Speed ahead of the first command to walk, m/s; it is then the only one.
    #[serde(default)]
    pub speed_mps: Option<f64>,
}

impl Request {
    /// From JSON.
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn read(json: &[u8]) -> Result<Self, String> {
        serde_json::from_slice(json).map_err(|error| format!("request: {error}"))
    }

    /// The scene that it asks for.
    ///
    /// # Errors
    /// What a scene file with these numbers would be refused for.
    pub fn scene(&self) -> Result<Scene, String> {
        let named = BUILT_IN.iter().find(|built_in| built_in.name == self.scene);
        let text = named.ok_or_else(|| format!("there is no built-in scene {}", self.scene))?.text;
        let mut table: Table = text.parse().map_err(|error| format!("{}: {error}", self.scene))?;
        let first_body = match open(&self.scene, text)? {
            scene if self.load_kg.is_some() => scene.robot().bodies.first().cloned(),
            _ => None,
        };
        if let Some(friction) = self.friction {
            let floor = ["feet", "floor"];
            *at(&mut table, &floor, "static_friction")? = friction.into();
            *at(&mut table, &floor, "dynamic_friction")? = friction.into();
        }
        if let Some(rate) = self.rate_hz {
            *at(&mut table, &["controller"], "rate_hz")? = rate.into();
        }
        if let Some(gain) = self.gain {
            for (name, factor) in [
                ("position_gain", gain),
                ("orientation_gain", gain),
                ("velocity_gain", gain.sqrt()),
                ("angular_velocity_gain", gain.sqrt()),
            ] {
                let all = at(&mut table, &["controller"], name)?.as_array_mut();
                for one in all.into_iter().flatten() {
                    *one = (factor * one.as_float().unwrap_or_default()).into();
                }
            }
        }
        if let (Some(load), Some(body)) = (self.load_kg.filter(|load| *load != 0.0), first_body) {
            *at(&mut table, &["plant", "bodies", &body], "added_mass_kg")? = load.into();
        }
        if let Some(speed) = self.speed_mps {
            let commands = table.get_mut("walk").and_then(Value::as_array_mut);
            let commands = commands.ok_or_else(|| format!("{} does not walk", self.scene))?;
            commands.truncate(1);
            for command in commands.iter_mut().filter_map(Value::as_table_mut) {
                command.insert("forward_mps".to_owned(), speed.into());
            }
        }
        open(&self.scene, &table.to_string())
    }
}

fn open(name: &str, text: &str) -> Result<Scene, String> {
    match parse(name, text).map_err(|error| error.to_string())? {
        AnyScene::Robot(scene) => Ok(*scene),
        AnyScene::Mechanism(_) => Err(format!("{name} has no robot")),
    }
}

/// The value of a key in nested tables, which are made where they lack.
fn at<'a>(mut table: &'a mut Table, path: &[&str], key: &str) -> Result<&'a mut Value, String> {
    for name in path {
        let inner = table.entry(*name).or_insert_with(|| Table::new().into());
        table = inner.as_table_mut().ok_or_else(|| format!("{name} is no table"))?;
    }
    Ok(table.entry(key).or_insert_with(|| 0.0.into()))
}

#[cfg(test)]
mod tests {
    use super::Request;

    fn scene(json: &str) -> Result<surefoot_sim::scene::Scene, String> {
        Request::read(json.as_bytes())?.scene()
    }

    #[test]
    fn what_is_asked_for_is_in_the_scene() {
        let plain = scene(r#"{"scene": "stand"}"#).expect("built in");
        let changed =
            r#"{"scene": "stand", "friction": 0.5, "load_kg": 10, "gain": 4, "rate_hz": 250}"#;
        let changed = scene(changed).expect("a scene");
        assert_eq!(changed.controller.rate_hz, 250.0);
        for k in 0..3 {
            let of = |scene: &surefoot_sim::scene::Scene| {
                (scene.controller.position_gain[k], scene.controller.velocity_gain[k])
            };
            assert_eq!(of(&changed), (4.0 * of(&plain).0, 2.0 * of(&plain).1));
        }
        assert_ne!(changed.plant, plain.plant);
    }

    #[test]
    fn nonsense_is_refused_with_what_is_wrong() {
        for (json, what) in [
            (r#"{"scene": "stan"}"#, "no built-in scene stan"),
            (r#"{"scene": "chain"}"#, "chain has no robot"),
            (r#"{"scene": "stand", "frction": 1}"#, "frction"),
            (r#"{"scene": "stand", "friction": -1}"#, "friction"),
            (r#"{"scene": "stand", "rate_hz": 333}"#, "rate"),
            (r#"{"scene": "stand", "speed_mps": 1}"#, "does not walk"),
            ("{", "request"),
        ] {
            let error = scene(json).expect_err(json);
            assert!(error.contains(what), "{json}: {error}");
        }
    }
}
