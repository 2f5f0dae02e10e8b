//! What a run of a robot has recorded.

use super::recorded::{Details, JointReading, Record};
use super::{Sample, note};
use crate::picture::{Moment, Shown, Tracking};
use crate::robot::{Robot, SharedRobot};
use crate::scene::Scene;
use serde_json::{Value, json};
use surefoot::dynamics::DynamicsFault;

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

/// Columns of the central body as it is estimated, after the word.
const ESTIMATE: [&str; 13] = [
    "x_m",
    "y_m",
    "z_m",
    "q_s",
    "q_x",
    "q_y",
    "q_z",
    "v_x_mps",
    "v_y_mps",
    "v_z_mps",
    "w_x_radps",
    "w_y_radps",
    "w_z_radps",
];

/// What a run of a robot has recorded.
pub struct RobotRecord<'a> {
    shown: Shown,
    robot: SharedRobot,
    samples: &'a [Sample],
    /// Whether its controller knows limits, and whether it walks.
    is_limited: bool,
    walks: bool,
}

impl<'a> RobotRecord<'a> {
    /// Of a scene's run.
    pub fn new(scene: &Scene, samples: &'a [Sample]) -> Self {
        let notes = || samples.iter().filter_map(|sample| sample.note.as_ref());
        Self {
            shown: Shown::of(scene),
            robot: scene.robot(),
            samples,
            is_limited: notes().next().is_some(),
            walks: notes().any(|note| note.capture_point.is_some()),
        }
    }
}

impl Record for RobotRecord<'_> {
    fn shown(&self) -> &Shown {
        &self.shown
    }

    fn times(&self) -> Vec<f64> {
        self.samples.iter().map(|sample| sample.time_s).collect()
    }

    fn columns(&self) -> Vec<String> {
        let mut names = header(&self.robot);
        // Only of runs that have it.
        if self.samples.iter().any(|sample| sample.estimate.is_some()) {
            names.extend(ESTIMATE.iter().map(|name| format!("estimate_{name}")));
        }
        if self.is_limited {
            names.extend(note::LIMITS.iter().chain(&note::PRESSURE).map(|name| (*name).to_owned()));
            let walks = note::CAPTURE.iter().filter(|_| self.walks);
            names.extend(walks.map(|name| (*name).to_owned()));
        }
        names
    }

    fn row(&self, sample: usize) -> Vec<String> {
        let sample = &self.samples[sample];
        let mut fields = row(&self.robot, sample);
        fields.extend(sample.estimate.iter().flatten().map(f64::to_string));
        if self.is_limited {
            fields.extend(note::row(&self.robot, sample, self.walks));
        }
        fields
    }

    fn moment(&self, sample: usize) -> Result<Moment, DynamicsFault> {
        let sample = &self.samples[sample];
        let on_floor = !self.shown.points.is_empty();
        let contacts = sample.contacts.iter().filter(|_| on_floor).flatten().flatten();
        let forces = sample.corner_forces.iter().filter(|_| on_floor).flatten().flatten();
        Ok(Moment {
            poses: self.robot.tree.body_poses(&sample.positions)?,
            contacts: contacts.copied().collect(),
            forces: forces.copied().collect(),
            block: sample.block,
            tracking: Some(Tracking {
                desired_wrench: sample.desired_wrench,
                distance: sample.error_distance(),
                angle: sample.error_angle(),
            }),
        })
    }

    fn joints(&self, sample: usize) -> Vec<JointReading<'_>> {
        let sample = &self.samples[sample];
        let joints = self.robot.joints.iter().enumerate();
        joints
            .map(|(i, name)| JointReading {
                name,
                position: sample.positions[7 + i],
                velocity: sample.velocities[6 + i],
                effort: Some(sample.torques[i]),
            })
            .collect()
    }

    fn details(&self) -> Details {
        let schema = schema(&self.robot);
        Details { topic: "/tracking", schema_name: "surefoot.Tracking", schema }
    }

    fn detail(&self, sample: usize) -> Value {
        message(&self.robot, &self.samples[sample])
    }
}

fn header(robot: &Robot) -> Vec<String> {
    let mut names = vec!["time_s".to_owned()];
    let mut add = |list: &[&str]| names.extend(list.iter().map(|name| (*name).to_owned()));
    add(&["x_m", "y_m", "z_m", "q_s", "q_x", "q_y", "q_z"]);
    let joints = |suffix: &str| -> Vec<String> {
        robot.columns.iter().map(|joint| format!("{joint}_{suffix}")).collect()
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
    names.extend(robot.feet.iter().map(|foot| format!("{}_n", foot.column)));
    names.extend(["kinetic_j", "potential_j"].map(str::to_owned));
    let points = || robot.feet.iter().flat_map(|foot| &foot.points);
    names.extend(points().map(|point| format!("{}_state", point.column)));
    for point in points() {
        names.extend(AXES.iter().map(|axis| format!("{}_f_{axis}_n", point.column)));
    }
    names.extend(BLOCK.iter().map(|name| (*name).to_owned()));
    names
}

fn row(robot: &Robot, sample: &Sample) -> Vec<String> {
    let points: usize = robot.points_of_feet().iter().sum();
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
        None => fields.extend(std::iter::repeat_n(String::new(), points)),
    }
    let forces = sample.corner_forces.iter().flatten().flatten().flatten();
    fields.extend(forces.map(f64::to_string));
    if sample.corner_forces.is_none() {
        fields.extend(std::iter::repeat_n(String::new(), 3 * points));
    }
    match &sample.block {
        Some(block) => {
            fields.extend(block.pose.iter().chain(&block.force).map(f64::to_string));
        }
        None => fields.extend(std::iter::repeat_n(String::new(), BLOCK.len())),
    }
    fields
}

/// Errors and forces of a sample.
fn message(robot: &Robot, sample: &Sample) -> Value {
    let vector = |[x, y, z]: [f64; 3]| json!({ "x": x, "y": y, "z": z });
    let [fx, fy, fz, tx, ty, tz] = sample.desired_wrench;
    let mut message = json!({
        "position_error_m": vector(sample.position_error),
        "distance_m": sample.error_distance(),
        "angle_rad": sample.error_angle(),
        "desired_force_n": vector([fx, fy, fz]),
        "desired_torque_nm": vector([tx, ty, tz]),
        "kinetic_j": sample.energy[0],
        "potential_j": sample.energy[1],
    });
    for (foot, force) in robot.feet.iter().zip(&sample.foot_forces) {
        message[format!("{}_n", foot.column)] = json!(force);
    }
    message
}

/// The JSON schema of [`message`].
fn schema(robot: &Robot) -> Value {
    let number = json!({ "type": "number" });
    let vector = json!({
        "type": "object",
        "properties": { "x": number, "y": number, "z": number },
    });
    let mut schema = json!({
        "type": "object",
        "title": "surefoot.Tracking",
        "properties": {
            "position_error_m": vector,
            "distance_m": number,
            "angle_rad": number,
            "desired_force_n": vector,
            "desired_torque_nm": vector,
            "kinetic_j": number,
            "potential_j": number,
        },
    });
    for foot in &robot.feet {
        schema["properties"][format!("{}_n", foot.column)] = number.clone();
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::BlockSample;
    use crate::record::{NotedLimit, TickNote, write_csv};
    use crate::robot::biped;
    use crate::scene::Outline;
    use crate::scene::load;
    use surefoot_multibody::contact::ContactState;

    #[test]
    fn rows_have_the_headers_columns_and_give_back_the_numbers() {
        let mut sample = Sample {
            time_s: 0.1 + 0.2,
            positions: vec![1.0 / 3.0; 19],
            velocities: vec![2.0; 18],
            torques: vec![3.0; 12],
            desired_wrench: [4.0; 6],
            position_error: [5.0; 3],
            orientation_error: [6.0; 4],
            foot_forces: vec![7.0; 2],
            contacts: Some(vec![vec![ContactState::Sticking; 4]; 2]),
            energy: [8.0; 2],
            corner_forces: Some(vec![vec![[9.0, 10.0, 11.0]; 4]; 2]),
            block: Some(BlockSample { pose: [12.0; 7], force: [13.0; 3] }),
            estimate: Some([14.0; 13]),
            note: Some(TickNote {
                limit: Some(NotedLimit { limit: "slip", of: "left leg".to_owned(), relief: 15.0 }),
                work: Some(16),
                capture_point: Some([17.0, 18.0]),
            }),
        };
        let robot = biped(Outline::A);
        let shown = Shown::of(&load("experiment-1").expect("a built-in scene"));
        let mut bytes = Vec::new();
        let samples = std::slice::from_ref(&sample);
        let record = RobotRecord {
            shown: shown.clone(),
            robot: robot.clone(),
            samples,
            is_limited: true,
            walks: true,
        };
        write_csv(&record, &mut bytes).expect("a vector takes all");
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
        assert_eq!(lines[1][column("estimate_w_z_radps")], "14");
        assert_eq!(lines[1][column("limit")], "slip");
        assert_eq!(lines[1][column("limit_of")], "left leg");
        assert_eq!(lines[1][column("solver_work")], "16");
        // 3 N·m of the 100 of the weakest motor.
        assert_eq!(lines[1][column("torque_share")], (3.0_f64 / 100.0).to_string());
        assert_eq!(lines[1][column("capture_y_m")], "18");
        sample.contacts = None;
        sample.corner_forces = None;
        sample.block = None;
        assert_eq!(row(&robot, &sample).len(), header(&robot).len());
    }
}
