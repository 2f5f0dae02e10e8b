//! The chart of a mechanism's run.

use super::{ChartError, XyChart, XySeries};
use crate::mechanism::MechanismSample;
use crate::scene::Mechanism;
use std::path::{Path, PathBuf};

/// Writes the chart of a run into a folder and returns its path: coordinates, and what should be
/// conserved.
///
/// # Errors
/// [`ChartError`] if it cannot be written.
pub fn write_mechanism_chart(
    folder: &Path,
    scene: &str,
    mechanism: &Mechanism,
    samples: &[MechanismSample],
) -> Result<PathBuf, ChartError> {
    let (names, axis): (Vec<String>, &str) = match mechanism {
        Mechanism::RigidBody { .. } => {
            (["q scalar", "q x", "q y", "q z"].map(str::to_owned).to_vec(), "unit quaternion")
        }
        Mechanism::Pendulum { links, .. } => (last_three(3, links.len()), "last mass (m)"),
        Mechanism::Multibody(all) => {
            (last_three(7, all.bodies.len()), "last body's centre of mass (m)")
        }
        Mechanism::Biped(_) => (["x", "y", "z"].map(str::to_owned).to_vec(), "central body (m)"),
        Mechanism::Chain { links, .. } => (last_three(7, *links), "last rod's centre of mass (m)"),
    };
    let curve = |name: &str, value: &dyn Fn(&MechanismSample) -> f64| {
        XySeries::curve(name, samples.iter().map(|sample| (sample.time_s, value(sample))))
    };
    let coordinates = names
        .iter()
        .enumerate()
        .filter(|(_, name)| !name.is_empty())
        .map(|(i, name)| curve(name, &|sample| sample.configuration[i]))
        .collect();
    let first = samples.first().map_or(0.0, |sample| sample.energy);
    let path = folder.join("motion.svg");
    XyChart::new(format!("{scene}: motion"), "time (s)", axis)
        .with(coordinates)
        .below(
            XyChart::new("Energy, less that of the start", "time (s)", "J")
                .with(vec![curve("energy", &|sample| sample.energy - first)]),
        )
        .draw(&path)?;
    Ok(path)
}

/// Names of the last body's position among all coordinates; those of others are empty.
fn last_three(each: usize, bodies: usize) -> Vec<String> {
    let last = each * (bodies - 1);
    let name = |i: usize| match i.checked_sub(last) {
        Some(k) if k < 3 => ["x", "y", "z"][k].to_owned(),
        _ => String::new(),
    };
    (0..each * bodies).map(name).collect()
}
