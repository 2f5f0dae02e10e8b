//! A scene's text, with the places of its fields, so that an error can name the line.

use super::SceneError;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Largest size of a number in a scene: products of ten of them are still finite, and nothing that a robot meets comes
/// near it in SI units.
const LARGEST: f64 = 1e30;

/// A scene's text, parsed.
pub(super) struct Source<'a> {
    /// The file's path, or the scene's name.
    place: &'a str,
    text: &'a str,
    root: Spanned<DeTable<'a>>,
}

impl<'a> Source<'a> {
    /// Parses the text.
    ///
    /// # Errors
    /// [`SceneError::Syntax`] where it is no TOML.
    pub fn parse(place: &'a str, text: &'a str) -> Result<Self, SceneError> {
        let root = DeTable::parse(text).map_err(|error| SceneError::Syntax {
            name: place.to_owned(),
            line: error.span().map_or(1, |span| line_of(text, span.start)),
            message: error.to_string().trim_end().to_owned(),
        })?;
        Ok(Self { place, text, root })
    }

    /// Whether the document has this key.
    pub fn has(&self, key: &str) -> bool {
        self.root.get_ref().contains_key(key)
    }

    /// The document, in which tables that name their kind are `{ kind = { fields } }`: so the deserializer knows the
    /// kind first, and errors inside keep their places.
    pub fn document(&self) -> Spanned<DeTable<'a>> {
        let mut root = self.root.clone();
        tag_first(root.get_mut());
        tag_start(&mut root);
        root
    }

    /// An error of a field that must be there; in a table, unless that has no name.
    pub fn missing(&self, table: &str, field: &str) -> SceneError {
        let mut line = 1;
        each(self.root.get_ref(), "", &mut |path, _, found| {
            if path == table {
                line = line_of(self.text, found.span().start);
            }
        });
        let dot = if table.is_empty() { "" } else { ": " };
        let message = format!("{table}{dot}missing field `{field}`");
        SceneError::Syntax { name: self.place.to_owned(), line, message }
    }

    /// Refuses numbers that are not finite, or so large that their powers are not.
    ///
    /// # Errors
    /// [`SceneError::Value`] of the first one.
    pub fn check_numbers(&self) -> Result<(), SceneError> {
        let mut bad = None;
        each(self.root.get_ref(), "", &mut |path, _, value| {
            if let DeValue::Float(number) = value.get_ref()
                && bad.is_none()
                // What cannot be parsed is too large for any.
                && !number.as_str().parse::<f64>().is_ok_and(|x| x.abs() <= LARGEST)
            {
                bad = Some(path.to_owned());
            }
        });
        let Some(field) = bad else { return Ok(()) };
        let (name, value) = (String::new(), String::new());
        let expected = format!("a finite number, of at most {LARGEST:e} in size");
        Err(self.locate(SceneError::Value { name, line: None, field, value, expected }))
    }

    /// An error with the line of its field, and with the value as it is written there.
    pub fn locate(&self, error: SceneError) -> SceneError {
        let SceneError::Value { field, value, expected, .. } = error else { return error };
        let mut nearest = ("", self.root.span().start);
        let mut written = None;
        each(self.root.get_ref(), "", &mut |path, _, found| {
            if path == field {
                written = self.written(found);
            }
            if is_within(&field, path) && path.len() >= nearest.0.len() {
                nearest = (&field[..path.len()], found.span().start);
            }
        });
        let value = written.map_or(value, shortened);
        let line = Some(line_of(self.text, nearest.1));
        SceneError::Value { name: self.place.to_owned(), line, field, value, expected }
    }

    /// An error of the deserializer, with its line and the path of its field.
    pub fn syntax(&self, error: &toml::de::Error) -> SceneError {
        let span = error.span().unwrap_or(0..0);
        let (mut path_there, mut length) = (String::new(), usize::MAX);
        each(self.root.get_ref(), "", &mut |path, key, value| {
            // An unknown field is at its key.
            let around = if key == span { key } else { value.span() };
            if around.start <= span.start && span.end <= around.end && around.len() <= length {
                path.clone_into(&mut path_there);
                length = around.len();
            }
        });
        let message = error.message();
        SceneError::Syntax {
            name: self.place.to_owned(),
            line: line_of(self.text, span.start),
            message: match &path_there[..] {
                "" => message.to_owned(),
                path => format!("{path}: {message}"),
            },
        }
    }

    /// The text of a value, unless it is a table under a header of its own, or a list of such tables.
    fn written(&self, value: &Spanned<DeValue<'_>>) -> Option<&str> {
        let text = self.text.get(value.span())?;
        let is_inline = match value.get_ref() {
            DeValue::Table(_) => text.starts_with('{'),
            DeValue::Array(items) => items.iter().all(|item| {
                !matches!(item.get_ref(), DeValue::Table(_)) || self.written(item).is_some()
            }),
            _ => true,
        };
        is_inline.then_some(text)
    }
}

/// Takes a value with its path and the span of its key, which entries of lists have not.
type Visit<'v, 't, 'a> = dyn FnMut(&str, Range<usize>, &'t Spanned<DeValue<'a>>) + 'v;

/// Visits all values below a table, outer ones first, with their paths: `a.b[2].c`.
fn each<'t, 'a>(table: &'t DeTable<'a>, path: &str, visit: &mut Visit<'_, 't, 'a>) {
    for (key, value) in table.iter() {
        let dot = if path.is_empty() { "" } else { "." };
        each_below(value, key.span(), &format!("{path}{dot}{}", key.get_ref()), visit);
    }
}

fn each_below<'t, 'a>(
    value: &'t Spanned<DeValue<'a>>,
    key: Range<usize>,
    path: &str,
    visit: &mut Visit<'_, 't, 'a>,
) {
    visit(path, key, value);
    match value.get_ref() {
        DeValue::Table(table) => each(table, path, visit),
        DeValue::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                each_below(item, 0..0, &format!("{path}[{k}]"), visit);
            }
        }
        _ => {}
    }
}

/// Whether a field is this value, or in it.
fn is_within(field: &str, path: &str) -> bool {
    field.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// The kind of a robot's start, which the scene's robot tells; a start of a robot from a file may be left out.
fn tag_start(root: &mut Spanned<DeTable<'_>>) {
    let whole = root.span();
    let fields = root.get_mut();
    let of_file = fields.contains_key("robot");
    let kind = if of_file { "joints" } else { "legs" };
    if fields.contains_key("mechanism") {
        return;
    }
    if of_file && !fields.contains_key("initial") {
        let nothing = Spanned::new(whole.clone(), DeValue::Table(DeTable::new()));
        fields.insert(Spanned::new(whole, "initial".into()), nothing);
    }
    let Some(start) = fields.get_mut("initial") else { return };
    let span = start.span();
    if !matches!(start.get_ref(), DeValue::Table(_)) {
        return;
    }
    let inner = std::mem::replace(start.get_mut(), DeValue::Boolean(false));
    let key = Spanned::new(span.clone(), kind.into());
    *start.get_mut() = DeValue::Table([(key, Spanned::new(span, inner))].into_iter().collect());
}

/// Tables of several kinds, and the key that names the kind.
const TAGGED: [(&str, &str); 3] = [("mechanism", "kind"), ("joint", "kind"), ("feet", "on")];

fn tag_first(table: &mut DeTable<'_>) {
    for (key, value) in table.iter_mut() {
        tag_first_below(value);
        let Some((_, tag)) = TAGGED.iter().find(|(tagged, _)| tagged == key.get_ref()) else {
            continue;
        };
        let whole = value.span();
        let DeValue::Table(fields) = value.get_mut() else { continue };
        // Without one the kind has no name, which the deserializer refuses as any other that it does not know.
        let (mut span, mut kind) = (whole.clone(), "".into());
        if let Some(named) = fields.remove(*tag) {
            span = named.span();
            if let DeValue::String(name) = named.into_inner() {
                kind = name;
            }
        }
        let fields = Spanned::new(whole, DeValue::Table(std::mem::take(fields)));
        *value.get_mut() =
            DeValue::Table([(Spanned::new(span, kind), fields)].into_iter().collect());
    }
}

fn tag_first_below(value: &mut Spanned<DeValue<'_>>) {
    match value.get_mut() {
        DeValue::Table(table) => tag_first(table),
        DeValue::Array(items) => items.iter_mut().for_each(tag_first_below),
        _ => {}
    }
}

/// Number of the line with this byte, from 1.
fn line_of(text: &str, at: usize) -> usize {
    1 + text.bytes().take(at).filter(|byte| *byte == b'\n').count()
}

/// On one line, of bearable length.
fn shortened(text: &str) -> String {
    const LENGTH: usize = 100;
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(LENGTH) {
        None => line,
        Some((end, _)) => format!("{} …", &line[..end]),
    }
}
