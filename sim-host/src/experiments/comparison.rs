//! One printed figure and ours.

use serde::Serialize;

/// One printed figure and ours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// What is compared.
    pub figure: String,
    /// Unit.
    pub unit: &'static str,
    /// What the run gives; `None` where what is compared did not happen in it.
    pub ours: Option<f64>,
    /// What the text prints.
    pub printed: f64,
    /// `ours/printed − 1`; of no meaning where zero is printed, or where there is none of ours.
    pub relative_difference: Option<f64>,
    /// How close ours should be, if something is asked for.
    pub asked: Option<Asked>,
    /// Whether it is.
    pub met: Option<bool>,
}

/// How close a figure should be to the printed one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Asked {
    /// Equal, when rounded to so many digits.
    PrintedDigits(usize),
    /// A relative difference of at most this.
    Relative(f64),
    /// Below this, where zero is printed.
    Absolute(f64),
}

impl Comparison {
    pub(super) fn new(
        figure: impl Into<String>,
        unit: &'static str,
        ours: impl Into<Option<f64>>,
        printed: f64,
    ) -> Self {
        let ours = ours.into();
        let relative_difference = ours.filter(|_| printed != 0.0).map(|ours| ours / printed - 1.0);
        Self {
            figure: figure.into(),
            unit,
            ours,
            printed,
            relative_difference,
            asked: None,
            met: None,
        }
    }

    /// Ours for people, or that it did not happen: times to milliseconds, all else to a decimal.
    pub fn ours_text(&self) -> String {
        match self.ours {
            None => "none".to_owned(),
            Some(time) if self.unit == "s" => format!("{time:.3} s"),
            Some(value) => format!("{value:.1} {}", self.unit),
        }
    }

    pub(super) fn asked(self, asked: Asked) -> Self {
        let met = match asked {
            Asked::PrintedDigits(digits) => {
                let places = digits.saturating_sub(1);
                let rounded = |x: f64| format!("{x:.places$e}");
                self.ours.map(rounded) == Some(rounded(self.printed))
            }
            Asked::Relative(limit) => self.relative_difference.is_some_and(|d| d.abs() <= limit),
            Asked::Absolute(limit) => {
                self.ours.is_some_and(|ours| (ours - self.printed).abs() <= limit)
            }
        };
        Self { asked: Some(asked), met: Some(met), ..self }
    }
}
