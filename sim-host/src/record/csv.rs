//! The record as CSV: one row a tick, one named column a number, units in the names.

use super::Sample;
use std::io::Write;

const LEGS: [&str; 2] = ["left", "right"];
const LEG_JOINTS: [&str; 6] = ["hip_x", "hip_y", "hip_z", "knee", "ankle_x", "ankle_y"];
const CORNERS: [&str; 4] = ["heel_minus_y", "heel_plus_y", "toe_minus_y", "toe_plus_y"];

const AXES: [&str; 3] = ["x", "y", "z"];
const BLOCK: [&str; 10] = [
    "block_x_m",
    "block_y_m",
    "block_z_m",
    "block_q_s",
    "block_q_x",
    "block_q_y",
    "block_q_z",
    "block_f_x_n",
    "block_f_y_n",
    "block_f_z_n",
];

/// Writes all samples. Columns of what a run has not, such as a block, are empty. Numbers are printed with as many digits as give back the same f64.
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
    for leg in LEGS {
        for corner in CORNERS {
            names.extend(AXES.iter().map(|axis| format!("{leg}_{corner}_f_{axis}_n")));
        }
    }
    names.extend(BLOCK.iter().map(|name| (*name).to_owned()));
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
    let forces = sample.corner_forces.iter().flatten().flatten().flatten();
    fields.extend(forces.map(f64::to_string));
    if sample.corner_forces.is_none() {
        fields.extend(std::iter::repeat_n(String::new(), 24));
    }
    match &sample.block {
        Some(block) => {
            fields.extend(block.pose.iter().chain(&block.force).map(f64::to_string));
        }
        None => fields.extend(std::iter::repeat_n(String::new(), BLOCK.len())),
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ContactState;
    use crate::plant::BlockSample;

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
            corner_forces: Some([[[9.0, 10.0, 11.0]; 4]; 2]),
            block: Some(BlockSample { pose: [12.0; 7], force: [13.0; 3] }),
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
        assert_eq!(lines[1][column("right_toe_plus_y_f_z_n")], "11");
        assert_eq!(lines[1][column("block_q_z")], "12");
        assert_eq!(lines[1][column("block_f_x_n")], "13");
        sample.contacts = None;
        sample.corner_forces = None;
        sample.block = None;
        assert_eq!(row(&sample).len(), header().len());
    }
}
