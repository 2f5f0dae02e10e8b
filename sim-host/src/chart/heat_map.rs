//! A grid of coloured, lettered cells under lines.

use super::style::{ChartError, Painted, at, drawn, font, points, write};
use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::path::Path;

/// How the cells of one kind look.
#[derive(Clone, Debug, PartialEq)]
pub struct CellKind {
    /// In the legend.
    pub name: String,
    /// In each cell, so that colour is not needed; empty for none.
    pub letter: &'static str,
    /// Red, green, blue.
    pub color: (u8, u8, u8),
}

/// An axis: its description, and its ticks in cells from the first cell's centre, with their texts.
#[derive(Clone, Debug, PartialEq)]
pub struct CellAxis {
    /// Name and unit.
    pub description: String,
    /// How many cells.
    pub cells: usize,
    /// Where, and what.
    pub ticks: Vec<(f64, String)>,
}

/// A line over the cells, in cells from the first cell's centre; `None` breaks it.
#[derive(Clone, Debug, PartialEq)]
pub struct CellLine {
    /// In the legend.
    pub name: String,
    /// Along x.
    pub points: Vec<Option<(f64, f64)>>,
    /// Dashed, for what is foretold.
    pub is_dashed: bool,
}

/// A grid of cells, each of a kind.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// Above.
    pub title: String,
    /// Across.
    pub x: CellAxis,
    /// Upwards.
    pub y: CellAxis,
    /// The kinds, in the legend's order.
    pub kinds: Vec<CellKind>,
    /// Numbers of kinds, column by column from below.
    pub cells: Vec<Vec<usize>>,
    /// Over the cells.
    pub lines: Vec<CellLine>,
}

/// Pixels of the grid.
const GRID: (i32, i32) = (520, 400);
/// Pixels left of the grid and above it.
const ORIGIN: (i32, i32) = (86, 44);
/// Pixels of the whole.
const SIZE: (u32, u32) = (830, 510);

impl HeatMap {
    /// Draws it as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(&self) -> Result<String, ChartError> {
        drawn(&self.title, SIZE, |root| self.paint(root))
    }

    /// Draws it to an SVG file.
    ///
    /// # Errors
    /// [`ChartError`] if the file cannot be written.
    pub fn draw(&self, path: &Path) -> Result<(), ChartError> {
        write(path, &self.svg()?)
    }

    /// Points of the drawing where a place in cells is.
    fn point(&self, (x, y): (f64, f64)) -> (i32, i32) {
        let share = |place: f64, cells: usize| (place + 0.5) / cells.max(1) as f64;
        let across = share(x, self.x.cells) * f64::from(at(GRID.0));
        let up = share(y, self.y.cells) * f64::from(at(GRID.1));
        (at(ORIGIN.0) + across as i32, at(ORIGIN.1 + GRID.1) - up as i32)
    }

    fn paint(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let title = font(18).into_text_style(root);
        root.draw(&Text::new(self.title.as_str(), (at(14), at(12)), title))?;
        self.paint_cells(root)?;
        for line in &self.lines {
            self.paint_line(root, line)?;
        }
        self.paint_axes(root)?;
        self.paint_legend(root)
    }

    fn paint_cells(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let height = GRID.1 / self.y.cells.max(1) as i32;
        let width = GRID.0 / self.x.cells.max(1) as i32;
        let size = (height.min(width) - 4).clamp(6, 13) as u32;
        for (x, column) in self.cells.iter().enumerate() {
            for (y, kind) in column.iter().enumerate() {
                let Some(kind) = self.kinds.get(*kind) else { continue };
                let place = (x as f64, y as f64);
                let corners = [
                    self.point((place.0 - 0.5, place.1 + 0.5)),
                    self.point((place.0 + 0.5, place.1 - 0.5)),
                ];
                let fill = RGBColor(kind.color.0, kind.color.1, kind.color.2);
                root.draw(&Rectangle::new(corners, fill.filled()))?;
                if kind.letter.is_empty() {
                    continue;
                }
                let ink = ink(kind.color);
                let style = font(size).into_text_style(root).color(&ink);
                let centred = style.pos(Pos::new(HPos::Center, VPos::Center));
                root.draw(&Text::new(kind.letter, self.point(place), centred))?;
            }
        }
        Ok(())
    }

    /// A line, bright around dark: seen on any cell.
    fn paint_line(&self, root: &DrawingArea<SVGBackend<'_>, Shift>, line: &CellLine) -> Painted {
        let [top, bottom] = [self.y.cells as f64 - 0.5, -0.5];
        for part in line.points.split(Option::is_none) {
            let inside = part.iter().flatten().map(|(x, y)| (*x, y.clamp(bottom, top)));
            // A column's limit holds for all its width.
            let steps: Vec<(i32, i32)> = inside
                .flat_map(|(x, y)| [self.point((x - 0.5, y)), self.point((x + 0.5, y))])
                .collect();
            if steps.is_empty() {
                continue;
            }
            for (color, width) in [(WHITE, 7), (BLACK, 3)] {
                let style = color.stroke_width(points(width));
                if line.is_dashed && color == BLACK {
                    let (on, off) = (at(9), at(6));
                    root.draw(&DashedPathElement::new(steps.clone(), on, off, style))?;
                } else {
                    root.draw(&PathElement::new(steps.clone(), style))?;
                }
            }
        }
        Ok(())
    }

    fn paint_axes(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let (left, top) = (at(ORIGIN.0), at(ORIGIN.1));
        let (right, bottom) = (at(ORIGIN.0 + GRID.0), at(ORIGIN.1 + GRID.1));
        let line = BLACK.stroke_width(points(1));
        root.draw(&Rectangle::new([(left, top), (right, bottom)], line))?;
        let text = font(13).into_text_style(root);
        let below = text.clone().pos(Pos::new(HPos::Center, VPos::Top));
        for (place, label) in &self.x.ticks {
            let x = self.point((*place, 0.0)).0;
            root.draw(&PathElement::new(vec![(x, bottom), (x, bottom + at(5))], line))?;
            root.draw(&Text::new(label.as_str(), (x, bottom + at(8)), below.clone()))?;
        }
        let beside = text.pos(Pos::new(HPos::Right, VPos::Center));
        for (place, label) in &self.y.ticks {
            let y = self.point((0.0, *place)).1;
            root.draw(&PathElement::new(vec![(left - at(5), y), (left, y)], line))?;
            root.draw(&Text::new(label.as_str(), (left - at(8), y), beside.clone()))?;
        }
        let description = font(14).into_text_style(root);
        let centred = description.pos(Pos::new(HPos::Center, VPos::Top));
        let middle = ((left + right) / 2, bottom + at(30));
        root.draw(&Text::new(self.x.description.as_str(), middle, centred.clone()))?;
        let upwards = centred.transform(FontTransform::Rotate270);
        let middle = (at(14), (top + bottom) / 2);
        root.draw(&Text::new(self.y.description.as_str(), middle, upwards))?;
        Ok(())
    }

    fn paint_legend(&self, root: &DrawingArea<SVGBackend<'_>, Shift>) -> Painted {
        let left = ORIGIN.0 + GRID.0 + 16;
        let row = |number: usize| ORIGIN.1 + 8 + 24 * number as i32;
        let text = font(14).into_text_style(root).pos(Pos::new(HPos::Left, VPos::Center));
        for (number, kind) in self.kinds.iter().enumerate() {
            let y = row(number);
            let corners = [(at(left), at(y - 8)), (at(left + 24), at(y + 8))];
            let fill = RGBColor(kind.color.0, kind.color.1, kind.color.2);
            root.draw(&Rectangle::new(corners, fill.filled()))?;
            root.draw(&Rectangle::new(corners, BLACK.stroke_width(points(1))))?;
            let ink = ink(kind.color);
            let letter = font(12).into_text_style(root).color(&ink);
            let centred = letter.pos(Pos::new(HPos::Center, VPos::Center));
            root.draw(&Text::new(kind.letter, (at(left + 12), at(y)), centred))?;
            root.draw(&Text::new(kind.name.as_str(), (at(left + 32), at(y)), text.clone()))?;
        }
        for (number, line) in self.lines.iter().enumerate() {
            let y = at(row(self.kinds.len() + number));
            let ends = vec![(at(left), y), (at(left + 24), y)];
            let style = BLACK.stroke_width(points(3));
            if line.is_dashed {
                root.draw(&DashedPathElement::new(ends, at(9), at(6), style))?;
            } else {
                root.draw(&PathElement::new(ends, style))?;
            }
            root.draw(&Text::new(line.name.as_str(), (at(left + 32), y), text.clone()))?;
        }
        Ok(())
    }
}

/// Black or white, whichever is read more easily on a colour.
fn ink((red, green, blue): (u8, u8, u8)) -> RGBColor {
    let luma = 0.299 * f64::from(red) + 0.587 * f64::from(green) + 0.114 * f64::from(blue);
    if luma > 110.0 { BLACK } else { WHITE }
}
