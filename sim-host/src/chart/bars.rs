//! Bars beside their names.

use super::style::{COLORS, ChartError, Painted, TITLE_HEIGHT, WIDTH, at, drawn, font};
use plotters::coord::Shift;
use plotters::prelude::*;

/// A bar: its name, its value, and the value as people read it.
#[derive(Clone, Debug)]
pub struct Bar {
    /// Beside it.
    pub name: String,
    /// Its length; none leaves a gap.
    pub value: Option<f64>,
    /// At its end.
    pub label: String,
}

/// A panel of bars from the top down.
#[derive(Clone, Debug)]
pub struct Bars {
    title: String,
    bars: Vec<Bar>,
    logarithmic: bool,
}

const ROW: i32 = 26;
const NAMES: i32 = 190;
const LABELS: i32 = 170;

impl Bars {
    /// Bars from zero.
    pub fn new(title: impl Into<String>, bars: Vec<Bar>) -> Self {
        Self { title: title.into(), bars, logarithmic: false }
    }

    /// As long as the logarithm of their value, from a decade below the least that is positive.
    pub fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    /// Draws panels, one below the other, as SVG.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(panels: &[Self]) -> Result<String, ChartError> {
        let height: u32 = panels.iter().map(Self::height).sum();
        let title = panels.first().map_or("", |panel| &panel.title);
        drawn(title, (WIDTH, height), |root| {
            let mut top = 0;
            for panel in panels {
                panel.paint(root, top)?;
                top += panel.height() as i32;
            }
            Ok(())
        })
    }

    fn height(&self) -> u32 {
        TITLE_HEIGHT + ROW as u32 * self.bars.len() as u32 + 16
    }

    fn paint(&self, area: &DrawingArea<SVGBackend<'_>, Shift>, top: i32) -> Painted {
        let pixels = |x: i32, y: i32| (at(x), at(y));
        area.draw(&Text::new(self.title.as_str(), pixels(14, top + 12), font(18)))?;
        let room = f64::from(WIDTH as i32 - NAMES - LABELS);
        for (i, bar) in self.bars.iter().enumerate() {
            let y = top + TITLE_HEIGHT as i32 + ROW * i as i32;
            area.draw(&Text::new(bar.name.as_str(), pixels(14, y + 4), font(14)))?;
            let end = NAMES + (room * self.share(bar)) as i32;
            let color = COLORS[2].filled();
            let corners = [pixels(NAMES, y), pixels(end, y + ROW - 6)];
            area.draw(&Rectangle::new(corners, color))?;
            area.draw(&Text::new(bar.label.as_str(), pixels(end + 8, y + 4), font(14)))?;
        }
        Ok(())
    }

    /// How long a bar is, from 0 to 1.
    fn share(&self, bar: &Bar) -> f64 {
        let values = self.bars.iter().filter_map(|bar| bar.value).filter(|v| *v > 0.0);
        let most = values.clone().fold(0.0, f64::max);
        let Some(value) = bar.value.filter(|v| *v > 0.0) else { return 0.0 };
        if !self.logarithmic {
            return value / most;
        }
        let low = 0.1 * values.fold(f64::INFINITY, f64::min);
        (value / low).ln() / (most / low).ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_long_as_their_values() {
        let bar = |value| Bar { name: String::new(), value, label: String::new() };
        let bars = [None, Some(0.0), Some(1.0), Some(100.0)].map(bar);
        let plain = Bars::new("", bars.to_vec());
        let logarithmic = plain.clone().logarithmic();
        assert_eq!(bars.each_ref().map(|bar| plain.share(bar)), [0.0, 0.0, 0.01, 1.0]);
        let shares = bars.each_ref().map(|bar| logarithmic.share(bar));
        for (share, expected) in shares.iter().zip([0.0, 0.0, 1.0 / 3.0, 1.0]) {
            assert!((share - expected).abs() < 1e-12, "{shares:?}");
        }
    }
}
