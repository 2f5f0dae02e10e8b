//! Distributions of a field's values, each a map from the unit cube.

use super::normal::{ordinary, quantile};
use libm::{cos, exp, log, sin, sqrt};
use std::f64::consts::TAU;
use toml::Value;

/// How a field's value is distributed.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// All values of a range are equally likely.
    Uniform([f64; 2]),
    /// All magnitudes of a range are equally likely.
    LogUniform([f64; 2]),
    /// Normal, cut to a range if one is given.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
        /// The range that it is cut to.
        within: [f64; 2],
    },
    /// All whole numbers of a range are equally likely.
    Integers([i64; 2]),
    /// All values of a list are equally likely.
    Set(Vec<Value>),
    /// A vector of any direction.
    Direction {
        /// With a third component of 0.
        horizontal: bool,
        /// Range of its length; the scene's own unless said.
        length: Option<[f64; 2]>,
    },
    /// A whole number for a generator of noise; it is no coordinate.
    Seed,
}

impl Distribution {
    /// What its coordinates are called, after the name of its field.
    pub fn coordinates(&self) -> &'static [&'static str] {
        match self {
            Self::Seed => &[],
            Self::Direction { horizontal: true, length: None } => &["azimuth_deg"],
            Self::Direction { horizontal: true, length: Some(_) } => &["azimuth_deg", "length"],
            Self::Direction { horizontal: false, length: None } => {
                &["azimuth_deg", "elevation_deg"]
            }
            Self::Direction { horizontal: false, length: Some(_) } => {
                &["azimuth_deg", "elevation_deg", "length"]
            }
            _ => &[""],
        }
    }

    /// Whether its values have an order, so that far from the middle means far from what is usual.
    pub fn is_ordered(&self) -> bool {
        !matches!(self, Self::Set(_) | Self::Seed)
    }

    /// The number of a coordinate at a place in (0, 1), for people and tables.
    pub fn number(&self, coordinate: usize, u: f64) -> f64 {
        let between = |[low, high]: [f64; 2]| low + u * (high - low);
        match self {
            Self::Uniform(range) => between(*range),
            Self::LogUniform(range) => exp(between(range.map(log))).clamp(range[0], range[1]),
            Self::Normal { mean, deviation, within } => {
                let [low, high] = within.map(|x| share_below((x - mean) / deviation));
                let z = quantile((low + u * (high - low)).clamp(f64::MIN_POSITIVE, 1.0 - 1e-16));
                (mean + deviation * z).clamp(within[0], within[1])
            }
            Self::Integers([low, high]) => {
                let count = (high - low + 1) as f64;
                *low as f64 + (u * count).floor().min(count - 1.0)
            }
            Self::Set(values) => (u * values.len() as f64).floor().min(values.len() as f64 - 1.0),
            Self::Direction { length, .. } => match self.coordinates()[coordinate] {
                "azimuth_deg" => 360.0 * u,
                // The sine of the elevation is uniform on a sphere.
                "elevation_deg" => libm::asin(2.0 * u - 1.0).to_degrees(),
                _ => length.map_or(0.0, between),
            },
            Self::Seed => 0.0,
        }
    }

    /// The value at a place in the unit cube of its coordinates; `own` is the length of the scene's own vector.
    pub fn value(&self, u: &[f64], own: f64) -> Value {
        let number = |coordinate: usize| self.number(coordinate, u[coordinate]);
        match self {
            Self::Integers(_) => Value::Integer(number(0) as i64),
            Self::Set(values) => values[number(0) as usize].clone(),
            Self::Direction { horizontal, length } => {
                let rise = if *horizontal { 0.0 } else { 2.0 * u[1] - 1.0 };
                let last = self.coordinates().len() - 1;
                let size = if length.is_some() { number(last) } else { own };
                let (across, turn) = (sqrt(1.0 - rise * rise), TAU * u[0]);
                let unit = [across * cos(turn), across * sin(turn), rise];
                Value::Array(unit.map(|x| Value::Float(size * x)).to_vec())
            }
            _ => Value::Float(number(0)),
        }
    }

    /// For people: `uniform from 1 to 3`.
    pub fn words(&self) -> String {
        let range = |[low, high]: [f64; 2]| format!("from {low} to {high}");
        match self {
            Self::Uniform(r) => format!("uniform {}", range(*r)),
            Self::LogUniform(r) => format!("log-uniform {}", range(*r)),
            Self::Normal { mean, deviation, within } => {
                let cut = within[0].is_finite() || within[1].is_finite();
                let cut = if cut { format!(", {}", range(*within)) } else { String::new() };
                format!("normal about {mean} with deviation {deviation}{cut}")
            }
            Self::Integers([low, high]) => format!("a whole number from {low} to {high}"),
            Self::Set(values) => {
                let all: Vec<String> = values.iter().map(ToString::to_string).collect();
                format!("one of {}", all.join(", "))
            }
            Self::Direction { horizontal, length } => {
                let which = if *horizontal { "any horizontal direction" } else { "any direction" };
                let long = length.map_or_else(String::new, |r| format!(", length {}", range(r)));
                format!("{which}{long}")
            }
            Self::Seed => "another one for each sample".to_owned(),
        }
    }
}

/// `Φ(z)`, exact at the ends.
fn share_below(z: f64) -> f64 {
    match z {
        f64::INFINITY => 1.0,
        f64::NEG_INFINITY => 0.0,
        z => ordinary(z),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_of_their_ranges() {
        let ends = [1e-9, 0.5, 1.0 - 1e-9];
        let values = |law: &Distribution| ends.map(|u| law.number(0, u));
        assert_eq!(values(&Distribution::Uniform([1.0, 3.0]))[1], 2.0);
        let [low, middle, high] = values(&Distribution::LogUniform([0.1, 10.0]));
        assert!((0.1..0.11).contains(&low) && (9.9..=10.0).contains(&high));
        assert!((middle - 1.0).abs() < 1e-15);
        let within = [0.5, f64::INFINITY];
        let [low, middle, _] = values(&Distribution::Normal { mean: 1.0, deviation: 1.0, within });
        // Half-way between Φ(−0.5) and 1: 1.3968711751 by SciPy 1.16.
        assert!(low >= 0.5 && (middle - 1.396_871_175_1).abs() < 1e-9, "{middle}");
        assert_eq!(values(&Distribution::Integers([-1, 2])), [-1.0, 1.0, 2.0]);
        let set = Distribution::Set(vec![Value::Integer(4), Value::String("a".into())]);
        assert_eq!(set.value(&[0.7], 0.0), Value::String("a".into()));
    }

    #[test]
    fn directions_have_their_length() {
        for (horizontal, length) in
            [(true, None), (false, Some([2.0, 2.5])), (true, Some([0.0, 1.0]))]
        {
            let law = Distribution::Direction { horizontal, length };
            let u = vec![0.3; law.coordinates().len()];
            let Value::Array(vector) = law.value(&u, 7.0) else { panic!("a vector") };
            let squares: f64 = vector.iter().filter_map(Value::as_float).map(|x| x * x).sum();
            let expected = length.map_or(7.0, |[a, b]| a + 0.3 * (b - a));
            assert!((squares.sqrt() - expected).abs() < 1e-15 * expected.max(1.0) * 4.0);
            assert_eq!(vector[2] == Value::Float(0.0), horizontal);
        }
    }
}
