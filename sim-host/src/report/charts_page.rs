//! One page of charts that needs nothing but itself.

use askama::Template;

/// A chart as it stands in a page.
#[derive(Clone, Debug)]
pub struct Figure {
    /// SVG.
    pub drawing: String,
    /// What it shows, in a sentence.
    pub says: String,
    /// What else there is to say.
    pub note: String,
    /// Files with its numbers and the drawing, beside the page.
    pub files: Vec<String>,
}

impl Figure {
    /// A drawing made for a file, which in a page needs no namespace.
    pub fn new(svg: &str, says: impl Into<String>, note: impl Into<String>) -> Self {
        Self {
            drawing: svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1),
            says: says.into(),
            note: note.into(),
            files: Vec::new(),
        }
    }

    /// With files beside the page.
    pub fn with_files(self, files: impl IntoIterator<Item = String>) -> Self {
        Self { files: files.into_iter().collect(), ..self }
    }
}

/// What one chart tells.
#[derive(Clone, Debug)]
pub struct Chapter {
    /// Of its heading.
    pub id: &'static str,
    /// Its heading.
    pub title: String,
    /// What it comes to, for those who read no further.
    pub headline: String,
    /// HTML.
    pub body: String,
}

/// Texts are escaped by the template, but for the style, which comes with the program, and chapters, whose own
/// templates escape.
#[derive(Template)]
#[template(path = "charts.html")]
struct Page<'a> {
    style: &'static str,
    about: &'a str,
    chapters: &'a [Chapter],
}

/// Draws the page. `about` says of which program and machine its numbers are.
///
/// # Errors
/// [`askama::Error`] if it cannot be written.
pub fn charts_page(chapters: &[Chapter], about: &str) -> Result<String, askama::Error> {
    let style = concat!(include_str!("page.css"), include_str!("charts.css"));
    Page { style, about, chapters }.render()
}
