//! `<default>`: attributes by class and kind of element.

use crate::error::ImportError;
use crate::xml::{Attribute, Element};
use std::collections::HashMap;

/// The class of an element outside any other.
const MAIN: &str = "main";

/// Attributes that say the same thing; one of an element's own replaces any of its class.
const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// Attributes of all classes, by class and tag; each class has its parents' too.
#[derive(Debug, Default)]
pub(super) struct Defaults {
    classes: HashMap<String, HashMap<String, Vec<Attribute>>>,
}

impl Defaults {
    pub fn read(root: &Element) -> Result<Self, ImportError> {
        let mut all = Self::default();
        all.classes.insert(MAIN.into(), HashMap::new());
        for top in root.all("default") {
            all.read_class(top, None)?;
        }
        Ok(all)
    }

    fn read_class(&mut self, element: &Element, parent: Option<&str>) -> Result<(), ImportError> {
        let name = match (element.attribute("class"), parent) {
            (Some(name), _) => name,
            (None, None) => MAIN,
            (None, Some(_)) => return Err(element.malformed("attribute class", "none")),
        };
        let inherited = parent.unwrap_or(name);
        let mut class = self.classes.get(inherited).cloned().unwrap_or_default();
        for child in element.children.iter().filter(|child| child.tag != "default") {
            child.mark();
            let inherited = class.remove(&child.tag).unwrap_or_default();
            class.insert(child.tag.clone(), merged(&child.attributes, &inherited));
        }
        self.classes.insert(name.to_owned(), class);
        for child in element.all("default") {
            self.read_class(child, Some(name))?;
        }
        Ok(())
    }

    /// An element with the attributes of its class, or else of the class of what contains it.
    pub fn apply(&self, element: &Element, class: Option<&str>) -> Result<Element, ImportError> {
        element.mark();
        let name = element.attribute("class").or(class).unwrap_or(MAIN);
        let class = self
            .classes
            .get(name)
            .ok_or_else(|| element.malformed("the name of a default class", format!("{name:?}")))?;
        let mut full = element.clone();
        if let Some(defaults) = class.get(&element.tag) {
            full.attributes = merged(&element.attributes, defaults);
        }
        Ok(full)
    }
}

/// An element's own attributes, then those of its class that they leave open.
fn merged(own: &[Attribute], defaults: &[Attribute]) -> Vec<Attribute> {
    let is_orientation = |name: &str| ORIENTATIONS.contains(&name);
    let oriented = own.iter().any(|a| is_orientation(&a.name));
    let open = defaults.iter().filter(|default| {
        default.name != "class"
            && !own.iter().any(|a| a.name == default.name)
            && !(oriented && is_orientation(&default.name))
    });
    own.iter().chain(open).cloned().collect()
}
