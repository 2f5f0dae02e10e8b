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
    writer.write_record(header(mechanism))?;
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

fn header(mechanism: &Mechanism) -> Vec<String> {
    let (coordinates, momenta): (Vec<String>, &[&str]) = match mechanism {
        Mechanism::RigidBody { .. } => {
            let names = ["q_s", "q_x", "q_y", "q_z"].map(str::to_owned);
            (names.to_vec(), &["momentum_x_nms", "momentum_y_nms", "momentum_z_nms"])
        }
        Mechanism::Pendulum { links, .. } => {
            let point = |k: usize| ["x", "y", "z"].map(|axis| format!("{axis}{}_m", k + 1));
            ((0..links.len()).flat_map(point).collect(), &["momentum_z_nms"])
        }
        Mechanism::Chain { links, floats, gravity_m_s2, .. } => {
            let names = ["x", "y", "z", "q_s", "q_x", "q_y", "q_z"];
            let body = |k: usize| names.map(|name| format!("{name}{}", k + 1));
            let momenta: &[&str] = if *floats && *gravity_m_s2 == 0.0 {
                &["momentum_x_nms", "momentum_y_nms", "momentum_z_nms"]
            } else {
                &[]
            };
            ((0..*links).flat_map(body).collect(), momenta)
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
