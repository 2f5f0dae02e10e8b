//! No field is accepted without effect.

use super::leaves::{Path, changed, field, leaves, written};
use super::record::{Record, record};
use super::representative::scenes;
use surefoot_sim::scene::{SceneError, parse};
use toml::{Table, Value};

/// Fields that may change without changing a motion, and why.
const IDLE: [(&str, &str); 3] = [
    ("description", "for people"),
    ("accuracy", "decides which method and step `surefoot run` advises, not what they make"),
    ("name", "a body's, that only other fields refer to"),
];

/// Words that a field of words may hold; the record must change from one to the next.
const WORDS: [(&str, &[&str]); 10] = [
    ("state", &["truth", "noise", "estimate"]),
    ("distribution", &["least-norm", "limited"]),
    ("torques_from", &["start", "touch-down"]),
    ("outline", &["A", "M", "R"]),
    ("switching", &["within-the-step", "at-midpoint"]),
    ("name", &["variational", "semi-implicit-euler", "runge-kutta-4", "rattle"]),
    ("joint", &["revolute", "alternating", "spherical"]),
    ("inboard", &["base", "arm", "swing"]),
    ("between", &["swing", "other", "crank", "base", "nobody"]),
    // Another kind has other fields.
    ("kind", &["no-such-kind"]),
];

/// Other values for a leaf, small changes first.
fn others(path: &Path, value: &Value) -> Vec<Value> {
    match value {
        Value::Float(x) => [x * 1.05 + 0.003, x * 0.6, x * 0.01, -x, x * 30.0, x + 10.0, 0.0]
            .into_iter()
            .filter(|other| other != x)
            .map(Value::Float)
            .collect(),
        Value::Integer(i) => {
            [i + 1, i / 50, -i, 0, 30 * i].into_iter().map(Value::Integer).collect()
        }
        Value::Boolean(b) => vec![Value::Boolean(!b)],
        Value::String(_) if field(path) == "workspace" => {
            vec![Value::Table([("big-base".to_owned(), Value::Float(2.0))].into_iter().collect())]
        }
        Value::String(word) => {
            let known = WORDS.iter().find(|(name, _)| *name == field(path));
            let words = known.map_or(&["no-such-word"][..], |(_, words)| words);
            words.iter().filter(|w| *w != word).map(|w| Value::String((*w).to_owned())).collect()
        }
        other => panic!("{other} in a scene"),
    }
}

/// Whether an error blames a leaf: by its path, or what it is part of.
fn blames(error: &SceneError, path: &Path) -> bool {
    let path = written(path);
    match error {
        SceneError::Value { field, line, .. } => path.starts_with(field.as_str()) && line.is_some(),
        SceneError::Syntax { message, .. } => {
            let key = message.split(": ").next().unwrap_or_default();
            path.starts_with(key) || key.starts_with(&path)
        }
        _ => false,
    }
}

/// What becomes of a leaf: that the record changes, or else that it is refused by name.
#[derive(Debug, PartialEq)]
enum Effect {
    Changes,
    Refused,
    Nothing,
}

fn effect(name: &str, table: &Table, base: &Record, path: &Path, value: &Value) -> Effect {
    let mut is_refused = false;
    for other in others(path, value) {
        match parse(name, &changed(table, &[(path, other)])) {
            Ok(scene) => {
                if record(scene) != *base {
                    return Effect::Changes;
                }
            }
            Err(error) => is_refused |= blames(&error, path),
        }
    }
    if is_refused { Effect::Refused } else { Effect::Nothing }
}

#[test]
fn every_field_of_every_scene_counts_or_is_refused() {
    let (mut fields, mut refused) = (0, Vec::new());
    for (name, text) in scenes() {
        let table: Table = toml::from_str(&text).expect("TOML");
        let base = record(parse(&name, &text).unwrap_or_else(|error| panic!("{error}")));
        let (numbers, _) = base.as_ref().unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(numbers.len() > 100, "{name} moves");
        for (path, value) in leaves(&table) {
            let is_method = written(&path) == "integrator.name";
            if !is_method && IDLE.iter().any(|(idle, _)| *idle == field(&path)) {
                continue;
            }
            fields += 1;
            match effect(&name, &table, &base, &path, &value) {
                Effect::Changes => {}
                Effect::Refused => refused.push(format!("{name}: {}", written(&path))),
                Effect::Nothing => panic!("{name}: {} = {value} has no effect", written(&path)),
            }
        }
    }
    println!("{fields} fields, of which {} are refused by name only: {refused:#?}", refused.len());
    // 680 of them.
    assert!(fields > 600, "the scenes were read: {fields}");
}

/// Fields that the representative scenes have not, as they have no effect there.
#[test]
fn idle_fields_are_refused_by_name() {
    let every: String =
        scenes().into_iter().find(|(name, _)| name == "every-joint").expect("there").1;
    let revolute: String =
        scenes().into_iter().find(|(name, _)| name == "loop-revolute").expect("there").1;
    let with = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let floating = "joint = { kind = \"floating\", velocity_m_s";
    let fixed = "joint = { kind = \"fixed\" }";
    let in_loop = "axis = [0.1, 1.0, 0.3]";
    let floor = "gravity_m_s2 = 9.81\nfloor = { normal_stiffness = 1e4, normal_damping = 1.0, \
                 tangential_stiffness = 1e4, tangential_damping = 1.0, static_friction = 0.3, \
                 dynamic_friction = 0.3, zero_velocity_threshold = 1e-3 }";
    for (text, words) in [
        (with(&every, floating, &format!("torque = 1.0\n{floating}")), "bodies[0].torque"),
        (with(&every, fixed, &format!("torque = 1.0\n{fixed}")), "bodies[5].torque"),
        (with(&every, fixed, &format!("law = {{ damping = 1.0 }}\n{fixed}")), "bodies[5].law"),
        (
            with(
                &every,
                "joint = { kind = \"universal\"",
                "torque = 1.0\njoint = { kind = \"universal\"",
            ),
            "bodies[3].torque",
        ),
        (
            with(
                &every,
                "joint = { kind = \"spherical\"",
                "torque = 1.0\njoint = { kind = \"spherical\"",
            ),
            "bodies[4].torque",
        ),
        (with(&every, "stiffness = 20.0, rest", "rest"), "law.rest"),
        (
            with(&every, "high = 0.02, stiffness = 50.0", "high = 0.02, stiffness = 0.0"),
            "law.stops.stiffness",
        ),
        (with(&every, "gravity_m_s2 = 9.81", floor), "mechanism.floor"),
        (
            with(&every, "gravity_m_s2 = 9.81", "gravity_m_s2 = 9.81\nswitching = \"at-midpoint\""),
            "mechanism.switching",
        ),
        (with(&revolute, in_loop, &format!("{in_loop}, rate_rad_s = 1.0")), "rate_rad_s"),
        (
            with(
                &revolute,
                "kind = \"revolute\", point_m = [0.4, 0.1, 0.7], axis = [0.1, 1.0, 0.3]",
                "kind = \"floating\"",
            ),
            "floating",
        ),
    ] {
        let error = parse("idle", &text).expect_err(words).to_string();
        assert!(error.contains(words) && error.starts_with("idle:"), "{words}: {error}");
    }
}
