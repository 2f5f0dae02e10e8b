//! The figures of a robot's run: those of §4.3, and what they leave out.

use super::marks::marks;
use super::{ChartError, Panel, Series, TimeSeries};
use surefoot_sim::record::{Event, Sample};
use surefoot_sim::robot::Robot;

/// A figure that can be drawn of any run.
#[derive(Clone, Copy, Debug)]
pub struct RunFigure {
    /// Name of its file, without the ending.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    panels: fn(&Robot, &[Sample]) -> Vec<Panel>,
}

/// All figures of a run. The first eight are those of each experiment of §4.3, in the text's order.
pub const RUN_FIGURES: [RunFigure; 10] = [
    RunFigure { name: "joint-angles", title: "joint angles", panels: joint_angles },
    RunFigure { name: "joint-torques", title: "joint torques", panels: joint_torques },
    RunFigure { name: "body-position", title: "body position", panels: body_position },
    RunFigure { name: "body-orientation", title: "body orientation", panels: body_orientation },
    RunFigure { name: "position-error", title: "body position error", panels: position_error },
    RunFigure {
        name: "orientation-error",
        title: "body orientation error",
        panels: orientation_error,
    },
    RunFigure { name: "desired-force", title: "desired body force", panels: desired_force },
    RunFigure { name: "desired-torque", title: "desired body torque", panels: desired_torque },
    RunFigure { name: "tracking-errors", title: "tracking errors", panels: tracking_errors },
    RunFigure { name: "ground-forces", title: "forces of the ground", panels: ground_forces },
];

/// Of runs whose controller knows limits.
pub const LIMIT_FIGURES: [RunFigure; 1] =
    [RunFigure { name: "limits", title: "limits of ground and motors", panels: limits }];

impl RunFigure {
    /// Draws it as SVG; `of` names the run.
    ///
    /// # Errors
    /// [`ChartError`] if it cannot be drawn.
    pub fn svg(
        &self,
        of: &str,
        robot: &Robot,
        samples: &[Sample],
        events: &[Event],
    ) -> Result<String, ChartError> {
        let times: Vec<f64> = samples.iter().map(|sample| sample.time_s).collect();
        TimeSeries {
            title: format!("{of}: {}", self.title),
            times: &times,
            panels: (self.panels)(robot, samples),
            marks: &marks(events),
        }
        .svg()
    }
}

fn series(samples: &[Sample], name: impl Into<String>, value: impl Fn(&Sample) -> f64) -> Series {
    Series { name: name.into(), values: samples.iter().map(value).collect() }
}

fn panel(title: &str, axis: &str, series: Vec<Series>) -> Panel {
    Panel { title: title.to_owned(), axis: axis.to_owned(), series }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Components `first` to `last` of a vector along the axes.
fn along(
    samples: &[Sample],
    range: std::ops::RangeInclusive<usize>,
    of: fn(&Sample, usize) -> f64,
) -> Vec<Series> {
    range.map(|i| series(samples, AXES[i], move |sample| of(sample, i))).collect()
}

/// The same about the axes.
fn about(
    samples: &[Sample],
    range: std::ops::RangeInclusive<usize>,
    of: fn(&Sample, usize) -> f64,
) -> Vec<Series> {
    let name = |i: usize| format!("about {}", AXES[i]);
    range.map(|i| series(samples, name(i), move |sample| of(sample, i))).collect()
}

/// One panel a leg, with a curve for each of its joints, and one for all other joints.
fn legs(
    robot: &Robot,
    samples: &[Sample],
    (what, unit): (&str, &str),
    of: fn(&Sample, usize) -> f64,
) -> Vec<Panel> {
    let of_leg = |(leg, name): (usize, &String)| {
        let own = robot.leg_joints.get(leg).map_or(&[][..], Vec::as_slice);
        let curves = own.iter().map(|i| {
            let (i, joint) = (*i, robot.joints[*i].as_str());
            let joint = joint.trim_start_matches("left ").trim_start_matches("right ");
            series(samples, joint, move |sample| of(sample, i))
        });
        panel(&format!("{}, {what}", capitalised(name)), unit, curves.collect())
    };
    let mut panels: Vec<Panel> = robot.legs.iter().enumerate().map(of_leg).collect();
    let others = (0..robot.joint_count()).filter(|i| robot.leg_of(i + 1).is_none());
    let others: Vec<_> =
        others.map(|i| series(samples, &robot.joints[i], move |sample| of(sample, i))).collect();
    if !others.is_empty() {
        panels.push(panel(&format!("Other joints, {what}"), unit, others));
    }
    panels
}

/// With a capital at its beginning.
fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn joint_angles(robot: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let angle = |sample: &Sample, i: usize| sample.positions[7 + i].to_degrees();
    legs(robot, samples, ("joint angles", "degrees"), angle)
}

fn joint_torques(robot: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let torque = |sample: &Sample, i: usize| sample.torques[i];
    legs(robot, samples, ("joint torques", "N·m"), torque)
}

fn body_position(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let centimetres = |sample: &Sample, i: usize| 1e2 * sample.positions[i];
    vec![
        panel("Centre of mass, world frame: x, y", "cm", along(samples, 0..=1, centimetres)),
        panel("Centre of mass, world frame: height", "cm", along(samples, 2..=2, centimetres)),
    ]
}

fn body_orientation(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let vector = |sample: &Sample, i: usize| sample.positions[4 + i];
    let scalar = series(samples, "scalar", |sample| sample.positions[3]);
    vec![
        panel("Unit quaternion, world from body: vector part", "", along(samples, 0..=2, vector)),
        panel("Unit quaternion, world from body: scalar part", "", vec![scalar]),
    ]
}

fn position_error(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let centimetres = |sample: &Sample, i: usize| 1e2 * sample.position_error[i];
    vec![
        panel("Position error, world frame: x, y", "cm", along(samples, 0..=1, centimetres)),
        panel("Position error, world frame: height", "cm", along(samples, 2..=2, centimetres)),
    ]
}

fn orientation_error(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let vector = |sample: &Sample, i: usize| sample.orientation_error[1 + i];
    // Near the set point the scalar part is 1 less something that only a finer scale shows.
    let scalar =
        series(samples, "1 − scalar", |sample| 1e3 * (1.0 - sample.orientation_error[0]));
    vec![
        panel("Error quaternion: vector part", "", along(samples, 0..=2, vector)),
        panel("Error quaternion: 1 less the scalar part", "thousandths", vec![scalar]),
    ]
}

fn desired_force(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let force = |sample: &Sample, i: usize| sample.desired_wrench[i];
    vec![
        panel("Desired force on body 1, body frame: x, y", "N", along(samples, 0..=1, force)),
        panel("Desired force on body 1, body frame: z", "N", along(samples, 2..=2, force)),
    ]
}

fn desired_torque(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let torque = |sample: &Sample, i: usize| sample.desired_wrench[3 + i];
    vec![
        panel("Desired torque on body 1, body frame: x, y", "N·m", about(samples, 0..=1, torque)),
        panel("Desired torque on body 1, body frame: z", "N·m", about(samples, 2..=2, torque)),
    ]
}

fn tracking_errors(_: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let millimetres = |sample: &Sample, i: usize| 1e3 * sample.position_error[i];
    let degrees = |sample: &Sample, i: usize| {
        // The vector part is sin(θ/2) times the axis.
        let half = sample.error_angle() / 2.0;
        let scale = if half.sin() > 1e-12 { 2.0 * half / half.sin() } else { 2.0 };
        (scale * sample.orientation_error[1 + i]).to_degrees()
    };
    vec![
        panel("Position error, world frame", "mm", along(samples, 0..=2, millimetres)),
        panel(
            "Rotation vector of the orientation error",
            "degrees",
            about(samples, 0..=2, degrees),
        ),
    ]
}

fn ground_forces(robot: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let feet = || robot.feet.iter().enumerate();
    let vertical = feet()
        .map(|(i, foot)| series(samples, &foot.name, move |sample| sample.foot_forces[i]))
        .collect();
    let mut panels = vec![panel("Vertical force of the ground on each foot", "N", vertical)];
    if samples.iter().any(|sample| sample.corner_forces.is_some()) {
        let horizontal = feet()
            .map(|(i, foot)| series(samples, &foot.name, move |s| friction_force(s, i)))
            .collect();
        panels.push(panel("Horizontal force of the ground on each foot", "N", horizontal));
    }
    if samples.iter().any(|sample| sample.block.is_some()) {
        let force = |sample: &Sample, i: usize| sample.block.map_or(0.0, |block| -block.force[i]);
        let force = along(samples, 0..=2, force);
        panels.push(panel("Force of the block on the body, world frame", "N", force));
    }
    panels
}

/// How near motors come to their limits, which limit of the ground binds, and what the program took.
fn limits(robot: &Robot, samples: &[Sample]) -> Vec<Panel> {
    let share = |sample: &Sample, joints: &[usize]| {
        let shares =
            joints.iter().map(|i| sample.torques[*i].abs() / robot.limits.joints[*i].torque);
        100.0 * shares.fold(0.0, f64::max)
    };
    let of_leg = |(leg, name): (usize, &String)| {
        let own = robot.leg_joints.get(leg).map_or(&[][..], Vec::as_slice);
        series(samples, name, move |sample| share(sample, own))
    };
    let torques = robot.legs.iter().enumerate().map(of_leg).collect();
    let binds = |sample: &Sample, word: &str| {
        let limit = sample.note.as_ref().and_then(|note| note.limit.as_ref());
        limit.filter(|limit| limit.limit == word).map_or(f64::NAN, |limit| limit.relief)
    };
    let words = ["slip", "tip", "twist", "lift", "press", "torque"];
    let is_met = |word: &&str| samples.iter().any(|sample| binds(sample, word).is_finite());
    let met = words.into_iter().filter(is_met);
    let met: Vec<_> = met.map(|word| series(samples, word, |s| binds(s, word))).collect();
    let mut panels = vec![panel("Largest torque over its limit, by leg", "%", torques)];
    if !met.is_empty() {
        panels.push(panel("The limit that costs most, by what it costs", "relief", met));
    }
    let work = |sample: &Sample| {
        let work = sample.note.as_ref().and_then(|note| note.work);
        work.map_or(f64::NAN, |work| 1e-3 * f64::from(work))
    };
    if samples.iter().any(|sample| work(sample).is_finite()) {
        let work = vec![series(samples, "work", work)];
        panels.push(panel("Work of the program within limits", "1000 multiplications", work));
    }
    panels
}

/// Size of the horizontal force of the ground on a foot, N.
fn friction_force(sample: &Sample, foot: usize) -> f64 {
    let Some(forces) = &sample.corner_forces else { return f64::NAN };
    let (x, y) = forces[foot].iter().fold((0.0, 0.0), |(x, y), force| (x + force[0], y + force[1]));
    f64::hypot(x, y)
}
