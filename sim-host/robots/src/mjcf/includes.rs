//! `<include file="…"/>`: the children of another file's root, in its place.

use crate::error::{ImportError, Refusal};
use crate::xml::{self, Element};
use std::path::{Path, PathBuf};

/// Files at most, so that a loop of them ends.
const MOST_FILES: usize = 256;

/// Elements that make bodies or move them, and for which there is no counterpart here.
const UNSUPPORTED: [&str; 6] =
    ["replicate", "composite", "flexcomp", "attach", "flex", "deformable"];

/// Replaces all includes below `root`. Paths are relative to the main file's folder.
///
/// # Errors
/// A file is not found or not XML, or is included twice (MuJoCo refuses that too, and so loops end).
pub(super) fn expand(root: &mut Element, path: &Path) -> Result<(), ImportError> {
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let mut files = vec![path.to_owned()];
    expand_below(root, &folder, &mut files)
}

fn expand_below(
    element: &mut Element,
    folder: &Path,
    files: &mut Vec<PathBuf>,
) -> Result<(), ImportError> {
    let mut children = Vec::new();
    for mut child in std::mem::take(&mut element.children) {
        if child.tag != "include" {
            expand_below(&mut child, folder, files)?;
            children.push(child);
            continue;
        }
        let path = folder.join(child.required_attribute("file")?);
        if files.contains(&path) || files.len() >= MOST_FILES {
            return Err(
                child.malformed("each file to be included once", path.display().to_string())
            );
        }
        files.push(path.clone());
        let mut included = xml::read(&path).map_err(|error| match error {
            ImportError::File { file, cause } => {
                child.malformed("a file that can be read", format!("{file}: {cause}"))
            }
            other => other,
        })?;
        expand_below(&mut included, folder, files)?;
        children.extend(included.children);
    }
    element.children = children;
    Ok(())
}

/// Refuses what would silently leave bodies out.
pub(super) fn refuse_unsupported(element: &Element) -> Result<(), ImportError> {
    for child in &element.children {
        if UNSUPPORTED.contains(&child.tag.as_str()) {
            let refusal = Refusal::Unsupported {
                what: format!("<{}>", child.tag),
                advice: "have its bodies written out, as mj_saveLastXML does".into(),
            };
            return Err(ImportError::refused(Some(&child.place), child.describe(), refusal));
        }
        refuse_unsupported(child)?;
    }
    Ok(())
}
