//! The record as CSV: one row a tick, one named column a number, units in the names.

use super::Sample;
use std::io::Write;

const LEGS: [&str; 2] = ["left", "right"];
const LEG_JOINTS: [&str; 6] = ["hip_x", "hip_y", "hip_z", "knee", "ankle_x", "ankle_y"];
const CORNERS: [&str; 4] = ["heel_minus_y", "heel_plus_y", "toe_minus_y", "toe_plus_y"];

/// Writes all samples. Numbers are printed with as many digits as give back the same f64.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(samples: &[Sample], to: impl Write) -> Result<(), ::csv::Error> {
    let mut writer = ::csv::Writer::from_writer(to);
    writer.write_record(header())?;
    for sample in samples {
        writer.write_record(row(sample))?;
    }
    writer.flush()?;
    Ok(())
}

fn header() -> Vec<String> {
    let mut names = vec!["time_s".to_owned()];
    let mut add = |list: &[&str]| names.extend(list.iter().map(|name| (*name).to_owned()));
    add(&["x_m", "y_m", "z_m", "q_s", "q_x", "q_y", "q_z"]);
    let joints = |suffix: &str| -> Vec<String> {
        LEGS.iter()
            .flat_map(|leg| LEG_JOINTS.iter().map(move |joint| format!("{leg}_{joint}_{suffix}")))
            .collect()
    };
    names.extend(joints("rad"));
    let mut add = |list: &[&str]| names.extend(list.iter().map(|name| (*name).to_owned()));
    add(&["v_x_mps", "v_y_mps", "v_z_mps", "w_x_radps", "w_y_radps", "w_z_radps"]);
    names.extend(joints("radps"));
    names.extend(joints("nm"));
    let mut add = |list: &[&str]| names.extend(list.iter().map(|name| (*name).to_owned()));
    add(&["desired_f_x_n", "desired_f_y_n", "desired_f_z_n"]);
    add(&["desired_t_x_nm", "desired_t_y_nm", "desired_t_z_nm"]);
    add(&["e_x_m", "e_y_m", "e_z_m", "e_q_s", "e_q_x", "e_q_y", "e_q_z"]);
    add(&["left_foot_n", "right_foot_n", "kinetic_j", "potential_j"]);
    names.extend(
        LEGS.iter()
            .flat_map(|leg| CORNERS.iter().map(move |corner| format!("{leg}_{corner}_state"))),
    );
    names
}

fn row(sample: &Sample) -> Vec<String> {
    let numbers = std::iter::once(&sample.time_s)
        .chain(&sample.positions)
        .chain(&sample.velocities)
        .chain(&sample.torques)
        .chain(&sample.desired_wrench)
        .chain(&sample.position_error)
        .chain(&sample.orientation_error)
        .chain(&sample.foot_forces)
        .chain(&sample.energy);
    let mut fields: Vec<String> = numbers.map(f64::to_string).collect();
    match &sample.contacts {
        Some(contacts) => {
            fields.extend(contacts.iter().flatten().map(|state| state.number().to_string()));
        }
        None => fields.extend(std::iter::repeat_n(String::new(), 8)),
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ContactState;

    #[test]
    fn rows_have_the_headers_columns_and_give_back_the_numbers() {
        let mut sample = Sample {
            time_s: 0.1 + 0.2,
            positions: [1.0 / 3.0; 19],
            velocities: [2.0; 18],
            torques: [3.0; 12],
            desired_wrench: [4.0; 6],
            position_error: [5.0; 3],
            orientation_error: [6.0; 4],
            foot_forces: [7.0; 2],
            contacts: Some([[ContactState::Sticking; 4]; 2]),
            energy: [8.0; 2],
            corner_forces: None,
            block: None,
        };
        let mut bytes = Vec::new();
        write_csv(&[sample], &mut bytes).expect("a vector takes all");
        let text = String::from_utf8(bytes).expect("text");
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(lines.len(), 2);
        assert_eq!(lines[0].len(), lines[1].len());
        assert_eq!(lines[1][0].parse::<f64>().expect("a number"), 0.1 + 0.2);
        let column = |name: &str| lines[0].iter().position(|x| *x == name).expect("a column");
        assert_eq!(lines[1][column("right_knee_nm")], "3");
        assert_eq!(lines[1][column("e_q_s")], "6");
        assert_eq!(lines[1][column("right_toe_plus_y_state")], "4");
        sample.contacts = None;
        assert_eq!(row(&sample).len(), header().len());
    }
}
