//! Where samples lie in the unit cube: each from its number alone, so that any machine can draw any of them.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

/// Coordinates that a point may have: those of the crate's table of direction numbers.
pub const MOST_COORDINATES: usize = sobol_burley::NUM_DIMENSIONS as usize;
/// Points of one Sobol sequence in that crate; the next ones are of another, scrambled independently.
const LENGTH: u64 = 1 << 16;
/// Bits of a coordinate there.
const BITS: i32 = 24;

/// How points are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Sampling {
    /// Sobol's sequence, scrambled as Owen does: each point is uniform, and all together lie more evenly than
    /// independent ones.
    #[default]
    Sobol,
    /// Independent points, as the binomial interval assumes them.
    Random,
}

/// Coordinates of a point, each inside (0, 1).
///
/// # Panics
/// For more than [`MOST_COORDINATES`] under [`Sampling::Sobol`].
pub fn point(sampling: Sampling, seed: u64, number: u64, coordinates: usize) -> Vec<f64> {
    let mut random = generator(seed, number, Stream::Point);
    let coordinate = |k: usize| {
        // Below the last bit of a scrambled coordinate all is equally likely.
        let below: f64 = inside(random.random::<u64>());
        match sampling {
            Sampling::Random => below,
            Sampling::Sobol => {
                let scramble = mixed(seed ^ mixed(number / LENGTH)) as u32;
                let leading = sobol_burley::sample((number % LENGTH) as u32, k as u32, scramble);
                let cells = f64::from(BITS).exp2();
                ((f64::from(leading) * cells).floor() + below) / cells
            }
        }
    };
    (0..coordinates).map(coordinate).map(|u| u.min(1.0 - f64::EPSILON)).collect()
}

/// What a generator is for: streams of one sample do not depend on one another.
#[derive(Clone, Copy, Debug)]
pub enum Stream {
    /// Coordinates.
    Point,
    /// Seeds of noise, by the number of the parameter.
    Seed(u64),
    /// Samples of a search, by its round.
    Round(u64),
}

/// A generator of random numbers that seed, sample and use decide.
pub fn generator(seed: u64, number: u64, stream: Stream) -> Pcg64Mcg {
    let stream = match stream {
        Stream::Point => 0,
        Stream::Seed(parameter) => 1 + (parameter << 1),
        Stream::Round(round) => 2 + (round << 1),
    };
    Pcg64Mcg::seed_from_u64(mixed(mixed(mixed(seed) ^ number) ^ stream))
}

/// Steele, Lea and Flood's finaliser (SplitMix64, OOPSLA 2014): any change of the bits changes half of them.
fn mixed(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A number inside (0, 1), never its ends.
fn inside(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}
