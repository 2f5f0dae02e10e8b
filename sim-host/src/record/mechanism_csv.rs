//! A mechanism's record as CSV.

use crate::mechanism::MechanismSample;
use crate::scene::Mechanism;
use std::io::Write;

/// Writes all samples. Numbers are printed with as many digits as give back the same f64.
///
/// # Errors
/// Those of the writer.
pub fn write_mechanism_csv(
    mechanism: &Mechanism,
    samples: &[MechanismSample],
    to: impl Write,
) -> Result<(), ::csv::Error> {
    let mut writer = ::csv::Writer::from_writer(to);
    let (configuration, momenta) =
        samples.first().map_or((0, 0), |s| (s.configuration.len(), s.momentum.len()));
    writer.write_record(header(mechanism, configuration, momenta))?;
    for sample in samples {
        let numbers = std::iter::once(&sample.time_s)
            .chain(&sample.configuration)
            .chain(&sample.velocity)
            .chain([&sample.energy])
            .chain(&sample.momentum)
            .chain([&sample.constraint]);
        writer.write_record(numbers.map(f64::to_string))?;
    }
    writer.flush()?;
    Ok(())
}

const MOMENTA: [&str; 3] = ["momentum_x_nms", "momentum_y_nms", "momentum_z_nms"];

/// Names of all columns, for so many coordinates and momenta.
fn header(mechanism: &Mechanism, configuration: usize, momenta: usize) -> Vec<String> {
    let (coordinates, momenta): (Vec<String>, &[&str]) = match mechanism {
        Mechanism::RigidBody { .. } => {
            let names = ["q_s", "q_x", "q_y", "q_z"].map(str::to_owned);
            (names.to_vec(), &MOMENTA)
        }
        Mechanism::Pendulum { links, .. } => {
            let point = |k: usize| ["x", "y", "z"].map(|axis| format!("{axis}{}_m", k + 1));
            ((0..links.len()).flat_map(point).collect(), &["momentum_z_nms"])
        }
        Mechanism::Chain { .. } | Mechanism::Multibody(_) | Mechanism::Biped(_) => {
            let names = ["x", "y", "z", "q_s", "q_x", "q_y", "q_z"];
            let bodies = configuration / names.len();
            let body = |k: usize| names.map(|name| format!("{name}{}", k + 1));
            ((0..bodies).flat_map(body).collect(), &MOMENTA[..momenta])
        }
    };
    let rates: Vec<String> = coordinates.iter().map(|name| format!("{name}_per_s")).collect();
    let mut names = vec!["time_s".to_owned()];
    names.extend(coordinates);
    names.extend(rates);
    names.push("energy_j".to_owned());
    names.extend(momenta.iter().map(|name| (*name).to_owned()));
    names.push("constraint".to_owned());
    names
}
