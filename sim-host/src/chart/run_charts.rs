//! The charts of one run.

use super::{ChartError, Panel, Series, draw};
use crate::record::{JOINTS, Sample};
use std::path::{Path, PathBuf};

/// Writes the charts of a run into a folder and returns their paths: body, joints, forces.
///
/// # Errors
/// [`ChartError`] if one cannot be written.
pub fn write_charts(
    folder: &Path,
    scene: &str,
    samples: &[Sample],
) -> Result<Vec<PathBuf>, ChartError> {
    let times: Vec<f64> = samples.iter().map(|sample| sample.time_s).collect();
    let charts = [
        ("body.svg", "central body", body(samples)),
        ("errors.svg", "tracking errors", errors(samples)),
        ("joints.svg", "joints", joints(samples)),
        ("forces.svg", "forces", forces(samples)),
    ];
    charts
        .into_iter()
        .map(|(file, what, panels)| {
            let path = folder.join(file);
            draw(&path, &format!("{scene}: {what}"), &times, &panels)?;
            Ok(path)
        })
        .collect()
}

fn series(samples: &[Sample], name: impl Into<String>, value: impl Fn(&Sample) -> f64) -> Series {
    Series { name: name.into(), values: samples.iter().map(value).collect() }
}

fn panel(title: &str, axis: &str, series: Vec<Series>) -> Panel {
    Panel { title: title.to_owned(), axis: axis.to_owned(), series }
}

const AXES: [&str; 3] = ["x", "y", "z"];

fn body(samples: &[Sample]) -> Vec<Panel> {
    let position = (0..3).map(|i| series(samples, AXES[i], move |s| s.positions[i])).collect();
    let names = ["q scalar", "q x", "q y", "q z"];
    let orientation =
        (0..4).map(|i| series(samples, names[i], move |s| s.positions[3 + i])).collect();
    vec![
        panel("Position of the central body's centre of mass, world frame", "m", position),
        panel("Orientation, world from body (unit quaternion)", "", orientation),
    ]
}

fn errors(samples: &[Sample]) -> Vec<Panel> {
    let position =
        (0..3).map(|i| series(samples, AXES[i], move |s| 1e3 * s.position_error[i])).collect();
    let orientation = (0..3)
        .map(|i| {
            series(samples, format!("about {}", AXES[i]), move |s| {
                // The vector part is sin(θ/2) times the axis.
                let half = s.error_angle() / 2.0;
                let scale = if half.sin() > 1e-12 { 2.0 * half / half.sin() } else { 2.0 };
                (scale * s.orientation_error[1 + i]).to_degrees()
            })
        })
        .collect();
    vec![
        panel("Position error", "mm", position),
        panel("Orientation error (rotation vector), world frame", "degrees", orientation),
    ]
}

fn joints(samples: &[Sample]) -> Vec<Panel> {
    let leg = |side: usize, scale: f64, of: fn(&Sample, usize) -> f64| -> Vec<Series> {
        (6 * side..6 * side + 6)
            .map(|i| {
                let name = JOINTS[i].trim_start_matches("left ").trim_start_matches("right ");
                series(samples, name, move |s| scale * of(s, i))
            })
            .collect()
    };
    let degrees = 1f64.to_degrees();
    vec![
        panel("Left leg, joint angles", "degrees", leg(0, degrees, |s, i| s.positions[7 + i])),
        panel("Right leg, joint angles", "degrees", leg(1, degrees, |s, i| s.positions[7 + i])),
        panel("Left leg, joint torques", "N·m", leg(0, 1.0, |s, i| s.torques[i])),
        panel("Right leg, joint torques", "N·m", leg(1, 1.0, |s, i| s.torques[i])),
    ]
}

fn forces(samples: &[Sample]) -> Vec<Panel> {
    let force = (0..3).map(|i| series(samples, AXES[i], move |s| s.desired_wrench[i])).collect();
    let torque = (0..3)
        .map(|i| series(samples, format!("about {}", AXES[i]), move |s| s.desired_wrench[3 + i]))
        .collect();
    let feet = ["left", "right"];
    let ground = (0..2).map(|i| series(samples, feet[i], move |s| s.foot_forces[i])).collect();
    vec![
        panel("Desired force on the central body, body frame", "N", force),
        panel("Desired torque on the central body, body frame", "N·m", torque),
        panel("Vertical force of the ground on each foot", "N", ground),
    ]
}
