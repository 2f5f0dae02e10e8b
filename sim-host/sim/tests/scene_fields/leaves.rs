//! The leaves of a scene's TOML, by their paths, and the text with one of them changed.

use toml::{Table, Value};

/// A step down the tree.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    Key(String),
    Index(usize),
}

pub type Path = Vec<Step>;

/// All leaves with their values.
pub fn leaves(table: &Table) -> Vec<(Path, Value)> {
    let mut all = Vec::new();
    let mut open: Vec<(Path, Value)> = vec![(Vec::new(), Value::Table(table.clone()))];
    while let Some((path, value)) = open.pop() {
        let mut below = |step, value| open.push(([&path[..], &[step]].concat(), value));
        match value {
            Value::Table(fields) => {
                fields.into_iter().for_each(|(key, v)| below(Step::Key(key), v))
            }
            Value::Array(items) => {
                items.into_iter().enumerate().for_each(|(k, v)| below(Step::Index(k), v));
            }
            leaf => all.push((path, leaf)),
        }
    }
    all
}

/// As messages write it: `a.b[2].c`.
pub fn written(path: &[Step]) -> String {
    path.iter().fold(String::new(), |text, step| match step {
        Step::Key(key) if text.is_empty() => key.clone(),
        Step::Key(key) => format!("{text}.{key}"),
        Step::Index(k) => format!("{text}[{k}]"),
    })
}

/// The last key of a path: the field's name.
pub fn field(path: &[Step]) -> &str {
    path.iter()
        .rev()
        .find_map(|step| match step {
            Step::Key(key) => Some(key.as_str()),
            Step::Index(_) => None,
        })
        .expect("a leaf has a key")
}

/// The scene's text with other values at these leaves.
pub fn changed(table: &Table, changes: &[(&Path, Value)]) -> String {
    let mut whole = Value::Table(table.clone());
    for (path, to) in changes {
        let mut at = &mut whole;
        for step in path.iter() {
            at = match step {
                Step::Key(key) => at.get_mut(key.as_str()),
                Step::Index(k) => at.get_mut(*k),
            }
            .expect("the path of a leaf");
        }
        *at = to.clone();
    }
    toml::to_string(&whole).expect("what was read can be written")
}
