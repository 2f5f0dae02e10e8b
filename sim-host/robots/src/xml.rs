//! XML as the readers see it: elements that know their file and line, and whether anyone has read them.

mod prefixes;

use crate::error::{ImportError, Place};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

/// Bytes of a file at most, elements at most, and how deep they may lie: far above any robot's, far
/// below what fills a machine.
const LARGEST_FILE: u64 = 64 << 20;
const MOST_NODES: u32 = 2_000_000;
const DEEPEST: usize = 512;
/// No length, angle, mass or inertia of a robot in SI units is larger.
const LARGEST_NUMBER: f64 = 1e9;

/// An element.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    /// With its prefix, where it has one.
    pub tag: String,
    pub place: Place,
    pub attributes: Vec<Attribute>,
    pub children: Vec<Element>,
    /// Of the element itself, up to its first child.
    pub text: String,
    seen: Rc<Cell<bool>>,
}

#[derive(Clone, Debug)]
pub(crate) struct Attribute {
    pub name: String,
    pub value: String,
    seen: Rc<Cell<bool>>,
}

/// The root element of a file.
///
/// # Errors
/// The file cannot be read, or is not well-formed XML. Document type definitions are refused, and
/// entities with them.
pub(crate) fn read(path: &Path) -> Result<Element, ImportError> {
    let file: Arc<str> = path.display().to_string().into();
    let text = read_text(path)?;
    match parse(&file, &text) {
        Err(roxmltree::Error::UnknownNamespace(..)) => {
            let declared = prefixes::declared(&text);
            parse(&file, &declared).map_err(|error| not_xml(&file, &error))?
        }
        other => other.map_err(|error| not_xml(&file, &error))?,
    }
}

/// The tree, or an error of what does not belong into it; or it is not XML.
fn parse(file: &Arc<str>, text: &str) -> Result<Result<Element, ImportError>, roxmltree::Error> {
    let options = roxmltree::ParsingOptions { nodes_limit: MOST_NODES, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(text, options)?;
    Ok(convert(file, &Lines::of(text), document.root_element(), 0))
}

fn not_xml(file: &Arc<str>, error: &roxmltree::Error) -> ImportError {
    malformed_xml(file, error.pos().row, &error.to_string())
}

/// The text of a file of a bounded size.
pub(crate) fn read_text(path: &Path) -> Result<String, ImportError> {
    use std::io::Read;
    let name = path.display().to_string();
    let failed = |cause| ImportError::File { file: name.clone(), cause };
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(failed)?;
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(failed(std::io::Error::other(format!("larger than {LARGEST_FILE} bytes"))));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count() as u32;
        malformed_xml(&name.as_str().into(), line, "a byte that is not UTF-8")
    })
}

fn malformed_xml(file: &Arc<str>, line: u32, found: &str) -> ImportError {
    ImportError::Malformed {
        place: Place { file: file.clone(), line },
        element: "file".into(),
        expected: "well-formed XML without a document type definition".into(),
        found: found.into(),
    }
}

/// Where lines start, since to count them for each element would take as long as the square of a file.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Self {
        Self(text.match_indices('\n').map(|(at, _)| at).collect())
    }

    /// The line of a byte, from 1.
    fn at(&self, byte: usize) -> u32 {
        self.0.partition_point(|end| *end < byte) as u32 + 1
    }
}

fn convert(
    file: &Arc<str>,
    lines: &Lines,
    node: roxmltree::Node<'_, '_>,
    depth: usize,
) -> Result<Element, ImportError> {
    let line = lines.at(node.range().start);
    if depth > DEEPEST {
        return Err(malformed_xml(file, line, &format!("elements nested deeper than {DEEPEST}")));
    }
    let local = node.tag_name().name();
    let tag = match node.tag_name().namespace() {
        None => local.to_owned(),
        // A namespace without a prefix is the format's own.
        Some(uri) => match node.lookup_prefix(uri) {
            Some(prefix) => format!("{prefix}:{local}"),
            None => local.to_owned(),
        },
    };
    let attributes = node
        .attributes()
        .map(|attribute| Attribute {
            name: attribute.name().to_owned(),
            value: attribute.value().to_owned(),
            seen: Rc::default(),
        })
        .collect();
    let children = node
        .children()
        .filter(roxmltree::Node::is_element)
        .map(|child| convert(file, lines, child, depth + 1))
        .collect::<Result<_, _>>()?;
    let place = Place { file: file.clone(), line };
    let text = node.text().unwrap_or_default().to_owned();
    Ok(Element { tag, place, attributes, children, text, seen: Rc::default() })
}

impl Element {
    /// `<joint name="knee">`, for messages.
    pub fn describe(&self) -> String {
        match self.attributes.iter().find(|a| a.name == "name") {
            Some(name) => format!("<{} name=\"{}\">", self.tag, name.value),
            None => format!("<{}>", self.tag),
        }
    }

    pub fn malformed(&self, expected: impl Into<String>, found: impl Into<String>) -> ImportError {
        ImportError::Malformed {
            place: self.place.clone(),
            element: self.describe(),
            expected: expected.into(),
            found: found.into(),
        }
    }

    /// Counts this element as read.
    pub fn mark(&self) {
        self.seen.set(true);
    }

    /// Children of one kind.
    pub fn all<'a>(&'a self, tag: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |c| c.tag == tag).inspect(|c| c.seen.set(true))
    }

    /// The child of one kind, where there is one.
    ///
    /// # Errors
    /// There are several.
    pub fn one(&self, tag: &str) -> Result<Option<&Element>, ImportError> {
        let mut first = None;
        for child in self.children.iter().filter(|child| child.tag == tag) {
            child.mark();
            if first.replace(child).is_some() {
                return Err(child.malformed(format!("one <{tag}>"), "a second one"));
            }
        }
        Ok(first)
    }

    /// The child of one kind.
    pub fn required(&self, tag: &str) -> Result<&Element, ImportError> {
        self.one(tag)?.ok_or_else(|| self.malformed(format!("a child <{tag}>"), "none"))
    }

    pub fn attribute(&self, name: &str) -> Option<&str> {
        let attribute = self.attributes.iter().find(|a| a.name == name)?;
        attribute.seen.set(true);
        Some(attribute.value.as_str())
    }

    pub fn required_attribute(&self, name: &str) -> Result<&str, ImportError> {
        match self.attribute(name) {
            Some(value) if !value.trim().is_empty() => Ok(value),
            Some(_) => Err(self.malformed(format!("attribute {name}"), "an empty one")),
            None => Err(self.malformed(format!("attribute {name}"), "none")),
        }
    }

    /// Any number of numbers.
    pub fn list(&self, name: &str) -> Result<Option<Vec<f64>>, ImportError> {
        self.attribute(name).map(|text| self.parse(text, name)).transpose()
    }

    /// Numbers between the tags.
    pub fn text_numbers(&self) -> Result<Vec<f64>, ImportError> {
        self.mark();
        self.parse(&self.text, "its text")
    }

    fn parse(&self, text: &str, what: &str) -> Result<Vec<f64>, ImportError> {
        let number = |word: &str| match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.malformed(format!("finite numbers in {what}"), format!("{word:?}"))),
        };
        text.split_whitespace().map(number).collect()
    }

    /// `N` numbers of a size that lengths, angles and masses have.
    pub fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[f64; N]>, ImportError> {
        let Some(list) = self.list(name)? else { return Ok(None) };
        if let Some(large) = list.iter().find(|x| x.abs() > LARGEST_NUMBER) {
            let expected = format!("numbers up to {LARGEST_NUMBER:e} in {name}");
            return Err(self.malformed(expected, format!("{large:e}")));
        }
        let count = list.len();
        match <[f64; N]>::try_from(list) {
            Ok(numbers) => Ok(Some(numbers)),
            Err(_) => Err(self.malformed(format!("{N} numbers in {name}"), count.to_string())),
        }
    }

    pub fn number(&self, name: &str) -> Result<Option<f64>, ImportError> {
        Ok(self.numbers::<1>(name)?.map(|[x]| x))
    }

    pub fn required_number(&self, name: &str) -> Result<f64, ImportError> {
        self.required_attribute(name)?;
        self.number(name)?.ok_or_else(|| self.malformed(format!("attribute {name}"), "none"))
    }

    /// A number that is not negative.
    pub fn size(&self, name: &str) -> Result<Option<f64>, ImportError> {
        match self.number(name)? {
            Some(x) if x < 0.0 => {
                Err(self.malformed(format!("{name} of 0 or more"), x.to_string()))
            }
            x => Ok(x),
        }
    }

    /// What nobody has read below this element: `parent/tag` and `parent@attribute`, with how often.
    pub fn unread(&self) -> BTreeMap<String, usize> {
        let mut found = BTreeMap::new();
        self.collect_unread(&mut found);
        found
    }

    fn collect_unread(&self, found: &mut BTreeMap<String, usize>) {
        for attribute in self.attributes.iter().filter(|a| !a.seen.get()) {
            *found.entry(format!("{}@{}", self.tag, attribute.name)).or_default() += 1;
        }
        for child in &self.children {
            if child.seen.get() {
                child.collect_unread(found);
            } else {
                *found.entry(format!("{}/{}", self.tag, child.tag)).or_default() += 1;
            }
        }
    }
}
