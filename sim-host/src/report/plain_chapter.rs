//! A chapter that is made of figures and tables.

use super::{Chapter, Figure};
use askama::Template;

/// A table as it stands in a page.
#[derive(Clone, Debug)]
pub struct Table {
    /// Above it.
    pub title: String,
    /// Its columns.
    pub head: Vec<String>,
    /// Its rows.
    pub rows: Vec<Vec<String>>,
    /// Below it.
    pub note: String,
    /// Files with its numbers, beside the page.
    pub files: Vec<String>,
}

/// Texts are escaped by the template, but for drawings, whose backend escapes.
#[derive(Template)]
#[template(path = "plain_chapter.html")]
struct Body<'a> {
    about: &'a str,
    figures: &'a [Figure],
    tables: &'a [Table],
}

/// Puts it together; `about` stands above, `headline` at the top of the page.
///
/// # Errors
/// [`askama::Error`] if it cannot be written.
pub fn plain_chapter(
    id: &'static str,
    (title, headline): (&str, String),
    about: &str,
    figures: &[Figure],
    tables: &[Table],
) -> Result<Chapter, askama::Error> {
    let body = Body { about, figures, tables }.render()?;
    Ok(Chapter { id, title: title.to_owned(), headline, body })
}
