//! Paths of fields in a scene's document: `block.mass_kg`, `pushes[0].force_n`, `plant.bodies."left foot".added_mass_kg`.

use std::fmt;
use toml::{Table, Value};

/// Where a field is, from the document's root.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldPath {
    steps: Vec<Step>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Key(String),
    Entry(usize),
}

/// Why there is no such field.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PathError {
    /// Not a path.
    #[error(
        "{text}: expected names with dots between them, and numbers of entries in brackets: block.mass_kg, pushes[0].force_n"
    )]
    Malformed {
        /// What was found.
        text: String,
    },
    /// A number beyond a list.
    #[error("{path}: entry {entry} of a list of {length}; expected a number from 0 to {}", length.saturating_sub(1))]
    NoEntry {
        /// The list.
        path: String,
        /// The number.
        entry: usize,
        /// How many entries it has.
        length: usize,
    },
    /// A step into what has no fields or no entries.
    #[error("{path}: is {found}; expected {expected}")]
    NoContainer {
        /// Where.
        path: String,
        /// What is there.
        found: &'static str,
        /// What would have to be there.
        expected: &'static str,
    },
}

impl FieldPath {
    /// From its text.
    ///
    /// # Errors
    /// [`PathError::Malformed`].
    pub fn parse(text: &str) -> Result<Self, PathError> {
        let malformed = || PathError::Malformed { text: text.to_owned() };
        let mut steps = Vec::new();
        let mut rest = text;
        loop {
            let key = match rest.strip_prefix('"') {
                Some(quoted) => {
                    let end = quoted.find('"').ok_or_else(malformed)?;
                    rest = &quoted[end + 1..];
                    &quoted[..end]
                }
                None => {
                    let end = rest.find(['.', '[', ']', '"']).unwrap_or(rest.len());
                    let key = &rest[..end];
                    rest = &rest[end..];
                    key
                }
            };
            if key.is_empty() {
                return Err(malformed());
            }
            steps.push(Step::Key(key.to_owned()));
            while let Some(bracket) = rest.strip_prefix('[') {
                let (number, after) = bracket.split_once(']').ok_or_else(malformed)?;
                steps.push(Step::Entry(number.parse().map_err(|_| malformed())?));
                rest = after;
            }
            if rest.is_empty() {
                return Ok(Self { steps });
            }
            rest = rest.strip_prefix('.').ok_or_else(malformed)?;
        }
    }

    /// What the document has there.
    pub fn get<'a>(&self, document: &'a Table) -> Option<&'a Value> {
        let mut steps = self.steps.iter();
        let Some(Step::Key(first)) = steps.next() else { return None };
        let mut found = document.get(first)?;
        for step in steps {
            found = match step {
                Step::Key(key) => found.as_table()?.get(key)?,
                Step::Entry(k) => found.as_array()?.get(*k)?,
            };
        }
        Some(found)
    }

    /// Puts a value there. Tables on the way that the document leaves out are made; entries of lists must exist.
    ///
    /// # Errors
    /// [`PathError::NoEntry`] and [`PathError::NoContainer`].
    pub fn set(&self, document: &mut Table, value: Value) -> Result<(), PathError> {
        let [Step::Key(first), rest @ ..] = &self.steps[..] else {
            return Err(PathError::Malformed { text: self.to_string() });
        };
        let empty = || Value::Table(Table::new());
        let mut at = document.entry(first).or_insert_with(empty);
        for (made, step) in rest.iter().enumerate() {
            let path = || shown(&self.steps[..=made]);
            at = match (step, at) {
                (Step::Key(key), Value::Table(table)) => table.entry(key).or_insert_with(empty),
                (Step::Entry(entry), Value::Array(list)) => {
                    let (entry, length) = (*entry, list.len());
                    let none = PathError::NoEntry { path: path(), entry, length };
                    list.get_mut(entry).ok_or(none)?
                }
                (step, other) => {
                    let expected = match step {
                        Step::Key(_) => "a table",
                        Step::Entry(_) => "a list",
                    };
                    return Err(PathError::NoContainer {
                        path: path(),
                        found: kind(other),
                        expected,
                    });
                }
            };
        }
        *at = value;
        Ok(())
    }
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Table(table) if table.is_empty() => "left out",
        Value::Table(_) => "a table",
        Value::Array(_) => "a list",
        Value::String(_) => "a word",
        Value::Boolean(_) => "true or false",
        _ => "a number",
    }
}

fn shown(steps: &[Step]) -> String {
    let mut out = String::new();
    for step in steps {
        match step {
            Step::Entry(k) => out.push_str(&format!("[{k}]")),
            Step::Key(key) => {
                if !out.is_empty() {
                    out.push('.');
                }
                let is_bare = !key.contains(['.', '[', ']', ' ', '"']);
                out.push_str(&if is_bare { key.clone() } else { format!("\"{key}\"") });
            }
        }
    }
    out
}

impl fmt::Display for FieldPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shown(&self.steps))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document() -> Table {
        "a = 1\n[b]\nc = [1, 2]\n[b.\"left foot\"]\nd = 3.0\n".parse().expect("TOML")
    }

    #[test]
    fn fields_are_found_and_set() {
        let mut document = document();
        for text in ["a", "b.c[1]", "b.\"left foot\".d"] {
            let path = FieldPath::parse(text).expect("a path");
            assert_eq!(path.to_string(), text);
            path.set(&mut document, Value::Float(7.5)).expect("set");
            assert_eq!(path.get(&document), Some(&Value::Float(7.5)));
        }
        let new = FieldPath::parse("e.f.g").expect("a path");
        assert_eq!(new.get(&document), None);
        new.set(&mut document, Value::Integer(1)).expect("tables are made");
        assert_eq!(new.get(&document), Some(&Value::Integer(1)));
    }

    #[test]
    fn what_is_no_field_is_refused() {
        for text in ["", ".", "a.", "a..b", "a[", "a[x]", "a[0]b", "\"a", "[0]"] {
            assert!(matches!(FieldPath::parse(text), Err(PathError::Malformed { .. })), "{text}");
        }
        let refused =
            |text| FieldPath::parse(text).expect("a path").set(&mut document(), Value::Integer(0));
        assert_eq!(
            refused("b.c[2]"),
            Err(PathError::NoEntry { path: "b.c".into(), entry: 2, length: 2 })
        );
        assert!(matches!(refused("a.b"), Err(PathError::NoContainer { .. })));
        assert!(matches!(refused("b[0]"), Err(PathError::NoContainer { .. })));
        assert!(matches!(
            refused("pushes[0].at_s"),
            Err(PathError::NoContainer { found: "left out", .. })
        ));
    }
}
